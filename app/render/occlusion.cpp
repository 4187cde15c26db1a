#include "render/occlusion.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

/// 1 inside, 0 outside, with a ramp of two spacings between.
Frame indicator(const Frame& frame) {
  Frame inside = frame;
  for (double& phi : inside.phi) phi = std::clamp(0.5 - 0.5 * phi / frame.grid.spacing, 0.0, 1.0);
  return inside;
}

/// Weights of a Gaussian of width sigma (in spacings) at 0, 1, 2, ...; they sum to 1 over both
/// sides.
std::vector<double> gaussian(double sigma) {
  std::vector<double> weights(std::size_t(std::ceil(3 * sigma)) + 1);
  double sum = 0;
  for (std::size_t d = 0; d < weights.size(); ++d) {
    weights[d] = std::exp(-0.5 * double(d * d) / (sigma * sigma));
    sum += (d == 0 ? 1 : 2) * weights[d];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// The blurred values of a row of nodes, `width` of them side by side, from a copy that goes on
/// beyond both ends.
void blur_row(const std::vector<double>& padded, std::size_t width,
              const std::vector<double>& weights, std::vector<double>& out) {
  const double* const middle = &padded[(weights.size() - 1) * width];
  for (std::size_t q = 0; q < out.size(); ++q) out[q] = weights[0] * middle[q];
  for (std::size_t d = 1; d < weights.size(); ++d) {
    const double weight = weights[d];
    const double *before = middle - d * width, *after = middle + d * width;
    for (std::size_t q = 0; q < out.size(); ++q) out[q] += weight * (before[q] + after[q]);
  }
}

/// Blur along one axis; `inner` values lie between neighbours along it.
void blur(std::vector<double>& values, int nodes, std::size_t inner,
          const std::vector<double>& weights) {
  constexpr std::size_t widest = 64; // what is worked on stays in the cache
  const int reach = int(weights.size()) - 1;
  const std::size_t bands = (inner + widest - 1) / widest, block = nodes * inner;
  const auto blur_band = [&](std::size_t n) {
    const std::size_t left = n % bands * widest, width = std::min(widest, inner - left);
    double* const band = &values[n / bands * block + left];
    std::vector<double> padded((nodes + 2 * reach) * width), out(nodes * width);
    for (int i = -reach; i < nodes + reach; ++i)
      std::copy_n(band + std::clamp(i, 0, nodes - 1) * inner, width, &padded[(i + reach) * width]);
    blur_row(padded, width, weights, out);
    for (int i = 0; i < nodes; ++i) std::copy_n(&out[i * width], width, band + i * inner);
  };
  const std::size_t grain = std::max<std::size_t>(1, 16384 / block);
  parallel_for(values.size() / block * bands, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) blur_band(n);
  });
}

Frame blurred_inside(const Frame& frame, double radius) {
  Frame inside = indicator(frame);
  const std::vector<double> weights = gaussian(radius / frame.grid.spacing);
  std::size_t inner = 1;
  for (int nodes : frame.grid.nodes) {
    blur(inside.phi, nodes, inner, weights);
    inner *= nodes;
  }
  return inside;
}

} // namespace

Occlusion::Occlusion(const Frame& frame, double radius)
    : radius_(radius), inside_(blurred_inside(frame, radius)), sampler_(inside_.grid, inside_.phi) {
}

double Occlusion::at(const Vec3& p, const Vec3& normal) const {
  constexpr double flat = 0.1587; // a Gaussian's weight beyond one sigma
  constexpr double full = 0.5;    // as in a hollow half a sigma wide
  Vec3 above;
  for (int a = 0; a < 3; ++a) above[a] = p[a] + radius_ * normal[a];
  return std::clamp((sampler_.value(above) - flat) / (full - flat), 0.0, 1.0);
}

} // namespace lamella::render
