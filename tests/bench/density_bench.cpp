// A density of the energy as text, beside the same in C++:
//   lamella_bench --benchmark_filter=Density     eight samples: the density, its two partial
//   derivatives and theirs along the membrane
#include "energy/text_density.h"

#include <benchmark/benchmark.h>

namespace lamella {
namespace {

/// 0.002 K_M^2 K + a (K_M - C)^2
class InCpp : public DensityTerm<InCpp> {
public:
  static constexpr bool depends_on_K = true;

  TermName term() const override { return Term::bending; }
  Derivatives needs() const override { return Derivatives::all; }
  bool differs_between_phases() const override { return false; }

  template <class C, class N>
  N density(const Steps<C>&, const N& KM, const N& K) const {
    const N off = KM + constant<N>(-C0);
    return 0.002 * (KM * KM * K) + a * (off * off);
  }

private:
  double a = 3, C0 = -2;
};

Jet some_jet(double about) {
  Jet jet = constant<Jet>(about);
  for (int lane = 0; lane < 8; lane++) {
    jet.f[lane] += 0.1 * lane;
    for (int d = 0; d < 3; d++) {
      jet.grad[d][lane] = 1 + 0.1 * lane * d;
      jet.B_grad[d][lane] = 2 - 0.2 * lane * d;
    }
    jet.lap[lane] = about - lane;
    jet.B_hess[lane] = about + lane;
  }
  return jet;
}

void add(benchmark::State& state, const SurfaceTerm& term) {
  SurfacePoint<Jet> point{some_jet(-2), some_jet(1), {}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(&point);
    benchmark::ClobberMemory();
    Partials<Jet> sum;
    benchmark::DoNotOptimize(term.add(point, sum));
    benchmark::DoNotOptimize(sum);
  }
}

void BM_DensityInCpp(benchmark::State& state) { add(state, InCpp()); }
BENCHMARK(BM_DensityInCpp);

void BM_DensityAsText(benchmark::State& state, const char* text) {
  add(state, TextDensity(text, text, {{"a", 3}, {"C0", -2}}));
}
BENCHMARK_CAPTURE(BM_DensityAsText, same, "0.002*KM^2*K + a*(KM - C0)^2");
BENCHMARK_CAPTURE(BM_DensityAsText, tanh, "a*tanh(KM*K)");

} // namespace
} // namespace lamella
