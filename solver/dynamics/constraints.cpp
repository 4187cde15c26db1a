#include "dynamics/constraints.h"

#include "dynamics/held_areas.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace lamella {

namespace {
using std::numbers::pi;

constexpr double rounding = 1e-12;         // of times, relative
constexpr double change_per_step = 2.5e-3; // of a reduced value that is led somewhere
constexpr double calm = 0.4;               // rate of a ramp, in kappa / R^4
const Eigen::Vector4d to_quantity{1, -1, -2, -1};
using Groups = std::vector<std::vector<int>>;

/// 0 of nothing.
double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

Eigen::RowVectorXd parts_of(double sum, const Eigen::RowVectorXd& each) {
  return sum == 0 || each.size() == 1 ? Eigen::RowVectorXd::Ones(each.size())
                                      : Eigen::RowVectorXd(each / sum);
}

/// Of the rows and columns of a matrix the sums over groups of them.
Eigen::MatrixXd grouped(const Eigen::MatrixXd& m, const Groups& groups) {
  const Eigen::Index n = Eigen::Index(groups.size());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; i++)
    for (Eigen::Index j = 0; j < n; j++)
      for (const int row : groups[std::size_t(i)])
        for (const int column : groups[std::size_t(j)]) sums(i, j) += m(row, column);
  return sums;
}

Eigen::VectorXd grouped(const Eigen::VectorXd& v, const Groups& groups) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(Eigen::Index(groups.size()));
  for (std::size_t i = 0; i < groups.size(); i++)
    for (const int row : groups[i]) sums[Eigen::Index(i)] += v[row];
  return sums;
}

double approach(double from, double to, double longest) {
  return from + std::clamp(to - from, -longest, longest);
}
} // namespace

Quantities quantities(std::span<const SurfaceIntegrals> vesicles) {
  Quantities q(4, vesicles.size());
  for (std::size_t k = 0; k < vesicles.size(); k++) {
    const SurfaceIntegrals& of = vesicles[k];
    q.col(Eigen::Index(k)) << of.volume, of.area(), of.int_KM(), of.area_Ld;
  }
  return q;
}

Quantities changes_from(const Eigen::Matrix4Xd& moments) {
  Quantities q(4, moments.cols());
  for (Eigen::Index k = 0; k < q.cols(); k++) q.col(k) = change_from(moments.col(k));
  return q;
}

Constraints::Constraints(const Scene& scene)
    : courses_{{{scene.volume.constraint, scene.volume.ramp},
                {Constraint::fixed, {}},
                {scene.area_difference.constraint, scene.area_difference.ramp},
                {scene.has_phases() ? Constraint::fixed : Constraint::free, {}}}},
      least_domain_(least_holding_domain * scene.grid().spacing * scene.grid().spacing),
      given_{scene.volume.pressure, 0, scene.area_difference.multiplier, 0},
      stiffness_(scene.stiffest()) {
  const bool own_lipid = scene.area.of == Of::each;
  of_each_ = {scene.volume.of == Of::each, own_lipid, own_lipid, own_lipid};
  const Course& last = courses_[2];
  held_ = {courses_[0].constraint != Constraint::free, true,
           last.constraint == Constraint::fixed ||
               (last.constraint == Constraint::ramped && last.ramp.start_times.front() <= 0),
           scene.has_phases()};
  list_held();
}

void Constraints::list_held() {
  indices_.clear();
  list_.clear();
  std::vector<int> all(vesicles());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<std::vector<int>> of_groups = groups();
  for (int i = 0; i < 4; i++) {
    if (!held_[i]) continue;
    indices_.push_back(i);
    if (!of_each_[i] || all.size() == 1) {
      list_.push_back({i, all});
    } else {
      for (const std::vector<int>& group : of_groups)
        if (i < 3 || has_both_phases(group)) list_.push_back({i, group});
    }
  }
}

std::vector<std::vector<int>> Constraints::groups() const {
  std::map<int, std::vector<int>> members;
  for (int k = 0; k < vesicles(); k++) members[group_[std::size_t(k)]].push_back(k);
  std::vector<std::vector<int>> all;
  for (const auto& [group, of] : members) all.push_back(of);
  return all;
}

/// What is of one phase has its area held already.
bool Constraints::has_both_phases(const std::vector<int>& vesicles) const {
  const Eigen::Vector4d of = target(0)(Eigen::all, vesicles).rowwise().sum();
  const double Ld = of[3], Lo = of[1] - Ld;
  return std::min(Ld, Lo) > least_domain_;
}

