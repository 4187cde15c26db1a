#pragma once
#include "grid/memory.h"
#include "levelset/narrow_band.h"
#include "levelset/quadrature.h"
#include "levelset/second_sheets.h"

#include <array>
#include <span>
#include <vector>

namespace lamella {

/// How much is known of the curvatures along the membrane.
enum class Derivatives {
  none,      ///< K_M and K alone
  laplacian, ///< Lap_s K_M, |grad_s K_M|^2
  gradient,  ///< also grad_s K_M and the curvature tensor B
  all,       ///< also B : grad_s grad_s K_M, and the same of K
  sixth      ///< also grad_s grad_s K_M and, by differentiate(), the same of Lap_s K_M as of K_M
};

/// The membrane as a cloud of samples: the nearest points of the band nodes within a few spacings
/// of it, each with the geometry of the surface there and a quadrature weight. About 5 samples a
/// squared spacing. Where sheets are close there are further samples, of nodes that reach a second
/// sheet; they have no band entry and come last.
///
/// K_M = -2 and K = 1 on the unit sphere; N points outwards.
class SurfaceGeometry {
public:
  explicit SurfaceGeometry(QuadratureKernel kernel = QuadratureKernel::outside())
      : kernel_(kernel) {}

  /// Takes the samples that the band offers.
  void sample(const LevelSet& phi, const NarrowBand& band);

  /// Normals, |grad phi|, K_M and K at the sample points (second derivatives of phi), and weights.
  void curvatures(const LevelSet& phi, NarrowBand& band);
  /// The same and derivatives of the curvatures (fourth derivatives of phi).
  void jets(const LevelSet& phi, NarrowBand& band, Derivatives wanted = Derivatives::laplacian);
  /// The same at points on the membrane that are given, without weights.
  void jets_at(const LevelSet& phi, std::span<const Vec3> points, Derivatives wanted);
  /// Derivatives of Lap_s K_M, from a field that continues it (LaplacianField); those of sixth
  /// order wanted.
  void differentiate(const LevelSet& lap_KM);
  /// What the last curvatures() or jets() found.
  Derivatives derivatives() const { return derivatives_; }

  /// Moves sample i along its normal; the others stay.
  void displace(std::size_t i, double distance, NarrowBand& band);

  /// Thickness of the inside at sample i: along the normal to the opposite sheet, at most 24
  /// spacings.
  double thickness(std::size_t i, const NarrowBand& band) const;

  std::size_t size() const { return x_.size(); }
  /// Band index of the samples that have one.
  std::span<const int> entry() const { return entry_; }
  /// 1 for the band entries that are samples, 0 for the others.
  std::span<const char> sampled() const { return sampled_; }

  std::span<const double> grad() const { return grad_; }
  std::span<const double> KM() const { return KM_; }
  std::span<const double> K() const { return K_; }
  std::span<const double> lap_KM() const { return lap_KM_; }
  /// |grad_s K_M|^2.
  std::span<const double> slope2() const { return slope2_; }
  std::span<const double> grad_KM(int axis) const { return grad_KM_[axis]; }
  std::span<const double> grad_K(int axis) const { return grad_K_[axis]; }
  /// Curvature tensor, trace K_M: xx, yy, zz, xy, xz, yz.
  std::span<const double> B(int component) const { return B_[component]; }
  std::span<const double> lap_K() const { return lap_K_; }
  /// B : grad_s grad_s K_M, and of K.
  std::span<const double> B_hess_KM() const { return B_hess_KM_; }
  std::span<const double> B_hess_K() const { return B_hess_K_; }
  /// grad_s grad_s K_M: xx, yy, zz, xy, xz, yz.
  std::span<const double> hess_KM(int component) const { return hess_KM_[component]; }
  std::span<const double> grad_lap_KM(int axis) const { return grad_lap_KM_[axis]; }
  std::span<const double> lap_lap_KM() const { return lap_lap_KM_; }
  /// Largest |principal curvature|, before K_M and K were limited to what the grid can carry.
  double sharpest(std::size_t i) const { return sharpest_[i]; }
  /// int f dA = sum of weight f.
  std::span<const double> weight() const { return weight_; }
  ConstPoints points() const { return {x_.data(), y_.data(), z_.data()}; }
  Vec3 point(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  Vec3 normal(std::size_t i) const { return {nx_[i], ny_[i], nz_[i]}; }

private:
  void resize(std::size_t samples);
  void make_room(Derivatives wanted);
  SurfaceArrays arrays_from(std::size_t sample, Derivatives wanted);
  template <class Kernel>
  void evaluate(const LevelSet& phi, NarrowBand& band, Kernel kernel, Derivatives wanted);
  void finish(NarrowBand& band, std::size_t begin, std::size_t end);
  void weigh();

  QuadratureKernel kernel_;
  Grid grid_;
  std::vector<int> entry_;
  std::vector<char> sampled_;
  SecondSheets second_;
  Array<double> x_, y_, z_, phi_, nx_, ny_, nz_, grad_, KM_, K_, lap_KM_, slope2_, sharpest_,
      weight_;
  Derivatives derivatives_ = Derivatives::none;
  std::array<Array<double>, 3> grad_KM_, grad_K_, grad_lap_KM_;
  std::array<Array<double>, 6> B_, hess_KM_;
  Array<double> B_hess_KM_, lap_K_, B_hess_K_, lap_lap_KM_;
};

/// |grad_s K_M|^2 at points on the membrane.
std::vector<double> squared_gradient_of_KM(const LevelSet& phi, std::span<const Vec3> points);

} // namespace lamella
