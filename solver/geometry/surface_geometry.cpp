#include "geometry/surface_geometry.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {
constexpr double least_reach = 1.8; // spacings; linear interpolation needs no more
// Spacings, of the way through the inside. Close to a sheet distances are those to it, without the
// crease in the middle between two.
constexpr double first_probe = 3, near_opposite = 1.5, longest_stride = 4, thickest = 24;
constexpr std::size_t samples_per_task = 256;

struct Greatest {
  double value = 0;
  void operator+=(const Greatest& other) { value = std::max(value, other.value); }
};

auto jets_kernel(Derivatives wanted) {
  return wanted >= Derivatives::all ? kernels().full_jets : kernels().jets;
}
} // namespace

void SurfaceGeometry::sample(const LevelSet& phi, const NarrowBand& band) {
  grid_ = band.grid();
  const double h = grid_.spacing, inside = std::max(least_reach, -kernel_.begin),
               outside = std::max(least_reach, kernel_.end);
  sampled_.resize(band.size());
  entry_.clear();
  for (std::size_t s = 0; s < band.size(); s++) {
    const double d = band.distance()[s] / h;
    sampled_[s] = d > -inside && d < outside;
    if (sampled_[s]) entry_.push_back(int(s));
  }
  second_.find(phi, band, kernel_.begin * h, kernel_.end * h);
  resize(entry_.size() + second_.size());
  const ConstPoints first = band.points(), second = second_.points();
  for (std::size_t i = 0; i < size(); i++) {
    const bool own = i < entry_.size();
    const ConstPoints& p = own ? first : second;
    const std::size_t s = own ? entry_[i] : i - entry_.size();
    x_[i] = p.x[s];
    y_[i] = p.y[s];
    z_[i] = p.z[s];
  }
}

void SurfaceGeometry::resize(std::size_t samples) {
  for (auto* a : {&x_, &y_, &z_, &phi_, &nx_, &ny_, &nz_, &grad_, &KM_, &K_, &lap_KM_, &slope2_,
                  &sharpest_, &weight_})
    a->resize(samples);
}

void SurfaceGeometry::curvatures(const LevelSet& phi, NarrowBand& band) {
  derivatives_ = Derivatives::none;
  evaluate(phi, band, kernels().curvatures, derivatives_);
}

void SurfaceGeometry::jets(const LevelSet& phi, NarrowBand& band, Derivatives wanted) {
  make_room(wanted);
  evaluate(phi, band, jets_kernel(wanted), wanted);
}

void SurfaceGeometry::jets_at(const LevelSet& phi, std::span<const Vec3> points,
                              Derivatives wanted) {
  entry_.clear();
  resize(points.size());
  make_room(wanted);
  const SplineView spline = phi.view();
  const auto kernel = jets_kernel(wanted);
  parallel_for(size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      x_[i] = points[i][0];
      y_[i] = points[i][1];
      z_[i] = points[i][2];
      weight_[i] = 0;
    }
    kernel(spline, end - begin, {&x_[begin], &y_[begin], &z_[begin]}, arrays_from(begin, wanted));
  });
}

void SurfaceGeometry::make_room(Derivatives wanted) {
  derivatives_ = wanted;
  if (wanted >= Derivatives::gradient) {
    for (Array<double>& a : grad_KM_) a.resize(size());
    for (Array<double>& a : B_) a.resize(size());
  }
  if (wanted >= Derivatives::all) {
    for (Array<double>& a : grad_K_) a.resize(size());
    for (Array<double>* a : {&B_hess_KM_, &lap_K_, &B_hess_K_}) a->resize(size());
  }
  if (wanted == Derivatives::sixth) {
    for (Array<double>& a : hess_KM_) a.resize(size());
    for (Array<double>& a : grad_lap_KM_) a.resize(size());
    lap_lap_KM_.resize(size());
  }
}

SurfaceArrays SurfaceGeometry::arrays_from(std::size_t i, Derivatives wanted) {
  SurfaceArrays out{.phi = &phi_[i],
                    .nx = &nx_[i],
                    .ny = &ny_[i],
                    .nz = &nz_[i],
                    .grad = &grad_[i],
                    .KM = &KM_[i],
                    .K = &K_[i],
                    .lap_KM = &lap_KM_[i],
                    .slope2 = &slope2_[i]};
  if (wanted >= Derivatives::gradient) {
    for (int d = 0; d < 3; d++) out.grad_KM[d] = &grad_KM_[d][i];
    for (int c = 0; c < 6; c++) out.B[c] = &B_[c][i];
  }
  if (wanted >= Derivatives::all) {
    for (int d = 0; d < 3; d++) out.grad_K[d] = &grad_K_[d][i];
    out.B_hess_KM = &B_hess_KM_[i];
    out.lap_K = &lap_K_[i];
    out.B_hess_K = &B_hess_K_[i];
  }
  if (wanted == Derivatives::sixth)
    for (int c = 0; c < 6; c++) out.hess_KM[c] = &hess_KM_[c][i];
  return out;
}

