#pragma once
#include "grid/grid.h"

#include <array>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

enum class ShapeKind { sphere, oblate, prolate, ellipsoid, torus, frame };

/// The start shape. Which members count depends on the kind. Before rotation the symmetry axis is
/// z.
struct Shape {
  ShapeKind kind = ShapeKind::oblate;
  double radius = 0.5;                         ///< sphere
  double semi_axis = 0.7;                      ///< oblate, prolate: the largest semi-axis
  double reduced_volume = 0.6;                 ///< oblate, prolate: V / (4/3 pi (A / 4 pi)^(3/2))
  Vec3 semi_axes{0.7, 0.6, 0.5};               ///< ellipsoid, along x, y, z
  double ring_radius = 0.5, tube_radius = 0.2; ///< torus about the z axis
  Vec3 center{0, 0, 0};
  Vec3 rotation_axis{0, 0, 1}; ///< any length but zero
  double rotation_angle = 0;   ///< degrees, right-handed about rotation_axis
  std::string file{};          ///< frame: a stored state, or a run's folder for its last one

  bool operator==(const Shape&) const = default;
};

/// A smooth displacement of the start shape that breaks its symmetry: the same for the same seed,
/// on any grid. Area and volume stay those of the shape.
struct Perturbation {
  double amplitude = 0;  ///< length; no point moves further; 0: none
  double wavelength = 0; ///< length, the shortest; 0: a third of the shape's largest extent
  int seed = 1;
  int fold = 0; ///< rotational symmetry about the shape's axis; 0: none, random in all directions

  bool operator==(const Perturbation&) const = default;
};

/// Moduli of a membrane, or of one of its phases: bending_modulus / 2 int (K_M -
/// spontaneous_curvature)^2 dA (Helfrich), and each of the others times the integral of its
/// invariant (Eq. 5). K_M = -2 and K = 1 on the unit sphere.
struct SurfaceModuli {
  double bending_modulus = 1;         ///< energy
  double spontaneous_curvature = 0;   ///< 1/length
  double gaussian_modulus = 0;        ///< of K: energy
  double linear_modulus = 0;          ///< C(1), of K_M: energy/length
  double cubic_modulus = 0;           ///< of K_M^3: energy length
  double mixed_cubic_modulus = 0;     ///< of K_M K: energy length
  double quartic_modulus = 0;         ///< of K_M^4: energy length^2
  double mixed_quartic_modulus = 0;   ///< of K_M^2 K: energy length^2
  double gaussian_square_modulus = 0; ///< of K^2: energy length^2
  double gradient_modulus = 0;        ///< of |grad_s K_M|^2: energy length^2
  std::string density{}; ///< formula of one more density, see scene/densities.h; empty: none

  bool operator==(const SurfaceModuli&) const = default;
};

/// Where the Ld domains are at the start; the rest of the membrane is Lo. none: one phase.
enum class DomainsKind { none, cap, caps, frame };

/// Domains of a start shape, each a cap around a direction from the centre of the shape (after its
/// rotation). Which members count depends on the kind.
struct Domains {
  DomainsKind kind = DomainsKind::none;
  double area_fraction = 0.5;     ///< cap: of the whole membrane
  Vec3 direction{0, 0, 1};        ///< cap: any length but zero
  std::vector<Vec3> directions{}; ///< caps: one each
  double half_angle = 20;         ///< caps: of each, seen from the centre; degrees
  /// caps on a sphere: degrees between the membrane at the rim and the plane of the rim; half_angle
  /// for one flush with the sphere, more bulges outwards, less than 0 dimples inwards. 0: flush.
  double bulge = 0;
  std::string file{}; ///< frame: a stored state with phases, or a run's folder for its last one

  /// Whether caps are other than flush with the sphere.
  bool is_bulged() const { return kind == DomainsKind::caps && bulge != 0 && bulge != half_angle; }
  bool operator==(const Domains&) const = default;
};

/// Energy of the phase boundary, oint (tension + geodesic_modulus kg + torsion_modulus tau_g +
/// normal_modulus kn + the square moduli times kg^2, tau_g^2, kn^2 + perpendicular_modulus B_perp)
/// dl (Eq. 6).
struct Line {
  double tension = 0;
  double geodesic_modulus = 0, torsion_modulus = 0, normal_modulus = 0;
  double geodesic_square_modulus = 0, torsion_square_modulus = 0, normal_square_modulus = 0;
  double perpendicular_modulus = 0;
  /// Of the boundary along the membrane, per length, over that of the membrane per area: a length.
  /// 0: the radius of the sphere of the vesicle's area.
  double drag = 0;
  std::string density{}; ///< formula of one more density, see scene/densities.h; empty: none

  bool operator==(const Line&) const = default;
};

/// How a field changes as the membrane that it is on moves: each point keeps its value, or its
/// amount per area falls where the membrane grows.
enum class Carried { value, amount };

/// A scalar on the membrane that moves with it, for densities to depend on.
struct MaterialField {
  std::string name;
  /// A formula of x, y and z, taken on the start shape; or the name of an array of the frame or
  /// image that the scene starts from. Empty: the array of the field's own name.
  std::string start;
  Carried carried = Carried::value;

  bool operator==(const MaterialField&) const = default;
};
using MaterialFields = std::vector<MaterialField>;
inline constexpr std::size_t most_fields = 8;

/// "value", "amount".
std::string_view to_string(Carried carried);

/// Named numbers of formulas.
using Parameters = std::map<std::string, double>;

