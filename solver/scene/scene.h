#pragma once
#include "grid/grid.h"

#include <array>
#include <string>
#include <vector>

namespace lamella {

enum class ShapeKind { sphere, oblate, prolate, ellipsoid, torus };

/// The start shape. Which members count depends on the kind.
struct Shape {
  ShapeKind kind = ShapeKind::oblate;
  double radius = 0.5;                         ///< sphere
  double semi_axis = 0.7;                      ///< oblate, prolate: the largest semi-axis
  double reduced_volume = 0.6;                 ///< oblate, prolate: V / (4/3 pi (A / 4 pi)^(3/2))
  Vec3 semi_axes{0.7, 0.6, 0.5};               ///< ellipsoid
  double ring_radius = 0.5, tube_radius = 0.2; ///< torus about the z axis
  Vec3 center{0, 0, 0};
  Vec3 rotation_axis{0, 0, 1};                 ///< any length but zero
  double rotation_angle = 0;                   ///< degrees, right-handed about rotation_axis
};

/// Helfrich energy: bending_modulus / 2 int (K_M - spontaneous_curvature)^2 dA; K_M = -2 on the unit sphere.
struct Membrane {
  double bending_modulus = 1;
  double spontaneous_curvature = 0;
};

enum class Constraint { fixed, free };

struct Constraints {
  Constraint volume = Constraint::fixed;
  Constraint area = Constraint::fixed;
};

struct Numerics {
  double tolerance = 0.005;  ///< local time error allowed per step, rms over the membrane, in grid spacings
  double max_time_step = 0;  ///< 0: end_time / 16
};

struct Output {
  int frames = 11; ///< stored states, equally spaced in time from start to end, both included
};

/// All parameters of a run. Lengths in box units, drag coefficient 1, so time is in length^4 / bending_modulus.
struct Scene {
  std::string name;  ///< file name without folder and extension
  std::string title;
  std::array<int, 3> nodes{64, 64, 64};
  double half_width = 1;  ///< of the box along its shortest axis
  Shape shape;
  Membrane membrane;
  Constraints constraints;
  double end_time = 1.6e-3;
  Numerics numerics;
  Output output;

  Grid grid() const;
};

} // namespace lamella
