#include "dynamics/topology_change.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

// Spacings. Below these radii necks and films are not resolved: a neck of the radius of a spacing
// and a quarter would pinch off within a few steps, if it is closing at all.
constexpr double neck_radius = 1.25, film_radius = 1.3, rest_radius = 0.9;
constexpr double hopeless_radius = 0.6; // whether closing or not
constexpr double soon = 60; // h^4 / kappa; a neck at rest takes longer than that to close
constexpr double film_anisotropy = 0.3; // of a film, second over first stiffness

// The lift, in spacings.
constexpr double lift = 1.2, lift_width = 1.5, film_hole = 3;

Eigen::Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

} // namespace

double ClosingRule::reach(double spacing) const {
  return std::max({neck_radius * spacing, film_radius * spacing, 0.5 * rupture_thickness}) +
         0.9 * spacing;
}

bool ClosingRule::parts(const CriticalPoint& point, double speed, double spacing,
                        Event::Kind& kind) const {
  const auto& [least, middle, most] = point.stiffness;
  if (most <= 0) return false;
  const double h = spacing, r = point.radius;
  const bool closing =
      speed * soon * h * h * h * h / bending_modulus > r || r < hopeless_radius * h;
  if (middle < film_anisotropy * most) {
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

void part(LevelSet& phi, std::span<const Closing> places) {
  const Grid& grid = phi.grid();
  const double h = grid.spacing, width = lift_width * h;
  std::vector<double> change(grid.size(), 0.0);
  for (const Closing& place : places) {
    const double amplitude = std::abs(place.at.phi) + lift * h * place.grad;
    const double hole = place.kind == Event::Kind::rupture ? film_hole * h : 0;
    const Eigen::Vector3d x = vector(place.at.place), across = vector(place.at.across);
    const int reach = int(std::ceil((hole + 3.5 * width) / h));
    int base[3];
    for (int d = 0; d < 3; d++) base[d] = int(std::lround((x[d] - grid.origin(d)) / h));
    for (int k = std::max(0, base[2] - reach); k <= std::min(grid.nz() - 1, base[2] + reach); k++)
      for (int j = std::max(0, base[1] - reach); j <= std::min(grid.ny() - 1, base[1] + reach); j++)
        for (int i = std::max(0, base[0] - reach); i <= std::min(grid.nx() - 1, base[0] + reach);
             i++) {
          const Eigen::Vector3d d =
              Eigen::Vector3d(grid.coordinate(0, i), grid.coordinate(1, j), grid.coordinate(2, k)) -
              x;
          const double along = d.dot(across);
          const double beyond = std::max(0.0, (d - along * across).norm() - hole);
          const double distance2 = along * along + beyond * beyond;
          double& most = change[grid.index(i, j, k)];
          most = std::max(most, amplitude * std::exp(-0.5 * distance2 / (width * width)));
        }
  }
  for (std::size_t i = 0; i < change.size(); i++) phi.coefficients()[i] += change[i];
}

} // namespace lamella
