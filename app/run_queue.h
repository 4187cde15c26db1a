#pragma once
#include "run_store.h"

#include <string>
#include <vector>

namespace lamella {

/// A run that did not come to its end, and why.
struct FailedRun {
  std::string scene, why;
};

/// Runs scenes that a store does not have yet, each as a process of this program, as many at a time
/// as there are cores, and the longest ones first. A terminal shows one line of progress; elsewhere
/// each run is told as it ends. Ends early where an interrupt is requested. Throws StoreError.
std::vector<FailedRun> run_all(std::vector<Scene> scenes, const RunStore& store, int cores);

} // namespace lamella
