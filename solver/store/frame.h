#pragma once
#include "grid/grid.h"

#include <array>
#include <filesystem>
#include <vector>

namespace lamella {

/// The state at one time: nodal values of the level set phi, negative inside, and of the fields on
/// the membrane that the scene has.
struct Frame {
  Grid grid;
  double time = 0;
  std::vector<double> phi;    ///< grid.size() values, x fastest
  std::array<int, 3> cells{}; ///< the box has moved by so many spacings to follow the vesicle
  std::vector<double> psi{};  ///< phases: negative in Ld, positive in Lo; empty: one phase
  std::vector<double> c{};    ///< local stretch; empty: none
};

/// Write a frame as VTKHDF ImageData (opens in ParaView >= 5.11) with point data phi, and psi and c
/// where the frame has them. The file appears whole or not at all. Throws StoreError.
void write_frame(const std::filesystem::path& file, const Frame& frame);

/// Read what write_frame wrote. Throws StoreError for anything else, a damaged file included.
Frame read_frame(const std::filesystem::path& file);

} // namespace lamella
