#pragma once
#include "dynamics/components.h"
#include "dynamics/surface_integrals.h"
#include "grid/memory.h"
#include "scene/scene.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace lamella {

/// Volume, area, int K_M dA, and the area of the Ld phase, or a change of them: a column for each
/// vesicle.
using Quantities = Eigen::Matrix4Xd;
Quantities quantities(std::span<const SurfaceIntegrals> vesicles);

/// Coefficients of 1, K_M, K, q K_M in the normal velocity: P, sigma, 2 h sigma_DA (Eq. 80), and
/// what the tension of Ld is in the mean above that of Lo; q is the share of Ld. A column for each
/// vesicle.
using Multipliers = Eigen::Matrix4Xd;

/// First-order change of the quantities by a normal displacement u, from int u dA, int K_M u dA,
/// int K u dA, int q K_M u dA.
inline Eigen::Vector4d change_from(const Eigen::Vector4d& moments) {
  return {moments[0], -moments[1], -2 * moments[2], -moments[3]};
}
Quantities changes_from(const Eigen::Matrix4Xd& moments);

/// Which quantities are held, where they are led to, and the multipliers of those that are free.
///
/// Every column has a number for each of the four; those of free quantities do not count. Each
/// vesicle's target is a share of that of all together: ramps lead all at the same relative rate.
class Constraints {
public:
  explicit Constraints(const Scene& scene);

  /// What does not follow from the scene: where the targets set out from, and what is held.
  struct State {
    std::array<int, 4> held{};      ///< 0 or 1
    std::array<double, 4> factor{}; ///< the quantity for a reduced value of 1
    std::array<double, 4> start{};  ///< reduced value
    Array<double> share{};          ///< of each vesicle, four numbers each
    std::vector<int> group{};       ///< of each vesicle; those of one hold what they do together
  };
  State state() const;
  void restore(const State& state);

  /// What the start has; targets set out from there.
  void begin(const Quantities& start);
  /// Vesicles parted, met or vanished: those of a group hold together what those before them held,
  /// until keep_apart() says what each has of it, of each phase. What vanishes takes along what it
  /// holds.
  void hand_on(const Succession& succession);
  /// False where each vesicle does already.
  bool keep_apart(const Quantities& now);
  int vesicles() const { return int(share_.cols()); }
  /// Of the sphere of the area that the start has: the length by which defaults scale.
  double radius() const;

  /// A ramped area difference is free until it sets out. True when it does so now, from what it has
  /// become.
  bool set_out(double time, const Quantities& now);

  bool is_held(int quantity) const { return held_[quantity]; }
  std::span<const int> held() const { return indices_; }
  /// Whether each vesicle keeps its own.
  bool is_of_each(int quantity) const { return of_each_[quantity]; }

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
  /// rates: g = 1, K_M, K on each vesicle in turn, and one function for each area in Ld and Lo that
  /// is held, its rate 0. `gram`: int g_i g_j dA, `variation`: int g_i F dA.
  Eigen::VectorXd multipliers(const Eigen::MatrixXd& gram, const Eigen::VectorXd& variation,
                              const Quantities& rate) const;

  /// Factors of the held quantities' directions that bring about a change, a column for each
  /// vesicle; `effect` has for each vesicle's four directions in turn a column of changes of each
  /// vesicle's four quantities. The vesicles' integrals tell what is much of a change.
  Eigen::Matrix4Xd combination(const Eigen::MatrixXd& effect, const Quantities& change,
                               std::span<const SurfaceIntegrals> vesicles) const;

  /// Corrections must be made with care: the area difference is held, or 1 and K_M are almost
  /// dependent on one of these vesicles, a long tube, so that a small correction takes a long way.
  bool is_delicate(std::span<const SurfaceIntegrals> vesicles) const;

  /// Largest relative deviation of a held quantity from its target.
  double drift(const Quantities& now, double time) const;
  /// That of one quantity, with its sign; 0 where it is not held.
  double drift_of(int quantity, const Quantities& now, double time) const;

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
  /// Numbers that are held together: a vesicle's, or the sum over the vesicles.
  struct Held {
    int quantity;
    std::vector<int> vesicles;
  };
  std::vector<double> turning_points() const;
  Eigen::Vector4d of_all(double time) const;
  std::vector<std::vector<int>> groups() const;
  bool has_both_phases(const std::vector<int>& vesicles) const;
  void list_held();
  void set_rates();

  std::array<Course, 4> courses_;
  std::array<bool, 4> held_{}, of_each_{};
  std::vector<int> indices_;
  std::vector<Held> list_;
  Eigen::Matrix4Xd share_ = Eigen::Matrix4Xd::Ones(4, 1);
  std::vector<int> group_{0}; // of each vesicle, see State
  double least_domain_;       // smaller ones hold nothing
  Eigen::Vector4d given_ = Eigen::Vector4d::Zero();
  double stiffness_; // the largest bending modulus
};

/// Solves m x = b with rows measured in a unit each, columns scaled to unit norm, and directions of
/// singular value below 1e-4 damped out: on a sphere volume and area say the same, and what they
/// differ by is noise. (1e-4 is about the relative variance of K_M at a reduced volume of 0.9999.)
Eigen::VectorXd solve_scaled(const Eigen::MatrixXd& m, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& unit);

} // namespace lamella
