#include "fields/spline_geometry.h"

#include "parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamella {
namespace {

constexpr std::size_t chunk = 256;
constexpr double longest_step = 0.5; // spacings

/// A chunk of points and what the kernels say of them.
struct Chunk {
  std::size_t count;
  std::array<double, chunk> x, y, z, phi, nx, ny, nz, grad, KM, K;

  ConstPoints points() const { return {x.data(), y.data(), z.data()}; }
  SurfaceArrays arrays() {
    return {phi.data(), nx.data(), ny.data(), nz.data(), grad.data(), KM.data(), K.data(), nullptr};
  }
  void evaluate(const SplineView& spline) {
    kernels().curvatures(spline, count, points(), arrays());
  }
  /// Not further than `longest`, and not at all where phi is flat.
  void take_newton_step(double longest) {
    for (std::size_t i = 0; i < count; ++i) {
      const double whole = phi[i] / grad[i];
      const double distance = std::isfinite(whole) ? std::clamp(whole, -longest, longest) : 0;
      x[i] -= distance * nx[i];
      y[i] -= distance * ny[i];
      z[i] -= distance * nz[i];
    }
  }
};

void take(vtkPoints& points, std::size_t begin, std::size_t end, Chunk& samples) {
  samples.count = end - begin;
  for (std::size_t i = 0; i < samples.count; ++i) {
    Vec3 p;
    points.GetPoint(vtkIdType(begin + i), p.data());
    samples.x[i] = p[0], samples.y[i] = p[1], samples.z[i] = p[2];
  }
}

/// The other way round, from `begin` on, with the geometry.
void put(const Chunk& s, std::size_t begin, vtkPoints& points, SplineGeometry& geometry) {
  for (std::size_t i = 0; i < s.count; ++i) {
    points.SetPoint(vtkIdType(begin + i), s.x[i], s.y[i], s.z[i]);
    float* normal = &geometry.normals[3 * (begin + i)];
    normal[0] = float(s.nx[i]), normal[1] = float(s.ny[i]), normal[2] = float(s.nz[i]);
    geometry.KM[begin + i] = s.KM[i];
    geometry.K[begin + i] = s.K[i];
  }
}

} // namespace

LevelSet fitted(const Grid& grid, std::span<const double> values) {
  Fourier fourier(grid);
  LevelSet f(grid);
  std::ranges::copy(values, f.coefficients().begin());
  f.fit(values, fourier);
  return f;
}

SplineGeometry move_onto(const LevelSet& phi, vtkPoints& points) {
  const SplineView spline = phi.view();
  const std::size_t n = points.GetNumberOfPoints();
  SplineGeometry geometry{std::vector<float>(3 * n), std::vector<double>(n),
                          std::vector<double>(n)};
  parallel_for(n, chunk, [&](std::size_t begin, std::size_t end) {
    Chunk samples;
    take(points, begin, end, samples);
    samples.evaluate(spline);
    samples.take_newton_step(longest_step * phi.grid().spacing);
    samples.evaluate(spline);
    put(samples, begin, points, geometry);
  });
  return geometry;
}

std::vector<double> slopes_at(const LevelSet& phi, vtkPoints& points) {
  const SplineView spline = phi.view();
  std::vector<double> slopes(points.GetNumberOfPoints());
  parallel_for(slopes.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Chunk samples;
    take(points, begin, end, samples);
    samples.evaluate(spline);
    std::copy_n(samples.grad.begin(), samples.count, slopes.begin() + std::ptrdiff_t(begin));
  });
  return slopes;
}

} // namespace lamella
