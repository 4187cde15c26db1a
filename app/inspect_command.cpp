#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "interrupt.h"
#include "progress.h"
#include "regular_file.h"
#include "run_contents.h"
#include "scene/scene_toml.h"
#include "shell_word.h"
#include "store/history.h"
#include "usage_error.h"

#include <fmt/format.h>

#include <algorithm>

namespace lamella {

namespace fs = std::filesystem;

namespace {

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 10'000) return fmt::format("{} bytes", bytes);
  if (bytes < 10'000'000) return fmt::format("{:.0f} kB", double(bytes) / 1e3);
  return fmt::format("{:.0f} MB", double(bytes) / 1e6);
}

std::string row(std::string_view name, const std::string& value) {
  return fmt::format("{:<14} {}\n", name, value);
}

std::string grid_text(const Grid& grid) {
  return fmt::format("{} x {} x {} nodes, spacing {:.5g}", grid.nx(), grid.ny(), grid.nz(),
                     grid.spacing);
}

std::string fields_text(const Frame& frame) {
  std::string text = "phi (the membrane)";
  for (const auto& [name, values] : frame.fields)
    text += ", " + name + (name == "psi" ? " (phases)" : name == "c" ? " (lipid per area)" : "");
  return text;
}

std::string scene_rows(const Scene& scene) {
  return row("scene",
             scene.title.empty() ? scene.name : fmt::format("{}: {}", scene.name, scene.title)) +
         row("grid", grid_text(scene.grid())) +
         row("phases", scene.has_phases() ? "Ld and Lo" : "one");
}

std::string measures_rows(const Measures& m) {
  std::string text = row(
      "energy", fmt::format("{:.8g}, of bending {:.8g}", m.energy, m.terms.value(Term::bending)));
  if (m.phases)
    text += row("", fmt::format("of the phase boundary {:.8g}, of its length {:.6g}",
                                m.phases->line_energy, m.phases->line_length));
  text += row("area", fmt::format("{:.8g}", m.area));
  text += row("volume", fmt::format("{:.8g}, reduced {:.6g}", m.volume, m.reduced_volume));
  return text + row("topology", fmt::format("{} component{}, genus {}", m.components,
                                            m.components == 1 ? "" : "s", m.genus));
}

/// Those that there are at a time.
std::string vesicles_rows(std::span<const ComponentMeasures> all, double time) {
  std::string text;
  for (const ComponentMeasures& m : all)
    if (m.time == time)
      text += row(fmt::format("vesicle {}", m.component),
                  fmt::format("at ({:.4g}, {:.4g}, {:.4g}), area {:.8g}, volume {:.8g}, reduced "
                              "{:.6g}, P {:.6g}, sigma {:.6g}",
                              m.center[0], m.center[1], m.center[2], m.area, m.volume,
                              m.reduced_volume, m.P, m.sigma));
  return text;
}

std::string events_rows(std::span<const Event> events, double spacing) {
  if (events.empty()) return row("events", "none");
  std::string text = row("events", std::to_string(events.size()));
  for (const Event& event : events) text += fmt::format("  {}\n", to_text(event, spacing));
  return text;
}

std::string frame_rows(const fs::path& file, const Frame& frame) {
  std::string text = row("time", fmt::format("{:.8g}", frame.time)) +
                     row("grid", grid_text(frame.grid)) + row("fields", fields_text(frame));
  if (frame.cells != std::array<int, 3>{})
    text += row("box", fmt::format("moved by ({}, {}, {}) cells", frame.cells[0], frame.cells[1],
                                   frame.cells[2]));
  return text + row("size", size_text(fs::file_size(file)));
}

std::string checkpoint_text(const fs::path& file, const Checkpoint& c) {
  const Scene scene = parse_scene(c.scene, "the scene in " + file.string());
  return fmt::format("{}: a checkpoint, and a frame\n", file.string()) + scene_rows(scene) +
         row("time", fmt::format("{:.8g} of {:g}, after {} steps in {}", c.state.measures.time,
                                 scene.end(), c.state.steps, duration_text(c.wall_seconds))) +
         row("next step", fmt::format("about {:.3g}", c.state.last_dt)) +
         measures_rows(c.state.measures) + events_rows(c.state.events, scene.grid().spacing) +
         row("written by", fmt::format("lamella {}, {}, {} thread{}", c.program, c.arithmetic,
                                       c.threads, c.threads == 1 ? "" : "s")) +
         row("scene hash", hash_of(c.scene)) + row("size", size_text(fs::file_size(file)));
}

std::string state_file_text(const fs::path& file) {
  if (is_checkpoint(file)) return checkpoint_text(file, read_checkpoint(file));
  return fmt::format("{}: a frame\n", file.string()) + frame_rows(file, read_frame(file));
}

std::string files_row(const char* name, const std::vector<fs::path>& files) {
  if (files.empty()) return row(name, "none");
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files) bytes += fs::file_size(file);
  return row(name, fmt::format("{}, to {}, {}", files.size(), files.back().filename().string(),
                               size_text(bytes)));
}

