#include "energy/surface_energy.h"

#include "energy/gradient.h"
#include "energy/helfrich.h"
#include "energy/linear.h"
#include "energy/monomial.h"
#include "energy/text_density.h"
#include "parallel.h"
#include "scene/densities.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace lamella {

namespace {
constexpr std::size_t lanes = 8, samples_per_task = 2048, strip_per_task = 256;

using UniformLinear = Monomial<Term::linear, 1, 0>;
using Gaussian = Monomial<Term::gaussian, 0, 1>;
using Cubic = Monomial<Term::cubic, 3, 0>;
using MixedCubic = Monomial<Term::mixed_cubic, 1, 1>;
using Quartic = Monomial<Term::quartic, 4, 0>;
using MixedQuartic = Monomial<Term::mixed_quartic, 2, 1>;
using GaussianSquare = Monomial<Term::gaussian_square, 0, 2>;
using Geodesic = Monomial<Term::geodesic, 0, 1>;

/// The sum of everything is F = Lap_s g + (K_M^2 - 2 K) g + K_M Lap_s f_K - B : grad grad f_K +
/// K_M K f_K + 2 f_X B(grad K_M, grad K_M) - K_M f, with partial derivatives f_M, f_K and f_X by
/// X = |grad_s K_M|^2 of the density f, g = f_M - 2 div_s(f_X grad_s K_M) (docs/theory.md,
/// which has a picture of the way to it); and
/// K_M m f_m for each field m whose amount is carried.
Lanes variation_of(const Lanes& f, const Partials<AffineJet>& by, const Lanes& KM, const Lanes& K) {
  return by.by_KM.lap + (KM * KM - 2 * K) * by.by_KM.f + KM * (K * by.by_K.f - f);
}
Lanes variation_of(const Lanes& f, const Partials<Jet>& by, const Lanes& KM, const Lanes& K) {
  return by.by_KM.lap + (KM * KM - 2 * K) * by.by_KM.f + KM * by.by_K.lap - by.by_K.B_hess +
         KM * (K * by.by_K.f + by.by_amounts - f);
}

/// B v, with B = xx yy zz xy xz yz.
std::array<Lanes, 3> times(const std::array<Lanes, 6>& B, const std::array<Lanes, 3>& v) {
  return {B[0] * v[0] + B[3] * v[1] + B[4] * v[2], B[3] * v[0] + B[1] * v[1] + B[5] * v[2],
          B[4] * v[0] + B[5] * v[1] + B[2] * v[2]};
}

/// Eight samples of an array, from `first` on or by their indices.
struct Consecutive {
  std::size_t first, count;
  std::size_t operator[](std::size_t lane) const { return first + std::min(lane, count - 1); }
};
struct Scattered {
  const int* index;
  std::size_t count;
  std::size_t operator[](std::size_t lane) const { return index[std::min(lane, count - 1)]; }
};
template <class Where>
Lanes load(std::span<const double> values, const Where& at) {
  Lanes out;
  for (std::size_t l = 0; l < lanes; l++) out[l] = values[at[l]];
  return out;
}
Lanes load(std::span<const double> values, const Consecutive& at) {
  Lanes out;
  if (at.count == lanes) {
    std::memcpy(&out, values.data() + at.first, sizeof(Lanes));
    return out;
  }
  for (std::size_t l = 0; l < lanes; l++) out[l] = values[at[l]];
  return out;
}

template <class Where>
void load_curvatures(const SurfaceGeometry& surface, const Where& at, SurfacePoint<AffineJet>& p) {
  p.KM = {load(surface.KM(), at), load(surface.lap_KM(), at)};
  p.K = {load(surface.K(), at), Lanes{}};
}

/// What is not known, because no term asks for it, is 0.
template <class Where>
void load_curvatures(const SurfaceGeometry& surface, const Where& at, SurfacePoint<Jet>& p) {
  const Derivatives known = surface.derivatives();
  p.KM = p.K = constant<Jet>(0);
  p.KM.f = load(surface.KM(), at);
  p.K.f = load(surface.K(), at);
  p.KM.lap = load(surface.lap_KM(), at);
  if (known == Derivatives::laplacian) return;
  std::array<Lanes, 6> B;
  for (int c = 0; c < 6; c++) B[c] = load(surface.B(c), at);
  for (int d = 0; d < 3; d++) p.KM.grad[d] = load(surface.grad_KM(d), at);
  p.KM.B_grad = times(B, p.KM.grad);
  if (known == Derivatives::gradient) return;
  p.KM.B_hess = load(surface.B_hess_KM(), at);
  for (int d = 0; d < 3; d++) p.K.grad[d] = load(surface.grad_K(d), at);
  p.K.B_grad = times(B, p.K.grad);
  p.K.lap = load(surface.lap_K(), at);
  p.K.B_hess = load(surface.B_hess_K(), at);
}

template <class Where>
Jet load_jets(std::span<const SurfaceJet<double>> jets, const Where& at) {
  Jet out;
  for (std::size_t l = 0; l < lanes; l++) {
    const SurfaceJet<double>& jet = jets[at[l]];
    out.f[l] = jet.f;
    for (int d = 0; d < 3; d++) {
      out.grad[d][l] = jet.grad[d];
      out.B_grad[d][l] = jet.B_grad[d];
    }
    out.lap[l] = jet.lap;
    out.B_hess[l] = jet.B_hess;
  }
  return out;
}

template <class Where>
void load(std::span<const SurfaceJet<double>> jets, const Where& at, Jet& field) {
  field = load_jets(jets, at);
}
template <class Where>
void load(std::span<const SurfaceJet<double>> jets, const Where& at, Lanes& field) {
  for (std::size_t l = 0; l < lanes; l++) field[l] = jets[at[l]].f;
}

/// Material fields at eight samples.
template <class N>
class FieldsAt {
public:
  template <class Where>
  FieldsAt(SurfaceEnergy::FieldJets jets, const Where& at) : count_(jets.size()) {
    for (std::size_t i = 0; i < count_; i++) load(jets[i], at, fields_[i]);
  }
  operator std::span<const N>() const { return {fields_.data(), count_}; }

private:
  std::size_t count_;
  std::array<N, most_fields> fields_;
};
/// Where one of them counts, nothing is affine.
template <>
class FieldsAt<AffineJet> {
public:
  template <class Where>
  FieldsAt(SurfaceEnergy::FieldJets, const Where&) {}
  operator std::span<const AffineJet>() const { return {}; }
};

/// The same values everywhere.
std::vector<Univariate> fixed(std::span<const double> fields) {
  std::vector<Univariate> all;
  for (const double value : fields) all.push_back(constant<Univariate>(value));
  return all;
}

/// A step, and its derivative by psi.
Dual<Jet> smeared(const SmearedStep& profile, const Jet& psi) {
  Lanes step, delta, slope, bend;
  for (std::size_t l = 0; l < lanes; l++) {
    const SmearedStep::Value v = profile.at(psi.f[l]);
    step[l] = v.step;
    delta[l] = v.delta;
    slope[l] = v.slope;
    bend[l] = v.bend;
  }
  return {compose(step, delta, slope, psi), compose(delta, slope, bend, psi)};
}

/// The inner product of two tensors along the membrane, xx, yy, zz, xy, xz, yz.
Lanes contracted(const std::array<Lanes, 6>& a, const std::array<Lanes, 6>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// p = grad_s psi . grad_s K_M, but for its B_grad and B_hess. By Bochner's formula
///   Lap_s p = 2 grad grad psi : grad grad K_M + grad psi . grad Lap_s K_M
///             + grad Lap_s psi . grad K_M + 2 K p.
Jet product_of_gradients(const SurfaceGeometry& surface, const SurfacePoint<Jet>& p, const Jet& psi,
                         std::span<const SurfaceEnergy::Strip::Further> further,
                         const Scattered& at) {
  std::array<Lanes, 6> of_psi, of_KM;
  std::array<Lanes, 3> grad_lap_psi, grad_lap_KM;
  for (int c = 0; c < 6; c++) {
    of_KM[c] = load(surface.hess_KM(c), at);
    for (std::size_t l = 0; l < lanes; l++)
      of_psi[c][l] = further[std::min(l, at.count - 1)].hess[c];
  }
  for (int d = 0; d < 3; d++) {
    grad_lap_KM[d] = load(surface.grad_lap_KM(d), at);
    for (std::size_t l = 0; l < lanes; l++)
      grad_lap_psi[d][l] = further[std::min(l, at.count - 1)].grad_lap[d];
  }
  Jet product = constant<Jet>(0);
  product.f = dot(psi.grad, p.KM.grad);
  const std::array<Lanes, 3> by_psi = times(of_psi, p.KM.grad), by_KM = times(of_KM, psi.grad);
  for (int d = 0; d < 3; d++) product.grad[d] = by_psi[d] + by_KM[d];
  product.lap = 2 * contracted(of_psi, of_KM) + dot(psi.grad, grad_lap_KM) +
                dot(grad_lap_psi, p.KM.grad) + 2 * p.K.f * product.f;
  return product;
}

/// 0 in Ld, 1 in Lo.
template <class N>
N step_apart(std::span<const char> is_Ld, const Consecutive& at) {
  N step = constant<N>(0);
  if (!is_Ld.empty())
    for (std::size_t l = 0; l < lanes; l++) step.f[l] = !is_Ld[at[l]];
  return step;
}

/// int weight density factor dA; `factor` empty: 1.
double integral(const SurfaceGeometry& surface, std::span<const double> density,
                std::span<const double> factor) {
  return parallel_sum<double>(surface.size(), 4096, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t i = begin; i < end; i++)
      if (const double w = surface.weight()[i]; w != 0)
        sum += w * (factor.empty() ? 1 : factor[i]) * density[i];
    return sum;
  });
}
} // namespace

