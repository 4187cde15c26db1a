#include "error.h"
#include "scene/bulge.h"
#include "scene/densities.h"
#include "scene/domains.h"
#include "scene/keys.h"
#include "scene/perturbation.h"
#include "scene/scene.h"
#include "scene/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace lamella {
namespace {

using Keys = std::vector<std::string_view>;

// Measured limits of the scheme, in grid spacings. The clearance lets no periodic image be felt;
// thinner or sharper starts than these do not keep their volume.
constexpr double least_clearance = 3;
constexpr double least_half_thickness = 1.5;
constexpr double least_radius_of_curvature = 0.4;
constexpr double largest_curvature_times_spacing = 1;
constexpr double least_wrinkling_length = 2;
constexpr double least_wavelength = 4;                  // of a perturbation
constexpr double longest_unstable_wave = 8;             // of a phase boundary
constexpr double least_rim_radius = 3.5, least_gap = 4; // of domains
constexpr double rounding = 1e-9;

class Rules {
public:
  Rules(const Scene& scene, const KeyLocator& locate) : scene_(scene), locate_(locate) {}

  void check() const {
    name();
    title();
    for (const Key& key : scene_keys())
      if (key.counts_in(scene_)) range(key);
    if (scene_.shape.kind == ShapeKind::frame) {
      frame();
    } else {
      torus_closes();
      rotation_axis();
      perturbation();
      if (scene_.has_phases()) domains();
      clearance();
      resolution();
      if (scene_.has_phases()) caps();
    }
    if (scene_.has_phases()) area_difference_is_free();
    if (scene_.volume.constraint == Constraint::ramped) ramp("volume", scene_.volume.ramp);
    if (scene_.area_difference.constraint == Constraint::ramped)
      ramp("area_difference", scene_.area_difference.ramp);
    spontaneous_curvatures();
    if (scene_.has_phases()) {
      quartic_moduli("ld", scene_.ld);
      quartic_moduli("lo", scene_.lo);
    } else {
      quartic_moduli("membrane", scene_.membrane);
    }
    fields();
    densities();
    pressure();
    if (scene_.shape.kind == ShapeKind::sphere) sphere_can_leave();
    if (scene_.has_phases()) {
      gaussian_moduli();
      line_moduli();
    }
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
                         lamella::quoted(name)));
  }

  void range(const Key& key) const {
    Scene scene = scene_;
    if (const auto* number = std::get_if<Member<double>>(&key.access))
      in_range(key, (*number)(scene));
    if (const auto* number = std::get_if<Member<int>>(&key.access)) in_range(key, (*number)(scene));
    if (const auto* vector = std::get_if<Member<Vec3>>(&key.access))
      for (const double x : (*vector)(scene)) in_range(key, x);
    if (const auto* list = std::get_if<Member<std::vector<double>>>(&key.access))
      for (const double x : (*list)(scene)) in_range(key, x);
    if (const auto* list = std::get_if<Member<std::vector<Vec3>>>(&key.access))
      for (const Vec3& vector : (*list)(scene))
        for (const double x : vector) in_range(key, x);
    if (const auto* numbers = std::get_if<Member<Parameters>>(&key.access))
      for (const auto& [name, x] : (*numbers)(scene)) in_range(key, x, "." + name);
    if (const auto* nodes = std::get_if<Member<std::array<int, 3>>>(&key.access))
      for (const int n : (*nodes)(scene)) in_range(key, n);
  }

  /// `name`: that of one among a key's numbers, ".name".
  void in_range(const Key& key, double x, const std::string& name = "") const {
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
    else if ((key.name.ends_with("_square_modulus") || key.name == "gradient_modulus") && x < 0)
      why = "leaves the energy without a lower bound";
    const std::string path = key.path() + name;
    refuse({path}, fmt::format("{} {}; allowed: {}", x, why, allowed_text(key)));
  }

  /// What else a stored state must be is known once it is read.
  void frame() const {
    if (scene_.shape.file.empty())
      refuse({"shape.file", "shape.kind"},
             "no file; allowed: a stored frame, or the folder of a run for its last one");
    if (scene_.perturbation.amplitude > 0)
      refuse({"perturbation.amplitude", "shape.kind"},
             "a stored frame is taken as it is; allowed: 0 with kind = \"frame\"");
    const DomainsKind domains = scene_.domains.kind;
    if (domains == DomainsKind::cap || domains == DomainsKind::caps)
      refuse(
          {"domains.kind", "shape.kind"},
          "a stored frame is taken as it is; allowed: \"frame\" for its phases, or \"none\", with "
          "kind = \"frame\" in [shape]");
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

  /// Of an analytic shape.
  void domains() const {
    const Domains& d = scene_.domains;
    if (d.kind == DomainsKind::frame)
      refuse({"domains.kind", "shape.kind"},
             "the phases of a stored frame go with its membrane; allowed: \"frame\" with kind = "
             "\"frame\" in [shape]");
    if (scene_.shape.kind == ShapeKind::torus)
      refuse({"domains.kind", "shape.kind"},
             "not on a torus yet; allowed: \"none\" with kind = \"torus\" in [shape]");
    directions();
    bulge();
  }

  /// At a given area a sphere is the only shape of its volume, and all of it is alike.
  void sphere_can_leave() const {
    const bool is_fixed = scene_.volume.constraint == Constraint::fixed,
               is_ramped = scene_.volume.constraint == Constraint::ramped,
               is_perturbed = scene_.perturbation.amplitude > 0;
    const bool wants_to = scene_.has_phases()
                              ? !scene_.domains.is_bulged() && !is_perturbed
                              : scene_.area_difference.constraint == Constraint::ramped;
    if (is_fixed && wants_to)
      refuse({"volume.constraint", "area_difference.constraint", "shape.kind"},
             "a sphere that keeps its volume and area cannot change its shape; allowed: \"ramped\" "
             "to a reduced volume below 1, or \"free\", or another kind in [shape]");
    if (scene_.has_phases()) return;
    if (!is_fixed) sphere_keeps_no_area_difference();
    if (is_ramped && !is_perturbed)
      refuse({"perturbation.amplitude", "volume.constraint", "shape.kind"},
             fmt::format("a sphere is alike all around, and nothing says where it is to give way; "
                         "allowed: another kind in [shape], or in [perturbation] an amplitude "
                         "above 0, such as {:.2g}",
                         0.02 * scene_.shape.radius));
  }

  /// It is 1 on a sphere, and more on all that is near one.
  void sphere_keeps_no_area_difference() const {
    const AreaDifferenceConstraint& a = scene_.area_difference;
    if (a.constraint == Constraint::free ||
        (a.constraint == Constraint::ramped && a.ramp.start_times.front() > 0))
      return;
    refuse({a.constraint == Constraint::ramped ? "area_difference.start_times"
                                               : "area_difference.constraint",
            "area_difference.constraint", "shape.kind"},
           "a sphere has no other area difference than 1, and what leaves it has another; allowed: "
           "\"ramped\" with start_times that begin when the volume has gone down, or \"free\", or "
           "another kind in [shape]");
  }

  /// What grows fastest with curvature is K_M^4 (quartic + mixed q + Gaussian square q^2), where
  /// K = q K_M^2: on a tube q is 0, on a sphere 1/4, and between them its least is at one of both
  /// or inside. Saddles, and cubic moduli, are watched as the run goes.
  void quartic_moduli(std::string_view section, const SurfaceModuli& m) const {
    const double fourth = m.quartic_modulus, mixed = m.mixed_quartic_modulus,
                 square = m.gaussian_square_modulus;
    const auto at = [&](double q) { return fourth + (mixed + square * q) * q; };
    const double inside = square > 0 ? std::clamp(-mixed / (2 * square), 0., 0.25) : 0,
                 least = std::min({at(0), at(0.25), at(inside)}),
                 slack = rounding * std::max({std::abs(fourth), std::abs(mixed), std::abs(square)});
    if (least >= -slack) return;
    const std::string quartic = fmt::format("{}.quartic_modulus", section),
                      mixed_quartic = fmt::format("{}.mixed_quartic_modulus", section),
                      gaussian_square = fmt::format("{}.gaussian_square_modulus", section);
    refuse({fourth < 0   ? quartic
            : square < 0 ? gaussian_square
                         : mixed_quartic,
            quartic},
           fmt::format("the energy has no lower bound: it falls with the fourth power of "
                       "curvature; allowed: a quartic_modulus of at least {:.6g}",
                       fourth - least));
  }

  /// A wave along a straight boundary, on both sides the shape of least energy: where the Gaussian
  /// moduli differ by more, its energy is negative at any wavelength, and without bound.
  void gaussian_moduli() const {
    const double of_line = scene_.line.geodesic_modulus;
    const double jump = scene_.ld.gaussian_modulus + of_line - scene_.lo.gaussian_modulus;
    const double least = -4 * scene_.ld.bending_modulus, most = 4 * scene_.lo.bending_modulus;
    if (jump >= least && jump <= most) return;
    refuse({"ld.gaussian_modulus", "lo.gaussian_modulus", "line.geodesic_modulus"},
           fmt::format("the energy has no lower bound: the Gaussian modulus of Ld, with "
                       "line.geodesic_modulus, less that of Lo is {:g}; allowed: from -4 times "
                       "ld.bending_modulus, {:g}, to 4 times lo.bending_modulus, {:g}",
                       jump, least, most));
  }

  /// Waves of the boundary shorter than this have a negative energy: the torsion or the normal
  /// modulus gains more from them than the tension takes, and without bound. They must be too short
  /// for the grid.
  void line_moduli() const {
    const Line& line = scene_.line;
    const double kappa = 2 / (1 / scene_.ld.bending_modulus + 1 / scene_.lo.bending_modulus);
    const double torsion = std::abs(line.torsion_modulus), normal = std::abs(line.normal_modulus);
    if (line.perpendicular_modulus != 0)
      refuse({"line.perpendicular_modulus"},
             "the energy has no lower bound: bending moduli do not control the curvature across a "
             "line; a gradient_modulus of both phases would, but with that this release does not "
             "know the force; allowed: 0");
    if (torsion == 0 && normal == 0) return;
    const double unstable = std::numbers::pi / 2 * (torsion * torsion + normal * normal) / kappa,
                 shortest = longest_unstable_wave * scene_.grid().spacing,
                 k = 2 * std::numbers::pi / shortest,
                 least = unstable / shortest - 2 * line.geodesic_square_modulus * k * k;
    if (line.tension >= least * (1 - rounding)) return;
    constexpr double rounded_up = 1.005; // to three digits
    refuse({torsion > normal ? "line.torsion_modulus" : "line.normal_modulus", "line.tension"},
           fmt::format("the energy has no lower bound: with torsion_modulus = {:g} and "
                       "normal_modulus = {:g} a phase boundary of tension {:g} gains energy from "
                       "waves that the grid resolves; allowed: a line.tension of at least {:.3g}",
                       line.torsion_modulus, line.normal_modulus, line.tension,
                       rounded_up * least));
  }

  void directions() const {
    const Domains& d = scene_.domains;
    const bool one = d.kind == DomainsKind::cap;
    if (!one && d.directions.empty())
      refuse({"domains.directions", "domains.kind"},
             "no domain; allowed: at least one direction, as in directions = [[0, 0, 1]]");
    if (one ? d.direction == Vec3{} : std::ranges::count(d.directions, Vec3{}) > 0)
      refuse({one ? "domains.direction" : "domains.directions"},
             "a cap has no direction; allowed: any [x, y, z] but [0, 0, 0]");
  }

  /// The keys that set the size of domains.
  Keys cap_keys() const {
    if (scene_.domains.kind == DomainsKind::caps)
      return {"domains.half_angle", "domains.directions"};
    return {"domains.area_fraction", "domains.direction"};
  }

  void caps() const {
    const std::vector<Cap> caps = caps_of(scene_);
    for (const Cap& cap : caps) rim(cap);
    gaps(caps);
  }

  /// Neither the domain nor what it leaves is too small.
  void rim(const Cap& cap) const {
    const double spacings = rim_of(cap, scene_.shape).radius / scene_.grid().spacing;
    if (spacings >= least_rim_radius * (1 - rounding)) return;
    refuse(with_grid(cap_keys()),
           fmt::format("the grid is too coarse for a domain whose boundary has a radius of {:.3g} "
                       "grid spacings; allowed: at least {:g}; {}",
                       spacings, least_rim_radius, finer_grid(least_rim_radius / spacings)));
  }

  void gaps(const std::vector<Cap>& caps) const {
    for (std::size_t i = 0; i < caps.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double angle = angle_between(caps[i].direction, caps[j].direction) -
                             caps[i].half_angle - caps[j].half_angle;
        const double length = std::min(rim_of(caps[i], scene_.shape).length_an_angle,
                                       rim_of(caps[j], scene_.shape).length_an_angle);
        const double spacings = angle * length / scene_.grid().spacing;
        if (spacings >= least_gap * (1 - rounding)) continue;
        const std::string pair = fmt::format("domains {} and {}", j + 1, i + 1);
        if (angle <= 0) refuse(cap_keys(), pair + " overlap; allowed: domains apart");
        refuse(with_grid(cap_keys()),
               fmt::format("the grid is too coarse for the gap of {:.3g} grid spacings between {}; "
                           "allowed: at least {:g}; {}",
                           spacings, pair, least_gap, finer_grid(least_gap / spacings)));
      }
  }

  void bulge() const {
    const Domains& d = scene_.domains;
    if (!d.is_bulged()) return;
    if (scene_.shape.kind != ShapeKind::sphere)
      refuse({"domains.bulge", "shape.kind"},
             "only caps of a sphere bulge; allowed: 0, or kind = \"sphere\" in [shape]");
    if (d.bulge < 0 && d.bulge < d.half_angle - 90)
      refuse({"domains.bulge", "domains.half_angle"},
             fmt::format(
                 "dimples of {} degrees could meet; allowed: at least half_angle - 90, which is {}",
                 d.bulge, d.half_angle - 90));
  }

  void area_difference_is_free() const {
    const AreaDifferenceConstraint& a = scene_.area_difference;
    const bool is_free = a.constraint == Constraint::free;
    if (!is_free || a.multiplier != 0)
      refuse(
          {is_free ? "area_difference.multiplier" : "area_difference.constraint", "domains.kind"},
          "not with domains yet; allowed: constraint = \"free\" with multiplier = 0");
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
    Bounds box = bounding_box(scene_.shape);
    for (double& x : box.low) x -= bulge_height(scene_);
    for (double& x : box.high) x += bulge_height(scene_);
    for (int i = 0; i < 3; ++i) {
      const double side = grid.length(i) / 2;
      const bool at_high_side = side - box.high[i] < side + box.low[i];
      const double reach = at_high_side ? box.high[i] : box.low[i];
      const double free =
          (std::min(side - box.high[i], side + box.low[i]) - scene_.perturbation.amplitude) /
          grid.spacing;
      if (free >= least_clearance * (1 - rounding)) continue;
      Keys keys = size_keys();
      keys.insert(keys.end(),
                  {"shape.center", "shape.rotation_angle", "shape.rotation_axis", "domains.bulge"});
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

  /// Tells of the rule that asks for more nodes.
  void resolution() const {
    const double h = scene_.grid().spacing;
    const double thickness = smallest_half_thickness(scene_.shape) / h,
                 radius = smallest_radius_of_curvature(scene_.shape) / h;
    if (thickness / least_half_thickness < radius / least_radius_of_curvature)
      resolved("half-thickness", thickness, least_half_thickness);
    else
      resolved("radius of curvature", radius, least_radius_of_curvature);
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

  /// A displacement that neither folds the surface nor is lost on the grid.
  void perturbation() const {
    const Perturbation& p = scene_.perturbation;
    if (p.amplitude == 0) return;
    if (p.fold > 0 && p.wavelength > 0)
      refuse({"perturbation.wavelength", "perturbation.fold"},
             "does not count where fold does; allowed: one of the two");
    const double wavelength = shortest_wavelength(p, scene_.shape);
    const double spacings = wavelength / scene_.grid().spacing;
    if (spacings < least_wavelength * (1 - rounding))
      refuse(with_grid({"perturbation.wavelength", "perturbation.fold", "perturbation.amplitude"}),
             fmt::format("the grid is too coarse for the perturbation, whose shortest wavelength "
                         "is {:.3g} grid spacings; allowed: at least {:g}; {}",
                         spacings, least_wavelength, finer_grid(least_wavelength / spacings)));
    const double thickness = smallest_half_thickness(scene_.shape);
    const double largest = std::min(thickness / 2, wavelength / 10);
    if (p.amplitude > largest * (1 + rounding))
      refuse(
          {"perturbation.amplitude", "perturbation.wavelength", "perturbation.fold"},
          fmt::format("{} is too large for this shape; allowed: at most {:.3g}, the less of half "
                      "the smallest half-thickness and a tenth of the shortest wavelength",
                      p.amplitude, largest));
  }

  void ramp(std::string_view section, const Ramp& ramp) const {
    const std::string constraint = fmt::format("{}.constraint", section);
    const std::string targets = fmt::format("{}.targets", section);
    const std::string start_times = fmt::format("{}.start_times", section);
    if (ramp.targets.empty())
      refuse({targets, constraint},
             "nothing to be led to; allowed: at least one number, as in targets = [0.9]");
    if (ramp.targets.size() != ramp.start_times.size())
      refuse(
          {start_times, targets},
          fmt::format("the numbers of targets ({}) and start times ({}) differ; allowed: one start "
                      "time for each target",
                      ramp.targets.size(), ramp.start_times.size()));
    const auto late = std::ranges::adjacent_find(ramp.start_times, std::ranges::greater_equal{});
    if (late != ramp.start_times.end())
      refuse({start_times},
             fmt::format("{} before {}; allowed: times that grow", late[0], late[1]));
  }

  void spontaneous_curvatures() const {
    if (scene_.has_phases()) {
      spontaneous_curvature(preferred_curvature(scene_.ld),
                            {"ld.spontaneous_curvature", "ld.linear_modulus"});
      spontaneous_curvature(preferred_curvature(scene_.lo),
                            {"lo.spontaneous_curvature", "lo.linear_modulus"});
      return;
    }
    const AreaDifferenceConstraint& a = scene_.area_difference;
    const double force = a.constraint == Constraint::free ? a.multiplier / 2 : 0;
    spontaneous_curvature(preferred_curvature(scene_.membrane, force),
                          {"membrane.spontaneous_curvature", "membrane.linear_modulus",
                           "area_difference.multiplier"});
  }

  /// The K_M of least energy per area, under a force on it. (Cubic moduli, which may have none, and
  /// those of K are left out.)
  static double preferred_curvature(const SurfaceModuli& m, double force = 0) {
    const double kappa = m.bending_modulus, q = std::max(0.0, m.quartic_modulus),
                 whole = kappa * m.spontaneous_curvature - m.linear_modulus - force;
    if (q == 0) return whole / kappa;
    // Newton's method, from beyond it.
    double x = std::copysign(
        std::min(std::abs(whole) / kappa, std::cbrt(std::abs(whole) / (4 * q))), whole);
    for (int pass = 0; pass < 100; pass++) {
      const double step = (kappa * x + 4 * q * x * x * x - whole) / (kappa + 12 * q * x * x);
      x -= step;
      if (!(std::abs(step) > rounding * std::abs(x))) break;
    }
    return x;
  }

  static std::string path_of(const std::string& parameter) { return "parameters." + parameter; }

  /// Every density is a formula, and every parameter is part of one.
  void densities() const {
    for (const auto& [name, value] : scene_.parameters)
      if (!is_name_to_give(name))
        refuse({path_of(name)},
               "cannot name a number; allowed: letters, digits and _, a letter first, but nothing "
               "that formulas have a meaning for");
    std::set<std::string> used;
    for (const auto& formulas : {densities_of(scene_), starts_of(scene_)})
      for (const SceneFormula& formula : formulas) {
        try {
          used.merge(read_formula(formula.text, formula.names).names);
        } catch (const FormulaError& e) {
          refuse({formula.key}, e.what());
        }
      }
    for (const auto& [name, value] : scene_.parameters)
      if (!used.contains(name))
        refuse(
            {path_of(name)},
            "no density speaks of it; allowed: numbers that density in [membrane], [ld], [lo] or "
            "[line] speaks of, or where a field starts");
    for (const MaterialField& field : scene_.fields)
      if (!used.contains(field.name))
        refuse({"fields"}, fmt::format("no density speaks of {}; allowed: fields that density in "
                                       "[membrane], [ld] or [lo] speaks of",
                                       field.name));
  }

  /// Material fields have names of their own, and something to start from.
  void fields() const {
    constexpr std::string_view taken[]{
        "phi", "psi", "c", "K_M", "Normals", "v", "phase", "energy_density", "velocity"};
    if (scene_.fields.size() > most_fields)
      refuse({"fields"},
             fmt::format("there are {}; allowed: at most {}", scene_.fields.size(), most_fields));
    std::set<std::string_view> names;
    for (const MaterialField& field : scene_.fields) {
      if (!is_name_to_give(field.name) || std::ranges::count(taken, field.name) > 0)
        refuse({"fields"},
               fmt::format("\"{}\" cannot name a field; allowed: letters, digits and _, a letter "
                           "first, but nothing that formulas or results have a meaning for",
                           field.name));
      if (scene_.parameters.contains(field.name) || !names.insert(field.name).second)
        refuse({"fields"},
               fmt::format("the name {} is given twice; allowed: each name once", field.name));
      if (array_of(field, scene_.parameters) && scene_.shape.kind != ShapeKind::frame)
        refuse({"fields", "shape.kind"},
               fmt::format("{} starts from an array \"{}\", and there is no frame; allowed: a "
                           "formula of x, y and z such as start = \"1 + 0.1*z\"",
                           field.name, *array_of(field, scene_.parameters)));
    }
    if (!scene_.fields.empty() && scene_.stretch.modulus > 0)
      refuse({"fields", "stretch.modulus"},
             "where lipid flows along the membrane, fields would have to flow with it, which is "
             "not available in this release; allowed: [stretch] modulus = 0, or no fields");
  }

  void spontaneous_curvature(double c, const Keys& keys) const {
    const double product = std::abs(c) * scene_.grid().spacing;
    if (product <= largest_curvature_times_spacing * (1 + rounding)) return;
    refuse(with_grid(keys),
           fmt::format(
               "the grid is too coarse for buds of radius 2 / |C| = {:.3g}: |C| times the grid "
               "spacing is {:.3g}; allowed: at most {:g}; {}",
               2 / std::abs(c), product, largest_curvature_times_spacing,
               finer_grid(product / largest_curvature_times_spacing)));
  }

  void pressure() const {
    if (scene_.volume.constraint != Constraint::free) return;
    const double p = std::abs(scene_.volume.pressure);
    const double softest = scene_.has_phases()
                               ? std::min(scene_.ld.bending_modulus, scene_.lo.bending_modulus)
                               : scene_.membrane.bending_modulus;
    const double length = std::cbrt(softest / p);
    const double spacings = length / scene_.grid().spacing;
    if (spacings >= least_wrinkling_length * (1 - rounding)) return;
    refuse(with_grid({"volume.pressure"}),
           fmt::format("the grid is too coarse for wrinkles of (bending_modulus / |P|)^(1/3) = "
                       "{:.3g}, {:.3g} grid spacings; allowed: at least {:g}; {}",
                       length, spacings, least_wrinkling_length,
                       finer_grid(least_wrinkling_length / spacings)));
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
