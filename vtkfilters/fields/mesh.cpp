#include "fields/mesh.h"

#include "dynamics/event.h"
#include "fields/image.h"
#include "fields/mesh_edges.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTriangleFilter.h>

#include <fmt/format.h>

#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

// The triangles of a data set, made one closed mesh.

namespace lamella {
namespace {

using Eigen::Vector3d;

constexpr double same = 1e-6; // of the diagonal of the bounds: so near are points one

/// f(ids of points) for the cells of an array.
template <class F>
void for_each_cell(vtkCellArray& cells, F&& f) {
  const auto it = vtk::TakeSmartPointer(cells.NewIterator());
  for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    it->GetCurrentCell(count, ids);
    f(std::span(ids, std::size_t(count)));
  }
}

/// Bounds of the points that polygons and strips are made of. Throws where one is not finite.
Eigen::AlignedBox3d checked_bounds(vtkPolyData& surface) {
  constexpr double least = 1e-50, most = 1e50; // products must not leave the range of numbers
  Eigen::AlignedBox3d bounds;
  for (vtkCellArray* cells : {surface.GetPolys(), surface.GetStrips()})
    for_each_cell(*cells, [&](std::span<const vtkIdType> ids) {
      for (const vtkIdType id : ids) {
        if (id < 0 || id >= surface.GetNumberOfPoints())
          throw InputError(
              fmt::format("the surface has no point {}, which a polygon of it names", id));
        const Vector3d p(surface.GetPoint(id));
        if (!p.allFinite())
          throw InputError(fmt::format("the surface has points that are not finite: point {} is "
                                       "({}, {}, {})",
                                       id, p[0], p[1], p[2]));
        bounds.extend(p);
      }
    });
  if (bounds.isEmpty())
    throw InputError("the surface has no triangles; a closed one of polygons or strips is needed");
  const double size = bounds.sizes().maxCoeff(), far = bounds.max().cwiseAbs().maxCoeff();
  if (size > most || far > most || (size > 0 && size < least))
    throw InputError(fmt::format("the surface is {:.3g} long; choose a unit in which it is about 1 "
                                 "(vtkTransformPolyDataFilter scales it)",
                                 size));
  return bounds;
}

/// Points, each new one added once: what is nearer than a distance to one before becomes that one.
class MergedPoints {
public:
  MergedPoints(const Vector3d& origin, double distance) : origin_(origin), distance_(distance) {}

  int index_of(const Vector3d& p) {
    const Cell at = cell_of(p);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells_.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      if (found == cells_.end()) continue;
      for (const int other : found->second)
        if ((points_[other] - p).norm() <= distance_) return other;
    }
    cells_[at].push_back(int(points_.size()));
    points_.push_back(p);
    return int(points_.size()) - 1;
  }

  const std::vector<Vector3d>& points() const { return points_; }

private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::size_t sum = 0;
      for (const std::int64_t at : cell) sum = (sum ^ std::size_t(at)) * 0x9e3779b97f4a7c15u;
      return sum ^ (sum >> 29);
    }
  };

  Cell cell_of(const Vector3d& p) const {
    Cell cell;
    for (int a = 0; a < 3; ++a)
      cell[a] = distance_ > 0 ? std::int64_t(std::floor((p[a] - origin_[a]) / distance_)) : 0;
    return cell;
  }

  Vector3d origin_;
  double distance_;
  std::vector<Vector3d> points_;
  std::unordered_map<Cell, std::vector<int>, Hash> cells_;
};

/// Makes triangles of polygons and strips.
class Triangulation {
public:
  /// Points that follow each other and are the same count once.
  void add_polygon(std::vector<vtkIdType> ids) {
    ids.erase(std::ranges::unique(ids).begin(), ids.end());
    while (ids.size() > 1 && ids.front() == ids.back()) ids.pop_back();
    if (ids.size() == 3) add(ids);
    if (ids.size() > 3) larger_->InsertNextCell(vtkIdType(ids.size()), ids.data());
  }
  void add_strip(std::span<const vtkIdType> ids) {
    for (std::size_t n = 0; n + 2 < ids.size(); ++n) add(ids.subspan(n, 3));
  }

