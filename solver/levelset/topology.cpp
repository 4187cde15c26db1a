#include "levelset/topology.h"

#include "parallel.h"

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
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

/// The inside nodes of a row along x as bits.
class Row {
public:
  Row(const double* phi, int n) : n_(n), used_((n + 63) / 64) {
    if (n > most) throw std::length_error("rows have at most 512 nodes");
    for (int i = 0; i < n; i++) words_[i / 64] |= std::uint64_t(phi[i] < 0) << (i % 64);
  }
  /// Bit i of a row shifted by one: its neighbour i + 1, periodic.
  Row shifted() const {
    Row r = *this;
    for (int w = 0; w < used_; w++)
      r.words_[w] = words_[w] >> 1 | (w + 1 < used_ ? words_[w + 1] << 63 : 0);
    r.words_[used_ - 1] |= (words_[0] & 1) << ((n_ - 1) % 64);
    return r;
  }
  Row operator&(const Row& other) const {
    Row r = *this;
    for (int w = 0; w < used_; w++) r.words_[w] &= other.words_[w];
    return r;
  }
  int count() const {
    int sum = 0;
    for (int w = 0; w < used_; w++) sum += std::popcount(words_[w]);
    return sum;
  }
  /// Vertices less edges along x.
  int vertices_less_edges() const { return count() - (*this & shifted()).count(); }

private:
  static constexpr int most = 512;
  int n_, used_;
  std::array<std::uint64_t, most / 64> words_{};
};

/// Vertices - edges + faces - cubes of the cubical complex of the inside nodes.
int euler_characteristic(const Grid& grid, std::span<const double> phi) {
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz();
  return parallel_sum<int>(nz, 4, [&](std::size_t begin, std::size_t end) {
    auto plane = [&](int k) {
      std::vector<Row> rows;
      for (int j = 0; j < ny; j++) rows.emplace_back(&phi[grid.index(0, j, k % nz)], nx);
      return rows;
    };
    int sum = 0;
    std::vector<Row> here = plane(int(begin));
    for (int k = int(begin); k < int(end); k++) {
      std::vector<Row> above = plane(k + 1);
      for (int j = 0; j < ny; j++) {
        const int up = (j + 1) % ny;
        const Row along_y = here[j] & here[up], along_z = here[j] & above[j];
        sum += here[j].vertices_less_edges() - along_y.vertices_less_edges() -
               along_z.vertices_less_edges() +
               (along_y & (above[j] & above[up])).vertices_less_edges();
      }
      here = std::move(above);
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
