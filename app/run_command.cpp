#include "commands.h"

#include "cancellation.h"
#include "error.h"
#include "find_scene.h"
#include "interrupt.h"
#include "output_folder.h"
#include "parallel.h"
#include "progress.h"
#include "resume.h"
#include "run_contents.h"
#include "run_folder.h"
#include "scene/preset.h"
#include "scene/scene_toml.h"
#include "shell_word.h"
#include "start_frame.h"
#include "summary.h"
#include "time_loop.h"
#include "usage_error.h"
#include "version.h"

#include <fmt/format.h>
#include <memory>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// One line on standard error.
void remark(const std::string& text) {
  std::fputs(fmt::format("lamella: {}\n", text).c_str(), stderr);
}

/// A run on its way: the simulation, where it is stored, and what is remembered of it.
class Run {
public:
  Run(const RunOptions& options, const Scene& scene, Simulation& simulation, RunFolder& folder,
      Course course, const Resumed& resumed, std::string origin = {})
      : options_(options), scene_(scene), sim_(simulation), folder_(folder),
        course_(std::move(course)), loop_(simulation, scene, resumed), origin_(std::move(origin)) {
    note_vesicles();
  }

  enum class Beginning { scene, branch, checkpoint };
  /// To its end, with the state there as its last frame. Returns an ExitCode.
  int carry_out(Beginning beginning);

private:
  void store_start(bool is_branch);
  void note_vesicles();
  void store_measures();
  void store_frame(bool can_go_on);
  void store_checkpoint();
  Checkpoint checkpoint() const;
  Outcome advance();
  void store_step(bool frame_is_due);
  RunStatus status(RunStatus::State state, const std::string& reason = {}) const;
  void finish(const Outcome& outcome);
  void report(const Outcome& outcome) const;

  const RunOptions& options_;
  const Scene& scene_;
  Simulation& sim_;
  RunFolder& folder_;
  Course course_;
  std::vector<ComponentMeasures> vesicles_; ///< after the last step; none where there is one
  TimeLoop loop_;
  std::string origin_;         ///< of a branch
  double checkpoint_time_ = 0; ///< wall-clock time of the last one
};

RunStatus Run::status(RunStatus::State state, const std::string& reason) const {
  return {state, reason, sim_.time(), loop_.wall_seconds(), thread_count(), {}, origin_};
}

void Run::note_vesicles() {
  vesicles_.clear();
  if (sim_.vesicles() > 1) vesicles_ = sim_.component_measures();
}

void Run::store_measures() {
  folder_.add(sim_.measures());
  note_vesicles();
  folder_.add(vesicles_);
}

void Run::store_start(bool is_branch) {
  store_measures();
  folder_.add_new(sim_.events());
  store_frame(false);                // what leads here is the scene
  if (is_branch) store_checkpoint(); // its scene alone does not
}

void Run::store_frame(bool can_go_on) {
  if (options_.exact_frames && can_go_on)
    folder_.add_frame(sim_.frame(), checkpoint());
  else
    folder_.add_frame(sim_.frame());
}

void Run::store_checkpoint() {
  checkpoint_time_ = loop_.wall_seconds();
  folder_.add_checkpoint(sim_.frame(), checkpoint());
}

Checkpoint Run::checkpoint() const {
  Checkpoint checkpoint;
  checkpoint.program = version();
  checkpoint.arithmetic = arithmetic();
  checkpoint.threads = thread_count();
  checkpoint.wall_seconds = loop_.wall_seconds();
  checkpoint.stopping = loop_.stopping();
  checkpoint.state = sim_.state();
  return checkpoint;
}

void Run::store_step(bool frame_is_due) {
  course_.add(sim_.measures());
  store_measures();
  folder_.add_new(sim_.events());
  if (frame_is_due) store_frame(true);
  const double since = loop_.wall_seconds() - checkpoint_time_;
  const bool is_due = options_.checkpoint_seconds > 0 && since >= options_.checkpoint_seconds;
  if (checkpoint_requested() || is_due) store_checkpoint();
}

Outcome Run::advance() {
  checkpoint_time_ = loop_.wall_seconds();
  folder_.write(status(RunStatus::State::running));
  const Outcome outcome = loop_.run([this](bool frame_is_due) { store_step(frame_is_due); });
  const bool can_go_on = outcome.code != run_stopped && course_.steps() > 0;
  if (can_go_on && options_.checkpoint_seconds > 0) store_checkpoint();
  if (folder_.last_frame_time() < sim_.time()) store_frame(can_go_on);
  return outcome;
}

