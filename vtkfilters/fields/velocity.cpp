#include "fields/velocity.h"

#include "dynamics/phases.h"
#include "energy/film.h"
#include "energy/surface_energy.h"
#include "fields/material_fields.h"
#include "geometry/laplacian_field.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"
#include "levelset/taylor.h"

#include <algorithm>
#include <optional>

namespace lamella {
namespace {

constexpr double band_half_width = 4.2; // spacings, as the solver's own
constexpr int sweeps = 60;              // of the spline through the speed: almost exact

/// The variation F (a normal displacement u changes the energy by int F u dA) as it is well off the
/// phase boundary, where q is the share of Ld.
std::vector<double> bulk_variation(const Scene& scene, const Frame& frame,
                                   const SurfaceGeometry& surface,
                                   std::span<const double> share_Ld) {
  Fourier fourier(frame.grid);
  const std::vector<CarriedField> carried = material_fields(scene, frame, surface, fourier);
  const auto fields = jets_of(carried);
  const auto of = [&](const SurfaceModuli& moduli) {
    std::vector<double> F(surface.size());
    SurfaceEnergy(moduli, scene.parameters, scene.fields).find_forces(surface, {}, {}, F, fields);
    return F;
  };
  if (!scene.has_phases()) return of(scene.membrane);
  std::vector<double> F = of(scene.ld);
  const std::vector<double> F_Lo = of(scene.lo);
  for (std::size_t i = 0; i < F.size(); ++i)
    F[i] = share_Ld[i] * F[i] + (1 - share_Ld[i]) * F_Lo[i];
  return F;
}

Derivatives derivatives_for(const Scene& scene) {
  const auto needs = [&](const SurfaceModuli& moduli) {
    return SurfaceEnergy(moduli, scene.parameters, scene.fields).needs();
  };
  if (!scene.has_phases()) return needs(scene.membrane);
  return std::max({Derivatives::gradient, needs(scene.ld), needs(scene.lo)});
}

bool has_surface_energy_only(const Scene& scene) {
  return !scene.has_phases() && scene.stretch.modulus == 0 &&
         scene.contact.disjoining_pressure == 0;
}

/// Values at the samples of a membrane: the variation by all forces but those of bulk_variation(),
/// and the share of Ld.
struct Forces {
  std::vector<double> other, share_Ld;
};

Forces forces_on(const Frame& frame, const LevelSet& phi, const NarrowBand& band,
                 const SurfaceGeometry& surface, const Scene& scene) {
  Fourier fourier(frame.grid);
  Forces f{std::vector<double>(surface.size(), 0), std::vector<double>(surface.size(), 0)};
  if (scene.has_phases()) {
    Phases phases(scene, frame.field("psi"), fourier);
    const Components together(frame.grid, false);
    phases.locate(phi, band, together);
    phases.sample(band, surface, together);
    SurfaceEnergy energy = phases.surface_energy(frame.time);
    const std::vector<CarriedField> fields = material_fields(scene, frame, surface, fourier);
    phases.find_forces(phi, surface, energy, f.other, fields);
    f.share_Ld.assign(phases.share().begin(), phases.share().end());
    const std::vector<double> bulk = bulk_variation(scene, frame, surface, f.share_Ld);
    for (std::size_t i = 0; i < surface.size(); ++i) f.other[i] -= bulk[i];
  }
  if (scene.stretch.modulus > 0) {
    StretchField stretch(scene.stretch.modulus, frame.grid, fourier);
    if (frame.has("c")) stretch.c().evolving().fit(frame.field("c"), sweeps);
    stretch.c().sample(surface);
    stretch.add_variation(surface, f.other);
  }
  const Film film{scene.contact.disjoining_pressure, scene.contact.disjoining_range};
  if (film.exists())
    for (std::size_t i = 0; i < surface.size(); ++i)
      f.other[i] -= film.pressure(surface.thickness(i, band));
  return f;
}

/// Values at the samples, carried into the box and from there to points.
class Carrier {
public:
  Carrier(const Grid& grid, const NarrowBand& band, const SurfaceGeometry& surface)
      : grid_(grid), band_(band), surface_(surface), extension_(grid), fourier_(grid) {
    extension_.prepare(band, surface.sampled());
  }

