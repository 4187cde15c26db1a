#pragma once
#include "grid/grid.h"
#include "grid/memory.h"

#include <complex>
#include <functional>
#include <memory>

namespace lamella {

/// Real-to-complex Fourier transform of a periodic box, its modes handed out row by row.
///
/// Transforms run plane by plane and then column block by column block, so that a whole
/// forward-modify-backward pass reads and writes each mode three times only.
class Fourier {
public:
  explicit Fourier(const Grid& grid);
  ~Fourier();

  /// Fills the nodal values of plane k (ny nx numbers).
  using Source = std::function<void(int k, double* plane)>;
  /// Changes a row of modes, kx = 0..nx/2, at given ky and kz; rows come with ky slowest, each
  /// once.
  using Modify = std::function<void(int ky, int kz, std::complex<double>* row)>;
  /// Takes the nodal values of plane k, not normalised (nx ny nz times the inverse transform).
  using Sink = std::function<void(int k, const double* plane)>;

  /// All three are called from several threads at once, for different planes or rows.
  void apply(const Source& source, const Modify& modify, const Sink& sink);

  int row_modes() const { return grid_.nx() / 2 + 1; }
  /// Place of a row in arrays of all modes kept between calls.
  std::size_t row_index(int ky, int kz) const {
    return (std::size_t(ky) * grid_.nz() + kz) * row_modes();
  }
  std::size_t modes() const { return std::size_t(row_modes()) * grid_.ny() * grid_.nz(); }
  /// Squared wave number of mode m along an axis.
  double k2(int axis, int m) const;
  /// Symbol of the degree-7 B-spline (nodal values from coefficients) of mode m along an axis.
  double spline_symbol(int axis, int m) const;

private:
  struct Plans;
  Grid grid_;
  std::unique_ptr<Plans> plans_;
  Array<std::complex<double>>
      modes_; // [kz][ky][kx] between the planes' and the columns' transforms
};

} // namespace lamella
