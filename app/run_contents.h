#pragma once
#include "store/checkpoint.h"
#include "store/folder.h"
#include "store/run_status.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// What is in the folder of a run, and what of it is the run's own. Unless it says otherwise a
// function throws StoreError for what cannot be read.
namespace lamella {

/// Whether there is a run, however far it has come: a scene, and beside it a status or a history as
/// this program writes them.
bool holds_run(const std::filesystem::path& folder);
/// Throws UsageError for a folder that holds no run.
void require_run(const std::filesystem::path& folder);

/// The last frame of a run that has ended, also early; nothing for any other folder.
std::optional<std::filesystem::path> end_of_run(const std::filesystem::path& folder);

/// The frames that a run lists and its checkpoints, the oldest first.
std::vector<std::filesystem::path> stored_frames(const std::filesystem::path& folder);
std::vector<std::filesystem::path> stored_checkpoints(const std::filesystem::path& folder);

/// By name, in a folder that holds them.
std::vector<std::string> checkpoints_in(const Folder& folder);

/// As status.toml says. Of a run without one, or with one that is damaged, of which `complain` is
/// told, that it is running.
RunStatus status_of_run(const std::filesystem::path& folder,
                        const std::function<void(const std::string&)>& complain);

/// What a run can go on from.
struct Resumption {
  std::optional<Checkpoint> checkpoint; ///< the newest that is whole, as is all that it relies on
  std::vector<std::string> damage;      ///< why newer ones are not, one sentence each
};
Resumption find_checkpoint(const std::filesystem::path& folder);

/// Reads all frames and tables of a run; throws StoreError for the first that is damaged.
void check_stored_files(const std::filesystem::path& folder);

// -----------------------------------------------------------------------------------------------
// in a folder that this process alone writes to

/// Throws UsageError for a folder that may not receive a run: one with something in it, and with
/// `force` one with something else than an earlier run. Throws StoreError where that run may not be
/// replaced, see refuse_foreign().
void refuse_unsuitable(const Folder& folder, bool force);

/// Throws StoreError where something that a run has not written has the name of something that it
/// writes: a link, a folder, a frame that it does not list. The first `frames` of them are its own
/// in any case.
void refuse_foreign(const Folder& folder, std::size_t frames = 0);

// These remove what the run wrote, and what a program that was killed was about to write.

/// The latter alone.
void erase_unfinished(const Folder& folder);

/// All but status.toml, by which what is left is known as a run's.
void erase_run(const Folder& folder);
/// Of a run that goes on: what it writes at its end, and the surfaces made of it.
void erase_results(const Folder& folder);
/// All frames from a number on, and checkpoints of more steps than so many.
void erase_later(const Folder& folder, std::size_t frames, long steps);

/// Those of an export, which its collections list, in a folder of any name.
void erase_surfaces(const Folder& surfaces);

} // namespace lamella
