#include "error.h"
#include "scene/keys.h"
#include "scene/scene.h"
#include "scene/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

using Keys = std::vector<std::string_view>;

// Measured limits of the scheme, in grid spacings. The clearance lets no periodic image be felt;
// thinner or sharper starts than these do not keep their volume.
constexpr double least_clearance = 3;
constexpr double least_half_thickness = 1.5;
constexpr double least_radius_of_curvature = 0.4;
constexpr double largest_curvature_times_spacing = 1;
constexpr double rounding = 1e-9;

class Rules {
public:
  Rules(const Scene& scene, const KeyLocator& locate) : scene_(scene), locate_(locate) {}

  void check() const {
    name();
    title();
    for (const Key& key : scene_keys())
      if (key.belongs_to(scene_.shape.kind)) range(key);
    torus_closes();
    rotation_axis();
    clearance();
    resolution();
    spontaneous_curvature();
  }

private:
  [[noreturn]] void refuse(const Keys& keys, std::string_view what) const {
    const KeyPlace blamed = locate_ ? locate_(keys) : KeyPlace{keys.front(), ""};
    const auto dot = blamed.key.find('.');
    const std::string label =
        dot == blamed.key.npos
            ? std::string(blamed.key)
            : fmt::format("[{}] {}", blamed.key.substr(0, dot), blamed.key.substr(dot + 1));
    throw SceneError(fmt::format("{}{}: {}", blamed.place, label, what));
  }

  static bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

  void title() const {
    if (std::ranges::any_of(scene_.title, is_control) || scene_.title.size() > 200)
      refuse({"title"}, "not a line of text; allowed: at most 200 letters, digits and signs");
  }

  void name() const {
    const std::string& name = scene_.name;
    const bool has_odd = std::ranges::any_of(
        name, [](unsigned char c) { return is_control(c) || c == '/' || c == '\\'; });
    if (has_odd || name.starts_with('.') || name.size() > 100)
      refuse({"name"},
             fmt::format("{} cannot name a folder; allowed: at most 100 letters, digits and signs "
                         "without slashes, not starting with a dot",
                         quoted(name)));
  }

  void range(const Key& key) const {
    Scene scene = scene_;
    if (const auto* number = std::get_if<Member<double>>(&key.access))
      in_range(key, (*number)(scene));
    if (const auto* number = std::get_if<Member<int>>(&key.access)) in_range(key, (*number)(scene));
    if (const auto* vector = std::get_if<Member<Vec3>>(&key.access))
      for (const double x : (*vector)(scene)) in_range(key, x);
    if (const auto* nodes = std::get_if<Member<std::array<int, 3>>>(&key.access))
      for (const int n : (*nodes)(scene)) in_range(key, n);
  }

  void in_range(const Key& key, double x) const {
    if (key.range.contains(x)) return;
    std::string why = "is out of range";
    if (!std::isfinite(x))
      why = "is not a finite number";
    else if (!key.range.divides(x))
      why = fmt::format("is not a multiple of {}", key.range.multiple_of);
    else if (key.name == "reduced_volume" && x == 1)
      why = "is the reduced volume of the sphere: write kind = \"sphere\" and radius";
    else if (key.name == "reduced_volume" && x > 1)
      why = "is more than the sphere's 1, which no closed surface exceeds";
    refuse({key.path()}, fmt::format("{} {}; allowed: {}", x, why, allowed_text(key)));
  }

  void torus_closes() const {
    const Shape& s = scene_.shape;
    if (s.kind == ShapeKind::torus && s.tube_radius >= s.ring_radius)
      refuse(
          {"shape.tube_radius", "shape.ring_radius"},
          fmt::format(
              "the torus has no hole: tube_radius = {}, ring_radius = {}; allowed: tube_radius < "
              "ring_radius",
              s.tube_radius, s.ring_radius));
  }

  void rotation_axis() const {
    if (scene_.shape.rotation_axis == Vec3{0, 0, 0})
      refuse({"shape.rotation_axis"},
             "the axis has no direction; allowed: any [x, y, z] but [0, 0, 0]");
  }

