#include "levelset/topology.h"

#include <numeric>
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

/// Inside nodes begin .. end - 1 of a row along x.
struct Run {
  int begin, end, set;
};
using Runs = std::vector<Run>;

Runs runs_of(const double* row, int n, Sets& sets) {
  Runs runs;
  for (int i = 0; i < n; i++) {
    if (!(row[i] < 0)) continue;
    const int begin = i;
    while (i < n && row[i] < 0) i++;
    runs.push_back({begin, i, sets.add()});
  }
  if (runs.size() > 1 && runs.front().begin == 0 && runs.back().end == n)
    sets.join(runs.front().set, runs.back().set);
  return runs;
}

void join_overlapping(const Runs& a, const Runs& b, Sets& sets) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].begin < b[j].end && b[j].begin < a[i].end) sets.join(a[i].set, b[j].set);
    a[i].end < b[j].end ? i++ : j++;
  }
}

} // namespace

int count_components(const Grid& grid, std::span<const double> phi) {
  const int ny = grid.ny(), nz = grid.nz();
  Sets sets;
  std::vector<Runs> first_plane, previous_plane, plane(ny);
  for (int k = 0; k < nz; k++) {
    for (int j = 0; j < ny; j++) {
      plane[j] = runs_of(&phi[grid.index(0, j, k)], grid.nx(), sets);
      if (j > 0) join_overlapping(plane[j - 1], plane[j], sets);
      if (k > 0) join_overlapping(previous_plane[j], plane[j], sets);
    }
    join_overlapping(plane[ny - 1], plane[0], sets);
    if (k == 0) first_plane = plane;
    std::swap(previous_plane, plane);
    plane.resize(ny);
  }
  for (int j = 0; j < ny; j++) join_overlapping(previous_plane[j], first_plane[j], sets);
  return sets.count;
}

} // namespace lamella