/// Local incompressibility: a field c of the lipid per area over its rest value, with the energy
/// modulus / 2 int [(1 - c)^2 + (1 - 1 / c)^2] dA. modulus 0: there is no such field.
struct Stretch {
  double modulus = 0; ///< mu, energy / length^2

  bool operator==(const Stretch&) const = default;
};

/// fixed: as it is at the start. ramped: led to given values. free: under a given multiplier.
enum class Constraint { fixed, ramped, free };

/// Whether each vesicle keeps its own of a quantity that is held, or all of them their sum.
enum class Of { each, all };

/// Values that a constraint is led to, one after the other, at a limited rate. Before the first
/// start time it stays as it is at the start.
struct Ramp {
  std::vector<double> targets;        ///< in the unit of the constrained quantity
  std::vector<double> start_times{0}; ///< when to set out for each; as many, ascending
  double rate = 0; ///< change per unit of time; 0: 0.4 bending_modulus / R^4, R the radius of the
                   ///< sphere of the vesicle's area

  bool operator==(const Ramp&) const = default;
};

/// The volume; targets are reduced volumes, V / (4/3 pi (A / 4 pi)^(3/2)).
struct VolumeConstraint {
  Constraint constraint = Constraint::fixed;
  Of of = Of::each; ///< where it is held
  Ramp ramp;
  double pressure = 0; ///< P, when free

  bool operator==(const VolumeConstraint&) const = default;
};

/// The area, of each phase too, which is always held, and so the area difference where it is.
struct AreaConstraint {
  Of of = Of::each;

  bool operator==(const AreaConstraint&) const = default;
};

/// The area difference; targets are reduced, -int K_M dA / (8 pi Rs), 1 for a sphere.
struct AreaDifferenceConstraint {
  Constraint constraint = Constraint::free;
  Ramp ramp;
  /// When free: coefficient of K in the normal velocity, 2 h sigma_DA of Eq. 80. Acts as a
  /// spontaneous curvature of -multiplier / (2 bending_modulus).
  double multiplier = 0;

  bool operator==(const AreaDifferenceConstraint&) const = default;
};

/// What happens where the membrane meets itself.
struct Contact {
  bool topology_changes = true;   ///< false: the run stops where one is about to happen
  double disjoining_pressure = 0; ///< at zero thickness, of films of fluid inside; 0: none
  double disjoining_range = 0;    ///< length over which it falls by a factor e; 0: R / 25, R the
                                  ///< radius of the sphere of the vesicle's area
  double rupture_thickness = 0;   ///< length; 0: as thin as the grid can resolve

  bool operator==(const Contact&) const = default;
};

/// When a run ends before its end time; 0 switches a rule off.
struct Stop {
  double energy_rate = 0;    ///< |dE/dt| / E below this, and
  double residual_force = 0; ///< largest normal velocity below this: at rest
  int topology_changes = 0;  ///< so many have happened
  double wall_time = 0;      ///< seconds

  bool operator==(const Stop&) const = default;
};

struct Numerics {
  double tolerance =
      0.005; ///< local time error allowed per step, rms over the membrane, in grid spacings
  double max_time_step = 0; ///< 0: a 16th of the whole run

  bool operator==(const Numerics&) const = default;
};

struct Output {
  int frames = 11; ///< stored states, equally spaced in time from start to end, both included

  bool operator==(const Output&) const = default;
};

/// All parameters of a run. The membrane's drag is 1, so time is in length^4 / energy. No number in
/// here hides a length or an energy: a scene in other units is the same scene.
struct Scene {
  std::string
      name; ///< of the run: file name without folder and extension unless the scene says otherwise
  std::string title;
  std::array<int, 3> nodes{64, 64, 64};
  double half_width = 1; ///< of the box along its shortest axis
  Shape shape;
  Perturbation perturbation;
  SurfaceModuli membrane; ///< without domains
  Domains domains;
  SurfaceModuli ld, lo; ///< with domains
  Line line;            ///< with domains
  /// With domains: spontaneous curvatures are 0 until then.
  double curvature_start_time = 0;
  Parameters parameters; ///< of the densities and of where fields start
  MaterialFields fields; ///< of the densities
  Stretch stretch;
  VolumeConstraint volume;
  AreaConstraint area;
  AreaDifferenceConstraint area_difference;
  Contact contact;
  double end_time = 0; ///< 0: see end()
  Stop stop;
  Numerics numerics;
  Output output;

  Grid grid() const;
  bool has_phases() const { return domains.kind != DomainsKind::none; }
  /// The fields on the membrane that evolve with it: psi with phases, c where it resists stretch,
  /// and material fields.
  std::vector<std::string> evolving_fields() const;
  /// The largest bending modulus.
  double stiffest() const;
  /// When the run ends: end_time or, where that is 0, 1.6e-3 half_width^4 / stiffest().
  double end() const;
  /// The longest time step: max_time_step or, where that is 0, a 16th of end().
  double longest_step() const;
  bool operator==(const Scene&) const = default;
};

/// One of several keys ("section.name"), and where it was given ("file:12: ", or nothing).
struct KeyPlace {
  std::string_view key;
  std::string place;
};

/// Chooses among the keys that a broken rule involves, most to blame first, the one to name.
using KeyLocator = std::function<KeyPlace(std::span<const std::string_view> keys)>;

/// Check every rule of docs/scene-format.md. Throws SceneError for the first that is broken, named
/// after the key and place that `locate` chooses, or without a place after the first key.
void validate(const Scene& scene, const KeyLocator& locate = {});

} // namespace lamella
