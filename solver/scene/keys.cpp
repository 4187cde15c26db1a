#include "scene/keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lamella {
namespace {

/// The member that a path of pointers to members leads to.
template <auto... path>
auto& at(Scene& scene) {
  return (scene.*....*path);
}

template <auto... path>
Access member() {
  return &at<path...>;
}

template <auto... path>
Choice choice(std::vector<std::string_view> names) {
  using Enum = std::remove_reference_t<decltype(at<path...>(std::declval<Scene&>()))>;
  return {std::move(names), [](Scene& scene) { return static_cast<int>(at<path...>(scene)); },
          [](Scene& scene, int value) { at<path...>(scene) = static_cast<Enum>(value); }};
}

const Range any{};
const Range positive{.low = 0, .above_low = true};
const Range not_negative{.low = 0};
const Range any_time{.low = 0};

/// The moduli of a membrane or phase.
template <auto section>
std::vector<Key> moduli(std::string_view name, const std::vector<std::string_view>& cases) {
  using M = SurfaceModuli;
  // clang-format off
  return {
      {name, "bending_modulus", member<section, &M::bending_modulus>(), "energy", {.low = 1e-30},
       cases, "bending modulus κ: of half the square of K_M less spontaneous_curvature (Helfrich)"},
      {name, "spontaneous_curvature", member<section, &M::spontaneous_curvature>(), "1/length", any,
       cases, "C: preferred sum of the principal curvatures, which is -2 on the unit sphere"},
      {name, "gaussian_modulus", member<section, &M::gaussian_modulus>(), "energy", any, cases,
       "κ_G: of the Gaussian curvature K; only a difference between phases has an effect on shapes"},
      {name, "linear_modulus", member<section, &M::linear_modulus>(), "energy/length", any, cases,
       "of K_M, the sum of the principal curvatures"},
      {name, "cubic_modulus", member<section, &M::cubic_modulus>(), "energy length", any, cases,
       "of K_M³"},
      {name, "mixed_cubic_modulus", member<section, &M::mixed_cubic_modulus>(), "energy length",
       any, cases, "of K_M K"},
      {name, "quartic_modulus", member<section, &M::quartic_modulus>(), "energy length²",
       any, cases, "of K_M⁴"},
      {name, "mixed_quartic_modulus", member<section, &M::mixed_quartic_modulus>(),
       "energy length²", any, cases, "of K_M² K"},
      {name, "gaussian_square_modulus", member<section, &M::gaussian_square_modulus>(),
       "energy length²", any, cases, "of K²"},
      {name, "gradient_modulus", member<section, &M::gradient_modulus>(), "energy length²",
       not_negative, cases, "of the square of the gradient of K_M along the membrane"},
      {name, "density", member<section, &M::density>(), "energy/length²", any, cases,
       "one more energy per area, a formula of KM and K", "none"},
  };
  // clang-format on
}

void add(std::vector<Key>& keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
}

// The one description of the scene format. A new parameter is a member of Scene and an entry here:
// section, name, access, unit, range, cases, help, default in words.
// clang-format off
std::vector<Key> make_keys() {
  const std::vector<std::string_view> analytic{"sphere", "oblate", "prolate", "ellipsoid", "torus"};
  const std::vector<std::string_view> one_phase{"none"}, two_phases{"cap", "caps", "frame"};
  std::vector<Key> keys{
      {"", "name", member<&Scene::name>(), "", any, {},
       "what the run is called", "the file's name without `.toml`"},
      {"", "title", member<&Scene::title>(), "", any, {},
       "one line about the run, for people", "none"},
      {"", "fields", member<&Scene::fields>(), "", any, {},
       "material fields, each a `[[fields]]` of its own: see below", "none"},

      {"grid", "nodes", member<&Scene::nodes>(), "", {.low = 16, .high = 512, .multiple_of = 8}, {},
       "nodes along x, y, z, equally spaced; one number for a cube"},
      {"grid", "half_width", member<&Scene::half_width>(), "length",
       {.low = 1e-12, .high = 1e12}, {},
       "half the width, along its shortest axis, of the periodic box around the origin"},

      {"shape", "kind", choice<&Scene::shape, &Shape::kind>(
           {"sphere", "oblate", "prolate", "ellipsoid", "torus", "frame"}), "", any, {},
       "start shape; before rotation its axis of symmetry is z"},
      {"shape", "radius", member<&Scene::shape, &Shape::radius>(), "length", positive, {"sphere"},
       "radius"},
      {"shape", "semi_axis", member<&Scene::shape, &Shape::semi_axis>(), "length", positive,
       {"oblate", "prolate"}, "largest semi-axis"},
      {"shape", "reduced_volume", member<&Scene::shape, &Shape::reduced_volume>(), "",
       {.low = 0.01, .high = 1, .below_high = true}, {"oblate", "prolate"},
       "volume over that of the sphere with the same area; sets the other semi-axis"},
      {"shape", "semi_axes", member<&Scene::shape, &Shape::semi_axes>(), "length", positive,
       {"ellipsoid"}, "semi-axes along x, y, z"},
      {"shape", "ring_radius", member<&Scene::shape, &Shape::ring_radius>(), "length", positive,
       {"torus"}, "from the centre of the torus to the centre of its tube"},
      {"shape", "tube_radius", member<&Scene::shape, &Shape::tube_radius>(), "length", positive,
       {"torus"}, "radius of the tube"},
      {"shape", "file", member<&Scene::shape, &Shape::file>(), "", any, {"frame"},
       "a stored frame, or the folder of a run for its last one", "none"},
      {"shape", "center", member<&Scene::shape, &Shape::center>(), "length", any, analytic,
       "centre of the shape"},
      {"shape", "rotation_axis", member<&Scene::shape, &Shape::rotation_axis>(), "", any, analytic,
       "axis through the centre about which the shape is turned; any length but zero"},
      {"shape", "rotation_angle", member<&Scene::shape, &Shape::rotation_angle>(), "degrees",
       {.low = -360, .high = 360}, analytic, "right-handed about rotation_axis"},

      {"perturbation", "amplitude", member<&Scene::perturbation, &Perturbation::amplitude>(),
       "length", not_negative, {},
       "bound of a smooth displacement of the start shape; 0: none"},
      {"perturbation", "wavelength", member<&Scene::perturbation, &Perturbation::wavelength>(),
       "length", not_negative, {},
       "shortest of its waves, the longest is three times it; 0 stands for a third of the shape's largest extent"},
      {"perturbation", "seed", member<&Scene::perturbation, &Perturbation::seed>(), "",
       {.low = 0, .high = 1e9}, {}, "each number gives a displacement of its own, always the same"},
      {"perturbation", "fold", member<&Scene::perturbation, &Perturbation::fold>(), "",
       {.low = 0, .high = 12}, {},
       "number of arms about the shape's axis that it seeds; 0: none, random in all directions"},

  };
  add(keys, moduli<&Scene::membrane>("membrane", one_phase));
  add(keys, {
      {"domains", "kind", choice<&Scene::domains, &Domains::kind>({"none", "cap", "caps", "frame"}),
       "", any, {}, "where the membrane is Ld at the start, the rest of it being Lo; none: one phase"},
      {"domains", "area_fraction", member<&Scene::domains, &Domains::area_fraction>(), "",
       {.low = 0, .high = 1, .above_low = true, .below_high = true}, {"cap"},
       "area of the cap over that of the whole membrane"},
      {"domains", "direction", member<&Scene::domains, &Domains::direction>(), "", any, {"cap"},
       "from the shape's centre to the middle of the cap; any length but zero"},
      {"domains", "directions", member<&Scene::domains, &Domains::directions>(), "", any, {"caps"},
       "from the shape's centre to the middle of each cap", "none"},
      {"domains", "half_angle", member<&Scene::domains, &Domains::half_angle>(), "degrees",
       {.low = 0, .high = 180, .above_low = true, .below_high = true}, {"caps"},
       "from the middle of a cap to its rim, seen from the shape's centre"},
      {"domains", "bulge", member<&Scene::domains, &Domains::bulge>(), "degrees",
       {.low = -90, .high = 90}, {"caps"},
       "on a sphere, from the plane of a cap's rim to its membrane: above half_angle it bulges outward, below 0 inward; 0: flush with the sphere"},
      {"domains", "file", member<&Scene::domains, &Domains::file>(), "", any, {"frame"},
       "a stored frame with two phases, or the folder of a run for its last one",
       "`file` in [shape]"},
      {"domains", "curvature_start_time", member<&Scene::curvature_start_time>(), "time", any_time,
       two_phases, "until then the spontaneous curvatures of both phases are 0"},

  });
  add(keys, moduli<&Scene::ld>("ld", two_phases));
  add(keys, moduli<&Scene::lo>("lo", two_phases));
  add(keys, {
      {"line", "tension", member<&Scene::line, &Line::tension>(), "energy/length", not_negative,
       two_phases, "line tension κ_l: energy of the phase boundary per length"},
      {"line", "geodesic_modulus", member<&Scene::line, &Line::geodesic_modulus>(), "energy", any,
       two_phases, "κ_g: energy per length and geodesic curvature"},
      {"line", "torsion_modulus", member<&Scene::line, &Line::torsion_modulus>(), "energy", any,
       two_phases, "κ_τ: energy per length and geodesic torsion"},
      {"line", "normal_modulus", member<&Scene::line, &Line::normal_modulus>(), "energy", any,
       two_phases, "κ_n: energy per length and normal curvature"},
      {"line", "geodesic_square_modulus",
       member<&Scene::line, &Line::geodesic_square_modulus>(), "energy length", not_negative,
       two_phases, "κ_g2: energy per length and square of the geodesic curvature, without a 1/2"},
      {"line", "torsion_square_modulus", member<&Scene::line, &Line::torsion_square_modulus>(),
       "energy length", not_negative, two_phases,
       "κ_τ2: energy per length and square of the geodesic torsion, without a 1/2"},
      {"line", "normal_square_modulus", member<&Scene::line, &Line::normal_square_modulus>(),
       "energy length", not_negative, two_phases,
       "κ_n2: energy per length and square of the normal curvature, without a 1/2"},
      {"line", "perpendicular_modulus", member<&Scene::line, &Line::perpendicular_modulus>(),
       "energy", any, two_phases,
       "κ_B: energy per length and curvature B_perp of the membrane across the boundary"},
      {"line", "drag", member<&Scene::line, &Line::drag>(), "length", not_negative, two_phases,
       "drag of the phase boundary along the membrane, per length, over that of the membrane, per area; 0 stands for the radius of the sphere of the vesicle's area"},
      {"line", "density", member<&Scene::line, &Line::density>(), "energy/length", any, two_phases,
       "one more energy per length, a formula of kg, kn and tau_g", "none"},

      {"parameters", "", member<&Scene::parameters>(), "", any, {},
       "a number that densities call by this name", "none"},

      {"stretch", "modulus", member<&Scene::stretch, &Stretch::modulus>(), "energy/length²",
       not_negative, {},
       "modulus μ that resists local stretch; 0: the membrane flows freely within each phase"},

      {"volume", "constraint", choice<&Scene::volume, &VolumeConstraint::constraint>(
           {"fixed", "ramped", "free"}), "", any, {},
       "fixed: as it is at the start; ramped: led to targets; free: under a pressure"},
      {"volume", "targets", member<&Scene::volume, &VolumeConstraint::ramp, &Ramp::targets>(), "",
       {.low = 0, .high = 1, .above_low = true}, {"ramped"},
       "reduced volumes to reach, one after the other", "none"},
      {"volume", "start_times",
       member<&Scene::volume, &VolumeConstraint::ramp, &Ramp::start_times>(), "time", any_time,
       {"ramped"}, "when to set out for each target"},
      {"volume", "rate", member<&Scene::volume, &VolumeConstraint::ramp, &Ramp::rate>(), "1/time",
       not_negative, {"ramped"},
       "change of the reduced volume per unit of time; 0 stands for 0.4 κ/R⁴, R the radius of the sphere of the vesicle's area"},
      {"volume", "pressure", member<&Scene::volume, &VolumeConstraint::pressure>(),
       "energy/length³", any, {"free"}, "pressure inside less that outside"},

      {"volume", "of", choice<&Scene::volume, &VolumeConstraint::of>({"each", "all"}), "", any,
       {"fixed", "ramped"},
       "each: every vesicle has its own volume, keeps it after parting, and the sum after fusing; all: they have one together, water passes between them"},

      {"area", "of", choice<&Scene::area, &AreaConstraint::of>({"each", "all"}), "", any, {},
       "each: every vesicle has its own area, keeps it after parting, and the sum after fusing; all: they have one together, lipid passes between them"},

      {"area_difference", "constraint",
       choice<&Scene::area_difference, &AreaDifferenceConstraint::constraint>(
           {"fixed", "ramped", "free"}), "", any, {},
       "fixed: as it is at the start; ramped: led to targets; free: under a multiplier"},
      {"area_difference", "targets",
       member<&Scene::area_difference, &AreaDifferenceConstraint::ramp, &Ramp::targets>(), "",
       {.low = 0, .high = 100, .above_low = true}, {"ramped"},
       "reduced area differences to reach, one after the other; 1 for a sphere", "none"},
      {"area_difference", "start_times",
       member<&Scene::area_difference, &AreaDifferenceConstraint::ramp, &Ramp::start_times>(),
       "time", any_time, {"ramped"},
       "when to set out for each target; free before the first"},
      {"area_difference", "rate",
       member<&Scene::area_difference, &AreaDifferenceConstraint::ramp, &Ramp::rate>(), "1/time",
       not_negative, {"ramped"},
       "change of the reduced area difference per unit of time; 0 stands for 0.4 κ/R⁴, R the radius of the sphere of the vesicle's area"},
      {"area_difference", "multiplier",
       member<&Scene::area_difference, &AreaDifferenceConstraint::multiplier>(), "energy/length",
       any, {"free"}, "coefficient of the Gaussian curvature in the outward normal velocity"},

      {"contact", "topology_changes", member<&Scene::contact, &Contact::topology_changes>(), "",
       any, {}, "whether necks pinch and films rupture; if not, the run stops where one is about to"},
      {"contact", "disjoining_pressure",
       member<&Scene::contact, &Contact::disjoining_pressure>(), "energy/length³", not_negative, {},
       "pressure that holds films of inner fluid open, at zero thickness; 0: none"},
      {"contact", "disjoining_range", member<&Scene::contact, &Contact::disjoining_range>(),
       "length", not_negative, {},
       "thickness over which it falls by a factor e; 0 stands for a 25th of the radius of the sphere of the vesicle's area"},
      {"contact", "rupture_thickness", member<&Scene::contact, &Contact::rupture_thickness>(),
       "length", not_negative, {},
       "films as thin as this rupture; 0: as thin as the grid can resolve"},

      {"run", "end_time", member<&Scene::end_time>(), "time", any_time, {},
       "when the run ends; it starts at 0; 0 stands for 1.6e-3 half_width⁴/κ"},

      {"stop", "energy_rate", member<&Scene::stop, &Stop::energy_rate>(), "1/time", any_time, {},
       "the run ends earlier, at rest, where the relative rate of the energy falls below this; 0: never"},
      {"stop", "residual_force", member<&Scene::stop, &Stop::residual_force>(), "length/time",
       any_time, {}, "the same for the largest normal velocity; given both, both must hold; 0: never"},
      {"stop", "topology_changes", member<&Scene::stop, &Stop::topology_changes>(), "",
       {.low = 0, .high = 1e6}, {}, "the run ends after so many pinches and ruptures; 0: never"},
      {"stop", "wall_time", member<&Scene::stop, &Stop::wall_time>(), "seconds", any_time, {},
       "the run ends after so long by the clock; 0: never"},

      {"numerics", "tolerance", member<&Scene::numerics, &Numerics::tolerance>(), "grid spacings",
       {.low = 0, .high = 0.1, .above_low = true}, {},
       "time error allowed per step, rms over the membrane"},
      {"numerics", "max_time_step", member<&Scene::numerics, &Numerics::max_time_step>(), "time",
       any_time, {}, "longest step; 0 stands for end_time / 16"},

      {"output", "frames", member<&Scene::output, &Output::frames>(), "",
       {.low = 2, .high = 100000}, {},
       "stored states, equally spaced in time, start and end included"},
  });
  return keys;
}
// clang-format on

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>; // for compilers without P1816

std::string range_text(const Range& range) {
  if (!range.above_low && !range.below_high)
    return fmt::format("from {:g} to {:g}", range.low, range.high);
  return fmt::format("{} {:g} and {} {:g}", range.above_low ? "above" : "from", range.low,
                     range.below_high ? "below" : "up to", range.high);
}

std::string fields_text(const MaterialFields& fields) {
  std::vector<std::string> all;
  for (const MaterialField& field : fields)
    all.push_back(fmt::format("{{name = {}, start = {}, carried = \"{}\"}}",
                              lamella::quoted(field.name), lamella::quoted(field.start),
                              to_string(field.carried)));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

std::string integer_text(const Range& range) {
  const std::string multiple =
      range.multiple_of == 0 ? "" : fmt::format("multiple of {} ", range.multiple_of);
  return fmt::format("an integer {}from {} to {}", multiple, range.low, range.high);
}

} // namespace

bool Range::contains(double x) const {
  return (above_low ? x > low : x >= low) && (below_high ? x < high : x <= high) && divides(x);
}

std::string Key::path() const {
  return fmt::format("{}{}{}", section, section.empty() || name.empty() ? "" : ".", name);
}

std::string Key::label() const {
  if (name.empty()) return fmt::format("[{}]", section);
  return section.empty() ? std::string(name) : fmt::format("[{}] {}", section, name);
}

bool Key::counts_in(Scene scene) const {
  if (cases.empty()) return true;
  const Choice& choice = std::get<Choice>(choice_key(section).access);
  return std::ranges::find(cases, choice.names.at(choice.get(scene))) != cases.end();
}

std::span<const Key> scene_keys() {
  static const std::vector<Key> keys = make_keys();
  return keys;
}

std::vector<std::string_view> scene_sections() {
  std::vector<std::string_view> sections;
  for (const Key& key : scene_keys())
    if (sections.empty() || sections.back() != key.section) sections.push_back(key.section);
  return sections;
}

std::vector<std::string_view> keys_of_section(std::string_view section) {
  std::vector<std::string_view> names;
  for (const Key& key : scene_keys())
    if (key.section == section) names.push_back(key.name);
  return names;
}

const Key* find_key(std::string_view section, std::string_view name) {
  const auto key = std::ranges::find_if(scene_keys(), [&](const Key& k) {
    return k.section == section && (k.name == name || k.name.empty());
  });
  return key == scene_keys().end() ? nullptr : &*key;
}

const Key& choice_key(std::string_view section) {
  const auto key = std::ranges::find_if(scene_keys(), [&](const Key& k) {
    return k.section == section && std::holds_alternative<Choice>(k.access);
  });
  return key == scene_keys().end() ? *find_key("domains", "kind") : *key;
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", c);
    else
      out += c;
  }
  return out + '"';
}

