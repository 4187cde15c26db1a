#pragma once
#include "geometry/curve_geometry.h"
#include "levelset/narrow_band.h"

#include <span>
#include <utility>
#include <vector>

namespace lamella {

struct BoundaryPoint : CurveGeometry {
  Eigen::Vector3d x;
  double s;      ///< arc length from the first point of its curve
  double weight; ///< oint f dl = sum of weight f
};

/// The phase boundary Gamma = {phi = psi = 0} as closed curves: points on Gamma in the order of t,
/// equally spaced along each curve by half a grid spacing or less.
///
/// Points at equal distances and weights of equal size make sums over them converge faster than any
/// power of their distance; what remains is the error of the splines (about h^6 in curvatures, h^8
/// in length). Curves are told apart, and turns of one curve followed, down to half a spacing.
class PhaseBoundary {
public:
  /// Finds all curves; nodal values of phi and psi, and the band of phi, up to date. Curves of
  /// half a spacing across may escape.
  void trace(const LevelSet& phi, const LevelSet& psi, const NarrowBand& band);

  std::size_t curves() const { return begin_.size() - 1; }
  std::span<const BoundaryPoint> curve(std::size_t c) const {
    return std::span(points_).subspan(begin_[c], begin_[c + 1] - begin_[c]);
  }
  /// All of them, curve after curve.
  std::span<const BoundaryPoint> points() const { return points_; }
  /// Places where a curve could not be followed all the way around, because phi and psi are tangent
  /// or turn within a fraction of a spacing (domains about to merge, to part or to vanish).
  std::span<const Eigen::Vector3d> unresolved() const { return unresolved_; }
  /// What could be followed of such curves: open pieces, their points after those of the closed
  /// ones in points(), not equally spaced.
  std::size_t open_pieces() const { return piece_begin_.size() - 1; }

  /// The points before and after one; at the end of an open piece, the point itself.
  std::pair<int, int> neighbours(int point) const;

  /// oint f(point) dl over all curves and pieces.
  template <class F>
  double integral(F&& f) const {
    double sum = 0;
    for (const BoundaryPoint& p : points_) sum += p.weight * f(p);
    return sum;
  }
  /// d_s f at all points for values f at them, by central differences of eighth order; of second
  /// order on open pieces.
  std::vector<double> derivative(std::span<const double> f) const;
  double length() const {
    return integral([](const BoundaryPoint&) { return 1.0; });
  }

private:
  void add_open(std::span<const BoundaryPoint> piece);

  std::vector<BoundaryPoint> points_;
  std::vector<std::size_t> begin_{0};       // of the closed curves
  std::vector<std::size_t> piece_begin_{0}; // of the open pieces
  std::vector<Eigen::Vector3d> unresolved_;
};

} // namespace lamella