Constraints::State Constraints::state() const {
  State s;
  for (int i = 0; i < 4; i++) {
    s.held[i] = held_[i];
    s.factor[i] = courses_[i].factor;
    s.start[i] = courses_[i].start;
  }
  s.share.assign(share_.data(), share_.data() + share_.size());
  s.group = group_;
  return s;
}

void Constraints::restore(const State& s) {
  for (int i = 0; i < 4; i++) {
    held_[i] = s.held[i] != 0;
    courses_[i].factor = s.factor[i];
    courses_[i].start = s.start[i];
  }
  share_ = Eigen::Map<const Eigen::Matrix4Xd>(s.share.data(), 4, Eigen::Index(s.share.size() / 4));
  group_ = s.group;
  list_held();
  set_rates();
}

bool Constraints::set_out(double time, const Quantities& now) {
  Course& course = courses_[2];
  if (held_[2] || course.constraint != Constraint::ramped ||
      time < course.ramp.start_times.front() * (1 - rounding))
    return false;
  const double sum = now.row(2).sum();
  course.start = sum / course.factor;
  share_.row(2) = parts_of(sum, now.row(2));
  held_[2] = true;
  list_held();
  return true;
}

void Constraints::begin(const Quantities& each) {
  const Eigen::Vector4d start = each.rowwise().sum();
  const double radius = std::sqrt(start[1] / (4 * pi));
  courses_[0].factor = 4. / 3 * pi * radius * radius * radius;
  courses_[2].factor = -8 * pi * radius;
  share_.resize(4, each.cols());
  group_.resize(std::size_t(each.cols()));
  std::iota(group_.begin(), group_.end(), 0);
  for (int i = 0; i < 4; i++) {
    courses_[i].start = start[i] / courses_[i].factor;
    share_.row(i) = parts_of(start[i], each.row(i));
  }
  list_held();
  set_rates();
}

/// What a group holds is divided among its vesicles evenly at first: only the sum counts. (Groups
/// grow where one of several vesicles that hold something together parts too.)
void Constraints::hand_on(const Succession& s) {
  std::map<int, int> joint; // of the groups of the succession
  for (std::size_t j = 0; j < s.before.size(); j++)
    for (std::size_t i = 0; i <= j; i++)
      if (group_[i] == group_[j]) {
        const int from = s.before[j], to = s.before[i];
        joint.try_emplace(to, to);
        const int root = joint[to], old = joint.try_emplace(from, from).first->second;
        for (auto& [group, of] : joint)
          if (of == old) of = root;
      }
  const Eigen::Matrix4Xd before = share_;
  group_.clear();
  for (const int group : s.after) group_.push_back(joint[group]);
  share_.setZero(4, Eigen::Index(group_.size()));
  for (std::size_t k = 0; k < group_.size(); k++) {
    const double count = double(std::ranges::count(group_, group_[k]));
    for (std::size_t j = 0; j < s.before.size(); j++)
      if (joint[s.before[j]] == group_[k])
        share_.col(Eigen::Index(k)) += before.col(Eigen::Index(j)) / count;
  }
  list_held();
}

