#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "interrupt.h"
#include "output_folder.h"
#include "progress.h"
#include "render/qt_session.h"
#include "render/still.h"
#include "run_contents.h"
#include "store/new_file.h"
#include "usage_error.h"

#include <QProcess>
#include <QStandardPaths>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <unistd.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// What is done with the pictures of a movie.
class Film {
public:
  virtual ~Film() = default;
  /// Throw StoreError.
  virtual void add(const render::Picture& picture) = 0;
  virtual void end() = 0;
};

/// Pictures in a folder, frame_0000.png and so on.
class Pictures : public Film {
public:
  explicit Pictures(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error)
      throw StoreError(
          fmt::format("{}: cannot be used as a folder: {}", folder_.string(), error.message()));
  }
  void add(const render::Picture& picture) override {
    render::write_png(folder_ / fmt::format("frame_{:04}.png", count_++), picture);
  }
  void end() override {}

private:
  fs::path folder_;
  int count_ = 0;
};

/// What an ending stands for: the form of the file, and encoders of ffmpeg that can write it, the
/// best first, with their options. Not every ffmpeg has all of them.
struct Format {
  std::string_view ending;
  const char* muxer;
  struct Encoder {
    const char* name;
    QStringList options;
  };
  std::vector<Encoder> encoders;
};

