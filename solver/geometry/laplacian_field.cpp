#include "geometry/laplacian_field.h"

#include <algorithm>

namespace lamella {

LaplacianField::LaplacianField(const Grid& grid, Fourier& fourier)
    : fourier_(fourier), field_(grid) {
  for (int axis = 0; axis < 3; axis++)
    for (int m = 0; m < (axis == 0 ? fourier.row_modes() : grid.nodes[axis]); m++)
      symbol_[axis].push_back(fourier.spline_symbol(axis, m));
}

void LaplacianField::find(const LevelSet& phi, const NarrowBand& band,
                          const SurfaceGeometry& surface, Extension& extension) {
  values_.resize(band.size());
  weights_.assign(band.size(), 1);
  for (std::size_t i = 0; i < surface.entry().size(); i++)
    values_[surface.entry()[i]] = surface.lap_KM()[i];
  // The spline's derivatives on the membrane reach to entries that are no samples.
  std::vector<int> others;
  std::vector<Vec3> places;
  const ConstPoints p = band.points();
  for (std::size_t s = 0; s < band.size(); s++)
    if (!surface.sampled()[s]) {
      others.push_back(int(s));
      places.push_back({p.x[s], p.y[s], p.z[s]});
    }
  SurfaceGeometry there;
  there.jets_at(phi, places, Derivatives::laplacian);
  for (std::size_t i = 0; i < others.size(); i++) values_[others[i]] = there.lap_KM()[i];
  extension.fill(band, values_, weights_);
  const Grid& grid = field_.grid();
  const std::size_t plane = std::size_t(grid.nx()) * grid.ny();
  // Coefficients for the nodal values, but for grid-scale content: (1 - (1 - symbol)^4) / symbol.
  const auto fit = [&](int ky, int kz, std::complex<double>* row) {
    const double across = symbol_[1][ky] * symbol_[2][kz];
    for (std::size_t kx = 0; kx < symbol_[0].size(); kx++) {
      const double symbol = across * symbol_[0][kx], off = (1 - symbol) * (1 - symbol);
      row[kx] *= (1 - off * off) / (symbol * double(grid.size()));
    }
  };
  fourier_.apply([&](int k, double* out) { extension.plane(k, out); }, fit,
                 [&](int k, const double* in) {
                   std::copy_n(in, plane,
                               field_.coefficients().begin() + std::ptrdiff_t(k * plane));
                 });
}

LevelSet lap_KM_around(const LevelSet& phi, const NarrowBand& band,
                       const SurfaceGeometry& surface) {
  Fourier fourier(phi.grid());
  Extension extension(phi.grid());
  extension.prepare(band, surface.sampled());
  LaplacianField field(phi.grid(), fourier);
  field.find(phi, band, surface, extension);
  return field.spline();
}

} // namespace lamella
