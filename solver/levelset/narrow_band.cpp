#include "levelset/narrow_band.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

constexpr double taper_start = 2.5; // spacings
constexpr double lost = 0.5;        // spacings; a Newton step longer than this follows no sheet
constexpr double out_of_reach = 1e300;
constexpr int unset = -1;
constexpr std::size_t chunk = 512;

double square(double x) { return x * x; }

double distance2(const Grid& grid, int node, const double* p) {
  const Vec3 x = grid.position(node);
  return square(x[0] - p[0]) + square(x[1] - p[1]) + square(x[2] - p[2]);
}

} // namespace

NarrowBand::NarrowBand(const Grid& grid, double half_width)
    : grid_(grid), half_width_(half_width), slot_(grid.size(), unset),
      plane_begin_(grid.nz() + 1, 0) {}

void NarrowBand::update(const LevelSet& phi) {
  // Marching from neighbour to neighbour, a new band takes some nodes to the wrong sheet first.
  const int passes = size() == 0 ? 2 : 1;
  for (int pass = 0; pass < passes; pass++) {
    refresh(phi);
    repair(phi);
    grow(phi);
  }
  finish(phi);
}

void NarrowBand::clear() {
  for (const int n : node_) slot_[n] = unset;
  for (auto* array : {&x_, &y_, &z_, &px_, &py_, &pz_, &distance_, &taper_}) array->clear();
  node_.clear();
  std::ranges::fill(plane_begin_, 0);
}

void NarrowBand::store(State& state) const {
  state.node = node_;
  state.x = px_;
  state.y = py_;
  state.z = pz_;
}

void NarrowBand::restore(const State& state) {
  clear();
  std::vector<Entry> entries;
  for (std::size_t s = 0; s < state.node.size(); s++)
    entries.push_back({state.node[s], {state.x[s], state.y[s], state.z[s]}, 0});
  fill(entries);
}

double NarrowBand::distance_at(const Vec3& x, double limit) const {
  int base[3];
  double t[3];
  for (int d = 0; d < 3; d++) {
    const double r = (x[d] - grid_.origin(d)) / grid_.spacing;
    base[d] = int(std::floor(r));
    t[d] = r - base[d];
    if (base[d] < 0 || base[d] + 1 >= grid_.nodes[d]) return limit;
  }
  double sum = 0;
  for (int corner = 0; corner < 8; corner++) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
    const int s = slot_[grid_.index(base[0] + dx, base[1] + dy, base[2] + dz)];
    const double value = s == unset ? -limit : std::clamp(distance_[s], -limit, limit);
    sum += (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]) * value;
  }
  return sum;
}

/// One Newton step for every node that was in the band. Points that it would move far have lost
/// their sheet, which has vanished; their nodes are out of reach until another sheet claims them.
void NarrowBand::refresh(const LevelSet& phi) {
  parallel_for(size(), chunk, [&](std::size_t begin, std::size_t end) {
    double step[chunk];
    kernels().closest_points(phi.view(), end - begin, {&x_[begin], &y_[begin], &z_[begin]},
                             {&px_[begin], &py_[begin], &pz_[begin]}, 1, false, step);
    for (std::size_t s = begin; s < end; s++)
      distance_[s] =
          step[s - begin] > lost * grid_.spacing
              ? out_of_reach
              : std::sqrt(square(x_[s] - px_[s]) + square(y_[s] - py_[s]) + square(z_[s] - pz_[s]));
  });
}

/// Nodes whose neighbour knows a point that is nearer by a tenth of a spacing (another sheet has
/// come closer) start again from it.
void NarrowBand::repair(const LevelSet& phi) {
  auto find = [&](std::size_t begin, std::size_t end, std::vector<Entry>& found) {
    for (std::size_t s = begin; s < end; s++) {
      const double enough = std::max(0.0, distance_[s] - 0.1 * grid_.spacing);
      double nearest = enough * enough;
      int from = unset;
      for_each_neighbour(grid_, node_[s], [&](int m) {
        const int t = slot_[m];
        if (t == unset || distance_[t] > distance_[s]) return;
        const double d2 = square(x_[s] - px_[t]) + square(y_[s] - py_[t]) + square(z_[s] - pz_[t]);
        if (d2 < nearest) {
          nearest = d2;
          from = t;
        }
      });
      if (from != unset) found.push_back({node_[s], {px_[from], py_[from], pz_[from]}, 0});
    }
  };
  std::vector<Entry> entries = parallel_collect<Entry>(size(), chunk, find);
  solve(phi, entries, 4);
  for (const Entry& e : entries) {
    const int s = slot_[e.node];
    if (e.distance >= distance_[s]) continue;
    px_[s] = e.p[0];
    py_[s] = e.p[1];
    pz_[s] = e.p[2];
    distance_[s] = e.distance;
  }
}

