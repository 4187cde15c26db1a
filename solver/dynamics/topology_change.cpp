#include "dynamics/topology_change.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

// Spacings. Below these radii necks and films are not resolved: a neck of the radius of a spacing
// and a quarter would pinch off within a few steps, if it is closing at all.
constexpr double neck_radius = 1.25, film_radius = 1.3, rest_radius = 0.9;
constexpr double soon = 60; // h^4 / kappa; a neck at rest takes longer than that to close
constexpr double film_anisotropy = 0.3; // of a film, second over first stiffness

// The lift: a Gaussian around the place, or around a disc in the middle of a film. In spacings, and
// relative to half the thickness of films thick enough for that.
constexpr double least_width = 1.5, width_to_thickness = 0.8;
constexpr double least_hole = 3, hole_to_thickness = 1.6;
constexpr double lift_to_width = 0.8; // height of phi / |grad phi| in the middle

Eigen::Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

} // namespace

double ClosingRule::least_reach(double spacing) const {
  return std::max({neck_radius * spacing, film_radius * spacing, 0.5 * rupture_thickness});
}

double ClosingRule::reach(double spacing) const { return least_reach(spacing) + 0.9 * spacing; }

bool ClosingRule::is_film(const CriticalPoint& point) {
  return point.stiffness[1] < film_anisotropy * point.stiffness[2];
}

bool ClosingRule::parts(const CriticalPoint& point, double speed, double spacing,
                        Event::Kind& kind) const {
  const double least = point.stiffness[0], most = point.stiffness[2];
  if (most <= 0) return false;
  const double h = spacing, r = point.radius;
  const double hopeless = is_film(point) ? hopeless_film : hopeless_neck;
  const bool closing = speed * soon * h * h * h * h / bending_modulus > r || r < hopeless * h;
  if (is_film(point)) {
    kind = Event::Kind::rupture;
    return rupture_thickness > 0 ? r < 0.5 * rupture_thickness : closing && r < film_radius * h;
  }
  if (least < 0) {
    kind = Event::Kind::fission;
    return closing && r < neck_radius * h;
  }
  kind = Event::Kind::vanished;
  return r < rest_radius * h;
}

void part(LevelSet& phi, const Closing& place) {
  const Grid& grid = phi.grid();
  const double h = grid.spacing;
  const bool film = place.kind == Event::Kind::rupture;
  const double thickness = film ? place.at.radius : 0;
  const double width = std::max(least_width * h, width_to_thickness * thickness);
  const double hole = film ? std::max(least_hole * h, hole_to_thickness * thickness) : 0;
  const double amplitude = std::abs(place.at.phi) + lift_to_width * width * place.grad;
  const Eigen::Vector3d x = vector(place.at.place), across = vector(place.at.across);
  const int reach = int(std::ceil((hole + 3.5 * width) / h));
  int first[3], last[3];
  for (int d = 0; d < 3; d++) {
    const int middle = int(std::lround((x[d] - grid.origin(d)) / h));
    first[d] = std::max(0, middle - reach);
    last[d] = std::min(grid.nodes[d] - 1, middle + reach);
  }
  for (int k = first[2]; k <= last[2]; k++)
    for (int j = first[1]; j <= last[1]; j++)
      for (int i = first[0]; i <= last[0]; i++) {
        const Eigen::Vector3d d =
            Eigen::Vector3d(grid.coordinate(0, i), grid.coordinate(1, j), grid.coordinate(2, k)) -
            x;
        const double along = d.dot(across);
        const double beyond = std::max(0.0, (d - along * across).norm() - hole);
        const double distance2 = along * along + beyond * beyond;
        phi.coefficients()[grid.index(i, j, k)] +=
            amplitude * std::exp(-0.5 * distance2 / (width * width));
      }
}

} // namespace lamella
