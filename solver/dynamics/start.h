#pragma once
#include "scene/scene.h"
#include "store/frame.h"

#include <array>
#include <optional>
#include <vector>

namespace lamella {

/// The fields that a scene starts from, at the nodes.
struct Start {
  struct Exact {
    double area, volume;
    double area_ld = 0; ///< of the domains; without them 0
  };
  std::vector<double> phi{}; ///< the membrane, negative inside
  /// psi with phases, about the signed distance from their boundary; c of local stretch where a
  /// stored frame has it, else 1; material fields that start from arrays.
  NodalFields fields{};
  std::optional<Exact> exact{}; ///< of the shape itself, where it is known
  std::array<int, 3> cells{};   ///< by which the box of a stored frame had moved
};

/// Throws RunError for a frame that does not fit the scene, StoreError for one that cannot be read.
Start start_of(const Scene& scene);

/// From a state in memory, in place of the file that a scene of kind "frame" names. Throws as
/// above.
Start start_of(const Scene& scene, Frame frame);

} // namespace lamella