/// Newton iterations from the points that the entries bring along; sets their distances.
void NarrowBand::solve(const LevelSet& phi, std::vector<Entry>& entries, int iterations) const {
  parallel_for(entries.size(), chunk, [&](std::size_t begin, std::size_t end) {
    double x[3][chunk], p[3][chunk], step[chunk];
    const std::size_t n = end - begin;
    for (std::size_t s = 0; s < n; s++) {
      const Vec3 at = grid_.position(entries[begin + s].node);
      for (int d = 0; d < 3; d++) {
        x[d][s] = at[d];
        p[d][s] = entries[begin + s].p[d];
      }
    }
    kernels().closest_points(phi.view(), n, {x[0], x[1], x[2]}, {p[0], p[1], p[2]}, iterations,
                             true, step);
    for (std::size_t s = 0; s < n; s++) {
      Entry& e = entries[begin + s];
      for (int d = 0; d < 3; d++) e.p[d] = p[d][s];
      e.distance = std::sqrt(distance2(grid_, e.node, e.p));
    }
  });
}

/// Ends of sign-change edges that the band does not hold (all of them, for a new band), each with
/// the nearest of its edges' crossings.
std::vector<NarrowBand::Entry> NarrowBand::seeds(const LevelSet& phi) const {
  const std::span<const double> f = phi.nodal();
  const int nx = grid_.nx(), ny = grid_.ny(), nz = grid_.nz();
  const int stride[3] = {1, nx, nx * ny};
  auto crossing = [&](std::vector<Entry>& out, int node, int d) {
    const int other = node + stride[d];
    const double t = f[node] / (f[node] - f[other]), h = grid_.spacing;
    Vec3 p = grid_.position(node);
    p[d] += t * h;
    if (slot_[node] == unset) out.push_back({node, {p[0], p[1], p[2]}, t * h});
    if (slot_[other] == unset) out.push_back({other, {p[0], p[1], p[2]}, (1 - t) * h});
  };
  auto find = [&](std::size_t k, std::size_t, std::vector<Entry>& found) {
    for (int j = 0; j < ny; j++) {
      const int row = (int(k) * ny + j) * nx;
      const double* a = &f[row];
      const double* up[3] = {a + 1, j + 1 < ny ? a + nx : a, int(k) + 1 < nz ? a + nx * ny : a};
      for (int i = 0; i < nx - 1; i++) {
        const bool s = a[i] < 0, sx = up[0][i] < 0, sy = up[1][i] < 0, sz = up[2][i] < 0;
        if (!((s != sx) | (s != sy) | (s != sz))) continue;
        if (s != sx) crossing(found, row + i, 0);
        if (s != sy) crossing(found, row + i, 1);
        if (s != sz) crossing(found, row + i, 2);
      }
    }
  };
  return parallel_collect<Entry>(nz, 1, find);
}

/// Nodes next to the frontier that have no entry yet, starting from the frontier's points.
std::vector<NarrowBand::Entry> NarrowBand::neighbours(std::span<const Entry> frontier) const {
  const double reach = half_width_ * grid_.spacing;
  auto find = [&](std::size_t begin, std::size_t end, std::vector<Entry>& found) {
    for (std::size_t s = begin; s < end; s++) {
      const Entry& e = frontier[s];
      if (e.distance > reach) continue;
      for_each_neighbour(grid_, e.node, [&](int m) {
        if (slot_[m] != unset) return;
        const double d = std::sqrt(distance2(grid_, m, e.p));
        if (d <= reach) found.push_back({m, {e.p[0], e.p[1], e.p[2]}, d});
      });
    }
  };
  return parallel_collect<Entry>(frontier.size(), chunk, find);
}

