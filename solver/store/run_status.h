#pragma once
#include "store/folder.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace lamella {

/// What became of a run so far, for programs: status.toml in its folder.
struct RunStatus {
  enum class State {
    running,     ///< under way, or killed
    interrupted, ///< stopped from outside; can be resumed
    finished,    ///< at its end time, or as far as a rule of the scene lets it
    stopped      ///< could not go on
  };
  State state = State::running;
  std::string reason;      ///< of an end before the end time
  double time = 0;         ///< of the simulation
  double wall_seconds = 0; ///< that it took, with all its resumptions
  int threads = 0;
  std::string scene_hash; ///< hash_of() the text of scene.toml
  std::string origin;     ///< of a branch: the folder and time that it set out from
};

std::string_view to_string(RunStatus::State state);

/// FNV-1a over 64 bits, as 16 hexadecimal digits.
std::string hash_of(std::string_view text);

/// Write status.toml, with the version of the program and its arithmetic. Whole or not at all.
/// Throws StoreError.
void write_status(const Place& place, const RunStatus& status);

/// Throws StoreError for anything else than what write_status wrote.
RunStatus read_status(const std::filesystem::path& file);

} // namespace lamella