const std::vector<Format>& formats() {
  const QStringList yuv{"-pix_fmt", "yuv420p"}, mpeg4 = yuv + QStringList{"-q:v", "2"},
                                                fast{"-movflags", "+faststart"};
  static const std::vector<Format> all{
      {".mp4",
       "mp4",
       {{"libx264", yuv + QStringList{"-crf", "18"} + fast},
        {"libopenh264", yuv + QStringList{"-b:v", "8M"} + fast},
        {"mpeg4", mpeg4 + fast}}},
      {".webm",
       "webm",
       {{"libvpx-vp9", yuv + QStringList{"-crf", "28", "-b:v", "0"}},
        {"libvpx", yuv + QStringList{"-crf", "10", "-b:v", "8M"}}}},
      {".avi", "avi", {{"mpeg4", mpeg4 + QStringList{"-vtag", "xvid"}}}},
      {".gif", "gif", {{"gif", {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"}}}},
  };
  return all;
}

/// The format of a file by its ending; nothing for a folder of pictures. Throws UsageError.
const Format* format_of(const fs::path& output) {
  std::string ending = output.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = std::ranges::find(formats(), ending, &Format::ending);
  if (found != formats().end()) return &*found;
  std::error_code ignored;
  if (ending.empty() || fs::is_directory(output, ignored)) return nullptr;
  throw UsageError(
      fmt::format("--output {}: movies end in .mp4, .webm, .avi or .gif; a name without "
                  "an ending is a folder for pictures",
                  output.string()));
}

/// The best encoder that this ffmpeg has for a format. Throws StoreError where it has none.
const Format::Encoder& encoder_for(const QString& ffmpeg, const Format& format) {
  QProcess process;
  process.start(ffmpeg, {"-hide_banner", "-encoders"});
  process.waitForFinished(-1);
  const QString list = QString::fromUtf8(process.readAllStandardOutput());
  std::vector<std::string> names;
  for (const Format::Encoder& encoder : format.encoders) {
    if (list.contains(QString(" %1 ").arg(encoder.name))) return encoder;
    names.push_back(encoder.name);
  }
  throw StoreError(
      fmt::format("{} movies need an encoder that this ffmpeg does not have ({}); choose "
                  "another ending, or pictures: -o FOLDER",
                  format.ending, fmt::join(names, " or ")));
}

/// A film that ffmpeg makes. The file appears whole or not at all.
class Encoder : public Film {
public:
  Encoder(const QString& program, const Format& format, fs::path file, const MovieOptions& options)
      : file_(std::move(file)), part_(Place(file_)) {
    const Format::Encoder& encoder = encoder_for(program, format);
    process_.setProcessChannelMode(QProcess::SeparateChannels);
    process_.setStandardOutputFile(QProcess::nullDevice());
    process_.start(
        program,
        QStringList{"-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s",
                    QString("%1x%2").arg(options.width).arg(options.height), "-r",
                    QString::number(options.rate), "-i", "-", "-c:v", encoder.name} +
            encoder.options +
            // the file that is open here, whatever the bytes of its name
            QStringList{"-f", format.muxer,
                        QString("file:/proc/%1/fd/%2").arg(::getpid()).arg(part_.descriptor())});
    if (!process_.waitForStarted()) fail("ffmpeg could not be started");
  }
  ~Encoder() override {
    process_.kill();
    process_.waitForFinished();
  }
  void add(const render::Picture& picture) override {
    process_.write(reinterpret_cast<const char*>(picture.pixels.data()),
                   qint64(picture.pixels.size() * sizeof(render::Color)));
    while (process_.bytesToWrite() > 0)
      if (!process_.waitForBytesWritten(-1)) fail(complaint());
  }
  void end() override {
    process_.closeWriteChannel();
    process_.waitForFinished(-1);
    if (process_.exitStatus() != QProcess::NormalExit || process_.exitCode() != 0)
      fail(complaint());
    part_.put_in_place();
  }

private:
  [[noreturn]] void fail(const std::string& why) const {
    throw StoreError(fmt::format("{}: the movie could not be made: {}", file_.string(), why));
  }
  std::string complaint() {
    process_.waitForFinished();
    const QString said = QString::fromUtf8(process_.readAllStandardError()).trimmed();
    return said.isEmpty() ? "ffmpeg ended" : said.section('\n', -1).toStdString();
  }

  fs::path file_;
  NewFile part_;
  QProcess process_;
};

/// By ffmpeg where it is installed; if not, or if the output has no ending, as pictures in a
/// folder, whose name `output` then is.
std::unique_ptr<Film> film_for(fs::path& output, const MovieOptions& options) {
  const Format* format = format_of(output);
  const QString program = QStandardPaths::findExecutable("ffmpeg");
  if (format && !program.isEmpty())
    return std::make_unique<Encoder>(program, *format, output, options);
  if (format) {
    std::fputs("lamella: ffmpeg is not installed (Debian: ffmpeg); pictures instead of a movie\n",
               stderr);
    output.replace_extension();
  }
  return std::make_unique<Pictures>(output);
}

void check(const MovieOptions& options) {
  if (options.width % 2 != 0 || options.height % 2 != 0)
    throw UsageError("--width, --height: movies need even numbers of pixels");
  format_of(options.output);
}

} // namespace

int movie(const MovieOptions& options) {
  check(options);
  require_run(options.folder);
  const Folder held = hold_run(options.folder);
  render::Studio studio(options.backend);
  render::begin_qt();
  const render::StoredStates run(options.folder);
  std::vector<render::Surface> surfaces;
  for (const SeriesEntry& frame : run.frames())
    surfaces.push_back(extract_surface(run.at(frame.time), options.view.color));
  const render::Still still(surfaces, options.view, options.turn != 0);

  fs::path output = options.output.empty() ? options.folder / "movie.mp4" : options.output;
  const auto film = film_for(output, options);
  const int count = std::max(2, int(std::lround(options.seconds * options.rate)));
  const double begin = surfaces.front().time, end = surfaces.back().time;
  std::optional<std::size_t> shown; // of the surfaces, in the last picture
  render::Picture picture;
  for (int n = 0; n < count; ++n) {
    if (interrupt_requested()) return interrupted;
    const double share = double(n) / (count - 1), time = std::lerp(begin, end, share);
    const auto nearest = std::ranges::min_element(
        surfaces, {}, [&](const render::Surface& s) { return std::abs(s.time - time); });
    const auto now = std::size_t(nearest - surfaces.begin());
    if (shown != now || options.turn != 0)
      picture = still.draw(*nearest, studio, options.width, options.height, options.turn * share);
    shown = now;
    film->add(picture);
  }
  film->end();
  say(fmt::format("{}\n", output.string()));
  return success;
}

} // namespace lamella
