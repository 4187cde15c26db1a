#include "scene/perturbation.h"

#include "scene/shapes.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace lamella {
namespace {

using std::numbers::pi;

constexpr int wave_count = 32;
constexpr double longest_over_shortest = 3;

/// splitmix64 (Steele, Lea & Flood, OOPSLA 2014): the same numbers with every compiler.
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  double between(double low, double high) { return low + (high - low) * 0x1p-53 * (next() >> 11); }

  Vec3 direction() {
    const double z = between(-1, 1), azimuth = between(0, 2 * pi), rho = std::sqrt(1 - z * z);
    return {rho * std::cos(azimuth), rho * std::sin(azimuth), z};
  }

private:
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

Vec3 scaled(double factor, const Vec3& x) { return {factor * x[0], factor * x[1], factor * x[2]}; }

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

} // namespace

double shortest_wavelength(const Perturbation& perturbation, const Shape& shape) {
  if (perturbation.fold > 0) return 2 * pi * largest_radius(shape) / perturbation.fold;
  return perturbation.wavelength > 0 ? perturbation.wavelength : largest_extent(shape) / 3;
}

Displacement::Displacement(const Perturbation& perturbation, const Shape& shape)
    : amplitude_(perturbation.amplitude), fold_(perturbation.fold), radius_(largest_radius(shape)) {
  Random random(static_cast<std::uint64_t>(perturbation.seed));
  arm_azimuth_ = random.between(0, 2 * pi);
  const double largest_wave_number = 2 * pi / shortest_wavelength(perturbation, shape);
  for (int n = 0; n < wave_count; ++n) {
    const double wave_number =
        random.between(largest_wave_number / longest_over_shortest, largest_wave_number);
    const Vec3 wave_vector = scaled(wave_number, random.direction());
    const Vec3 polarisation = scaled(std::sqrt(2.0 / wave_count), random.direction());
    waves_.push_back({wave_vector, polarisation, random.between(0, 2 * pi)});
  }
}

Vec3 Displacement::operator()(const Vec3& x) const {
  if (amplitude_ == 0) return {0, 0, 0};
  const Vec3 u = fold_ == 0 ? waves(x) : arms(x);
  return scaled(amplitude_ / std::sqrt(1 + dot(u, u)), u);
}

Vec3 Displacement::waves(const Vec3& x) const {
  Vec3 u{};
  for (const Wave& wave : waves_) {
    const double elongation = std::cos(dot(wave.wave_vector, x) + wave.phase);
    for (int i = 0; i < 3; ++i) u[i] += elongation * wave.polarisation[i];
  }
  return u;
}

Vec3 Displacement::arms(const Vec3& x) const {
  const double rho = std::hypot(x[0], x[1]), theta = std::atan2(x[1], x[0]);
  const double height = std::pow(rho / radius_, fold_) * std::cos(fold_ * (theta - arm_azimuth_));
  return {height * x[0] / radius_, height * x[1] / radius_, 0};
}

} // namespace lamella
