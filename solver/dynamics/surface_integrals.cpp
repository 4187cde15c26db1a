#include "dynamics/surface_integrals.h"

#include "parallel.h"

namespace lamella {

SurfaceIntegrals& SurfaceIntegrals::operator+=(const SurfaceIntegrals& other) {
  gram += other.gram;
  variation += other.variation;
  volume += other.volume;
  area_Ld += other.area_Ld;
  return *this;
}

SurfaceIntegrals integrate(const SurfaceGeometry& surface, const Variation& variation,
                           const Samples& samples) {
  const bool with_variation = !variation.values.empty();
  const double stiffness = variation.stiffness;
  return parallel_sum<SurfaceIntegrals>(
      samples.count(surface), 2048, [&](std::size_t begin, std::size_t end) {
        SurfaceIntegrals sum;
        double s[6] = {}, f[3] = {};
        for (std::size_t j = begin; j < end; j++) {
          const std::size_t i = samples[j];
          const double w = surface.weight()[i], KM = surface.KM()[i], K = surface.K()[i];
          if (w == 0) continue;
          const Vec3 p = surface.point(i), n = surface.normal(i);
          const double products[6] = {1, KM, K, KM * KM, KM * K, K * K};
          for (int m = 0; m < 6; m++) s[m] += w * products[m];
          if (with_variation) {
            for (int m = 0; m < 3; m++) f[m] += w * products[m] * variation.values[i];
            if (stiffness != 0) {
              const double lap = surface.lap_KM()[i];
              f[0] -= w * stiffness * lap;
              f[1] -= w * stiffness * (KM * lap + surface.slope2()[i]);
            }
          }
          sum.volume += w * (p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / 3;
        }
        sum.gram.topLeftCorner<3, 3>() << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
        sum.variation << f[0], f[1], f[2];
        return sum;
      });
}

} // namespace lamella
