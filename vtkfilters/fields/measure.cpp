#include "fields/measure.h"

#include "dynamics/surface_integrals.h"
#include "energy/helfrich.h"
#include "energy/smeared_step.h"
#include "energy/surface_energy.h"
#include "fields/image.h"
#include "fields/material_fields.h"
#include "fields/spline_geometry.h"
#include "geometry/laplacian_field.h"
#include "geometry/phase_boundary.h"
#include "levelset/critical_points.h"
#include "levelset/topology.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lamella {
namespace {

// Spacings. The solver's own band, and one in which necks are looked for.
constexpr double band_half_width = 4.2, neck_band_half_width = 12;
constexpr double step_half_width = 4; // of the boundary between phases
// Of a neck: along it phi falls off to both sides, however little in proportion to across it.
constexpr double least_narrowing = 0.01;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Sampled {
  LevelSet phi;
  NarrowBand band;
  SurfaceGeometry surface;

  explicit Sampled(const Frame& frame, Derivatives wanted = Derivatives::laplacian)
      : phi(fitted(frame.grid, frame.phi)), band(frame.grid, band_half_width) {
    band.update(phi);
    surface.sample(phi, band);
    surface.jets(phi, band, wanted);
    if (wanted == Derivatives::sixth) surface.differentiate(lap_KM_around(phi, band, surface));
  }
};

std::vector<Eigen::Vector3d> places(const ConstPoints& p, std::size_t count) {
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < count; ++i) out.emplace_back(p.x[i], p.y[i], p.z[i]);
  return out;
}

/// Smallest radius of the inside at a point where it widens in both directions along one axis.
double thinnest_neck(const LevelSet& phi) {
  NarrowBand band(phi.grid(), neck_band_half_width);
  band.update(phi);
  std::vector<double> slopes;
  for (const Taylor& t : taylor(phi, places(std::as_const(band).points(), band.size())))
    slopes.push_back(t.gradient.norm());
  const double reach = neck_band_half_width * phi.grid().spacing;
  const auto points = critical_points(phi, band, slopes, reach, true); // the thinnest first
  const auto is_neck = [](const CriticalPoint& point) {
    const auto& [along, across, other] = point.stiffness;
    return along < -least_narrowing * other && across > 0;
  };
  const auto neck = std::ranges::find_if(points, is_neck);
  return neck == points.end() ? none : neck->radius;
}

/// P and sigma for which volume and area are at rest: int v dA = int K_M v dA = 0.
void set_multipliers(ShapeMeasures& m, const SurfaceIntegrals& integrals) {
  const Eigen::Vector2d solution =
      integrals.gram.topLeftCorner<2, 2>().fullPivLu().solve(integrals.variation.head<2>());
  m.P = solution[0];
  m.sigma = solution[1];
}

/// The share of Lo at a sample: the solver's smeared step, over about the distance along the
/// membrane. It may leave [0, 1]; sums over the membrane are right to the fourth order.
double share_of_Lo(const SmearedStep& step, const Taylor& psi, const Vec3& normal) {
  const Eigen::Vector3d N(normal[0], normal[1], normal[2]);
  const double slope = (psi.gradient - psi.gradient.dot(N) * N).norm();
  return step.at(psi.value / (slope + 1e-300)).step;
}

ShapeMeasures::Phases measure_phases(const Frame& frame, const Sampled& membrane,
                                     const Scene& forces) {
  const LevelSet psi = fitted(frame.grid, frame.field("psi"));
  const SurfaceGeometry& surface = membrane.surface;
  const std::vector<Taylor> around = taylor(psi, places(surface.points(), surface.size()));
  const auto step = SmearedStep::accurate(step_half_width * frame.grid.spacing);
  ShapeMeasures::Phases m;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double Lo = share_of_Lo(step, around[i], surface.normal(i)), w = surface.weight()[i],
                 KM = surface.KM()[i];
    m.area_Ld += w * (1 - Lo);
    m.area_Lo += w * Lo;
    m.bending_energy_Ld += w * (1 - Lo) * bending_density(forces.ld, KM);
    m.bending_energy_Lo += w * Lo * bending_density(forces.lo, KM);
  }
  PhaseBoundary boundary;
  boundary.trace(membrane.phi, psi, membrane.band);
  m.line_length = boundary.length();
  return m;
}

} // namespace

std::vector<Size> sizes_of(const Frame& frame, const std::vector<int>& nearest, int sheets) {
  const Sampled membrane(frame);
  const SurfaceGeometry& surface = membrane.surface;
  const ConstPoints p = surface.points();
  std::vector<Size> sizes(sheets);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Vec3 normal = surface.normal(i);
    const double w = surface.weight()[i];
    Size& size = sizes[nearest[frame.grid.nearest({p.x[i], p.y[i], p.z[i]})]];
    size.area += w;
    size.volume += w * (p.x[i] * normal[0] + p.y[i] * normal[1] + p.z[i] * normal[2]) / 3;
  }
  return sizes;
}

ShapeMeasures measure(const Frame& frame, const Scene& forces) {
  SurfaceEnergy energy(forces.membrane, forces.parameters, forces.fields);
  const Sampled membrane(frame, energy.needs());
  const SurfaceGeometry& surface = membrane.surface;
  std::vector<double> variation(surface.size());
  Fourier fourier(frame.grid);
  const std::vector<CarriedField> fields = material_fields(forces, frame, surface, fourier);
  energy.find_forces(surface, {}, {}, variation, jets_of(fields));
  const double stiffness = energy.stiffness(surface, {}, jets_of(fields)).most;
  const SurfaceIntegrals integrals = integrate(surface, {variation, stiffness});
  if (!(integrals.area() > 0))
    throw InputError("the membrane is too small for the grid to be measured");
  const double pi = std::numbers::pi, radius = std::sqrt(integrals.area() / (4 * pi));
  const Topology topology = topology_of(frame.grid, frame.phi);
  ShapeMeasures m;
  m.area = integrals.area();
  m.volume = integrals.volume;
  m.reduced_volume = m.volume / (4. / 3 * pi * radius * radius * radius);
  m.area_difference = -integrals.int_KM() / (8 * pi * radius);
  m.int_KM2 = integrals.int_KM2();
  m.components = topology.components;
  m.genus = topology.genus;
  m.neck_radius = thinnest_neck(membrane.phi);
  if (!frame.has("psi")) {
    EnergyTerms terms;
    energy.find_energies(surface, terms);
    m.bending_energy = terms.value(Term::bending);
    set_multipliers(m, integrals);
    return m;
  }
  m.phases = measure_phases(frame, membrane, forces);
  m.bending_energy = m.phases->bending_energy_Ld + m.phases->bending_energy_Lo;
  m.P = m.sigma = none;
  return m;
}

} // namespace lamella