int draw(const RunFolder& folder, const RunOptions& options) {
  try {
    draw_pictures({folder.path(), {.backend = options.backend}});
  } catch (const RenderError& e) {
    remark(fmt::format("no pictures: {}; all else is stored, `lamella render` draws it later",
                       e.what()));
    return no_pictures;
  }
  return success;
}

std::string opening(const Scene& scene, const std::string& origin) {
  const Grid grid = scene.grid();
  return fmt::format("{}: {} x {} x {} nodes, {}to t = {:g}, {} thread{}\n", scene.name, grid.nx(),
                     grid.ny(), grid.nz(), origin, scene.end(), thread_count(),
                     thread_count() == 1 ? "" : "s");
}

std::string result(const Course& course, double seconds) {
  return fmt::format("t = {:.6g} after {} steps in {}: energy {:.6g} -> {:.6g}; constraints "
                     "kept within {:.0e}\n",
                     course.end().time, course.steps(), duration_text(seconds),
                     course.start().energy, course.end().energy,
                     std::max(course.area_drift(), course.volume_drift()));
}

/// What became of two phases.
std::string phases_result(const PhaseMeasures& start, const PhaseMeasures& end) {
  return fmt::format("bending Ld {:.6g} -> {:.6g}, Lo {:.6g} -> {:.6g}; line {:.6g} -> {:.6g}, "
                     "length {:.6g} -> {:.6g}; domains Ld {} -> {}, Lo {} -> {}\n",
                     start.bending_energy_Ld, end.bending_energy_Ld, start.bending_energy_Lo,
                     end.bending_energy_Lo, start.line_energy, end.line_energy, start.line_length,
                     end.line_length, start.domains_Ld, end.domains_Ld, start.domains_Lo,
                     end.domains_Lo);
}

void Run::report(const Outcome& outcome) const {
  const std::string words = words_for(outcome, sim_.time()), warning = caution(sim_.events());
  if (outcome.code == success && !outcome.reason.empty()) say(fmt::format("The run {}\n", words));
  say(result(course_, loop_.wall_seconds()));
  if (course_.end().phases) say(phases_result(*course_.start().phases, *course_.end().phases));
  if (outcome.code == resumable)
    remark(fmt::format("the run {}; `lamella run --resume {}` goes on", words,
                       shell_word(folder_.path())));
  else if (outcome.code != success)
    remark(fmt::format("the run {}; stored up to there", words));
  if (!warning.empty()) remark("warning: " + warning);
  if (outcome.code != success || !outcome.reason.empty()) return;
  if (const std::string word = word_on_end_time(scene_, course_, sim_.ramping()); !word.empty())
    remark("note: " + word);
}

std::string contents(const RunFolder& folder, bool pictures) {
  return fmt::format("In {}: {}summary.txt, history.csv, events.csv, {} frames (for ParaView: "
                     "frames/frames.hdf.series)\n",
                     folder.path().string(), pictures ? "figure.png, energy.png, " : "",
                     folder.frames());
}

void Run::finish(const Outcome& outcome) {
  const RunStatus::State state = outcome.code == success     ? RunStatus::State::finished
                                 : outcome.code == resumable ? RunStatus::State::interrupted
                                                             : RunStatus::State::stopped;
  folder_.write_summary(summary(scene_, course_, sim_.events(), outcome, sim_.ramping(),
                                loop_.wall_seconds(), vesicles_));
  folder_.write(status(state, outcome.reason));
  report(outcome);
}

int Run::carry_out(Beginning beginning) {
  Outcome outcome;
  try {
    if (beginning != Beginning::checkpoint) store_start(beginning == Beginning::branch);
    outcome = advance();
    finish(outcome);
  } catch (const StoreError& e) {
    throw StoreError(fmt::format("{}; the run stopped at t = {:.6g}, what was stored before is "
                                 "whole, and `lamella run --resume {}` goes on from there",
                                 e.what(), sim_.time(), shell_word(folder_.path())));
  }
  const int pictures = options_.no_pictures ? success : draw(folder_, options_);
  say(contents(folder_, !options_.no_pictures && pictures == success));
  return outcome.code != success ? outcome.code : pictures;
}

// -----------------------------------------------------------------------------------------------
// the three ways in

/// The scene that the options ask for. `stored`: that of the run to go on with.
Scene wanted_scene(const RunOptions& options, const std::string& stored = {}) {
  const std::string& name = options.scene.empty() ? stored : options.scene;
  Scene scene = at_preset(find_preset(options.preset), find_scene(name, options.set));
  validate(scene);
  return scene;
}

int give_up() {
  remark("interrupted before the run began; nothing was written");
  return interrupted;
}

