#pragma once
#include "fields/parts.h"

#include <vtkPolyData.h>

#include <Eigen/Core>

#include <array>
#include <string>
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

/// The polygons and strips of a data set as a closed mesh: points within 1e-6 of the extent become
/// one, edges that others end on are divided there, triangles that are there more than once go; the
/// remark says so. Throws InputError, with how many and where, for what encloses nothing: no
/// triangles, points that are not finite, edges that are not shared by two triangles.
Mesh closed_mesh_of(vtkPolyData& surface, std::string& remark);

/// Throws InputError, with how many and where, where triangles cross others.
void check_crossings(const Mesh& mesh);

struct MeshBounds {
  Eigen::Vector3d low, high;
};
MeshBounds bounds_of(const Mesh& mesh);

/// Moves the middle of a mesh's bounds to the origin and scales its longest side to a length.
void scale(Mesh& mesh, double longest_side);

/// A closed mesh and the parts of it that hang together.
struct PartedMesh {
  Mesh mesh;
  std::vector<int> part_of; ///< by triangle
  std::vector<Part> parts;
};

/// However the triangles are wound.
PartedMesh parted(Mesh mesh);

/// Leaves out the parts that enclose less than a volume; the remark says so. May leave none.
void drop_small_parts(PartedMesh& mesh, double least_volume, std::string& remark);

/// Distances from a closed mesh at the nodes of a grid, x fastest: negative where a line from the
/// node crosses the mesh an odd number of times. Exact within six spacings.
struct MeshDistance {
  std::vector<double> phi;
  std::vector<int> nearest; ///< part
};
MeshDistance signed_distance(const PartedMesh& mesh, const Grid& grid);

} // namespace lamella
