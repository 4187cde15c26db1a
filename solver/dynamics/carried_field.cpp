#include "dynamics/carried_field.h"

#include "energy/scalar_jet.h"
#include "parallel.h"

#include <utility>

namespace lamella {

namespace {
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

void CarriedField::sample(const SurfaceGeometry& surface) {
  find_jets(spline(), surface, jets_);
  if (carried_ == Carried::amount && !amount_) amount_ = integral(jets_, surface);
}

void CarriedField::extend(const NarrowBand& band, const SurfaceGeometry& surface,
                          Extension& extension) {
  LevelSet& m = field_.spline();
  m.update_nodal();
  const ConstPoints p = band.points();
  off_.resize(band.size());
  parallel_for(band.size(), 256, [&](std::size_t begin, std::size_t end) {
    double t[10 * 256];
    kernels().taylor(m.view(), end - begin, {p.x + begin, p.y + begin, p.z + begin}, t);
    for (std::size_t i = begin; i < end; i++) off_[i] = t[i - begin] - m.nodal()[band.node()[i]];
  });
  extension.fill(band, off_);
  double missing = 0;
  if (amount_) {
    double area = 0;
    for (const double w : surface.weight()) area += w;
    missing = (*amount_ - integral(jets_, surface)) / area;
  }
  const Grid& grid = band.grid();
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  std::span<double> c = m.coefficients();
  field_.corrections().apply([&](int k, double* out) { extension.plane(k, out); },
                             [&](int k, const double* in) {
                               for (std::size_t i = 0; i < plane; i++)
                                 c[k * plane + i] += in[i] + missing;
                             });
}

} // namespace lamella
