#include "dynamics/carried_field.h"

#include "energy/scalar_jet.h"
#include "parallel.h"

#include <algorithm>
#include <utility>

namespace lamella {

namespace {
constexpr int removals = 3;

double area_of(const SurfaceGeometry& surface) {
  double area = 0;
  for (const double w : surface.weight()) area += w;
  return area;
}

/// Of the band's entries.
std::vector<double> at_nearest_points(const LevelSet& f, const NarrowBand& band) {
  std::vector<double> values(band.size());
  const ConstPoints p = band.points();
  constexpr std::size_t chunk = 256;
  parallel_for(band.size(), chunk, [&](std::size_t begin, std::size_t end) {
    kernels().values(f.view(), end - begin, {p.x + begin, p.y + begin, p.z + begin},
                     &values[begin]);
  });
  return values;
}

/// Takes off what a field has too much of on the membrane, all but a sixteenth.
void remove(std::span<const double> excess, const NarrowBand& band, LevelSet& f) {
  const std::span<double> c = f.coefficients();
  for (std::size_t i = 0; i < band.size(); i++) c[band.node()[i]] -= band.taper()[i] * excess[i];
}

/// int m dA
double integral(std::span<const SurfaceJet<double>> m, const SurfaceGeometry& surface) {
  double sum = 0;
  for (std::size_t i = 0; i < m.size(); i++) sum += surface.weight()[i] * m[i].f;
  return sum;
}
} // namespace

CarriedField::CarriedField(std::string name, Carried carried, const Grid& grid, Fourier& fourier)
    : carried_(carried), field_(std::move(name), grid, fourier) {}

void CarriedField::restore(std::span<const double> coefficients, double amount) {
  field_.restore(coefficients);
  if (carried_ == Carried::amount) amount_ = amount;
}

void CarriedField::start(const std::function<double(const Vec3&)>& value, const NarrowBand& band,
                         Extension& extension) {
  const Grid& grid = band.grid();
  const ConstPoints p = band.points();
  std::vector<double> at_entries(band.size()), nodal(grid.size());
  for (std::size_t i = 0; i < band.size(); i++) at_entries[i] = value({p.x[i], p.y[i], p.z[i]});
  extension.fill(band, at_entries);
  for (int k = 0; k < grid.nz(); k++) extension.plane(k, &nodal[grid.index(0, 0, k)]);
  field_.fit(nodal, 60); // almost exact
  for (int pass = 0; pass < removals; pass++) {
    std::vector<double> off = at_nearest_points(spline(), band);
    for (std::size_t i = 0; i < band.size(); i++) off[i] -= at_entries[i];
    remove(off, band, field_.spline());
  }
}

std::vector<std::span<const SurfaceJet<double>>> jets_of(std::span<const CarriedField> fields) {
  std::vector<std::span<const SurfaceJet<double>>> all;
  for (const CarriedField& field : fields) all.push_back(field.jets());
  return all;
}

void CarriedField::sample(const SurfaceGeometry& surface) {
  find_jets(spline(), surface, jets_);
  if (carried_ == Carried::amount && !amount_) amount_ = integral(jets_, surface);
}

/// What a correction does to the membrane itself, as it is smooth, is taken off again. (Left there
/// it would add up from step to step.)
void CarriedField::extend(const NarrowBand& band, const SurfaceGeometry& surface,
                          Extension& extension, bool smoothing) {
  LevelSet& m = field_.spline();
  m.update_nodal();
  std::vector<double> off = at_nearest_points(m, band);
  for (std::size_t i = 0; i < band.size(); i++) off[i] -= m.nodal()[band.node()[i]];
  extension.fill(band, off);
  const Grid& grid = band.grid();
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  LevelSet correction(grid);
  const std::span<double> d = correction.coefficients();
  field_.corrections().apply(
      [&](int k, double* out) { extension.plane(k, out); },
      [&](int k, const double* in) { std::copy_n(in, plane, d.begin() + k * plane); });
  for (int pass = 0; pass < removals && !smoothing; pass++)
    remove(at_nearest_points(correction, band), band, correction);
  const double missing = amount_ ? (*amount_ - integral(jets_, surface)) / area_of(surface) : 0;
  const std::span<double> c = m.coefficients();
  parallel_for(c.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) c[i] += d[i] + missing;
  });
}

} // namespace lamella
