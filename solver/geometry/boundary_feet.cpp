#include "geometry/boundary_feet.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

using Eigen::Vector3d;

constexpr std::size_t most_in_block = 24;

/// Consecutive points of the boundary and a ball around them.
struct Block {
  int begin, end;
  Vector3d center;
  double radius;
};

std::vector<Block> blocks_of(const PhaseBoundary& boundary) {
  const std::span<const BoundaryPoint> p = boundary.points();
  std::vector<Block> blocks;
  for (std::size_t begin = 0; begin < p.size();) {
    const std::size_t end = std::min(begin + most_in_block, p.size());
    Block b{int(begin), int(end), Vector3d::Zero(), 0};
    for (std::size_t i = begin; i < end; i++) b.center += p[i].x / double(end - begin);
    for (std::size_t i = begin; i < end; i++)
      b.radius = std::max(b.radius, (p[i].x - b.center).norm());
    blocks.push_back(b);
    begin = end;
  }
  return blocks;
}

/// Unit normal at the nearest point of a band entry: from there to the node, or where that is a
/// short way the gradient between the neighbours of the node.
Vector3d normal_at(const LevelSet& phi, const NarrowBand& band, std::size_t entry) {
  const ConstPoints x = band.positions(), p = band.points();
  const double d = band.distance()[entry];
  if (std::abs(d) > 0.5 * band.grid().spacing)
    return Vector3d(x.x[entry] - p.x[entry], x.y[entry] - p.y[entry], x.z[entry] - p.z[entry]) / d;
  const Grid& grid = band.grid();
  const int node = band.node()[entry], stride[3] = {1, grid.nx(), grid.nx() * grid.ny()};
  Vector3d g;
  for (int a = 0; a < 3; a++) {
    const int at = node / stride[a] % grid.nodes[a];
    const int before = at > 0 ? node - stride[a] : node,
              after = at + 1 < grid.nodes[a] ? node + stride[a] : node;
    g[a] = phi.nodal()[after] - phi.nodal()[before];
  }
  return g.normalized();
}

/// The foot near the nearest point of the boundary: a way along the curve, which bends. The
/// distance is the length of the cubic between foot and point with the slopes of the membrane at
/// both ends.
BoundaryFeet::Foot foot_at(const PhaseBoundary& boundary, int nearest, const Vector3d& x,
                           const Vector3d& N) {
  const BoundaryPoint& c = boundary.points()[nearest];
  const Vector3d r = x - c.x;
  const double way = r.dot(c.t) / std::max(0.25, 1 - r.dot(c.curvature()));
  const auto [before, after] = boundary.neighbours(nearest);
  const int next = way < 0 ? before : after;
  const double gap = (boundary.points()[next].x - c.x).norm();
  BoundaryFeet::Foot foot{nearest, next, 0, 0};
  foot.share = gap > 0 ? std::min(std::abs(way) / gap, 1.0) : 0;
  const Vector3d t = c.t + way * c.curvature(), n = c.n - way * (c.kg * c.t - c.tau_g * c.N),
                 N_foot = c.N - way * (c.kn * c.t + c.tau_g * c.n);
  Vector3d away = r - way * (c.t + 0.5 * way * c.curvature());
  away -= away.dot(t) / t.squaredNorm() * t;
  const double chord = away.norm(), least = 0.5 * chord;
  const double a = away.dot(N_foot) / std::max(std::abs(away.dot(n)), least + 1e-300),
               b = away.dot(N) / std::max((away - away.dot(N) * N).norm(), least + 1e-300);
  foot.distance = std::copysign(chord * (1 + (a * a + b * b) / 15 - a * b / 30), away.dot(n));
  return foot;
}

} // namespace

void BoundaryFeet::find(const PhaseBoundary& boundary, const LevelSet& phi, const NarrowBand& band,
                        double reach) {
  const ConstPoints points = band.points();
  feet_.assign(band.size(), {});
  const std::vector<Block> blocks = blocks_of(boundary);
  const std::span<const BoundaryPoint> curve = boundary.points();
  std::vector<double> cx, cy, cz;
  for (const BoundaryPoint& p : curve) {
    cx.push_back(p.x[0]);
    cy.push_back(p.x[1]);
    cz.push_back(p.x[2]);
  }
  parallel_for(band.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const Vector3d x(points.x[i], points.y[i], points.z[i]);
      double best2 = reach * reach;
      int nearest = -1;
      for (const Block& b : blocks) {
        const double d = (x - b.center).norm() - b.radius;
        if (d > 0 && d * d > best2) continue;
        for (int m = b.begin; m < b.end; m++) {
          const double dx = cx[m] - x[0], dy = cy[m] - x[1], dz = cz[m] - x[2],
                       d2 = dx * dx + dy * dy + dz * dz;
          if (d2 < best2) {
            best2 = d2;
            nearest = m;
          }
        }
      }
      if (nearest >= 0) feet_[i] = foot_at(boundary, nearest, x, normal_at(phi, band, i));
    }
  });
}

} // namespace lamella
