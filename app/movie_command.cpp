#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "interrupt.h"
#include "progress.h"
#include "render/qt_session.h"
#include "render/still.h"
#include "run_folder.h"
#include "usage_error.h"

#include <QProcess>
#include <QStandardPaths>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

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

/// A film that ffmpeg makes. The file appears whole or not at all.
class Encoder : public Film {
public:
  Encoder(const QString& program, fs::path file, const MovieOptions& options)
      : file_(std::move(file)), part_(file_.string() + ".part") {
    const bool webm = file_.extension() == ".webm";
    const QStringList codec =
        webm ? QStringList{"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-f", "webm"}
             : QStringList{"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"};
    process_.setProcessChannelMode(QProcess::SeparateChannels);
    process_.setStandardOutputFile(QProcess::nullDevice());
    process_.start(program,
                   QStringList{"-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s",
                               QString("%1x%2").arg(options.width).arg(options.height), "-r",
                               QString::number(options.rate), "-i", "-", "-pix_fmt", "yuv420p"} +
                       codec + QStringList{QString::fromStdString(part_.string())});
    if (!process_.waitForStarted()) fail("ffmpeg could not be started");
  }
  ~Encoder() override {
    process_.kill();
    process_.waitForFinished();
    std::error_code ignored;
    fs::remove(part_, ignored);
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
    std::error_code error;
    fs::rename(part_, file_, error);
    if (error) fail(error.message());
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

  fs::path file_, part_;
  QProcess process_;
};

/// By ffmpeg where it is installed; if not, or if the output is neither .mp4 nor .webm, as pictures
/// in a folder, whose name `output` then is.
std::unique_ptr<Film> film_for(fs::path& output, const MovieOptions& options) {
  const bool video = output.extension() == ".mp4" || output.extension() == ".webm";
  const QString program = QStandardPaths::findExecutable("ffmpeg");
  if (video && !program.isEmpty()) return std::make_unique<Encoder>(program, output, options);
  if (video) {
    std::fputs("lamella: ffmpeg is not installed (Debian: ffmpeg); pictures instead of a movie\n",
               stderr);
    output.replace_extension();
  }
  return std::make_unique<Pictures>(output);
}

void check(const MovieOptions& options) {
  if (options.width % 2 != 0 || options.height % 2 != 0)
    throw UsageError("--width, --height: movies need even numbers of pixels");
}

} // namespace

int movie(const MovieOptions& options) {
  check(options);
  require_run(options.folder);
  watch_for_interrupt();
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
