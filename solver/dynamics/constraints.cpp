#include "dynamics/constraints.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lamella {

namespace {
using std::numbers::pi;

constexpr double rounding = 1e-12;         // of times, relative
constexpr double change_per_step = 2.5e-3; // of a reduced value that is led somewhere
constexpr double calm = 0.4;               // rate of a ramp, in kappa / R^4
const Eigen::Vector4d to_quantity{1, -1, -2, -1};

double approach(double from, double to, double longest) {
  return from + std::clamp(to - from, -longest, longest);
}
} // namespace

Quantities quantities(const SurfaceIntegrals& integrals) {
  return {integrals.volume, integrals.area(), integrals.int_KM(), integrals.area_Ld};
}

Constraints::Constraints(const Scene& scene)
    : courses_{{{scene.volume.constraint, scene.volume.ramp},
                {Constraint::fixed, {}},
                {scene.area_difference.constraint, scene.area_difference.ramp},
                {scene.has_phases() ? Constraint::fixed : Constraint::free, {}}}},
      given_{scene.volume.pressure, 0, scene.area_difference.multiplier, 0},
      stiffness_(scene.stiffest()) {
  const Course& last = courses_[2];
  held_ = {courses_[0].constraint != Constraint::free, true,
           last.constraint == Constraint::fixed ||
               (last.constraint == Constraint::ramped && last.ramp.start_times.front() <= 0),
           scene.has_phases()};
  list_held();
}

void Constraints::list_held() {
  indices_.clear();
  for (int i = 0; i < 4; i++)
    if (held_[i]) indices_.push_back(i);
}

Constraints::State Constraints::state() const {
  State s;
  for (int i = 0; i < 4; i++) {
    s.held[i] = held_[i];
    s.factor[i] = courses_[i].factor;
    s.start[i] = courses_[i].start;
  }
  return s;
}

void Constraints::restore(const State& s) {
  for (int i = 0; i < 4; i++) {
    held_[i] = s.held[i] != 0;
    courses_[i].factor = s.factor[i];
    courses_[i].start = s.start[i];
  }
  list_held();
  set_rates();
}

bool Constraints::set_out(double time, const Quantities& now) {
  Course& course = courses_[2];
  if (held_[2] || course.constraint != Constraint::ramped ||
      time < course.ramp.start_times.front() * (1 - rounding))
    return false;
  course.start = now[2] / course.factor;
  held_[2] = true;
  list_held();
  return true;
}

void Constraints::begin(const Quantities& start) {
  const double radius = std::sqrt(start[1] / (4 * pi));
  courses_[0].factor = 4. / 3 * pi * radius * radius * radius;
  courses_[2].factor = -8 * pi * radius;
  for (int i = 0; i < 4; i++) courses_[i].start = start[i] / courses_[i].factor;
  set_rates();
}

double Constraints::radius() const { return courses_[2].factor / (-8 * pi); }

/// Of ramps that the scene gives none.
void Constraints::set_rates() {
  for (Course& course : courses_)
    if (course.ramp.rate == 0) course.ramp.rate = calm * stiffness_ / std::pow(radius(), 4);
}

double Constraints::Course::at(double time) const {
  double value = start;
  if (constraint == Constraint::ramped)
    for (std::size_t i = 0; i < ramp.targets.size() && time > ramp.start_times[i]; i++) {
      const double end =
          i + 1 < ramp.targets.size() ? std::min(time, ramp.start_times[i + 1]) : time;
      value = approach(value, ramp.targets[i], ramp.rate * (end - ramp.start_times[i]));
    }
  return value;
}

double Constraints::Course::end_time() const {
  if (constraint != Constraint::ramped) return 0;
  const double set_out = ramp.start_times.back();
  return set_out + std::abs(ramp.targets.back() - at(set_out)) / ramp.rate;
}

Quantities Constraints::target(double time) const {
  Quantities q;
  for (int i = 0; i < 4; i++) q[i] = courses_[i].factor * courses_[i].at(time);
  return q;
}

Quantities Constraints::rate(double time) const {
  Quantities q = Quantities::Zero();
  for (int i = 0; i < 4; i++) {
    const Course& c = courses_[i];
    if (c.constraint != Constraint::ramped || !held_[i]) continue;
    const double soon = 1e-6 * change_per_step / c.ramp.rate;
    const double ahead = (c.at(time + soon) - c.at(time)) / soon;
    q[i] = c.factor * std::round(ahead / c.ramp.rate) * c.ramp.rate;
  }
  return q;
}

bool Constraints::is_led(double from, double to) const {
  return std::ranges::any_of(indices_,
                             [&](int i) { return courses_[i].at(from) != courses_[i].at(to); });
}

