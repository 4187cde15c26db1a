#pragma once
#include "dynamics/simulation.h"
#include "dynamics/stopping.h"
#include "store/table.h"

#include <filesystem>
#include <string>

namespace lamella {

/// A run at one time, with all that it takes to go on exactly.
struct Checkpoint {
  std::string scene;   ///< its TOML text, complete
  std::string program; ///< version() and arithmetic() of the one that wrote it
  std::string arithmetic;
  int threads = 0;                       ///< for the record: results do not depend on them
  double wall_seconds = 0;               ///< that the run has taken so far
  TableMark history, events, components; ///< of history.csv, events.csv and components.csv
  Array<double> frame_times;             ///< of the frames stored so far
  Stopping::State stopping;
  SimulationState state;
};

/// Write a checkpoint. The file is a frame too, for read_frame and for ParaView. Whole or not at
/// all. Throws StoreError.
void write_checkpoint(const Place& place, const Frame& frame, Checkpoint checkpoint);
void write_checkpoint(const std::filesystem::path& file, const Frame& frame, Checkpoint checkpoint);

/// Whether a frame is a checkpoint too. Throws StoreError for what is no frame.
bool is_checkpoint(const std::filesystem::path& file);

/// Read what write_checkpoint wrote. Throws StoreError for anything else, a damaged file and one of
/// a later format included; whether the state fits its scene, Simulation will say.
Checkpoint read_checkpoint(const std::filesystem::path& file);

} // namespace lamella
