#include "scene/shapes.h"

#include "parallel.h"
#include "scene/perturbation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace lamella {
namespace {

using std::numbers::pi;

/// Carlson's symmetric elliptic integral R_F by duplication (DLMF 19.36.1). The test is written so
/// that a NaN ends the loop.
double carlson_rf(double x, double y, double z) {
  for (;;) {
    const double mean = (x + y + z) / 3;
    const double dx = 1 - x / mean, dy = 1 - y / mean, dz = 1 - z / mean;
    if (!(std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) >= 1e-3)) {
      const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
      return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / std::sqrt(mean);
    }
    const double shift = std::sqrt(x * y) + std::sqrt(x * z) + std::sqrt(y * z);
    x = (x + shift) / 4, y = (y + shift) / 4, z = (z + shift) / 4;
  }
}

/// Carlson's R_D, symmetric in x and y, by duplication (DLMF 19.36.2).
double carlson_rd(double x, double y, double z) {
  double sum = 0, scale = 1;
  for (;;) {
    const double mean = (x + y + 3 * z) / 5;
    const double dx = 1 - x / mean, dy = 1 - y / mean, dz = 1 - z / mean;
    if (!(std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) >= 1e-3)) {
      const double xy = dx * dy, zz = dz * dz;
      const double e2 = xy - 6 * zz, e3 = (3 * xy - 8 * zz) * dz, e4 = 3 * (xy - zz) * zz;
      const double e5 = xy * zz * dz;
      const double series = 1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 -
                            9 * e2 * e3 / 52 + 3 * e5 / 26;
      return 3 * sum + scale * series / (mean * std::sqrt(mean));
    }
    const double shift = std::sqrt(x * y) + std::sqrt(x * z) + std::sqrt(y * z);
    sum += scale / (std::sqrt(z) * (z + shift));
    scale /= 4;
    x = (x + shift) / 4, y = (y + shift) / 4, z = (z + shift) / 4;
  }
}

/// Area of an ellipsoid, 4 pi R_G(b^2 c^2, a^2 c^2, a^2 b^2) (DLMF 19.33.1), with R_G from R_F and
/// R_D by 19.21.10. The middle argument stands apart there, so that no two terms cancel.
double ellipsoid_area(const Vec3& axes) {
  const auto [a, b, c] = axes;
  std::array<double, 3> q{b * b * c * c, a * a * c * c, a * a * b * b};
  std::ranges::sort(q);
  const auto [low, middle, high] = q;
  return 2 * pi *
         (middle * carlson_rf(low, high, middle) +
          (middle - low) * (high - middle) / 3 * carlson_rd(low, high, middle) +
          std::sqrt(low * high / middle));
}

double ellipsoid_volume(const Vec3& axes) { return 4 * pi / 3 * axes[0] * axes[1] * axes[2]; }

double reduced_volume(const Vec3& axes) {
  return ellipsoid_volume(axes) / (4 * pi / 3 * std::pow(ellipsoid_area(axes) / (4 * pi), 1.5));
}

/// Bisect for the ratio in (0, 1) at which a reduced volume that grows with the ratio is reached.
template <class AxesOfRatio>
double axis_ratio(double target, AxesOfRatio axes) {
  double low = 0, high = 1;
  for (;;) {
    const double ratio = low + (high - low) / 2;
    if (ratio <= low || ratio >= high) return high;
    (reduced_volume(axes(ratio)) < target ? low : high) = ratio;
  }
}

using Rotation = std::array<Vec3, 3>; ///< rows; body to box coordinates

/// Cosine and sine of an angle in degrees, exact at multiples of 90.
std::pair<double, double> cosine_and_sine(double degrees) {
  int quarter_turns = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter_turns) * pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (quarter_turns & 3) {
  case 0:
    return {c, s};
  case 1:
    return {-s, c};
  case 2:
    return {-c, -s};
  default:
    return {s, -c};
  }
}

Rotation rotation(const Shape& shape) {
  const auto& axis = shape.rotation_axis;
  const double largest = std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
  const double length = std::hypot(axis[0] / largest, axis[1] / largest, axis[2] / largest);
  const Vec3 u{axis[0] / largest / length, axis[1] / largest / length, axis[2] / largest / length};
  const auto [c, s] = cosine_and_sine(shape.rotation_angle);
  Rotation r{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r[i][j] = (1 - c) * u[i] * u[j];
    r[i][i] += c;
    r[i][(i + 2) % 3] += s * u[(i + 1) % 3];
    r[i][(i + 1) % 3] -= s * u[(i + 2) % 3];
  }
  return r;
}

Vec3 to_body(const Rotation& r, const Vec3& d) {
  Vec3 x{};
  for (int j = 0; j < 3; ++j) x[j] = r[0][j] * d[0] + r[1][j] * d[1] + r[2][j] * d[2];
  return x;
}

