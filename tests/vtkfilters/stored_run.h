#pragma once
#include "dynamics/simulation.h"
#include "scene/scene_toml.h"
#include "store/atomic_file.h"
#include "store/frame.h"
#include "store/history.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lamella {

/// What `lamella run` would leave of a scene in a folder, but for pictures and words, with three
/// frames, and an event that did not happen.
inline void store_run(const std::filesystem::path& folder, const Scene& scene,
                      const Event& invented) {
  std::filesystem::create_directories(folder / "frames");
  Simulation simulation(scene);
  HistoryWriter history(folder / "history.csv", simulation.measures());
  std::vector<SeriesEntry> series;
  ComponentWriter components(folder / "components.csv", simulation.component_measures().front());
  const auto store = [&] {
    const std::string name = "frame_000" + std::to_string(series.size()) + ".hdf";
    write_frame(folder / "frames" / name, simulation.frame());
    series.push_back({name, simulation.time()});
  };
  history.add(simulation.measures());
  store();
  for (const double goal : {scene.end_time / 2, scene.end_time}) {
    while (simulation.time() < goal) {
      simulation.step(goal);
      history.add(simulation.measures());
    }
    store();
  }
  EventWriter events(folder / "events.csv");
  for (const Event& event : simulation.events()) events.add(event);
  events.add(invented);
  write_series(folder / "frames" / "frames.hdf.series", series);
}

} // namespace lamella
