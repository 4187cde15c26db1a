#include "energy/line.h"

namespace lamella {

/// As the curve moves by v n + w N, its frame turns by a = d_s v - tau_g w from t to n, by
/// b = d_s w + tau_g v from t to N and by c from n to N, and dl by -(kg v + kn w) dl = -stretch dl.
/// Then
///   d kg = d_s a - tau_g b + kn c + kg stretch,   d kn = d_s b + tau_g a - kg c + kn stretch,
///   d tau_g = d_s c + kg b - kn a + tau_g stretch,
///   d B_perp = d_n d_n w + (B_perp^2 + tau_g^2) w - 2 tau_g a + v d_n B_perp.
/// Integrated by parts,
///   dE = oint [A a + B b + couple c + S stretch + l_B (d B_perp + 2 tau_g a)] dl.
LineLoads::LineLoads(const LineDensity& density, const PhaseBoundary& boundary,
                     std::span<const CurveGeometry> ribbon, std::span<const double> dn_B_perp) {
  const std::size_t size = ribbon.size();
  std::vector<LineDensity::Value> l;
  std::vector<double> l_g, l_n, l_t;
  for (const CurveGeometry& p : ribbon) {
    l.push_back(density.at(p));
    l_g.push_back(l.back().kg);
    l_n.push_back(l.back().kn);
    l_t.push_back(l.back().tau_g);
    second.push_back(l.back().B_perp);
  }
  const std::vector<double> dl_g = boundary.derivative(l_g), dl_n = boundary.derivative(l_n),
                            dl_t = boundary.derivative(l_t);
  std::vector<double> A(size), B(size);
  for (std::size_t i = 0; i < size; i++) {
    const CurveGeometry& p = ribbon[i];
    A[i] = -dl_g[i] + l_n[i] * p.tau_g - l_t[i] * p.kn - 2 * l[i].B_perp * p.tau_g;
    B[i] = -dl_n[i] - l_g[i] * p.tau_g + l_t[i] * p.kg;
    couple.push_back(l_g[i] * p.kn - l_n[i] * p.kg - dl_t[i]);
  }
  const std::vector<double> dA = boundary.derivative(A), dB = boundary.derivative(B);
  for (std::size_t i = 0; i < size; i++) {
    const CurveGeometry& p = ribbon[i];
    const double S = l_g[i] * p.kg + l_n[i] * p.kn + l_t[i] * p.tau_g - l[i].l,
                 D = dn_B_perp.empty() ? 0 : dn_B_perp[i];
    const double along_n = -dA[i] + p.tau_g * B[i] + p.kg * S + l[i].B_perp * D,
                 along_N = -p.tau_g * A[i] - dB[i] + p.kn * S +
                           l[i].B_perp * (p.B_perp * p.B_perp + p.tau_g * p.tau_g);
    force.push_back(-along_n * p.n - along_N * p.N);
  }
}

} // namespace lamella
