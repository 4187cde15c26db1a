#pragma once
#include "grid/grid.h"

#include <vtkPolyData.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace lamella {

/// A surface of triangles whose points are all different.
struct Mesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles; ///< indices of points

  std::array<Eigen::Vector3d, 3> corners(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {points[a], points[b], points[c]};
  }
};

/// The polygons and strips of a data set as triangles; points at the same place become one, and
/// triangles without three points go. Throws InputError where there are none, or points that are
/// not finite.
Mesh mesh_of(vtkPolyData& surface);

/// Throws InputError, with how many and where, for a surface that encloses nothing: with edges that
/// are not shared by two triangles, or triangles that cross others.
void check_closed(const Mesh& mesh);

struct MeshBounds {
  Eigen::Vector3d low, high;
};
MeshBounds bounds_of(const Mesh& mesh);

/// Of the inside of a closed mesh, however its triangles are wound; parts within parts are hollows.
double volume_of(Mesh mesh);

/// Moves the middle of a mesh's bounds to the origin and scales its longest side to a length.
void scale(Mesh& mesh, double longest_side);

/// Signed distance from a closed mesh at the nodes of a grid, negative inside, x fastest. A node is
/// inside where a line from it crosses the mesh an odd number of times. Exact near the mesh, and to
/// a fraction of a spacing far from it.
std::vector<double> signed_distance(const Mesh& mesh, const Grid& grid);

} // namespace lamella