std::string state_text(const RunStatus& s) {
  switch (s.state) {
  case RunStatus::State::running:
    return "running, or killed";
  case RunStatus::State::interrupted:
    return fmt::format("interrupted after {}", duration_text(s.wall_seconds));
  case RunStatus::State::finished:
    return fmt::format("finished in {}{}{}", duration_text(s.wall_seconds),
                       s.reason.empty() ? "" : ": ", s.reason);
  case RunStatus::State::stopped:
    return fmt::format("could not go on after {}: {}", duration_text(s.wall_seconds), s.reason);
  }
  return {};
}

std::string folder_text(const fs::path& folder) {
  if (!holds_run(folder))
    throw UsageError(folder.string() + ": holds no run; name the folder of a run, or a file of it");
  const Scene scene = read_scene(folder / "scene.toml");
  const RunStatus status = status_of_run(
      folder, [](const std::string& why) { fmt::print(stderr, "lamella: warning: {}\n", why); });
  std::string text = fmt::format("{}: a run\n", folder.string()) + scene_rows(scene);
  text += row("state", state_text(status));
  if (!status.origin.empty()) text += row("branch of", status.origin);
  if (const std::vector<Measures> rows = read_history(folder / "history.csv"); !rows.empty()) {
    text += row("time", fmt::format("{:.8g} of {:g}, after {} steps", rows.back().time, scene.end(),
                                    rows.size() - 1));
    text += row("energy", fmt::format("{:.8g} -> {:.8g}", rows.front().energy, rows.back().energy));
    text += row("reduced volume", fmt::format("{:.6g} -> {:.6g}", rows.front().reduced_volume,
                                              rows.back().reduced_volume));
    text += row("topology", fmt::format("{} component{}, genus {}", rows.back().components,
                                        rows.back().components == 1 ? "" : "s", rows.back().genus));
    text += vesicles_rows(read_components(folder / "components.csv"), rows.back().time);
  }
  text += events_rows(read_events(folder / "events.csv"), scene.grid().spacing);
  text += files_row("frames", stored_frames(folder));
  const std::vector<fs::path> checkpoints = stored_checkpoints(folder);
  text += files_row("checkpoints", checkpoints);
  const bool is_open =
      status.state == RunStatus::State::running || status.state == RunStatus::State::interrupted;
  return is_open ? text + row("go on with", "lamella run --resume " + shell_word(folder)) : text;
}

} // namespace

int inspect(const fs::path& what) {
  end_at_interrupt();
  if (is_free(what)) throw UsageError(what.string() + ": no such file or folder");
  std::error_code ignored;
  say(fs::is_directory(what, ignored) ? folder_text(what) : state_file_text(what));
  return success;
}

} // namespace lamella
