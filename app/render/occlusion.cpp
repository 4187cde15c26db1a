#include "render/occlusion.h"

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

/// Blur along one axis; `inner` values lie between neighbours along it.
void blur(std::vector<double>& values, int nodes, std::size_t inner,
          const std::vector<double>& weights) {
  const std::vector<double> in = values;
  for (std::size_t first = 0; first < in.size(); first += nodes * inner)
    for (int i = 0; i < nodes; ++i) {
      double* row = &values[first + i * inner];
      std::fill_n(row, inner, 0.0);
      for (int d = 1 - int(weights.size()); d < int(weights.size()); ++d) {
        const double* from = &in[first + std::clamp(i + d, 0, nodes - 1) * inner];
        const double weight = weights[std::abs(d)];
        for (std::size_t q = 0; q < inner; ++q) row[q] += weight * from[q];
      }
    }
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