/// In a folder that may not be one for runs.
int run_from_start(const RunOptions& options, Scene scene, OutputFolder output) {
  refuse_unsuitable(*output, options.force);
  const std::string origin =
      scene.shape.kind == ShapeKind::frame ? fmt::format("from {} ", scene.shape.file) : "";
  const StartFrame start_frame(scene);
  Simulation sim = start(scene);
  if (interrupt_requested()) return give_up();
  RunFolder folder(std::move(output), options.force, scene, sim);
  say(opening(scene, origin));
  Run run(options, scene, sim, folder, Course(sim.measures()), {});
  return run.carry_out(Run::Beginning::scene);
}

int run_new(const RunOptions& options) {
  Scene scene = wanted_scene(options);
  OutputFolder output(options.folder.empty() ? fs::path(scene.name) : options.folder);
  return run_from_start(options, std::move(scene), std::move(output));
}

/// The simulation at a checkpoint, or at its start where there is none. Throws SceneError.
std::unique_ptr<Simulation> simulation_at(const Scene& scene, const Checkpoint* checkpoint) {
  const Cancellation when(interrupt_requested);
  try {
    if (checkpoint) return std::make_unique<Simulation>(scene, checkpoint->state);
    return std::make_unique<Simulation>(scene);
  } catch (const RunError& e) {
    throw SceneError(fmt::format("{}: the run cannot go on: {}", scene.name, e.what()));
  }
}

/// Of the rows that a checkpoint found.
Course course_until(const fs::path& folder, double time) {
  std::vector<Measures> rows = read_history(folder / "history.csv");
  if (rows.empty()) throw StoreError((folder / "history.csv").string() + ": it has no rows");
  Course course(rows.front());
  for (std::size_t i = 1; i < rows.size() && rows[i].time <= time * (1 + 1e-11); i++)
    course.add(rows[i]);
  return course;
}

void warn_of_other_arithmetic(const Checkpoint& checkpoint) {
  if (checkpoint.program != version() || checkpoint.arithmetic != arithmetic())
    remark(fmt::format("warning: the checkpoint is of lamella {} with {}, this is {} with {}: the "
                       "run goes on, but not to the last bit",
                       checkpoint.program, checkpoint.arithmetic, version(), arithmetic()));
}

int resume_in_place(const RunOptions& options, const Scene& scene,
                    const std::optional<Checkpoint>& checkpoint, const std::string& branch_of,
                    OutputFolder output) {
  const Checkpoint* from = checkpoint ? &*checkpoint : nullptr;
  const std::unique_ptr<Simulation> sim = simulation_at(scene, from);
  RunFolder folder(std::move(output), *sim, from);
  Course course = from ? course_until(options.resume, sim->time()) : Course(sim->measures());
  say(opening(scene, from ? fmt::format("resumed at t = {:.6g}, ", sim->time())
                          : "resumed at its start, "));
  Resumed resumed;
  if (from) resumed = {from->stopping, from->wall_seconds};
  Run run(options, scene, *sim, folder, std::move(course), resumed, branch_of);
  return run.carry_out(from ? Run::Beginning::checkpoint : Run::Beginning::scene);
}

int branch_off(const RunOptions& options, const Scene& scene, const Checkpoint& checkpoint,
               const Scene& stored, const std::vector<const Key*>& changed) {
  refuse_unbranchable(changed, stored, scene);
  OutputFolder output(options.folder);
  refuse_unsuitable(*output, options.force);
  Checkpoint from = checkpoint;
  from.state = branched(std::move(from.state), changed);
  const std::unique_ptr<Simulation> sim = simulation_at(scene, &from);
  if (sim->time() >= scene.end())
    throw UsageError(fmt::format("the state is at t = {:.6g} already; set run.end_time beyond it, "
                                 "as in --set run.end_time={:g}",
                                 sim->time(), 2 * sim->time()));
  const std::string origin = fmt::format("{}, t = {:.6g}", options.resume.string(), sim->time());
  RunFolder folder(std::move(output), options.force, scene, *sim, origin);
  say(opening(scene, fmt::format("from {} ", origin)));
  Run run(options, scene, *sim, folder, Course(sim->measures()), {from.stopping, 0}, origin);
  return run.carry_out(Run::Beginning::branch);
}

/// From one of the states in a run's folder.
int branch_off_file(const RunOptions& options) {
  const fs::path& file = options.resume;
  if (!options.branch)
    throw UsageError(file.string() + ": a run goes on in its folder; from a file in it, --branch "
                                     "with -o starts another run");
  const fs::path scene_file = fs::absolute(file).parent_path().parent_path() / "scene.toml";
  if (!fs::is_regular_file(scene_file))
    throw UsageError(file.string() + ": it is not in the folder of a run");
  const Checkpoint checkpoint = read_checkpoint(file);
  const Scene scene = wanted_scene(options, scene_file.string()),
              stored = parse_scene(checkpoint.scene, scene_file.string());
  return branch_off(options, scene, checkpoint, stored, differences(stored, scene));
}

