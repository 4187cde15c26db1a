#include "levelset/topology.h"

#include "parallel.h"

#include <array>
#include <utility>
#include <vector>

namespace lamella {

namespace {

/// Disjoint sets of runs.
struct Sets {
  std::vector<int> parent;
  int count = 0;

  int add() {
    parent.push_back(int(parent.size()));
    count++;
    return parent.back();
  }
  int root(int a) {
    while (parent[a] != a) a = parent[a] = parent[parent[a]];
    return a;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    parent[b] = a;
    count--;
  }
};

/// Nodes begin .. end - 1 of a row along x that belong to the set.
struct Run {
  int begin, end, set;
};
using Runs = std::vector<Run>;

Runs runs_of(const double* row, int n, bool inside, Sets& sets) {
  auto in = [&](int i) { return (row[i] < 0) == inside; };
  Runs runs;
  for (int i = 0; i < n; i++) {
    if (!in(i)) continue;
    const int begin = i;
    while (i < n && in(i)) i++;
    runs.push_back({begin, i, sets.add()});
  }
  if (runs.size() > 1 && runs.front().begin == 0 && runs.back().end == n)
    sets.join(runs.front().set, runs.back().set);
  return runs;
}

/// slack 0: runs that share a column; 1: also those that touch diagonally.
void join_overlapping(const Runs& a, const Runs& b, int slack, Sets& sets) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].begin < b[j].end + slack && b[j].begin < a[i].end + slack)
      sets.join(a[i].set, b[j].set);
    a[i].end < b[j].end ? i++ : j++;
  }
}

/// Parts of the inside (neighbours along the axes) or of the outside (diagonal neighbours too, as
/// the inside's complement must be taken) of the periodic lattice.
int count_parts(const Grid& grid, std::span<const double> phi, bool inside) {
  const int ny = grid.ny(), nz = grid.nz(), slack = inside ? 0 : 1;
  Sets sets;
  std::vector<Runs> first_plane, previous_plane, plane(ny);
  auto join_planes = [&](const std::vector<Runs>& a, const std::vector<Runs>& b) {
    for (int j = 0; j < ny; j++)
      for (int diagonal = -slack; diagonal <= slack; diagonal++)
        join_overlapping(a[(j + diagonal + ny) % ny], b[j], slack, sets);
  };
  for (int k = 0; k < nz; k++) {
    for (int j = 0; j < ny; j++) {
      plane[j] = runs_of(&phi[grid.index(0, j, k)], grid.nx(), inside, sets);
      if (j > 0) join_overlapping(plane[j - 1], plane[j], slack, sets);
    }
    join_overlapping(plane[ny - 1], plane[0], slack, sets);
    if (k == 0)
      first_plane = plane;
    else
      join_planes(previous_plane, plane);
    std::swap(previous_plane, plane);
    plane.resize(ny);
  }
  join_planes(previous_plane, first_plane);
  return sets.count;
}

/// Vertices - edges + faces - cubes of the cubical complex of the inside nodes.
int euler_characteristic(const Grid& grid, std::span<const double> phi) {
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz();
  return parallel_sum<int>(nz, 4, [&](std::size_t begin, std::size_t end) {
    int sum = 0;
    for (int k = int(begin); k < int(end); k++)
      for (int j = 0; j < ny; j++) {
        const int up = (j + 1) % ny, above = (k + 1) % nz;
        const double* row[4] = {&phi[grid.index(0, j, k)], &phi[grid.index(0, up, k)],
                                &phi[grid.index(0, j, above)], &phi[grid.index(0, up, above)]};
        // Of the cells that start at a node: its share with x fixed, and with its x-neighbour.
        auto across = [&](int i) {
          const int a = row[0][i] < 0, b = row[1][i] < 0, c = row[2][i] < 0, d = row[3][i] < 0;
          return std::array{a - (a & b) - (a & c) + (a & b & c & d), a | b << 1 | c << 2 | d << 3};
        };
        auto last = across(nx - 1);
        for (int i = 0; i < nx; i++) {
          const auto here = across(i);
          const int both = last[1] & here[1];
          const int a = both & 1, b = both >> 1 & 1, c = both >> 2 & 1, d = both >> 3;
          sum += here[0] - a + (a & b) + (a & c) - (a & b & c & d);
          last = here;
        }
      }
    return sum;
  });
}

} // namespace

int count_components(const Grid& grid, std::span<const double> phi) {
  return count_parts(grid, phi, true);
}

Topology topology_of(const Grid& grid, std::span<const double> phi) {
  const int components = count_parts(grid, phi, true);
  const int cavities = count_parts(grid, phi, false) - 1;
  return {components, components + cavities - euler_characteristic(grid, phi)};
}

} // namespace lamella