/// |grad_s K_M|^2 at eight places, with what its variation needs.
struct SurfaceEnergy::GradientSquare {
  Lanes slope2, B_slope2;        ///< |grad_s K_M|^2, B(grad_s K_M, grad_s K_M)
  Jet lap;                       ///< Lap_s K_M, but for its B_grad and B_hess
  Jet across = constant<Jet>(0); ///< grad_s psi . grad_s K_M, in the strip, but for the same
  Steps<Jet> slopes;             ///< derivatives of the steps by psi

  template <class Where>
  GradientSquare(const SurfaceGeometry& surface, const Jet& KM, const Where& at)
      : slope2(dot(KM.grad, KM.grad)), B_slope2(dot(KM.grad, KM.B_grad)), lap(constant<Jet>(0)) {
    slopes.accurate = slopes.moments = slopes.monotonic = constant<Jet>(0);
    lap.f = KM.lap;
    for (int d = 0; d < 3; d++) lap.grad[d] = load(surface.grad_lap_KM(d), at);
    lap.lap = load(surface.lap_lap_KM(), at);
  }
};

SurfaceEnergy::SurfaceEnergy(const SurfaceModuli& membrane, const Parameters& parameters,
                             const MaterialFields& fields)
    : SurfaceEnergy(membrane, membrane, 0, StepProfiles::of_grid(1), parameters, fields) {}

