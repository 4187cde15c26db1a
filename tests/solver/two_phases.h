#pragma once
#include "geometry/phase_boundary.h"
#include "start_surface.h"

#include <cmath>
#include <functional>

namespace lamella {

/// A membrane cut by {psi = 0}, and the phase boundary on it.
struct TwoPhases : StartSurface {
  using Function = std::function<double(const Eigen::Vector3d&)>;

  LevelSet psi;
  PhaseBoundary boundary;

  TwoPhases(const std::vector<double>& phi_nodal, const Function& psi_at, int nodes)
      : StartSurface(phi_nodal, Grid::cube(nodes, 1)), psi(grid) {
    const auto nodal = at_nodes(grid, [&](const Vec3& x) { // levels off, to be nearly periodic
      return 0.5 * std::tanh(2 * psi_at({x[0], x[1], x[2]}));
    });
    std::copy(nodal.begin(), nodal.end(), psi.coefficients().begin());
    psi.fit(nodal, fourier);
    trace();
  }
  TwoPhases(const Shape& shape, const Function& psi_at, int nodes)
      : TwoPhases(initial_phi(shape, Grid::cube(nodes, 1)), psi_at, nodes) {}

  void trace() { boundary.trace(phi, psi, band); }

  std::vector<Eigen::Vector3d> places() const {
    std::vector<Eigen::Vector3d> out;
    for (const BoundaryPoint& p : boundary.points()) out.push_back(p.x);
    return out;
  }
};

} // namespace lamella
