#include "fields/mesh_tree.h"
#include "parallel.h"

#include <algorithm>

// The level set of a closed mesh.

namespace lamella {
namespace {

constexpr double exact = 6; // spacings: beyond, it only matters that the membrane is far

/// The distances of the nodes of a row along x; `guess` is a triangle near its beginning, and then
/// near its end.
void measure_row(const PartedMesh& mesh, const TriangleTree& tree, const LineCrossings& lines,
                 const Grid& grid, std::size_t row, int& guess, MeshDistance& distance) {
  const std::size_t first = row * grid.nx();
  const Vec3 start = grid.position(first);
  const auto crossings = lines.at(start[1], start[2]);
  for (int i = 0; i < grid.nx(); ++i) {
    const double x = grid.coordinate(0, i);
    const auto nearest = tree.nearest({x, start[1], start[2]}, guess, exact * grid.spacing);
    const auto before =
        std::ranges::count_if(crossings, [x](const auto& crossing) { return crossing.x < x; });
    distance.phi[first + i] = before % 2 == 1 ? -nearest.distance : nearest.distance;
    distance.nearest[first + i] = mesh.part_of[nearest.triangle];
    guess = nearest.triangle;
  }
}

} // namespace

MeshDistance signed_distance(const PartedMesh& mesh, const Grid& grid) {
  const TriangleTree tree(mesh.mesh);
  const LineCrossings lines(mesh.mesh);
  MeshDistance distance{std::vector<double>(grid.size()), std::vector<int>(grid.size())};
  parallel_for(std::size_t(grid.ny()) * grid.nz(), 16, [&](std::size_t begin, std::size_t end) {
    int guess = 0;
    for (std::size_t row = begin; row < end; ++row)
      measure_row(mesh, tree, lines, grid, row, guess, distance);
  });
  return distance;
}

} // namespace lamella
