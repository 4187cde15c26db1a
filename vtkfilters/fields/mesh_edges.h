#pragma once
#include "fields/mesh.h"

#include <algorithm>
#include <span>

namespace lamella {

/// A side of a triangle.
struct Edge {
  int low, high; ///< points
  int triangle;

  bool joins(const Edge& other) const { return low == other.low && high == other.high; }
};

/// The sides of all triangles, those between the same points together.
std::vector<Edge> edges_of(const Mesh& mesh);

/// f(sides) for each two points that sides lie between.
template <class F>
void for_each_edge(std::span<const Edge> edges, F&& f) {
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end =
        std::find_if_not(begin, edges.end(), [&](const Edge& e) { return e.joins(*begin); });
    f(std::span(begin, end));
    begin = end;
  }
}

} // namespace lamella