  std::vector<std::array<int, 3>> triangles(const std::vector<Vector3d>& points) {
    vtkNew<vtkPoints> vertices;
    vertices->SetDataTypeToDouble();
    for (const Vector3d& p : points) vertices->InsertNextPoint(p.data());
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(vertices);
    polygons->SetPolys(larger_);
    vtkNew<vtkTriangleFilter> filter;
    filter->SetInputData(polygons);
    filter->Update();
    for_each_cell(*filter->GetOutput()->GetPolys(), [&](auto ids) { add(ids); });
    return std::move(triangles_);
  }

private:
  void add(std::span<const vtkIdType> ids) {
    const int a = int(ids[0]), b = int(ids[1]), c = int(ids[2]);
    if (a != b && b != c && c != a) triangles_.push_back({a, b, c});
  }

  std::vector<std::array<int, 3>> triangles_;
  vtkNew<vtkCellArray> larger_; // polygons of more than three points
};

/// The triangles of a surface, where points nearer than a distance are one.
Mesh merged(vtkPolyData& surface, const Vector3d& origin, double distance) {
  MergedPoints points(origin, distance);
  std::vector<int> index(surface.GetNumberOfPoints(), -1);
  Triangulation triangulation;
  std::vector<vtkIdType> cell;
  const auto read = [&](std::span<const vtkIdType> ids) {
    cell.clear();
    for (const vtkIdType id : ids) {
      if (index[id] < 0) index[id] = points.index_of(Vector3d(surface.GetPoint(id)));
      cell.push_back(index[id]);
    }
  };
  for_each_cell(*surface.GetPolys(), [&](auto ids) {
    read(ids);
    triangulation.add_polygon(cell);
  });
  for_each_cell(*surface.GetStrips(), [&](auto ids) {
    read(ids);
    triangulation.add_strip(cell);
  });
  return {points.points(), triangulation.triangles(points.points())};
}

/// The points on open edges that lie within others of them.
class Junctions {
public:
  Junctions(const Mesh& mesh, const std::vector<Edge>& open, double distance)
      : mesh_(mesh), distance_(distance) {
    std::set<int> ends;
    for (const Edge& edge : open) ends.insert({edge.low, edge.high});
    const std::vector<int> points(ends.begin(), ends.end());
    std::vector<Box> boxes;
    for (const int p : points) boxes.emplace_back(mesh.points[p]);
    tree_.init(points.begin(), points.end(), boxes.begin(), boxes.end());
  }

  /// In the order in which they lie on the edge from one point to another.
  std::vector<int> between(int from, int to) const {
    const Vector3d a = mesh_.points[from], along = mesh_.points[to] - a;
    Box around(a);
    around.extend(mesh_.points[to]);
    around = Box((around.min().array() - distance_).matrix(),
                 (around.max().array() + distance_).matrix());
    std::vector<std::pair<double, int>> found;
    struct Query {
      const Box& around;
      std::function<void(int)> take;
      bool intersectVolume(const Box& box) { return around.intersects(box); }
      bool intersectObject(int p) { return take(p), false; }
    } query{around, [&](int p) {
              const double t = (mesh_.points[p] - a).dot(along) / along.squaredNorm();
              const double off = (mesh_.points[p] - a - t * along).norm();
              if (p != from && p != to && t > 0 && t < 1 && off <= distance_)
                found.emplace_back(t, p);
            }};
    Eigen::BVIntersect(tree_, query);
    std::ranges::sort(found);
    std::vector<int> points;
    for (const auto& [t, p] : found) points.push_back(p);
    return points;
  }

private:
  using Box = Eigen::AlignedBox3d;
  const Mesh& mesh_;
  double distance_;
  Eigen::KdBVH<double, 3, int> tree_;
};

