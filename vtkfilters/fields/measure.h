#pragma once
#include "fields/field_data.h"
#include "store/frame.h"

#include <optional>
#include <vector>

namespace lamella {

/// What the geometry of a membrane and its bending energy tell. The share of a phase
/// changes smoothly across the boundary.
struct ShapeMeasures {
  double area = 0, volume = 0;
  double reduced_volume = 0, area_difference = 0;
  double int_KM2 = 0;
  double bending_energy = 0;
  double P = 0, sigma = 0; ///< that hold volume and area, of one phase; NaN with two
  int components = 0, genus = 0;
  double neck_radius = 0; ///< of the thinnest neck; NaN where there is none
  struct Phases {
    double area_Ld = 0, area_Lo = 0;
    double bending_energy_Ld = 0, bending_energy_Lo = 0;
    double line_length = 0;
  };
  std::optional<Phases> phases;
};

/// Area and volume alone.
struct Size {
  double area = 0, volume = 0;
};
/// Of each sheet of the membrane, where `nearest` tells the sheet next to each node; one around a
/// cavity has a negative volume.
std::vector<Size> sizes_of(const Frame& frame, const std::vector<int>& nearest, int sheets);

ShapeMeasures measure(const Frame& frame, const Scene& forces);

} // namespace lamella