/// With a line more there is one term more.
SurfaceEnergy::SurfaceEnergy(const SurfaceModuli& ld, const SurfaceModuli& lo,
                             double geodesic_modulus, const StepProfiles& profiles,
                             const Parameters& parameters, const MaterialFields& fields)
    : profiles_(profiles) {
  using M = SurfaceModuli;
  const auto both = [&](double M::*modulus, Profile profile) {
    return Coefficient{ld.*modulus, lo.*modulus, profile};
  };
  add(std::make_shared<Helfrich>(both(&M::bending_modulus, Profile::compliance),
                                 both(&M::spontaneous_curvature, Profile::accurate)));
  if (ld.linear_modulus != lo.linear_modulus)
    add(std::make_shared<Linear>(ld, lo));
  else
    add_if<UniformLinear>(both(&M::linear_modulus, Profile::accurate));
  add_if<Gaussian>(both(&M::gaussian_modulus, Profile::moments));
  add_if<Cubic>(both(&M::cubic_modulus, Profile::monotonic));
  add_if<MixedCubic>(both(&M::mixed_cubic_modulus, Profile::moments));
  add_if<Quartic>(both(&M::quartic_modulus, Profile::monotonic));
  add_if<MixedQuartic>(both(&M::mixed_quartic_modulus, Profile::monotonic));
  add_if<GaussianSquare>(both(&M::gaussian_square_modulus, Profile::monotonic));
  add_if<Gradient>(both(&M::gradient_modulus, Profile::monotonic));
  add_if<Geodesic>({geodesic_modulus, 0, Profile::moments});
  if (!ld.density.empty() || !lo.density.empty())
    add(std::make_shared<TextDensity>(ld.density, lo.density, parameters, fields));
}

template <class Monomial>
void SurfaceEnergy::add_if(const Coefficient& modulus) {
  if (!modulus.vanishes()) add(std::make_shared<Monomial>(modulus));
}