/// How to do without what is stored.
std::string advice(const fs::path& run) {
  return fmt::format("put back what was there, or begin again with `lamella run {} -o {} --force`",
                     shell_word(run / "scene.toml"), shell_word(run));
}

/// Of the run in a folder. Throws StoreError where it is damaged so that it cannot go on.
std::optional<Checkpoint> newest_checkpoint(const fs::path& path) {
  Resumption found = find_checkpoint(path);
  if (!found.checkpoint && !found.damage.empty())
    throw StoreError(fmt::format("{}; there is no older checkpoint to go on from; {}",
                                 found.damage.front(), advice(path)));
  for (const std::string& why : found.damage)
    remark(fmt::format("warning: {}; falling back to the state before", why));
  return std::move(found.checkpoint);
}

/// The scene that the options ask for, and what it changes in that of a run.
struct Wanted {
  Scene scene, stored;
  std::vector<const Key*> changed;
};

Wanted wanted_of(const RunOptions& options, const std::optional<Checkpoint>& checkpoint) {
  const std::string place = (options.resume / "scene.toml").string();
  Wanted wanted{wanted_scene(options, place),
                checkpoint ? parse_scene(checkpoint->scene, place) : read_scene(place),
                {}};
  wanted.changed = differences(wanted.stored, wanted.scene);
  return wanted;
}

int branch_off_run(const RunOptions& options) {
  const std::optional<Checkpoint> checkpoint = newest_checkpoint(options.resume);
  const Wanted wanted = wanted_of(options, checkpoint);
  if (!checkpoint)
    throw UsageError(options.resume.string() + ": there is no checkpoint to branch from");
  return branch_off(options, wanted.scene, *checkpoint, wanted.stored, wanted.changed);
}

/// Says so.
int leave_finished(const fs::path& path, const RunStatus& status) {
  try {
    check_stored_files(path);
  } catch (const StoreError& e) {
    throw StoreError(fmt::format("{}; the run has {}, and all else is kept; {}", e.what(),
                                 to_string(status.state), advice(path)));
  }
  say(fmt::format("{}: the run has {} at t = {:.6g}; nothing is left to do\n", path.string(),
                  to_string(status.state), status.time));
  return status.state == RunStatus::State::finished ? success : run_stopped;
}

int go_on(const RunOptions& options, OutputFolder output) {
  const fs::path& path = options.resume;
  erase_unfinished(*output);
  const RunStatus status =
      status_of_run(path, [](const std::string& why) { remark("warning: " + why); });
  const std::optional<Checkpoint> checkpoint = newest_checkpoint(path);
  const Wanted wanted = wanted_of(options, checkpoint);
  if (!wanted.changed.empty())
    throw UsageError(fmt::format(
        "{}: the scene is not that of the run: {}; --branch with -o starts another run from its "
        "state",
        path.string(), difference_text(wanted.changed, wanted.stored, wanted.scene)));
  if (status.state == RunStatus::State::finished || status.state == RunStatus::State::stopped)
    return leave_finished(path, status);
  if (!checkpoint && !status.origin.empty())
    throw UsageError(fmt::format("{}: this branch of {} has no checkpoint yet, and its scene alone "
                                 "does not lead to its state; start it again with --branch and "
                                 "--force",
                                 path.string(), status.origin));
  if (checkpoint) warn_of_other_arithmetic(*checkpoint);
  return resume_in_place(options, wanted.scene, checkpoint, status.origin, std::move(output));
}

int resume(const RunOptions& options) {
  const fs::path& path = options.resume;
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return branch_off_file(options);
  const bool is_run = holds_run(path);
  if (!is_run && (options.scene.empty() || options.branch))
    throw UsageError(path.string() + ": there is no run to resume; with a scene, as in `lamella "
                                     "run SCENE --resume FOLDER`, one is started");
  if (is_run && options.branch) return branch_off_run(options);
  OutputFolder output(path);
  if (holds_run(path)) return go_on(options, std::move(output)); // as nobody else changes it now
  return run_from_start(options, wanted_scene(options), std::move(output));
}

} // namespace

int run(const RunOptions& options) {
  set_thread_count(options.threads);
  try {
    return options.resume.empty() ? run_new(options) : resume(options);
  } catch (const Cancelled&) {
    if (options.resume.empty() || options.branch || !holds_run(options.resume)) return give_up();
    remark(fmt::format("interrupted before the run went on; `lamella run --resume {}` does",
                       shell_word(options.resume)));
    return resumable;
  }
}

} // namespace lamella
