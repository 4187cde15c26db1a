// A vesicle relaxes under an energy that Lamella does not have. Checks the force of the new term,
// runs a built-in scene with it, and stores that as a run, which ParaView and `lamella render`
// open: own_term FOLDER
#include "force_check.h"
#include "softening.h"

#include <lamella/dynamics/simulation.h>
#include <lamella/scene/builtin.h>
#include <lamella/scene/scene_toml.h>
#include <lamella/store/history.h>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace fs = std::filesystem;

namespace {

/// The times at which the scene wants to be stored.
double frame_time(const lamella::Scene& scene, int number) {
  return scene.end() * number / (scene.output.frames - 1);
}

void store_run(const lamella::Scene& scene, lamella::Simulation& simulation,
               const fs::path& folder) {
  fs::create_directories(folder / "frames");
  std::ofstream(folder / "scene.toml") << to_toml(scene);
  lamella::HistoryWriter history(folder / "history.csv", simulation.measures());
  history.add(simulation.measures());
  std::vector<lamella::SeriesEntry> frames;
  for (int number = 0; number < scene.output.frames; number++) {
    while (simulation.time() < frame_time(scene, number)) {
      simulation.step(frame_time(scene, number));
      history.add(simulation.measures());
    }
    frames.push_back({"frame_000" + std::to_string(number) + ".hdf", simulation.time()});
    write_frame(folder / "frames" / frames.back().file, simulation.frame());
  }
  write_series(folder / "frames" / "frames.hdf.series", frames);
  lamella::EventWriter events(folder / "events.csv");
  for (const lamella::Event& event : simulation.events()) events.add(event);
}

void print(const lamella::Measures& m) {
  std::cout << "t = " << m.time << ": energy " << m.energy << ", of bending "
            << m.terms.value(lamella::Term::bending) << ", of softening "
            << m.terms.others().at("softening") << "\n";
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "own_term FOLDER\n";
    return 2;
  }
  const lamella::SurfaceTerms terms{std::make_shared<Softening>(2.0, 4.0)};
  const double error = force_error(terms[0]);
  std::cout << "force against difference of the energy: " << error << "\n";
  if (!(error < 1e-2)) return 1;

  const std::vector<std::string> changes{"grid.nodes=32", "run.end_time=2e-4", "output.frames=3"};
  const lamella::Scene scene = lamella::builtin_scene("fig3_oblate", changes);
  lamella::Simulation simulation(scene, terms);
  print(simulation.measures());
  store_run(scene, simulation, argv[1]);
  print(simulation.measures());
}
