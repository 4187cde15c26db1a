#include "commands.h"

#include "cancellation.h"
#include "error.h"
#include "exit_code.h"
#include "find_scene.h"
#include "interrupt.h"
#include "output_folder.h"
#include "parallel.h"
#include "progress.h"
#include "render/run_pictures.h"
#include "start_frame.h"
#include "store/atomic_file.h"
#include "sweep_progress.h"
#include "tradeoff/report.h"
#include "tradeoff/sweep.h"
#include "usage_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

constexpr const char *table_file = "tradeoff.csv", *page_file = "tradeoff.md",
                     *plot_file = "tradeoff.png";

/// The fastest of several runs; all have the same course. Where it starts from the end of another
/// scene, that one runs before and does not count.
Trial fastest(Scene scene, int repeats, SweepProgress& progress) {
  Trial best;
  const Cancellation when(interrupt_requested);
  try {
    const StartFrame start_frame(scene);
    for (int n = 0; n < repeats && !interrupt_requested(); ++n) {
      progress.begin(scene);
      Trial trial = run_trial(scene, [&](double time) {
        progress.update(time);
        return !interrupt_requested();
      });
      progress.end();
      if (n == 0 || trial.seconds < best.seconds) best = std::move(trial);
    }
  } catch (const SceneError& e) {
    best.scene = scene;
    best.stopped = e.what();
  } catch (const Cancelled&) { // the caller asks why
  }
  return best;
}

Reference finest_run(std::span<const Scene> scenes) {
  const Scene scene = finer_than_all(scenes);
  const std::string name =
      fmt::format("a run at {}, tolerance {:g}", grid_text(scene), scene.numerics.tolerance);
  say(fmt::format("Reference: {}\n", name));
  SweepProgress progress({&scene, 1}, 1);
  const Trial trial = fastest(scene, 1, progress);
  if (!trial.stopped.empty())
    throw UsageError(fmt::format("{}, which the others are compared with, stopped: {}; choose one "
                                 "with --reference",
                                 name, trial.stopped));
  return {trial.history, name};
}

/// Given, or known of a built-in scene.
std::optional<Reference> known_reference(const fs::path& given, const Scene& scene) {
  if (given.empty()) return builtin_reference(scene);
  Reference reference = read_reference(given);
  if (!reference.covers(scene.end()))
    throw UsageError(fmt::format("{}: ends before the run, whose end_time is {:g}", given.string(),
                                 scene.end()));
  return reference;
}

/// Throws UsageError for a folder with an earlier sweep, and StoreError where a file that is none
/// has the name of one of its files.
void refuse_unsuitable(const Folder& folder, bool force) {
  for (const char* file : {table_file, page_file, plot_file}) {
    Place(folder, file).refuse_other_kinds();
    if (!force && folder.type_of(file) != fs::file_type::not_found)
      throw UsageError(
          fmt::format("{}: the folder holds a sweep; choose another with -o, or replace "
                      "it with --force",
                      folder.path().string()));
  }
}

int draw(std::span<const Trial> trials, const fs::path& folder) {
  std::vector<Trade> trades;
  for (const Trial& trial : trials)
    trades.push_back({trial.scene.nodes, trial.seconds, trial.errors.largest(), trial.on_front,
                      std::string(trial.preset)});
  std::ranges::sort(trades, {}, &Trade::seconds);
  try {
    render::draw_tradeoff(trades, folder / plot_file);
  } catch (const RenderError& e) {
    std::fprintf(stderr, "lamella: no picture: %s; all else is stored\n", e.what());
    return no_pictures;
  }
  return success;
}

/// Runs all, compares each and stores the table anew.
std::vector<Trial> carry_out(const Scene& scene, std::span<const Scene> scenes,
                             const Reference& reference, const Folder& folder, int repeats) {
  std::vector<Trial> trials;
  SweepProgress progress(scenes, repeats);
  say(table_head());
  for (const Scene& variant : scenes) {
    Trial trial = fastest(variant, repeats, progress);
    if (interrupt_requested()) break;
    trial.preset = preset_of(variant, scene);
    if (trial.stopped.empty()) trial.errors = compare(trial.history, reference);
    say(table_row(trial));
    trials.push_back(std::move(trial));
    mark_front(trials);
    write_text_atomically(Place(folder, table_file), tradeoff_csv(trials));
  }
  return trials;
}

} // namespace

int tradeoff(const TradeoffOptions& options) {
  const Scene scene = find_scene(options.scene, options.set);
  const fs::path path =
      options.folder.empty() ? fs::path(scene.name + "-tradeoff") : options.folder;
  const std::vector<Scene> scenes = sweep(scene, options.range);
  std::optional<Reference> reference = known_reference(options.reference, scene);
  const OutputFolder own(path);
  refuse_unsuitable(*own, options.force);
  set_thread_count(options.threads);
  if (!reference) reference = finest_run(scenes);
  say(fmt::format("{} to t = {:g}, compared with {}\n", scene.name, scene.end(),
                  reference->source()));

  const std::vector<Trial> trials = carry_out(scene, scenes, *reference, *own, options.repeats);
  if (trials.empty()) return interrupted;
  write_text_atomically(Place(*own, page_file),
                        tradeoff_markdown(scene, *reference, trials, options.repeats));
  const int pictures = draw(trials, path);
  say(fmt::format("In {}: {}, {}{}\n", path.string(), table_file, page_file,
                  pictures == success ? fmt::format(", {}", plot_file) : ""));
  return interrupt_requested() ? interrupted : pictures;
}

} // namespace lamella
