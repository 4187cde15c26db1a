#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "figures/figure_page.h"
#include "find_scene.h"
#include "interrupt.h"
#include "nearest.h"
#include "output_folder.h"
#include "progress.h"
#include "run_queue.h"
#include "store/atomic_file.h"
#include "usage_error.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <thread>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// "9" is "fig9".
std::string builtin_name(const std::string& word) {
  const bool number =
      !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c); });
  return number ? fmt::format("fig{}", word) : word;
}

std::vector<FigureSpec> find_figures(const std::string& word) {
  std::vector<FigureSpec> figures;
  std::vector<std::string_view> names{"all"};
  for (const BuiltinFigure& figure : builtin_figures()) {
    names.push_back(figure.name);
    if (word == "all" || figure.name == builtin_name(word))
      figures.push_back(parse_figure(figure.text, fmt::format("{}.toml", figure.name)));
  }
  if (!figures.empty()) return figures;
  std::error_code ignored;
  const fs::path file = word;
  if (fs::exists(file, ignored) || file.has_parent_path() || file.extension() == ".toml")
    return {read_figure(file)};
  throw SceneError(fmt::format("\"{}\": neither a file nor a built-in figure; built in are {}{}",
                               word, fmt::join(names, ", "), suggestion(word, names)));
}

/// The scenes that figures need, with those of their own files beside these.
class Scenes {
public:
  explicit Scenes(std::vector<std::string> set) : set_(std::move(set)) {}

  const Scene& find(const RunSpec& run) {
    const std::string key = fmt::format("{}\n{}", run.scene, fmt::join(run.set, "\n"));
    if (const auto known = scenes_.find(key); known != scenes_.end()) return known->second;
    std::vector<std::string> set = run.set;
    set.insert(set.end(), set_.begin(), set_.end());
    return scenes_.emplace(key, find_scene(run.scene, set)).first->second;
  }

private:
  std::vector<std::string> set_;
  std::map<std::string, Scene> scenes_;
};

void remark(const std::string& text) {
  std::fputs(fmt::format("lamella: {}\n", text).c_str(), stderr);
}

std::vector<Scene> scenes_of(const std::vector<FigureSpec>& figures, Scenes& scenes) {
  std::vector<Scene> all;
  for (const FigureSpec& figure : figures)
    for (const RunSpec& run : runs_of(figure)) {
      const Scene& scene = scenes.find(run);
      if (std::ranges::find(all, scene) == all.end()) all.push_back(scene);
    }
  return all;
}

/// A page of small pictures of figures, in Markdown.
class Gallery {
public:
  explicit Gallery(fs::path file) : file_(std::move(file)) {
    if (file_.empty()) return;
    std::error_code error;
    fs::create_directories(file_.parent_path() / images, error);
    if (error)
      throw StoreError(fmt::format("{}: cannot be written: {}", file_.string(), error.message()));
  }

  void add(const FigureSpec& figure, const FigurePage& page) {
    if (file_.empty()) return;
    const fs::path image = fs::path(images) / (figure.name + ".png");
    constexpr int width = 840;
    render::write_png(file_.parent_path() / image, render::print(page.sheet, width));
    text_ += fmt::format("\n## {}\n\n`lamella figure {}`\n\n![{}]({})\n", figure.title, figure.name,
                         figure.title, image.string());
    for (const FigureTable& table : page.tables) text_.append("\n").append(table.markdown());
  }

  void write() const {
    if (!file_.empty()) write_text_atomically(file_, text_);
  }

private:
  static constexpr const char* images = "images/gallery";
  fs::path file_;
  std::string text_ =
      "# Gallery\n\nFigures as `lamella figure` draws them; [figures.md](figures.md) "
      "describes how. This page is made by `lamella figure --gallery`.\n";
};

/// Draws a figure; false where an outcome is not as its file expects.
bool draw(const FigureSpec& figure, const FigureOptions& options, const RunFinder& find_run,
          render::Studio& studio, Gallery& gallery) {
  const FigurePage page = draw_figure(figure, find_run, {studio});
  std::vector<std::string> files;
  const auto file = [&](const std::string& end) {
    files.push_back(figure.name + end);
    return options.folder / files.back();
  };
  for (const std::string& format : options.formats)
    write_sheet(file(fmt::format(".{}", format)), page.sheet, 300, options.background);
  for (std::size_t n = 0; n < page.tables.size(); ++n) {
    const std::string number = page.tables.size() == 1 ? "" : fmt::format("_{}", n + 1);
    write_text_atomically(file(number + ".csv"), page.tables[n].csv());
    write_text_atomically(file(number + ".md"), page.tables[n].markdown());
  }
  gallery.add(figure, page);
  say(fmt::format("{}: {}\n", figure.name, fmt::join(files, ", ")));
  for (const std::string& surprise : page.surprises)
    remark(fmt::format("{}: {}", figure.name, surprise));
  return page.surprises.empty();
}

} // namespace

int figure(const FigureOptions& options) {
  if (options.name.empty()) {
    for (const BuiltinFigure& figure : builtin_figures())
      say(fmt::format("{:<10} {}\n", figure.name, figure.title));
    return success;
  }
  const std::vector<FigureSpec> figures = find_figures(options.name);
  Scenes scenes(options.set);
  const std::vector<Scene> needed = scenes_of(figures, scenes);
  const OutputFolder folder(options.folder);
  const RunStore store(folder->inner("runs"));
  const int cores =
      options.threads > 0 ? options.threads : std::max(1, int(std::thread::hardware_concurrency()));
  const std::vector<FailedRun> failed = run_all(needed, store, cores);
  if (interrupt_requested()) {
    remark("interrupted; runs that have ended are kept, the same command goes on with the others");
    return interrupted;
  }
  for (const FailedRun& run : failed) remark(fmt::format("{}: {}", run.scene, run.why));

  const RunFinder find_run = [&](const RunSpec& run) {
    const Scene& scene = scenes.find(run);
    if (!store.has(scene)) throw SceneError(scene.name + " did not come to its end");
    return store.place(scene);
  };
  render::Studio studio(options.backend);
  Gallery gallery(options.gallery);
  int code = success;
  for (const FigureSpec& each : figures) {
    if (interrupt_requested()) return interrupted;
    try {
      if (!draw(each, options, find_run, studio, gallery) && code == success) code = unexpected;
    } catch (const SceneError& e) {
      remark(fmt::format("{}: not drawn: {}", each.name, e.what()));
      code = failed.empty() ? bad_input : run_stopped;
    }
  }
  gallery.write();
  return code;
}

} // namespace lamella
