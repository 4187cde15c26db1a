#pragma once
#include "grid/grid.h"
#include "scene/bulge.h"
#include "scene/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace lamella {

/// Small over large semi-axis of the oblate (a, a, c) and prolate (b, b, a) spheroid of a reduced
/// volume between 0 and 1: c / a, b / a.
double oblate_axis_ratio(double reduced_volume);
double prolate_axis_ratio(double reduced_volume);

// All that follows is for analytic shapes; std::logic_error for ShapeKind::frame.

/// Semi-axes along the body's own x, y, z of any shape but the torus.
Vec3 semi_axes(const Shape& shape);

/// A vector along the body's own x, y, z.
Vec3 in_own_frame(const Shape& shape, const Vec3& vector);

/// Area and volume of the shape itself, to rounding; not those of its level set on a grid.
double exact_area(const Shape& shape);
double exact_volume(const Shape& shape);

struct Bounds {
  Vec3 low, high;
};

/// The smallest axis-parallel box that holds the rotated, shifted shape.
Bounds bounding_box(const Shape& shape);

/// Largest distance from the shape's axis, z before rotation, and between any two points.
double largest_radius(const Shape& shape);
double largest_extent(const Shape& shape);

/// Radius of the largest ball that fits inside at the thinnest place: smallest semi-axis, tube
/// radius. The hole of a torus counts too, as the half-thickness of what lies outside.
double smallest_half_thickness(const Shape& shape);

/// Smallest radius of curvature anywhere on the surface, in any direction.
double smallest_radius_of_curvature(const Shape& shape);

/// The start level set at the nodes of a grid, negative inside, x fastest.
///
/// The polynomial that vanishes on the shape (degree 2; 4 for the torus), which a degree-7 spline
/// represents exactly, scaled so that |grad phi| on the surface lies around 1: from
/// sqrt(c / a) to sqrt(a / c) for semi-axes from c to a. It levels off as W tanh(phi / W), W the
/// larger of 16 spacings and a quarter of the box. Towards the sides it is made periodic: with f_i
/// the polynomials of the shape's images beyond them, f becomes f / (1 + sum (f / f_i)^4)^(1/4),
/// which vanishes nowhere else than f and has a smooth ridge half way to an image. (Without, the
/// level set of a turned shape jumped at the sides; the ringing of the spline there grew to pieces
/// of membrane in empty space.) (A first-order distance, f / |grad f|, is smooth too, but not on
/// the scale of a thin rim: at 64^3 it put an error of 70 % into Lap_s K_M at the rim of the oblate
/// with reduced volume 0.6.)
///
/// A perturbation is taken into the argument, phi(x - w(x)) with w its displacement: to first order
/// it moves the surface by w. It fades where |phi| is from 6 to 12 spacings. Caps of a sphere that
/// bulge are worked into the polynomial before it levels off; they keep a slope of 1.
std::vector<double> initial_phi(const Shape& shape, const Grid& grid,
                                const Perturbation& perturbation = {},
                                std::span<const BulgedCap> caps = {});

/// A function of the way from the centre of the shape, at the nodes of a grid and periodic: the
/// mean of what it is for the shape and for its images beyond the sides of the box, weighted with
/// 1 / phi^4 and thus what it is for the shape near the surface.
std::vector<double> mean_over_images(const Shape& shape, const Grid& grid,
                                     std::span<const BulgedCap> caps,
                                     const std::function<double(const Vec3&)>& value);

/// The scaled polynomial at one point of unbounded space.
double shape_function(const Shape& shape, const Vec3& point, const Perturbation& perturbation = {});

} // namespace lamella
