#include "levelset/taylor.h"

#include "parallel.h"

namespace lamella {

namespace {

constexpr std::size_t points_per_task = 64;

/// What a kernel finds at each point, from the ten numbers that it gives.
template <class Out, class Kernel, class From>
std::vector<Out> at_points(const LevelSet& f, std::span<const Eigen::Vector3d> points,
                           Kernel kernel, From&& from) {
  std::vector<Out> out(points.size());
  auto part = [&](std::size_t begin, std::size_t end) {
    const std::size_t n = end - begin;
    double x[3][points_per_task], o[10 * points_per_task];
    for (std::size_t i = 0; i < n; i++)
      for (int d = 0; d < 3; d++) x[d][i] = points[begin + i][d];
    kernel(f.view(), n, {x[0], x[1], x[2]}, o);
    for (std::size_t i = 0; i < n; i++) out[begin + i] = from([&](int m) { return o[m * n + i]; });
  };
  if (points.size() <= points_per_task)
    part(0, points.size());
  else
    parallel_for(points.size(), points_per_task, part);
  return out;
}

} // namespace

std::vector<Taylor> taylor(const LevelSet& f, std::span<const Eigen::Vector3d> points) {
  return at_points<Taylor>(f, points, kernels().taylor, [](auto&& at) {
    Taylor t;
    t.value = at(0);
    t.gradient << at(1), at(2), at(3);
    t.hessian << at(4), at(7), at(8), at(7), at(5), at(9), at(8), at(9), at(6);
    return t;
  });
}

std::vector<ThirdDerivatives> third_derivatives(const LevelSet& f,
                                                std::span<const Eigen::Vector3d> points) {
  return at_points<ThirdDerivatives>(f, points, kernels().third, [](auto&& at) {
    ThirdDerivatives t;
    t.by[0] << at(0), at(1), at(2), at(1), at(3), at(4), at(2), at(4), at(5);
    t.by[1] << at(1), at(3), at(4), at(3), at(6), at(7), at(4), at(7), at(8);
    t.by[2] << at(2), at(4), at(5), at(4), at(7), at(8), at(5), at(8), at(9);
    return t;
  });
}

} // namespace lamella
