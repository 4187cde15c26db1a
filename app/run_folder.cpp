#include "run_folder.h"

#include "regular_file.h"
#include "run_contents.h"
#include "run_names.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "store/place_frame.h"

namespace lamella {

namespace fs = std::filesystem;
namespace names = run_names;

namespace {
constexpr std::size_t checkpoints_kept = 2;
constexpr std::size_t largest_scene = 1 << 20;
} // namespace

RunFolder::RunFolder(OutputFolder folder, bool force, const Scene& scene, const Simulation& start,
                     const std::string& origin)
    : folder_(std::move(folder)), event_count_(start.time() > 0 ? start.events().size() : 0) {
  Scene stored = scene;
  std::optional<Frame> state; // read before anything is removed: it may be in this very folder
  if (scene.shape.kind == ShapeKind::frame) {
    state = read_frame(scene.shape.file);
    stored.shape.file = names::start;
  }
  scene_text_ = to_toml(stored);
  refuse_unsuitable(*folder_, force); // others may have put something there meanwhile
  RunStatus beginning;
  beginning.origin = origin;
  write(beginning); // first of all: where that fails, an earlier run is kept
  try {
    erase_run(*folder_);
    if (state) write_frame(Place(*folder_, names::start), *state);
    write_text_atomically(Place(*folder_, names::scene), scene_text_);
    open_tables(start, nullptr);
  } catch (...) {
    erase_run(*folder_);
    folder_->remove(names::status);
    throw;
  }
}

RunFolder::RunFolder(OutputFolder folder, const Simulation& now, const Checkpoint* from)
    : folder_(std::move(folder)), scene_text_(file_text(path() / names::scene, largest_scene)),
      event_count_(from ? now.events().size() : 0) {
  const std::size_t frames = from ? from->frame_times.size() : 0;
  for (std::size_t i = 0; i < frames; i++)
    series_.push_back({names::frame(i), from->frame_times[i]});
  refuse_foreign(*folder_, frames);
  open_tables(now, from);
  erase_results(*folder_);
  erase_later(*folder_, frames, from ? from->state.steps : -1);
  if (from) write_series(Place(*frames_, names::series), series_);
}

void RunFolder::open_tables(const Simulation& now, const Checkpoint* from) {
  const fs::path history = path() / names::history, events = path() / names::events,
                 components = path() / names::components;
  const ComponentMeasures vesicle = now.component_measures().front();
  frames_ = folder_->inner(names::frames);
  if (from) {
    history_.emplace(history, now.measures(), from->history);
    events_.emplace(events, Event{}, from->events);
    components_.emplace(components, vesicle, from->components);
  } else {
    history_.emplace(history, now.measures());
    events_.emplace(events);
    components_.emplace(components, vesicle);
  }
}

/// write(place) writes the frame.
template <class Write>
void RunFolder::store_frame(double time, Write write) {
  const std::string name = names::frame(series_.size());
  series_.push_back({name, time});
  writing_.start([frames = *frames_, name, write = std::move(write), series = series_]() mutable {
    write(Place(frames, name));
    write_series(Place(frames, names::series), series);
  });
}

void RunFolder::add_frame(Frame frame) {
  const double time = frame.time;
  store_frame(time, [frame = std::move(frame)](const Place& place) { write_frame(place, frame); });
}

void RunFolder::add_frame(Frame frame, Checkpoint checkpoint) {
  const double time = frame.time;
  note_in(checkpoint);
  store_frame(time, [frame = std::move(frame),
                     checkpoint = std::move(checkpoint)](const Place& place) mutable {
    write_checkpoint(place, frame, std::move(checkpoint));
  });
}

void RunFolder::add(std::span<const ComponentMeasures> vesicles) {
  for (const ComponentMeasures& vesicle : vesicles) components_->add(vesicle);
}

void RunFolder::add_new(std::span<const Event> all) {
  for (; event_count_ < all.size(); event_count_++) events_->add(all[event_count_]);
}

/// What else is stored.
void RunFolder::note_in(Checkpoint& checkpoint) const {
  checkpoint.scene = scene_text_;
  checkpoint.history = history_->mark();
  checkpoint.events = events_->mark();
  checkpoint.components = components_->mark();
  for (const SeriesEntry& entry : series_) checkpoint.frame_times.push_back(entry.time);
}

void RunFolder::add_checkpoint(const Frame& frame, Checkpoint checkpoint) {
  writing_.wait();
  history_->synchronise();
  events_->synchronise();
  components_->synchronise();
  note_in(checkpoint);
  const Folder inner = folder_->inner(names::checkpoints);
  const std::string name = names::checkpoint(checkpoint.state.steps);
  write_checkpoint(Place(inner, name), frame, std::move(checkpoint));
  const std::vector<std::string> all = checkpoints_in(inner);
  for (std::size_t i = 0; i + checkpoints_kept < all.size(); i++) inner.remove(all[i]);
}

void RunFolder::write(RunStatus status) {
  writing_.wait();
  status.scene_hash = hash_of(scene_text_);
  write_status(Place(*folder_, names::status), status);
}

void RunFolder::write_summary(const std::string& text) {
  writing_.wait();
  write_text_atomically(Place(*folder_, names::summary), text);
}

} // namespace lamella
