#pragma once
#include "grid/grid.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace lamella {

enum class ShapeKind { sphere, oblate, prolate, ellipsoid, torus };

/// The start shape. Which members count depends on the kind. Before rotation the symmetry axis is
/// z.
struct Shape {
  ShapeKind kind = ShapeKind::oblate;
  double radius = 0.5;                         ///< sphere
  double semi_axis = 0.7;                      ///< oblate, prolate: the largest semi-axis
  double reduced_volume = 0.6;                 ///< oblate, prolate: V / (4/3 pi (A / 4 pi)^(3/2))
  Vec3 semi_axes{0.7, 0.6, 0.5};               ///< ellipsoid, along x, y, z
  double ring_radius = 0.5, tube_radius = 0.2; ///< torus about the z axis
  Vec3 center{0, 0, 0};
  Vec3 rotation_axis{0, 0, 1}; ///< any length but zero
  double rotation_angle = 0;   ///< degrees, right-handed about rotation_axis

  bool operator==(const Shape&) const = default;
};

/// Helfrich energy: bending_modulus / 2 int (K_M - spontaneous_curvature)^2 dA; K_M = -2 on the
/// unit sphere.
struct Membrane {
  double bending_modulus = 1;
  double spontaneous_curvature = 0;

  bool operator==(const Membrane&) const = default;
};

/// What is held during a run. This release knows one way for each.
enum class Constraint { fixed };

struct Constraints {
  Constraint volume = Constraint::fixed;
  Constraint area = Constraint::fixed;

  bool operator==(const Constraints&) const = default;
};

struct Numerics {
  double tolerance =
      0.005; ///< local time error allowed per step, rms over the membrane, in grid spacings
  double max_time_step = 0; ///< 0: end_time / 16

  bool operator==(const Numerics&) const = default;
};

struct Output {
  int frames = 11; ///< stored states, equally spaced in time from start to end, both included

  bool operator==(const Output&) const = default;
};

/// All parameters of a run. Lengths in box units, drag coefficient 1, so time is in length^4 /
/// bending_modulus.
struct Scene {
  std::string
      name; ///< of the run: file name without folder and extension unless the scene says otherwise
  std::string title;
  std::array<int, 3> nodes{64, 64, 64};
  double half_width = 1; ///< of the box along its shortest axis
  Shape shape;
  Membrane membrane;
  Constraints constraints;
  double end_time = 1.6e-3;
  Numerics numerics;
  Output output;

  Grid grid() const;
  bool operator==(const Scene&) const = default;
};

/// One of several keys ("section.name"), and where it was given ("file:12: ", or nothing).
struct KeyPlace {
  std::string_view key;
  std::string place;
};

/// Chooses among the keys that a broken rule involves, most to blame first, the one to name.
using KeyLocator = std::function<KeyPlace(std::span<const std::string_view> keys)>;

/// Check every rule of docs/scene-format.md. Throws SceneError for the first that is broken, named
/// after the key and place that `locate` chooses, or without a place after the first key.
void validate(const Scene& scene, const KeyLocator& locate = {});

} // namespace lamella
