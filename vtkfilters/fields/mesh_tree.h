#pragma once
#include "fields/mesh.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <span>

namespace lamella {

/// The triangles of a mesh by their place, in boxes that lie as the triangles in them do: what is
/// asked costs about as much whether these are slivers, fans of them, or of very different sizes.
/// The mesh must stay.
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

  /// Triangles that a triangle may touch, other than where they have a point in common.
  std::vector<int> near(int triangle) const;

private:
  struct Box {
    Eigen::Vector3d middle, half; ///< half its lengths, along
    Eigen::Matrix3d axes;         ///< its axes, the columns
    double squared_distance(const Eigen::Vector3d& x) const;
    bool touches(const Box& other, double within) const;
  };
  struct Node {
    Box box;
    std::array<int, 3> common; ///< points of all its triangles; -1: fewer
    int begin, end;            ///< of its triangles in order_
    int first = -1;            ///< of its two inner nodes; -1: a leaf
  };

  Box box_around(std::span<const int> triangles) const;
  void divide(int node);

  const Mesh& mesh_;
  double rounding_ = 0; ///< of what touches
  std::vector<int> order_;
  std::vector<Node> nodes_; ///< each before its inner nodes
};

/// Lines along x through a closed mesh, which must stay.
class LineCrossings {
public:
  explicit LineCrossings(const Mesh& mesh);

  struct Crossing {
    double x;
    int triangle;
  };
  /// Where the line through (y, z) crosses the mesh: an even number of times, whatever edges and
  /// points it meets.
  std::vector<Crossing> at(double y, double z) const;

private:
  const Mesh& mesh_;
  Eigen::KdBVH<double, 2, int> tree_;
};

} // namespace lamella