  /// The keys that set the shape's size, then those of the grid.
  Keys size_keys() const {
    switch (scene_.shape.kind) {
    case ShapeKind::sphere:
      return {"shape.radius"};
    case ShapeKind::ellipsoid:
      return {"shape.semi_axes"};
    case ShapeKind::torus:
      return {"shape.ring_radius", "shape.tube_radius"};
    default:
      return {"shape.semi_axis", "shape.reduced_volume"};
    }
  }

  Keys with_grid(Keys keys) const {
    keys.insert(keys.end(), {"grid.nodes", "grid.half_width"});
    return keys;
  }

  void clearance() const {
    const Grid grid = scene_.grid();
    const Bounds box = bounding_box(scene_.shape);
    for (int i = 0; i < 3; ++i) {
      const double side = grid.length(i) / 2;
      const bool at_high_side = side - box.high[i] < side + box.low[i];
      const double reach = at_high_side ? box.high[i] : box.low[i];
      const double free = std::min(side - box.high[i], side + box.low[i]) / grid.spacing;
      if (free >= least_clearance * (1 - rounding)) continue;
      Keys keys = size_keys();
      keys.insert(keys.end(), {"shape.center", "shape.rotation_angle", "shape.rotation_axis"});
      refuse(
          with_grid(keys),
          fmt::format(
              "the shape reaches to {} = {:.4g}, {}; allowed: {:g} free grid spacings ({:.4g}) to "
              "the side of the box at {:.4g}",
              "xyz"[i], reach,
              free < 0 ? "outside the box"
                       : fmt::format("{:.3g} grid spacings from the side", free),
              least_clearance, least_clearance * grid.spacing, at_high_side ? side : -side));
    }
  }

  void resolution() const {
    const double h = scene_.grid().spacing;
    resolved("half-thickness", smallest_half_thickness(scene_.shape) / h, least_half_thickness);
    resolved("radius of curvature", smallest_radius_of_curvature(scene_.shape) / h,
             least_radius_of_curvature);
  }

  void resolved(std::string_view what, double spacings, double least) const {
    if (spacings >= least * (1 - rounding)) return;
    Keys keys = size_keys();
    std::ranges::reverse(keys);
    refuse(with_grid(keys),
           fmt::format(
               "the grid is too coarse for the shape, whose smallest {} is {:.3g} grid spacings; "
               "allowed: at least {:g}; {}",
               what, spacings, least, finer_grid(least / spacings)));
  }

  void spontaneous_curvature() const {
    const double c = scene_.membrane.spontaneous_curvature;
    const double product = std::abs(c) * scene_.grid().spacing;
    if (product > largest_curvature_times_spacing * (1 + rounding))
      refuse({"membrane.spontaneous_curvature", "grid.nodes", "grid.half_width"},
             fmt::format(
                 "the grid is too coarse for buds of radius 2 / |C| = {:.3g}: |C| times the grid "
                 "spacing is {:.3g}; allowed: at most {:g}; {}",
                 2 / std::abs(c), product, largest_curvature_times_spacing,
                 finer_grid(product / largest_curvature_times_spacing)));
  }

  /// What to do about a grid that is too coarse by a factor.
  std::string finer_grid(double factor) const {
    const Range& range = find_key("grid", "nodes")->range;
    const int shortest = std::ranges::min(scene_.nodes), longest = std::ranges::max(scene_.nodes);
    const double exact = shortest * factor * (1 - rounding);
    const double nodes = std::ceil(exact / range.multiple_of) * range.multiple_of;
    if (!(nodes / shortest * longest <= range.high))
      return "no grid of this release resolves it in this box";
    return fmt::format("nodes = {}{} would do", nodes,
                       shortest == longest ? "" : " along the shortest axis");
  }

  const Scene& scene_;
  const KeyLocator& locate_;
};

} // namespace

void validate(const Scene& scene, const KeyLocator& locate) { Rules(scene, locate).check(); }

} // namespace lamella