template <class Kernel>
void SurfaceGeometry::evaluate(const LevelSet& phi, NarrowBand& band, Kernel kernel,
                               Derivatives wanted) {
  const SplineView spline = phi.view();
  parallel_for(size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
    kernel(spline, end - begin, {&x_[begin], &y_[begin], &z_[begin]}, arrays_from(begin, wanted));
    finish(band, begin, end);
  });
  weigh();
}

/// Limits curvatures to what the grid can carry, and takes the last bit of the way onto {phi = 0}.
/// Leaves the node's distance in place of a weight.
void SurfaceGeometry::finish(NarrowBand& band, std::size_t begin, std::size_t end) {
  const double h = grid_.spacing, longest = 0.5 * h, KM_limit = 2 / h, K_limit = 1 / (h * h);
  const ConstPoints first = band.positions(), second = second_.positions();
  for (std::size_t i = begin; i < end; i++) {
    sharpest_[i] =
        0.5 * std::abs(KM_[i]) + std::sqrt(std::max(0.0, 0.25 * KM_[i] * KM_[i] - K_[i]));
    KM_[i] = std::clamp(KM_[i], -KM_limit, KM_limit);
    K_[i] = std::clamp(K_[i], -K_limit, K_limit);
    displace(i, std::clamp(-phi_[i] / grad_[i], -longest, longest), band);
    const bool own = i < entry_.size();
    const ConstPoints& node = own ? first : second;
    const std::size_t s = own ? entry_[i] : i - entry_.size();
    weight_[i] =
        (node.x[s] - x_[i]) * nx_[i] + (node.y[s] - y_[i]) * ny_[i] + (node.z[s] - z_[i]) * nz_[i];
  }
}

void SurfaceGeometry::weigh() {
  const double h = grid_.spacing;
  const Greatest bend =
      parallel_sum<Greatest>(size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
        Greatest of;
        for (std::size_t i = begin; i < end; i++)
          of += {std::sqrt(std::max(0.0, 0.25 * KM_[i] * KM_[i] - K_[i])) - 0.5 * KM_[i]};
        return of;
      });
  const QuadratureKernel kernel = kernel_.reaching(bend.value * h);
  parallel_for(size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++)
      weight_[i] = kernel.weight(weight_[i], KM_[i], K_[i], h);
  });
}

void SurfaceGeometry::differentiate(const LevelSet& lap_KM) {
  const ConstPoints p = points();
  parallel_for(size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    double taylor[10 * samples_per_task];
    kernels().taylor(lap_KM.view(), n, {p.x + begin, p.y + begin, p.z + begin}, taylor);
    for (std::size_t j = 0; j < n; j++) {
      const auto at = [&](int m) { return taylor[m * n + j]; };
      const std::size_t i = begin + j;
      const Vec3 N = normal(i);
      const double along = at(1) * N[0] + at(2) * N[1] + at(3) * N[2],
                   twice = N[0] * N[0] * at(4) + N[1] * N[1] * at(5) + N[2] * N[2] * at(6) +
                           2 * (N[0] * N[1] * at(7) + N[0] * N[2] * at(8) + N[1] * N[2] * at(9));
      for (int d = 0; d < 3; d++) grad_lap_KM_[d][i] = at(1 + d) - along * N[d];
      lap_lap_KM_[i] = at(4) + at(5) + at(6) - twice + KM_[i] * along;
    }
  });
}

void SurfaceGeometry::displace(std::size_t i, double distance, NarrowBand& band) {
  x_[i] += distance * nx_[i];
  y_[i] += distance * ny_[i];
  z_[i] += distance * nz_[i];
  if (i >= entry_.size()) return;
  const Points p = band.points();
  const int s = entry_[i];
  p.x[s] = x_[i];
  p.y[s] = y_[i];
  p.z[s] = z_[i];
}

/// From the sample inwards in strides that cannot pass a sheet, until the opposite one is near.
double SurfaceGeometry::thickness(std::size_t i, const NarrowBand& band) const {
  const double h = grid_.spacing, furthest = thickest * h;
  double way = first_probe * h;
  while (way < furthest) {
    const Vec3 at{x_[i] - way * nx_[i], y_[i] - way * ny_[i], z_[i] - way * nz_[i]};
    const double d = band.distance_at(at, longest_stride * h);
    if (d > -near_opposite * h) return std::min(way - d, furthest);
    way += -d - h;
  }
  return furthest;
}

std::vector<double> squared_gradient_of_KM(const LevelSet& phi, std::span<const Vec3> points) {
  SurfaceGeometry surface;
  surface.jets_at(phi, points, Derivatives::laplacian);
  return {surface.slope2().begin(), surface.slope2().end()};
}

} // namespace lamella