void SurfaceEnergy::add(std::shared_ptr<const SurfaceTerm> term) {
  const TermName name = term->term();
  if (const auto* word = std::get_if<std::string>(&name); word && !is_term_name(*word))
    throw std::invalid_argument(
        fmt::format("\"{}\" cannot name a term of the energy; allowed: letters, digits and _, a "
                    "letter first",
                    *word));
  terms_.push_back(std::move(term));
  density_.emplace_back();
}

Derivatives SurfaceEnergy::needs() const {
  Derivatives most = differs() ? Derivatives::gradient : Derivatives::laplacian;
  for (const auto& term : terms_) most = std::max(most, term->needs());
  return most;
}

bool SurfaceEnergy::differs() const {
  return std::ranges::any_of(terms_, [](const auto& t) { return t->differs_between_phases(); });
}

bool SurfaceEnergy::gradient_differs() const {
  return std::ranges::any_of(terms_, [](const auto& t) { return t->of_gradient().differs(); });
}

bool SurfaceEnergy::is_affine() const {
  return std::ranges::all_of(terms_,
                             [](const auto& t) { return t->needs() == Derivatives::laplacian; });
}

void SurfaceEnergy::find_forces(const SurfaceGeometry& surface, std::span<const char> is_Ld,
                                const Strip& strip, std::span<double> variation, FieldJets fields) {
  for (std::vector<double>& density : density_) density.resize(surface.size());
  if (is_affine())
    find_bulk<AffineJet>(surface, is_Ld, fields, variation);
  else
    find_bulk<Jet>(surface, is_Ld, fields, variation);
  find_strip(surface, strip, fields, variation);
}

/// `square`: null where no term is of the gradient of K_M.
template <class N, class Where>
void SurfaceEnergy::find_at(const SurfacePoint<N>& p, const GradientSquare* square, const Where& at,
                            std::span<double> variation) {
  Partials<N> by;
  Lanes f = Lanes{}, of_square = Lanes{};
  for (std::size_t t = 0; t < terms_.size(); t++) {
    Lanes density = terms_[t]->add(p, by);
    if constexpr (std::is_same_v<N, Jet>)
      if (const Coefficient modulus = terms_[t]->of_gradient(); !modulus.vanishes()) {
        const Jet c = modulus.at(p.steps);
        by.by_KM =
            by.by_KM - 2 * (c * square->lap + modulus.slope(square->slopes) * square->across);
        density += c.f * square->slope2;
        of_square += 2 * c.f * square->B_slope2;
      }
    for (std::size_t l = 0; l < at.count; l++) density_[t][at[l]] = density[l];
    f += density;
  }
  const Lanes F = variation_of(f, by, value_of(p.KM), value_of(p.K)) + of_square;
  for (std::size_t l = 0; l < at.count; l++) variation[at[l]] = F[l];
}

template <class N>
void SurfaceEnergy::find_bulk(const SurfaceGeometry& surface, std::span<const char> is_Ld,
                              FieldJets fields, std::span<double> variation) {
  const bool has_gradient = needs() == Derivatives::sixth;
  parallel_for(surface.size(), samples_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += lanes) {
      const Consecutive at{first, std::min(lanes, end - first)};
      SurfacePoint<N> p;
      load_curvatures(surface, at, p);
      p.steps.accurate = p.steps.moments = p.steps.monotonic = step_apart<N>(is_Ld, at);
      const FieldsAt<N> here(fields, at);
      p.fields = here;
      std::optional<GradientSquare> square;
      if constexpr (std::is_same_v<N, Jet>)
        if (has_gradient) square.emplace(surface, p.KM, at);
      find_at(p, square ? &*square : nullptr, at, variation);
    }
  });
}