  std::vector<double> carry(const std::vector<double>& values,
                            std::span<const Eigen::Vector3d> places) {
    std::vector<double> at_entries(band_.size()), nodal(grid_.size());
    for (std::size_t i = 0; i < surface_.entry().size(); ++i)
      at_entries[surface_.entry()[i]] = values[i];
    extension_.complete(0, at_entries);
    extension_.fill(band_, at_entries);
    for (int k = 0; k < grid_.nz(); ++k) extension_.plane(k, &nodal[grid_.index(0, 0, k)]);
    LevelSet field(grid_);
    std::ranges::copy(nodal, field.coefficients().begin());
    field.fit(nodal, fourier_, sweeps);
    std::vector<double> out;
    for (const Taylor& t : taylor(field, places)) out.push_back(t.value);
    return out;
  }

private:
  const Grid& grid_;
  const NarrowBand& band_;
  const SurfaceGeometry& surface_;
  Extension extension_;
  Fourier fourier_;
};

/// The membrane as the solver samples it.
struct Membrane {
  NarrowBand band;
  SurfaceGeometry surface;
  std::optional<LevelSet> lap_KM; ///< around it, where its derivatives are needed

  Membrane(const LevelSet& phi, const Scene& scene)
      : band(phi.grid(), band_half_width),
        surface(scene.has_phases() ? QuadratureKernel::symmetric() : QuadratureKernel::outside()) {
    const Derivatives wanted = derivatives_for(scene);
    for (int pass = 0; pass < 2; ++pass) { // nearest points go by one Newton step at a time
      band.update(phi);
      surface.sample(phi, band);
      surface.jets(phi, band, wanted);
    }
    if (wanted != Derivatives::sixth) return;
    lap_KM = lap_KM_around(phi, band, surface);
    surface.differentiate(*lap_KM);
  }
};

/// The forces at points.
Forces forces_at(const Frame& frame, const LevelSet& phi, const std::optional<Membrane>& membrane,
                 const Scene& scene, vtkPoints& points) {
  const std::size_t count = points.GetNumberOfPoints();
  Forces f{std::vector<double>(count, 0), std::vector<double>(count, 0)};
  if (has_surface_energy_only(scene)) return f;
  const auto& [band, surface, lap_KM] = *membrane;
  const Forces samples = forces_on(frame, phi, band, surface, scene);
  std::vector<Eigen::Vector3d> places(count);
  for (std::size_t n = 0; n < count; ++n) points.GetPoint(vtkIdType(n), places[n].data());
  Carrier carrier(frame.grid, band, surface);
  f.other = carrier.carry(samples.other, places);
  if (scene.has_phases()) f.share_Ld = carrier.carry(samples.share_Ld, places);
  return f;
}

} // namespace

/// Eq. 80, with a tension for each phase. What changes most along the membrane, the forces of its
/// curvatures, is that at the points themselves.
std::vector<double> normal_velocity(const Frame& frame, const LevelSet& phi, const Scene& scene,
                                    const KnownMultipliers& m, vtkPoints& points) {
  std::optional<Membrane> membrane;
  if (!has_surface_energy_only(scene) || derivatives_for(scene) == Derivatives::sixth)
    membrane.emplace(phi, scene);
  const auto [other, share_Ld] = forces_at(frame, phi, membrane, scene, points);
  std::vector<Vec3> places(points.GetNumberOfPoints());
  for (std::size_t n = 0; n < places.size(); ++n) points.GetPoint(vtkIdType(n), places[n].data());
  SurfaceGeometry surface;
  surface.jets_at(phi, places, derivatives_for(scene));
  if (membrane && membrane->lap_KM) surface.differentiate(*membrane->lap_KM);
  const std::vector<double> bulk = bulk_variation(scene, frame, surface, share_Ld);
  std::vector<double> v(other.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double sigma =
        scene.has_phases() ? m.sigma + (m.sigma_Ld - m.sigma) * share_Ld[i] : m.sigma;
    v[i] = m.P + sigma * surface.KM()[i] + m.K_multiplier * surface.K()[i] - other[i] - bulk[i];
  }
  return v;
}

} // namespace lamella
