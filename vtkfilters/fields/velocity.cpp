#include "fields/velocity.h"

#include "dynamics/phases.h"
#include "energy/film.h"
#include "fields/spline_geometry.h"
#include "levelset/extension.h"
#include "levelset/level_set.h"
#include "levelset/taylor.h"

#include <algorithm>

namespace lamella {
namespace {

constexpr double band_half_width = 4.2; // spacings, as the solver's own
constexpr int sweeps = 60;              // of the spline through the speed: almost exact

/// The variation F of the energy by bending (a normal displacement u changes it by int F u dA), at
/// a point where q is the share of Ld.
double by_bending(const Scene& scene, double q, double KM, double K, double lap_KM) {
  const auto of = [&](double modulus, double curvature) {
    return Helfrich{modulus, curvature}.variation(KM, K, lap_KM);
  };
  if (!scene.has_phases())
    return of(scene.membrane.bending_modulus, scene.membrane.spontaneous_curvature);
  return q * of(scene.ld.bending_modulus, scene.ld.spontaneous_curvature) +
         (1 - q) * of(scene.lo.bending_modulus, scene.lo.spontaneous_curvature);
}

bool has_bending_only(const Scene& scene) {
  return !scene.has_phases() && scene.stretch.modulus == 0 &&
         scene.contact.disjoining_pressure == 0;
}

/// Values at the samples of a membrane: the variation by all forces but bending, and the share of
/// Ld.
struct Forces {
  std::vector<double> other, share_Ld;
};

Forces forces_on(const Frame& frame, const LevelSet& phi, const NarrowBand& band,
                 const SurfaceGeometry& surface, const Scene& scene) {
  Fourier fourier(frame.grid);
  Forces f{std::vector<double>(surface.size(), 0), std::vector<double>(surface.size(), 0)};
  if (scene.has_phases()) {
    Phases phases(scene, frame.psi, fourier);
    const Components together(frame.grid, false);
    phases.locate(phi, band, together);
    phases.sample(band, surface, together);
    phases.find_forces(phi, surface, frame.time, f.other);
    f.share_Ld.assign(phases.share().begin(), phases.share().end());
    for (std::size_t i = 0; i < surface.size(); ++i)
      f.other[i] -=
          by_bending(scene, f.share_Ld[i], surface.KM()[i], surface.K()[i], surface.lap_KM()[i]);
  }
  if (scene.stretch.modulus > 0) {
    StretchField stretch(scene.stretch.modulus, frame.grid, frame.c, fourier);
    stretch.sample(surface);
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

/// The same at points.
Forces forces_at(const Frame& frame, const LevelSet& phi, const Scene& scene, vtkPoints& points) {
  const std::size_t count = points.GetNumberOfPoints();
  Forces f{std::vector<double>(count, 0), std::vector<double>(count, 0)};
  if (has_bending_only(scene)) return f;
  NarrowBand band(frame.grid, band_half_width);
  const bool phases = scene.has_phases();
  SurfaceGeometry surface(phases ? QuadratureKernel::symmetric() : QuadratureKernel::outside(),
                          phases);
  for (int pass = 0; pass < 2; ++pass) { // nearest points go by one Newton step at a time
    band.update(phi);
    surface.sample(phi, band);
    surface.jets(phi, band);
  }
  const Forces samples = forces_on(frame, phi, band, surface, scene);
  std::vector<Eigen::Vector3d> places(count);
  for (std::size_t n = 0; n < count; ++n) points.GetPoint(vtkIdType(n), places[n].data());
  Carrier carrier(frame.grid, band, surface);
  f.other = carrier.carry(samples.other, places);
  if (phases) f.share_Ld = carrier.carry(samples.share_Ld, places);
  return f;
}

} // namespace

/// Eq. 80, with a tension for each phase. What changes most along the membrane, bending, is that at
/// the points themselves.
std::vector<double> normal_velocity(const Frame& frame, const LevelSet& phi, const Scene& scene,
                                    const KnownMultipliers& m, vtkPoints& points,
                                    const SplineGeometry& geometry) {
  const auto [other, share_Ld] = forces_at(frame, phi, scene, points);
  std::vector<double> v(other.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double KM = geometry.KM[i], K = geometry.K[i], q = share_Ld[i],
                 sigma = scene.has_phases() ? m.sigma + (m.sigma_Ld - m.sigma) * q : m.sigma;
    v[i] = m.P + sigma * KM + m.K_multiplier * K - other[i] -
           by_bending(scene, q, KM, K, geometry.lap_KM[i]);
  }
  return v;
}

} // namespace lamella