std::vector<Edge> open_edges(const Mesh& mesh) {
  std::vector<Edge> open;
  for_each_edge(edges_of(mesh), [&](std::span<const Edge> sides) {
    if (sides.size() == 1) open.push_back(sides.front());
  });
  return open;
}

/// The corner of its triangle that is not on an edge.
int apex_of(const Mesh& mesh, const Edge& edge) {
  return *std::ranges::find_if(mesh.triangles[edge.triangle], [&](int corner) {
    return corner != edge.low && corner != edge.high;
  });
}

/// Divides a triangle at points on one of its edges.
void divide(Mesh& mesh, const Edge& edge, std::vector<int> points) {
  const int apex = apex_of(mesh, edge);
  points.push_back(edge.high);
  mesh.triangles[edge.triangle] = {edge.low, points[0], apex};
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    mesh.triangles.push_back({points[n], points[n + 1], apex});
}

/// Divides triangles where corners of others lie on their open edges, one edge of each at a time.
void divide_at_junctions(Mesh& mesh, double distance) {
  for (int edge_of_triangle = 0; edge_of_triangle < 3; ++edge_of_triangle) {
    const std::vector<Edge> open = open_edges(mesh);
    if (open.empty()) return;
    const Junctions junctions(mesh, open, distance);
    std::set<int> divided;
    for (const Edge& edge : open) {
      if (divided.contains(edge.triangle)) continue;
      const std::vector<int> points = junctions.between(edge.low, edge.high);
      if (points.empty() || std::ranges::count(points, apex_of(mesh, edge)) > 0) continue;
      divide(mesh, edge, points);
      divided.insert(edge.triangle);
    }
    if (divided.empty()) return;
  }
}

/// Leaves one of triangles with the same corners, or, where their number is even, none. How many
/// were there more than once.
int drop_repeated(Mesh& mesh, bool all_of_even) {
  using Corners = std::array<int, 3>;
  std::vector<std::pair<Corners, int>> sorted; // corners, triangle
  for (int t = 0; t < int(mesh.triangles.size()); ++t) {
    Corners corners = mesh.triangles[t];
    std::ranges::sort(corners);
    sorted.emplace_back(corners, t);
  }
  std::ranges::sort(sorted);
  int repeated = 0;
  std::vector<Corners> kept;
  for (auto at = sorted.begin(); at != sorted.end();) {
    const auto next =
        std::find_if(at, sorted.end(), [&](const auto& one) { return one.first != at->first; });
    if (next - at > 1) ++repeated;
    if (!all_of_even || (next - at) % 2 == 1) kept.push_back(mesh.triangles[at->second]);
    at = next;
  }
  if (repeated > 0) mesh.triangles = std::move(kept);
  return repeated;
}

