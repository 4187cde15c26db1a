#pragma once
#include "dynamics/simulation.h"
#include "start_surface.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace lamella {

inline Scene scene_of(const Shape& shape, int nodes, double end_time) {
  Scene scene;
  scene.shape = shape;
  scene.nodes = {nodes, nodes, nodes};
  scene.end_time = end_time;
  return scene;
}

/// Measures of the start and after every step, and what happened on the way.
struct Outcome {
  std::vector<Measures> history;
  std::vector<Event> events;
  Frame end;
};

inline Outcome follow(const Scene& scene) {
  Simulation sim(scene);
  Outcome run{{sim.measures()}, {}, {}};
  while (sim.time() < scene.end_time) {
    sim.step(scene.end_time);
    run.history.push_back(sim.measures());
  }
  run.events.assign(sim.events().begin(), sim.events().end());
  run.end = sim.frame();
  return run;
}

inline std::vector<Measures> run(const Scene& scene) { return follow(scene).history; }

inline int count(std::span<const Event> events, Event::Kind kind) {
  return int(std::ranges::count(events, kind, &Event::kind));
}

inline int topology_changes(std::span<const Event> events) {
  return int(std::ranges::count_if(events, &Event::changes_topology));
}

/// Rows of numbers of a file in data/reference.
inline std::vector<std::vector<double>> reference(const std::string& name) {
  std::ifstream file(std::string(LAMELLA_SOURCE_DIR "/data/reference/") + name);
  EXPECT_TRUE(file) << name;
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

/// Column `column` at x, linear in the first column, whichever way that runs.
inline double interpolated(const std::vector<std::vector<double>>& rows, double x, int column) {
  for (std::size_t i = 1; i < rows.size(); i++) {
    const double a = rows[i - 1][0], b = rows[i][0];
    if ((x - a) * (x - b) > 0) continue;
    const double t = (x - a) / (b - a);
    return (1 - t) * rows[i - 1][column] + t * rows[i][column];
  }
  ADD_FAILURE() << x << " is outside the table";
  return 0;
}

inline double worst_drift(const std::vector<Measures>& history) {
  double worst = 0;
  for (const Measures& m : history)
    worst = std::max({worst, std::abs(m.area_drift), std::abs(m.volume_drift)});
  return worst;
}

inline double largest_rise(const std::vector<Measures>& history) {
  double rise = 0;
  for (std::size_t i = 1; i < history.size(); i++)
    rise = std::max(rise, history[i].energy - history[i - 1].energy);
  return rise;
}

} // namespace lamella
