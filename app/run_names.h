#pragma once
#include <cstddef>
#include <string>

// What a run writes into its folder, by name.
namespace lamella::run_names {

inline constexpr const char *scene = "scene.toml", *start = "start.hdf", *history = "history.csv",
                            *events = "events.csv", *components = "components.csv",
                            *summary = "summary.txt", *status = "status.toml",
                            *series = "frames.hdf.series";
inline constexpr const char *frames = "frames", *checkpoints = "checkpoints",
                            *surfaces = "surfaces"; ///< folders

std::string frame(std::size_t number);
std::string checkpoint(long steps);

} // namespace lamella::run_names