/// The number of separate chains that edges form, and the largest half diagonal of one's bounds.
struct Chains {
  int count;
  double radius;
};
Chains chains_of(const Mesh& mesh, const std::vector<Edge>& edges) {
  std::map<int, int> parent;
  const auto root = [&](int p) {
    parent.try_emplace(p, p);
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  for (const Edge& edge : edges) parent[root(edge.low)] = root(edge.high);
  std::map<int, Eigen::AlignedBox3d> bounds;
  for (const Edge& edge : edges)
    for (const int p : {edge.low, edge.high}) bounds[root(p)].extend(mesh.points[p]);
  Chains chains{int(bounds.size()), 0};
  for (const auto& [root, box] : bounds)
    chains.radius = std::max(chains.radius, 0.5 * box.diagonal().norm());
  return chains;
}

bool is_closed(const Mesh& mesh) {
  bool closed = !mesh.triangles.empty();
  for_each_edge(edges_of(mesh),
                [&](std::span<const Edge> sides) { closed = closed && sides.size() == 2; });
  return closed;
}

/// A number rounded up to two digits, to be typed.
std::string rounded_up(double x) {
  const double digit = std::pow(10, std::floor(std::log10(x)) - 1);
  return fmt::format("{:.2g}", std::ceil(x / digit) * digit);
}

class SurfaceReader {
public:
  explicit SurfaceReader(vtkPolyData& surface)
      : surface_(surface), bounds_(checked_bounds(surface)) {}

  Mesh read(std::string& remark) const {
    for (const bool all_of_even : {false, true}) {
      auto [mesh, repeated] = mesh_within(same, all_of_even);
      if (!is_closed(mesh)) continue;
      if (repeated > 0)
        add_remark(
            remark,
            fmt::format("{} triangle{} of the surface {} there more than once: {}", repeated,
                        repeated == 1 ? "" : "s", repeated == 1 ? "is" : "are",
                        all_of_even ? "left out, as walls between its parts" : "taken once"));
      return std::move(mesh);
    }
    refuse();
  }

private:
  struct Tried {
    Mesh mesh;
    int repeated;
  };
  /// With points so near, in diagonals of the bounds, as one.
  Tried mesh_within(double distance, bool all_of_even) const {
    distance *= bounds_.diagonal().norm();
    Tried tried{merged(surface_, bounds_.min(), distance), 0};
    tried.repeated = drop_repeated(tried.mesh, all_of_even);
    divide_at_junctions(tried.mesh, distance);
    return tried;
  }

  [[noreturn]] void refuse() const {
    const Mesh mesh = mesh_within(same, false).mesh;
    if (mesh.triangles.empty())
      throw InputError("the surface has no triangles with an area; a closed one is needed");
    std::vector<Edge> open, branching;
    for_each_edge(edges_of(mesh), [&](std::span<const Edge> sides) {
      if (sides.size() != 2) (sides.size() < 2 ? open : branching).push_back(sides.front());
    });
    const auto where = [&](const Edge& edge) {
      const Vector3d p = 0.5 * (mesh.points[edge.low] + mesh.points[edge.high]);
      return place_text({p[0], p[1], p[2]});
    };
    if (!branching.empty())
      throw InputError(fmt::format(
          "the surface branches: {} edge{} shared by more than two triangles, one of them at {}; "
          "parts must not touch, and walls within the surface must go",
          branching.size(), branching.size() == 1 ? " is" : "s are", where(branching.front())));
    const auto [holes, radius] = chains_of(mesh, open);
    throw InputError(fmt::format("the surface is not closed: it has {} hole{}, with {} edges, one "
                                 "of them at {}; {}",
                                 holes, holes == 1 ? "" : "s", open.size(), where(open.front()),
                                 advice(radius)));
  }

  /// How to close it.
  std::string advice(double radius) const {
    for (const double tolerance : {1e-5, 1e-4, 1e-3})
      if (is_closed(mesh_within(tolerance, false).mesh))
        return fmt::format("its points do not meet: vtkCleanPolyData with SetTolerance({:g}) "
                           "brings them together",
                           tolerance);
    return fmt::format("vtkCleanPolyData and then vtkFillHolesFilter with SetHoleSize({}) close "
                       "it, or vtkPolyDataConnectivityFilter with "
                       "SetExtractionModeToLargestRegion() where only other parts are open",
                       rounded_up(1.01 * radius));
  }

  vtkPolyData& surface_;
  Eigen::AlignedBox3d bounds_;
};

} // namespace

Mesh closed_mesh_of(vtkPolyData& surface, std::string& remark) {
  return SurfaceReader(surface).read(remark);
}

MeshBounds bounds_of(const Mesh& mesh) {
  MeshBounds bounds{mesh.corners(0)[0], mesh.corners(0)[0]};
  for (const auto& triangle : mesh.triangles)
    for (const int p : triangle) {
      bounds.low = bounds.low.cwiseMin(mesh.points[p]);
      bounds.high = bounds.high.cwiseMax(mesh.points[p]);
    }
  return bounds;
}

void scale(Mesh& mesh, double longest_side) {
  const auto [low, high] = bounds_of(mesh);
  const Vector3d middle = 0.5 * (low + high);
  const double factor = longest_side / (high - low).maxCoeff();
  for (Vector3d& p : mesh.points) p = factor * (p - middle);
}

} // namespace lamella