/// Negative inside; |gradient| 2 / semi-axis at the poles.
double quadric(const Vec3& axes, const Vec3& x) {
  double value = -1;
  for (int i = 0; i < 3; ++i) value += x[i] / axes[i] * (x[i] / axes[i]);
  return value;
}

/// Negative inside; |gradient| 8 ring^2 tube on top of the tube.
double quartic(double ring, double tube, const Vec3& x) {
  const double rho_squared = x[0] * x[0] + x[1] * x[1];
  const double g = rho_squared + x[2] * x[2] + ring * ring - tube * tube;
  return g * g - 4 * ring * ring * rho_squared;
}

/// 0 up to 0, rising to 1 at 1, four times differentiable.
double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return std::pow(u, 5) * (126 - u * (420 - u * (540 - u * (315 - 70 * u))));
}

/// The level set in the shape's own frame, with all that does not depend on the point computed
/// once.
class ShapeFunction {
public:
  /// Where |phi| is more than `reach`, and from half of it on more and more, the shape is taken
  /// without its perturbation, which costs most of the time.
  ShapeFunction(const Shape& shape, const Perturbation& perturbation,
                std::span<const BulgedCap> caps = {},
                double reach = std::numeric_limits<double>::infinity())
      : shape_(shape), rotation_(rotation(shape)), is_perturbed_(perturbation.amplitude > 0),
        displacement_(perturbation, shape), reach_(reach), caps_(caps) {
    if (shape.kind == ShapeKind::torus) {
      scale_ = 1 / (8 * shape.ring_radius * shape.ring_radius * shape.tube_radius);
    } else {
      axes_ = semi_axes(shape);
      const auto [smallest, largest] = std::ranges::minmax(axes_);
      scale_ = std::sqrt(smallest * largest) / 2;
    }
  }

  /// d: from the shape's centre.
  double operator()(const Vec3& d) const {
    Vec3 x = to_body(rotation_, d);
    const double smooth = of_shape(x);
    if (!is_perturbed_) return smooth;
    const double share = 1 - smooth_step(2 * std::abs(smooth) / reach_ - 1);
    if (share == 0) return smooth;
    const Vec3 w = displacement_(x);
    for (int i = 0; i < 3; ++i) x[i] -= share * w[i];
    return of_shape(x);
  }

private:
  double of_shape(const Vec3& x) const {
    if (shape_.kind == ShapeKind::torus)
      return scale_ * quartic(shape_.ring_radius, shape_.tube_radius, x);
    double phi = scale_ * quadric(axes_, x);
    for (const BulgedCap& cap : caps_) phi = cap(phi, x);
    return phi;
  }

  Shape shape_;
  Rotation rotation_;
  bool is_perturbed_;
  Displacement displacement_;
  double reach_;
  std::span<const BulgedCap> caps_;
  Vec3 axes_{};
  double scale_;
};

/// use(d_i, f_i, share) for a shape and each of its images beyond the sides of a periodic box: the
/// way there from its centre, its level set there, and how much it counts, 1 for the shape itself
/// and what rises from 0 half way to a side to 1 there for an image.
template <class Use>
void for_each_image(const ShapeFunction& function, const Vec3& d, const Vec3& length, Use&& use) {
  Vec3 near;
  for (int i = 0; i < 3; ++i) near[i] = smooth_step(4 * std::abs(d[i]) / length[i] - 1);
  use(d, function(d), 1.0);
  for (int image = 1; image < 8; ++image) {
    Vec3 there = d;
    double share = 1;
    for (int i = 0; i < 3; ++i) {
      if (!(image >> i & 1)) continue;
      there[i] -= std::copysign(length[i], d[i]);
      share *= near[i];
    }
    if (share > 0) use(there, function(there), share);
  }
}

/// f(d) at the nodes of a grid, d the way there from the nearest image of a shape's centre.
template <class Function>
std::vector<double> at_box_nodes(const Grid& grid, const Vec3& center, Function&& f) {
  std::vector<double> values(grid.size());
  parallel_for(values.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      Vec3 d = grid.position(n);
      for (int i = 0; i < 3; ++i) d[i] = std::remainder(d[i] - center[i], grid.length(i));
      values[n] = f(d);
    }
  });
  return values;
}

Vec3 side_lengths(const Grid& grid) { return {grid.length(0), grid.length(1), grid.length(2)}; }

} // namespace

double oblate_axis_ratio(double reduced_volume) {
  return axis_ratio(reduced_volume, [](double q) { return Vec3{1, 1, q}; });
}

double prolate_axis_ratio(double reduced_volume) {
  return axis_ratio(reduced_volume, [](double q) { return Vec3{q, q, 1}; });
}

