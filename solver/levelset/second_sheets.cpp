#include "levelset/second_sheets.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr double apart = 1.5; // spacings between the points of neighbours that are on two sheets
constexpr double same_point = 0.5; // spacings within which two points of one node are the same
constexpr int closest_point_steps = 6;
constexpr double residual = 1e-3;    // spacings, of x - p off the normal
constexpr double least_spread = 0.1; // 1 - d k: below, the point is not (safely) a nearest one
constexpr std::size_t lists = 4096;
constexpr std::size_t per_task = 512;

double distance2(const Vec3& a, const Vec3& b) {
  double sum = 0;
  for (int d = 0; d < 3; d++) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

Vec3 point_of(const NarrowBand& band, std::size_t s) {
  const ConstPoints p = band.points();
  return {p.x[s], p.y[s], p.z[s]};
}

} // namespace

/// Nodes of which a neighbour's nearest point is on another sheet: they may belong to it too.
std::vector<SecondSheets::Pair> SecondSheets::seeds(const NarrowBand& band, double nearest,
                                                    double furthest) const {
  const Grid& grid = band.grid();
  const double far2 = apart * apart * grid.spacing * grid.spacing;
  auto find = [&](std::size_t begin, std::size_t end, std::vector<Pair>& found) {
    for (std::size_t s = begin; s < end; s++) {
      const double d = band.distance()[s];
      if (d < nearest - 0.5 * grid.spacing || d > furthest + 0.5 * grid.spacing) continue;
      const Vec3 p = point_of(band, s);
      for_each_neighbour(grid, band.node()[s], [&](int m) {
        const int t = band.slot(m);
        if (t < 0) return;
        const Vec3 q = point_of(band, t);
        if (distance2(p, q) > far2) found.push_back({band.node()[s], q});
      });
    }
  };
  return parallel_collect<Pair>(band.size(), per_task, find);
}

bool SecondSheets::is_known(const NarrowBand& band, const Pair& pair) const {
  const double near2 = same_point * same_point * band.grid().spacing * band.grid().spacing;
  const int s = band.slot(pair.node);
  if (s >= 0 && distance2(point_of(band, s), pair.p) < near2) return true;
  for (const int i : at_node_[pair.node % lists])
    if (node_[i] == pair.node && distance2({p_[0][i], p_[1][i], p_[2][i]}, pair.p) < near2)
      return true;
  return false;
}

/// Finds the candidates' points, and takes in those that are nearest points of a sheet in reach and
/// not known yet. Returns what was taken in.
std::vector<SecondSheets::Pair> SecondSheets::accept(const LevelSet& phi, const NarrowBand& band,
                                                     std::vector<Pair> candidates, double nearest,
                                                     double furthest) {
  const Grid& grid = band.grid();
  const double h = grid.spacing;
  const std::size_t n = candidates.size();
  std::vector<char> good(n, 0);
  parallel_for(n, per_task, [&](std::size_t begin, std::size_t end) {
    const std::size_t m = end - begin;
    double x[3][per_task], p[3][per_task], step[per_task], taylor[10 * per_task];
    for (std::size_t i = 0; i < m; i++) {
      const Vec3 at = grid.position(candidates[begin + i].node);
      for (int d = 0; d < 3; d++) {
        x[d][i] = at[d];
        p[d][i] = candidates[begin + i].p[d];
      }
    }
    kernels().closest_points(phi.view(), m, {x[0], x[1], x[2]}, {p[0], p[1], p[2]},
                             closest_point_steps, true, step);
    kernels().taylor(phi.view(), m, {p[0], p[1], p[2]}, taylor);
    for (std::size_t i = 0; i < m; i++) {
      Pair& pair = candidates[begin + i];
      pair.p = {p[0][i], p[1][i], p[2][i]};
      auto t = [&](int k) { return taylor[k * m + i]; };
      const double grad = std::sqrt(t(1) * t(1) + t(2) * t(2) + t(3) * t(3));
      if (step[i] < 0 || !(grad > 0)) continue;
      const Vec3 normal{t(1) / grad, t(2) / grad, t(3) / grad};
      double d = 0, off2 = 0;
      for (int c = 0; c < 3; c++) d += (x[c][i] - p[c][i]) * normal[c];
      for (int c = 0; c < 3; c++) {
        const double off = x[c][i] - p[c][i] - d * normal[c];
        off2 += off * off;
      }
      // 1 - d K_M + d^2 K and 1 - d K_M / 2 from the Hessian, both positive where p is nearest.
      const double nHn = t(4) * normal[0] * normal[0] + t(5) * normal[1] * normal[1] +
                         t(6) * normal[2] * normal[2] +
                         2 * (t(7) * normal[0] * normal[1] + t(8) * normal[0] * normal[2] +
                              t(9) * normal[1] * normal[2]);
      const double KM = (nHn - t(4) - t(5) - t(6)) / grad;
      const double cxx = t(5) * t(6) - t(9) * t(9), cyy = t(4) * t(6) - t(8) * t(8),
                   czz = t(4) * t(5) - t(7) * t(7), cxy = t(8) * t(9) - t(7) * t(6),
                   cxz = t(7) * t(9) - t(5) * t(8), cyz = t(7) * t(8) - t(4) * t(9);
      const double K =
          (cxx * normal[0] * normal[0] + cyy * normal[1] * normal[1] + czz * normal[2] * normal[2] +
           2 * (cxy * normal[0] * normal[1] + cxz * normal[0] * normal[2] +
                cyz * normal[1] * normal[2])) /
          (grad * grad);
      good[begin + i] = d > nearest && d < furthest && off2 < residual * residual * h * h &&
                        1 - 0.5 * d * KM > least_spread && 1 - d * KM + d * d * K > least_spread;
    }
  });
  std::vector<Pair> taken;
  for (std::size_t i = 0; i < n; i++) {
    if (!good[i] || is_known(band, candidates[i])) continue;
    const Vec3 at = grid.position(candidates[i].node);
    at_node_[candidates[i].node % lists].push_back(int(node_.size()));
    node_.push_back(candidates[i].node);
    for (int d = 0; d < 3; d++) {
      x_[d].push_back(at[d]);
      p_[d].push_back(candidates[i].p[d]);
    }
    taken.push_back(candidates[i]);
  }
  return taken;
}

void SecondSheets::find(const LevelSet& phi, const NarrowBand& band, double nearest,
                        double furthest) {
  node_.clear();
  for (int d = 0; d < 3; d++) {
    x_[d].clear();
    p_[d].clear();
  }
  std::vector<Pair> frontier = seeds(band, nearest, furthest);
  if (frontier.empty()) return;
  at_node_.assign(lists, {});
  frontier = accept(phi, band, std::move(frontier), nearest, furthest);
  while (!frontier.empty()) {
    std::vector<Pair> next;
    for (const Pair& pair : frontier)
      for_each_neighbour(band.grid(), pair.node, [&](int m) {
        if (!is_known(band, {m, pair.p})) next.push_back({m, pair.p});
      });
    frontier = accept(phi, band, std::move(next), nearest, furthest);
  }
}

} // namespace lamella