std::string value_text(const Key& key, Scene scene) {
  return std::visit(
      Overloaded{
          [&](Member<std::string> text) { return lamella::quoted(text(scene)); },
          [&](Member<std::array<int, 3>> member) {
            const auto& [x, y, z] = member(scene);
            return x == y && y == z ? fmt::to_string(x) : fmt::format("[{}, {}, {}]", x, y, z);
          },
          [&](Member<Vec3> vector) { return fmt::format("[{}]", fmt::join(vector(scene), ", ")); },
          [&](Member<std::vector<double>> list) {
            return fmt::format("[{}]", fmt::join(list(scene), ", "));
          },
          [&](Member<std::vector<Vec3>> list) { return fmt::format("{}", list(scene)); },
          [&](Member<Parameters> numbers) {
            std::vector<std::string> all;
            for (const auto& [name, number] : numbers(scene))
              all.push_back(fmt::format("{} = {}", name, number));
            return fmt::format("{}", fmt::join(all, ", "));
          },
          [&](Member<MaterialFields> fields) { return fields_text(fields(scene)); },
          [&](const Choice& choice) { return lamella::quoted(choice.names.at(choice.get(scene))); },
          [&](auto scalar) { return fmt::to_string(scalar(scene)); },
      },
      key.access);
}

std::string allowed_text(const Key& key) {
  return std::visit(
      Overloaded{
          [&](Member<double>) { return "a number " + range_text(key.range); },
          [&](Member<int>) { return integer_text(key.range); },
          [&](Member<Parameters>) { return "a number " + range_text(key.range); },
          [&](Member<bool>) { return std::string("true or false"); },
          [&](Member<std::string>) { return std::string("a text in quotes"); },
          [&](Member<Vec3>) { return "three numbers [x, y, z] " + range_text(key.range); },
          [&](Member<std::array<int, 3>>) {
            return integer_text(key.range) + ", or three of them [nx, ny, nz]";
          },
          [&](Member<std::vector<double>>) {
            return fmt::format("a number {}, or a list of them", range_text(key.range));
          },
          [&](Member<std::vector<Vec3>>) {
            return fmt::format("a list of three numbers each, [[x, y, z], ...], {}",
                               range_text(key.range));
          },
          [&](Member<MaterialFields>) {
            return std::string("a list of fields, each with its name, start and carried");
          },
          [&](const Choice& choice) {
            return fmt::format("\"{}\"", fmt::join(choice.names, "\", \""));
          },
      },
      key.access);
}

} // namespace lamella