/// March outwards from the band's outer nodes, and from sign changes of phi that the band does not
/// cover.
void NarrowBand::grow(const LevelSet& phi) {
  constexpr int pending = -2;
  const double h = grid_.spacing, reach = half_width_ * h;
  std::vector<Entry> frontier, added;
  for (std::size_t s = 0; s < size(); s++)
    if (distance_[s] > reach - 2 * h)
      frontier.push_back({node_[s], {px_[s], py_[s], pz_[s]}, distance_[s]});
  std::vector<Entry> candidates = seeds(phi);
  for (bool first = true; first || !frontier.empty(); first = false) {
    std::vector<Entry> next = neighbours(frontier);
    candidates.insert(candidates.end(), next.begin(), next.end());
    std::sort(candidates.begin(), candidates.end(), [](const Entry& a, const Entry& b) {
      return a.node != b.node ? a.node < b.node : a.distance < b.distance;
    });
    candidates.erase(std::unique(candidates.begin(), candidates.end(),
                                 [](const Entry& a, const Entry& b) { return a.node == b.node; }),
                     candidates.end());
    solve(phi, candidates, 5);
    for (const Entry& e : candidates) slot_[e.node] = pending;
    added.insert(added.end(), candidates.begin(), candidates.end());
    frontier = std::move(candidates);
    candidates.clear();
  }
  rebuild(added);
}

/// Drop nodes out of reach, take in the new ones, and keep everything in the order of the grid.
void NarrowBand::rebuild(std::vector<Entry>& added) {
  const double reach = half_width_ * grid_.spacing;
  if (added.empty() &&
      std::all_of(distance_.begin(), distance_.end(), [=](double d) { return d <= reach; }))
    return;
  std::sort(added.begin(), added.end(),
            [](const Entry& a, const Entry& b) { return a.node < b.node; });
  std::vector<Entry> kept;
  kept.reserve(size() + added.size());
  std::size_t a = 0;
  for (std::size_t s = 0; s < size(); s++) {
    for (; a < added.size() && added[a].node < node_[s]; a++) kept.push_back(added[a]);
    kept.push_back({node_[s], {px_[s], py_[s], pz_[s]}, distance_[s]});
  }
  kept.insert(kept.end(), added.begin() + std::ptrdiff_t(a), added.end());
  for (const Entry& e : kept) slot_[e.node] = unset;
  std::erase_if(kept, [=](const Entry& e) { return e.distance > reach; });
  fill(kept);
}

/// Makes these the band, in the order of the grid; nobody else is in it.
void NarrowBand::fill(std::span<const Entry> entries) {
  const std::size_t n = entries.size();
  node_.resize(n);
  for (auto* array : {&x_, &y_, &z_, &px_, &py_, &pz_, &distance_, &taper_}) array->resize(n);
  parallel_for(n, chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; s++) {
      const Entry& e = entries[s];
      const Vec3 at = grid_.position(e.node);
      slot_[e.node] = int(s);
      node_[s] = e.node;
      x_[s] = at[0];
      y_[s] = at[1];
      z_[s] = at[2];
      px_[s] = e.p[0];
      py_[s] = e.p[1];
      pz_[s] = e.p[2];
      distance_[s] = e.distance;
    }
  });
  const int plane = grid_.nx() * grid_.ny();
  for (int k = 0, s = 0; k <= grid_.nz(); k++) {
    while (s < int(n) && node_[s] < k * plane) s++;
    plane_begin_[k] = s;
  }
}

/// Signs of the distances, and the taper.
void NarrowBand::finish(const LevelSet& phi) {
  parallel_for(size(), chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; s++) {
      const double d = distance_[s] / grid_.spacing;
      const double u = std::clamp((half_width_ - d) / (half_width_ - taper_start), 0.0, 1.0);
      taper_[s] = u * u * (3 - 2 * u);
      if (phi.nodal()[node_[s]] < 0) distance_[s] = -distance_[s];
    }
  });
}

} // namespace lamella
