#pragma once
#include "dynamics/surface_integrals.h"
#include "scene/scene.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace lamella {

/// Volume, area, int K_M dA, and the area of the Ld phase; or a change of them.
using Quantities = Eigen::Vector4d;
Quantities quantities(const SurfaceIntegrals& integrals);

/// Coefficients of 1, K_M, K, q K_M in the normal velocity: P, sigma, 2 h sigma_DA (Eq. 80), and
/// what the tension of Ld is in the mean above that of Lo; q is the share of Ld.
using Multipliers = Eigen::Vector4d;

/// First-order change of the quantities by a normal displacement u, from int u dA, int K_M u dA,
/// int K u dA, int q K_M u dA.
inline Quantities change_from(const Eigen::Vector4d& moments) {
  return {moments[0], -moments[1], -2 * moments[2], -moments[3]};
}

/// Which quantities are held, where they are led to, and the multipliers of those that are free.
///
/// Every vector has a component for each of the four; those of free quantities do not count.
class Constraints {
public:
  explicit Constraints(const Scene& scene);

  /// What does not follow from the scene: where the targets set out from, and what is held.
  struct State {
    std::array<int, 4> held{};      ///< 0 or 1
    std::array<double, 4> factor{}; ///< the quantity for a reduced value of 1
    std::array<double, 4> start{};  ///< reduced value
  };
  State state() const;
  void restore(const State& state);

  /// What the start has; targets set out from there.
  void begin(const Quantities& start);
  /// Of the sphere of the area that the start has: the length by which defaults scale.
  double radius() const;

  /// A ramped area difference is free until it sets out. True when it does so now, from what it has
  /// become.
  bool set_out(double time, const Quantities& now);

  bool is_held(int quantity) const { return held_[quantity]; }
  std::span<const int> held() const { return indices_; }

  Quantities target(double time) const;
  /// d target / dt.
  Quantities rate(double time) const;
  /// A held quantity is led on between two times.
  bool is_led(double from, double to) const;
  /// Some target still moves or has yet to set out.
  bool ramping(double time) const;
  /// A ramp begins or ends at this time.
  bool turns_at(double time) const;
  /// Longest step that follows the ramps, and does not pass over the beginning or end of one.
  double longest_step(double time) const;

  /// The multipliers for which the velocity -F + sum_i m_i g_i changes the held quantities at their
  /// rates: g = 1, K_M, K, and one function for each area in Ld and Lo that is held, its rate 0.
  /// `gram`: int g_i g_j dA, `variation`: int g_i F dA.
  Eigen::VectorXd multipliers(const Eigen::MatrixXd& gram, const Eigen::VectorXd& variation,
                              const Quantities& rate) const;

  /// Factors of the held quantities' directions that bring about a change; `effect` has a column of
  /// changes for each direction. `integrals` tell what is much of a change.
  Eigen::Vector4d combination(const Eigen::Matrix4d& effect, const Quantities& change,
                              const SurfaceIntegrals& integrals) const;

  /// Corrections must be made with care: the area difference is held, or 1 and K_M are almost
  /// dependent on this membrane, a long tube, so that a small correction takes a long way.
  bool is_delicate(const SurfaceIntegrals& integrals) const;

  /// Largest relative deviation of a held quantity from its target.
  double drift(const Quantities& now, double time) const;

  /// Energy of a given multiplier, -P V or (2 h sigma_DA / 2) int K_M dA; nothing where the
  /// quantity is held, or its multiplier 0.
  std::optional<double> potential(int quantity, const Quantities& now) const;

private:
  struct Course {
    Constraint constraint;
    Ramp ramp;
    double factor = 1; ///< the quantity for a reduced value of 1
    double start = 0;
    double at(double time) const;
    double end_time() const;
  };
  std::vector<double> turning_points() const;
  void list_held();
  void set_rates();

  std::array<Course, 4> courses_;
  std::array<bool, 4> held_{};
  std::vector<int> indices_;
  Multipliers given_ = Multipliers::Zero();
  double stiffness_; // the largest bending modulus
};

/// Solves m x = b with rows measured in a unit each, columns scaled to unit norm, and directions of
/// singular value below 1e-4 damped out: on a sphere volume and area say the same, and what they
/// differ by is noise. (1e-4 is about the relative variance of K_M at a reduced volume of 0.9999.)
Eigen::VectorXd solve_scaled(const Eigen::MatrixXd& m, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& unit);

} // namespace lamella
