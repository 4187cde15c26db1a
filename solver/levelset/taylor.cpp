#include "levelset/taylor.h"

#include "parallel.h"

namespace lamella {

namespace {

constexpr std::size_t points_per_task = 64;

void fill(const LevelSet& f, std::span<const Eigen::Vector3d> points, std::span<Taylor> out) {
  const std::size_t n = points.size();
  double x[3][points_per_task], o[10 * points_per_task];
  for (std::size_t i = 0; i < n; i++)
    for (int d = 0; d < 3; d++) x[d][i] = points[i][d];
  kernels().taylor(f.view(), n, {x[0], x[1], x[2]}, o);
  for (std::size_t i = 0; i < n; i++) {
    auto at = [&](int m) { return o[m * n + i]; };
    Taylor& t = out[i];
    t.value = at(0);
    t.gradient << at(1), at(2), at(3);
    t.hessian << at(4), at(7), at(8), at(7), at(5), at(9), at(8), at(9), at(6);
  }
}

} // namespace

std::vector<Taylor> taylor(const LevelSet& f, std::span<const Eigen::Vector3d> points) {
  std::vector<Taylor> out(points.size());
  auto part = [&](std::size_t begin, std::size_t end) {
    fill(f, points.subspan(begin, end - begin), std::span(out).subspan(begin, end - begin));
  };
  if (points.size() <= points_per_task)
    part(0, points.size());
  else
    parallel_for(points.size(), points_per_task, part);
  return out;
}

} // namespace lamella
