#pragma once
#include "fields/mesh.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

namespace lamella {

/// The triangles of a mesh by their place. The mesh must stay.
class TriangleTree {
public:
  explicit TriangleTree(const Mesh& mesh);

  struct Nearest {
    double distance;
    int triangle;
  };
  /// The triangle next to a point; the search begins at a guess, such as that of a point nearby.
  /// What is farther than `exact` may be too far by a twentieth of the rest.
  Nearest nearest(const Eigen::Vector3d& x, int guess, double exact) const;

  struct Crossing {
    double x;
    int triangle;
  };
  /// Where the line along x through (y, z) crosses a closed mesh: an even number of times, whatever
  /// edges and points it meets.
  std::vector<Crossing> crossings(double y, double z) const;

  /// Triangles whose bounds a triangle's touch, itself among them.
  std::vector<int> near(int triangle) const;

private:
  using Box = Eigen::AlignedBox3d;
  Box box_of(int triangle) const;

  /// f(triangle) where wanted(box) holds for all boxes around it.
  template <class Wanted, class F>
  void for_each(Wanted&& wanted, F&& f) const;

  const Mesh& mesh_;
  Eigen::KdBVH<double, 3, int> tree_;
};

} // namespace lamella
