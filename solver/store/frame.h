#pragma once
#include "grid/grid.h"

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// Values at the nodes, of fields by their names.
using NodalFields = std::map<std::string, std::vector<double>, std::less<>>;

/// The state at one time: nodal values of the level set phi, negative inside, and of the fields on
/// the membrane that the scene has.
struct Frame {
  Grid grid;
  double time = 0;
  std::vector<double> phi;    ///< grid.size() values, x fastest
  std::array<int, 3> cells{}; ///< the box has moved by so many spacings to follow the vesicle
  /// By name, as many values each: psi, negative in Ld and positive in Lo, of two phases; c of
  /// local stretch; material fields.
  NodalFields fields{};

  bool has(std::string_view field) const { return fields.find(field) != fields.end(); }
  /// Empty where there is none of this name.
  std::span<const double> field(std::string_view name) const;
};

/// Write a frame as VTKHDF ImageData (opens in ParaView >= 5.11) with point data phi and the
/// frame's fields. The file appears whole or not at all. Throws StoreError.
void write_frame(const std::filesystem::path& file, const Frame& frame);

/// Read what write_frame wrote. Throws StoreError for anything else, a damaged file included.
Frame read_frame(const std::filesystem::path& file);

} // namespace lamella