void SurfaceEnergy::find_strip(const SurfaceGeometry& surface, const Strip& strip, FieldJets fields,
                               std::span<double> variation) {
  const bool has_gradient = needs() == Derivatives::sixth;
  parallel_for(strip.sample.size(), strip_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += lanes) {
      const Scattered at{&strip.sample[first], std::min(lanes, end - first)};
      SurfacePoint<Jet> p;
      load_curvatures(surface, at, p);
      const Jet psi = load_jets(strip.psi, Consecutive{first, at.count});
      const FieldsAt<Jet> here(fields, at);
      p.fields = here;
      const Dual<Jet> accurate = smeared(profiles_.accurate, psi),
                      moments = smeared(profiles_.moments, psi),
                      monotonic = smeared(profiles_.monotonic, psi);
      p.steps = {accurate.f, moments.f, monotonic.f};
      std::optional<GradientSquare> square;
      if (has_gradient) {
        square.emplace(surface, p.KM, at);
        square->slopes = {accurate.d, moments.d, monotonic.d};
        if (!strip.further.empty())
          square->across =
              product_of_gradients(surface, p, psi, std::span(strip.further).subspan(first), at);
      }
      find_at(p, square ? &*square : nullptr, at, variation);
    }
  });
}

/// A wave changes K_M by -k^2 and K by -k^2 q, where q is the curvature across its direction, of
/// all that there are at a sample: f_MM + 2 f_MK q + f_KK q^2; and its gradient by k^3.
SurfaceEnergy::Stiffness SurfaceEnergy::stiffness(const SurfaceGeometry& surface,
                                                  std::span<const char> is_Ld,
                                                  FieldJets fields) const {
  Stiffness all{1e300, -1e300};
  Coefficient gradient;
  for (const auto& term : terms_) {
    gradient.ld += term->of_gradient().ld;
    gradient.lo += term->of_gradient().lo;
  }
  std::tie(all.least_gradient, all.most_gradient) = std::minmax(2 * gradient.ld, 2 * gradient.lo);
  // Where it does not depend on curvatures, one place of each phase tells.
  const std::size_t end = is_affine() ? std::min(lanes, surface.size()) : surface.size();
  for (std::size_t first = 0; first < end; first += lanes) {
    const Consecutive at{first, std::min(lanes, surface.size() - first)};
    const FieldsAt<Lanes> here(fields, at);
    SurfacePoint<Lanes> p{load(surface.KM(), at), load(surface.K(), at), {}, here};
    for (std::size_t l = 0; l < lanes; l++) {
      const bool in_Lo = is_affine() ? l % 2 : !is_Ld.empty() && !is_Ld[at[l]];
      p.steps.accurate[l] = p.steps.moments[l] = p.steps.monotonic[l] = in_Lo;
    }
    SecondPartials by;
    for (const auto& term : terms_) term->add(p, by);
    for (std::size_t l = 0; l < at.count; l++) {
      const double mean = 0.5 * p.KM[l], apart = std::sqrt(std::max(0.0, mean * mean - p.K[l]));
      const auto of = [&](double q) { return by.KM_KM[l] + (2 * by.KM_K[l] + by.K_K[l] * q) * q; };
      const double between = by.K_K[l] == 0 ? mean : -by.KM_K[l] / by.K_K[l],
                   extreme = of(std::clamp(between, mean - apart, mean + apart));
      const auto [least, most] = std::minmax({of(mean - apart), of(mean + apart), extreme});
      if (least < all.least) all.softest = at[l];
      all.least = std::min(all.least, least);
      all.most = std::max(all.most, most);
    }
  }
  return all;
}

double SurfaceEnergy::density(double KM, double K, double slope2,
                              std::span<const double> fields) const {
  const std::vector<Univariate> here = fixed(fields);
  const SurfacePoint<Univariate> p{constant<Univariate>(KM), constant<Univariate>(K), {}, here};
  double sum = 0;
  for (const auto& term : terms_) sum += term->across(p).f + term->of_gradient().ld * slope2;
  return sum;
}

Univariate SurfaceEnergy::across(double psi, double KM, double K, double slope2,
                                 std::span<const double> fields) const {
  const std::vector<Univariate> here = fixed(fields);
  const SurfacePoint<Univariate> p{constant<Univariate>(KM), constant<Univariate>(K),
                                   profiles_.at(psi), here};
  Univariate sum;
  for (const auto& term : terms_)
    if (term->differs_between_phases())
      sum = sum + term->across(p) + slope2 * term->of_gradient().at(p.steps);
  return sum;
}

void SurfaceEnergy::find_energies(const SurfaceGeometry& surface, EnergyTerms& terms) const {
  for (std::size_t t = 0; t < terms_.size(); t++)
    terms.add(terms_[t]->term(), integral(surface, density_[t], {}));
}

double SurfaceEnergy::bending_Ld(const SurfaceGeometry& surface,
                                 std::span<const double> share) const {
  return integral(surface, density_[0], share);
}

} // namespace lamella
