#pragma once
#include "scene/scene.h"

#include <array>
#include <optional>
#include <vector>

namespace lamella {

/// The level set that a scene starts from.
struct Start {
  struct Exact {
    double area, volume;
  };
  std::vector<double> phi; ///< nodal values
  std::vector<double>
      psi{};               ///< the same, with phases: about the signed distance from their boundary
  std::vector<double> c{}; ///< the same, with a stretch modulus: local stretch
  std::optional<Exact> exact; ///< of the shape itself, where it is known
  std::array<int, 3> cells{}; ///< by which the box of a stored frame had moved
};

/// Throws RunError for a frame that does not fit the scene, StoreError for one that cannot be read.
Start start_of(const Scene& scene);

} // namespace lamella