bool Constraints::ramping(double time) const {
  return std::ranges::any_of(courses_, [&](const Course& c) { return time < c.end_time(); });
}

/// Times at which a ramp begins or ends.
std::vector<double> Constraints::turning_points() const {
  std::vector<double> points;
  for (const Course& c : courses_) {
    if (c.constraint != Constraint::ramped) continue;
    for (std::size_t i = 0; i < c.ramp.targets.size(); i++) {
      const double begin = c.ramp.start_times[i];
      points.push_back(begin);
      points.push_back(begin + std::abs(c.ramp.targets[i] - c.at(begin)) / c.ramp.rate);
    }
  }
  return points;
}

bool Constraints::turns_at(double time) const {
  return std::ranges::any_of(
      turning_points(), [&](double t) { return std::abs(t - time) <= rounding * std::abs(time); });
}

double Constraints::longest_step(double time) const {
  double longest = std::numeric_limits<double>::infinity();
  for (const double t : turning_points())
    if (t > time * (1 + rounding)) longest = std::min(longest, t - time);
  const Quantities moving = rate(time);
  for (int i = 0; i < 4; i++)
    if (moving[i] != 0) longest = std::min(longest, change_per_step / courses_[i].ramp.rate);
  return longest;
}

Eigen::VectorXd solve_scaled(const Eigen::MatrixXd& m, const Eigen::VectorXd& b,
                             const Eigen::VectorXd& unit) {
  constexpr double damping = 1e-4;
  const Eigen::VectorXd row_scale = unit.cwiseInverse();
  Eigen::MatrixXd scaled = row_scale.asDiagonal() * m;
  const Eigen::VectorXd column_scale = scaled.colwise().norm().transpose().cwiseInverse();
  scaled = scaled * column_scale.asDiagonal();
  const Eigen::MatrixXd normal = scaled.transpose() * scaled +
                                 damping * damping * Eigen::MatrixXd::Identity(m.cols(), m.cols());
  return column_scale.cwiseProduct(normal.inverse() *
                                   (scaled.transpose() * row_scale.cwiseProduct(b)));
}

Eigen::Vector4d Constraints::combination(const Eigen::Matrix4d& effect, const Quantities& change,
                                         const SurfaceIntegrals& integrals) const {
  const Eigen::Vector4d unit = integrals.gram.diagonal().cwiseSqrt();
  const Eigen::VectorXd x =
      solve_scaled(effect(indices_, indices_), change(indices_), unit(indices_));
  Eigen::Vector4d all = Eigen::Vector4d::Zero();
  all(indices_) = x;
  return all;
}

Eigen::VectorXd Constraints::multipliers(const Eigen::MatrixXd& gram,
                                         const Eigen::VectorXd& variation,
                                         const Quantities& rate) const {
  Eigen::VectorXd m = Eigen::VectorXd::Zero(gram.rows()), b = variation;
  Eigen::VectorXi held(gram.rows());
  Eigen::Index count = 0;
  for (int i = 0; i < gram.rows(); i++) {
    if (i >= 3 || held_[i])
      held[count++] = i;
    else
      m[i] = given_[i];
    if (i < 3) b[i] += rate[i] / to_quantity[i];
  }
  held.conservativeResize(count);
  const Eigen::VectorXd left = b - gram * m;
  m(held) = solve_scaled(gram(held, held), left(held), gram.diagonal()(held).cwiseSqrt());
  return m;
}

bool Constraints::is_delicate(const SurfaceIntegrals& integrals) const {
  if (held_[2]) return true;
  constexpr double little = 0.03; // of independence: least eigenvalue of the correlations
  const Eigen::Vector4d scale = integrals.gram.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix4d correlation = scale.asDiagonal() * integrals.gram * scale.asDiagonal();
  const Eigen::MatrixXd held = correlation(indices_, indices_);
  const Eigen::MatrixXd shifted =
      held - little * Eigen::MatrixXd::Identity(held.rows(), held.cols());
  return shifted.llt().info() != Eigen::Success; // not positive definite
}

double Constraints::drift(const Quantities& now, double time) const {
  const Quantities wanted = target(time);
  double worst = 0;
  for (const int i : indices_) worst = std::max(worst, std::abs(now[i] / wanted[i] - 1));
  return worst;
}

std::optional<double> Constraints::potential(int quantity, const Quantities& now) const {
  if (held_[quantity] || given_[quantity] == 0) return {};
  const double of_unit = quantity == 0 ? -1 : 0.5;
  return of_unit * given_[quantity] * now[quantity];
}

} // namespace lamella