bool Constraints::keep_apart(const Quantities& now) {
  const std::vector<std::vector<int>> before = groups();
  if (int(before.size()) == vesicles()) return false;
  const Eigen::Vector4d all = of_all(0);
  for (const std::vector<int>& group : before) {
    if (group.size() == 1) continue;
    const Eigen::Vector4d held = share_(Eigen::all, group).rowwise().sum(),
                          have = now(Eigen::all, group).rowwise().sum();
    const double held_Ld = held[3] * all[3], held_Lo = held[1] * all[1] - held_Ld;
    for (const int k : group) {
      const Eigen::Vector4d here = now.col(k);
      for (const int i : {0, 2, 3}) share_(i, k) = held[i] * ratio(here[i], have[i]);
      share_(1, k) = (held_Ld * ratio(here[3], have[3]) +
                      held_Lo * ratio(here[1] - here[3], have[1] - have[3])) /
                     all[1];
    }
  }
  std::iota(group_.begin(), group_.end(), 0);
  list_held();
  return true;
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

Eigen::Vector4d Constraints::of_all(double time) const {
  Eigen::Vector4d q;
  for (int i = 0; i < 4; i++) q[i] = courses_[i].factor * courses_[i].at(time);
  return q;
}

Quantities Constraints::target(double time) const { return of_all(time).asDiagonal() * share_; }

Quantities Constraints::rate(double time) const {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();
  for (int i = 0; i < 4; i++) {
    const Course& c = courses_[i];
    if (c.constraint != Constraint::ramped || !held_[i]) continue;
    const double soon = 1e-6 * change_per_step / c.ramp.rate;
    const double ahead = (c.at(time + soon) - c.at(time)) / soon;
    q[i] = c.factor * std::round(ahead / c.ramp.rate) * c.ramp.rate;
  }
  return q.asDiagonal() * share_;
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
    if (!moving.row(i).isZero(0))
      longest = std::min(longest, change_per_step / courses_[i].ramp.rate);
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

Eigen::Matrix4Xd Constraints::combination(const Eigen::MatrixXd& effect, const Quantities& change,
                                          std::span<const SurfaceIntegrals> vesicles) const {
  Groups groups;
  Eigen::VectorXd unit(list_.size());
  for (const auto& [quantity, of] : list_) {
    double square = 0;
    std::vector<int>& group = groups.emplace_back();
    for (const int k : of) {
      group.push_back(4 * k + quantity);
      square += vesicles[k].gram(quantity, quantity);
    }
    unit[Eigen::Index(groups.size()) - 1] = std::sqrt(square);
  }
  const Eigen::VectorXd x = solve_scaled(grouped(effect, groups),
                                         grouped(Eigen::VectorXd(change.reshaped()), groups), unit);
  Eigen::Matrix4Xd all = Eigen::Matrix4Xd::Zero(4, change.cols());
  for (std::size_t g = 0; g < groups.size(); g++)
    for (const int row : groups[g]) all.data()[row] = x[Eigen::Index(g)];
  return all;
}

Eigen::VectorXd Constraints::multipliers(const Eigen::MatrixXd& gram,
                                         const Eigen::VectorXd& variation,
                                         const Quantities& rate) const {
  const int of_surface = 3 * vesicles();
  Eigen::VectorXd m = Eigen::VectorXd::Zero(gram.rows()), b = variation;
  for (int k = 0; k < vesicles(); k++)
    for (int i = 0; i < 3; i++) {
      if (!held_[i]) m[3 * k + i] = given_[i];
      b[3 * k + i] += rate(i, k) / to_quantity[i];
    }
  Groups groups;
  for (const auto& [quantity, of] : list_) {
    if (quantity == 3) continue;
    std::vector<int>& group = groups.emplace_back();
    for (const int k : of) group.push_back(3 * k + quantity);
  }
  for (int i = of_surface; i < gram.rows(); i++)
    if (gram(i, i) > 0) groups.push_back({i}); // else there is nothing of that part
  const Eigen::VectorXd left = b - gram * m;
  const Eigen::MatrixXd held = grouped(gram, groups);
  const Eigen::VectorXd x = solve_scaled(held, grouped(left, groups), held.diagonal().cwiseSqrt());
  for (std::size_t g = 0; g < groups.size(); g++)
    for (const int row : groups[g]) m[row] = x[Eigen::Index(g)];
  return m;
}

bool Constraints::is_delicate(std::span<const SurfaceIntegrals> vesicles) const {
  if (held_[2]) return true;
  constexpr double little = 0.03; // of independence: least eigenvalue of the correlations
  for (const std::vector<int>& group : groups()) {
    Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();
    for (const int k : group) gram += vesicles[std::size_t(k)].gram;
    std::vector<int> quantities;
    for (const Held& held : list_)
      if (std::ranges::count(held.vesicles, group.front()) > 0) quantities.push_back(held.quantity);
    const Eigen::Vector4d scale = gram.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix4d correlation = scale.asDiagonal() * gram * scale.asDiagonal();
    const Eigen::MatrixXd held = correlation(quantities, quantities);
    const Eigen::MatrixXd shifted =
        held - little * Eigen::MatrixXd::Identity(held.rows(), held.cols());
    if (shifted.llt().info() != Eigen::Success) return true; // not positive definite
  }
  return false;
}

double Constraints::drift(const Quantities& now, double time) const {
  double worst = 0;
  for (const int i : indices_) worst = std::max(worst, std::abs(drift_of(i, now, time)));
  return worst;
}

double Constraints::drift_of(int quantity, const Quantities& now, double time) const {
  const Quantities wanted = target(time);
  double worst = 0;
  for (const auto& [i, of] : list_) {
    if (i != quantity) continue;
    double have = 0, want = 0;
    for (const int k : of) {
      have += now(i, k);
      want += wanted(i, k);
    }
    const double off = have / want - 1;
    if (std::abs(off) > std::abs(worst)) worst = off;
  }
  return worst;
}

std::optional<double> Constraints::potential(int quantity, const Quantities& now) const {
  if (held_[quantity] || given_[quantity] == 0) return {};
  const double of_unit = quantity == 0 ? -1 : 0.5;
  return of_unit * given_[quantity] * now.row(quantity).sum();
}

} // namespace lamella