Vec3 semi_axes(const Shape& shape) {
  const double a = shape.semi_axis;
  switch (shape.kind) {
  case ShapeKind::oblate:
    return {a, a, a * oblate_axis_ratio(shape.reduced_volume)};
  case ShapeKind::prolate: {
    const double b = a * prolate_axis_ratio(shape.reduced_volume);
    return {b, b, a};
  }
  case ShapeKind::ellipsoid:
    return shape.semi_axes;
  case ShapeKind::sphere:
    return {shape.radius, shape.radius, shape.radius};
  default:
    throw std::logic_error("this kind of shape has no semi-axes");
  }
}

Vec3 in_own_frame(const Shape& shape, const Vec3& vector) {
  return to_body(rotation(shape), vector);
}

double exact_area(const Shape& shape) {
  if (shape.kind == ShapeKind::torus) return 4 * pi * pi * shape.ring_radius * shape.tube_radius;
  return ellipsoid_area(semi_axes(shape));
}

double exact_volume(const Shape& shape) {
  if (shape.kind == ShapeKind::torus)
    return 2 * pi * pi * shape.ring_radius * shape.tube_radius * shape.tube_radius;
  return ellipsoid_volume(semi_axes(shape));
}

Bounds bounding_box(const Shape& shape) {
  const Rotation r = rotation(shape);
  const bool is_torus = shape.kind == ShapeKind::torus;
  const Vec3 axes = is_torus ? Vec3{shape.ring_radius, shape.ring_radius, 0} : semi_axes(shape);
  Bounds box{};
  for (int i = 0; i < 3; ++i) {
    const double reach = std::hypot(r[i][0] * axes[0], r[i][1] * axes[1], r[i][2] * axes[2]) +
                         (is_torus ? shape.tube_radius : 0);
    box.low[i] = shape.center[i] - reach;
    box.high[i] = shape.center[i] + reach;
  }
  return box;
}

double largest_radius(const Shape& shape) {
  if (shape.kind == ShapeKind::torus) return shape.ring_radius + shape.tube_radius;
  const Vec3 axes = semi_axes(shape);
  return std::max(axes[0], axes[1]);
}

double largest_extent(const Shape& shape) {
  if (shape.kind == ShapeKind::torus) return 2 * largest_radius(shape);
  return 2 * std::ranges::max(semi_axes(shape));
}

double smallest_half_thickness(const Shape& shape) {
  if (shape.kind == ShapeKind::torus)
    return std::min(shape.tube_radius, shape.ring_radius - shape.tube_radius);
  return std::ranges::min(semi_axes(shape));
}

double smallest_radius_of_curvature(const Shape& shape) {
  if (shape.kind == ShapeKind::torus) return smallest_half_thickness(shape);
  const auto [smallest, largest] = std::ranges::minmax(semi_axes(shape));
  return smallest * smallest / largest;
}

double shape_function(const Shape& shape, const Vec3& point, const Perturbation& perturbation) {
  const Vec3& c = shape.center;
  return ShapeFunction(shape, perturbation)({point[0] - c[0], point[1] - c[1], point[2] - c[2]});
}

std::vector<double> initial_phi(const Shape& shape, const Grid& grid,
                                const Perturbation& perturbation, std::span<const BulgedCap> caps) {
  constexpr double perturbed = 12; // spacings
  const ShapeFunction function(shape, perturbation, caps, perturbed * grid.spacing);
  const double shortest = grid.spacing * std::ranges::min(grid.nodes);
  const double width = std::max(16 * grid.spacing, shortest / 4);
  return at_box_nodes(grid, shape.center, [&, length = side_lengths(grid)](const Vec3& d) {
    double phi = 0, sum = 0;
    for_each_image(function, d, length, [&](const Vec3&, double f, double share) {
      if (sum == 0) phi = f;
      sum += sum == 0 ? 1 : share * std::pow(phi / f, 4);
    });
    return width * std::tanh(phi / std::sqrt(std::sqrt(sum)) / width);
  });
}

std::vector<double> mean_over_images(const Shape& shape, const Grid& grid,
                                     std::span<const BulgedCap> caps,
                                     const std::function<double(const Vec3&)>& value) {
  const ShapeFunction function(shape, {}, caps);
  return at_box_nodes(grid, shape.center, [&, length = side_lengths(grid)](const Vec3& d) {
    double phi = 0, weights = 0, sum = 0;
    for_each_image(function, d, length, [&](const Vec3& there, double f, double share) {
      if (weights == 0) phi = f;
      const double weight = weights == 0 ? 1 : share * std::pow(phi / f, 4);
      weights += weight;
      sum += weight * value(there);
    });
    return sum / weights;
  });
}

} // namespace lamella
