#include "dynamics/held_areas.h"

#include "parallel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <utility>

namespace lamella {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double beside = 1.2;         // spacings from the boundary: there a part is surely met
constexpr double longest_shift = 0.02; // spacings a step
constexpr std::size_t most_parts = 100;

double squared_distance(const Vec3& a, const Vec3& b) {
  double sum = 0;
  for (int d = 0; d < 3; d++) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

} // namespace

HeldAreas::Integrals& HeldAreas::Integrals::operator+=(const Integrals& other) {
  if (area.size() == 0) return *this = other;
  with_surface += other.with_surface;
  gram += other.gram;
  variation += other.variation;
  area += other.area;
  return *this;
}

void HeldAreas::find(const NarrowBand& band, const DomainMap& map, const PhaseBoundary& boundary,
                     const Components& vesicles) {
  if (!of_each_domain_) {
    parts_.resize(of_each_vesicle_ ? std::size_t(vesicles.count()) : 1);
    of_point_.clear();
    for (const BoundaryPoint& p : boundary.points())
      of_point_.push_back(
          {of_each_vesicle_ ? vesicles.at({p.x[0], p.x[1], p.x[2]}, {p.N[0], p.N[1], p.N[2]}) : 0,
           -1});
    return;
  }
  find_domains(band, map, vesicles);
  of_point_.clear();
  for (const BoundaryPoint& p : boundary.points()) {
    const Vector3d way = beside * band.grid().spacing * p.n, in = p.x - way, out = p.x + way;
    of_point_.push_back({at(band.grid().nearest({in[0], in[1], in[2]})).ld,
                         at(band.grid().nearest({out[0], out[1], out[2]})).lo});
  }
}

/// All domains but specks and the largest of Lo of each vesicle.
void HeldAreas::find_domains(const NarrowBand& band, const DomainMap& map,
                             const Components& vesicles) {
  const double least = least_holding_domain * band.grid().spacing * band.grid().spacing;
  std::vector<int> vesicle(map.domains.size(), 0), rest(std::size_t(vesicles.count()), -1);
  for (std::size_t s = 0; of_each_vesicle_ && s < band.size(); s++)
    if (map.of_entry[s] >= 0) vesicle[map.of_entry[s]] = vesicles.of_entry(s);
  for (std::size_t d = 0; d < map.domains.size(); d++) {
    int& most = rest[vesicle[d]];
    if (!map.domains[d].is_Ld && (most < 0 || map.domains[d].area > map.domains[most].area))
      most = int(d);
  }
  std::vector<Part> found;
  std::vector<signed char> part(map.domains.size(), -1);
  for (std::size_t d = 0; d < map.domains.size(); d++) {
    const Domain& domain = map.domains[d];
    if (domain.area < least || int(d) == rest[vesicle[d]] || found.size() == most_parts) continue;
    part[d] = static_cast<signed char>(found.size());
    found.push_back({domain.is_Ld, domain.center, 0});
  }
  take_over_targets(found);
  parts_ = std::move(found);
  part_of_node_.assign(band.grid().size(), -1);
  for (std::size_t s = 0; s < band.size(); s++)
    if (map.of_entry[s] >= 0) part_of_node_[band.node()[s]] = part[map.of_entry[s]];
}

/// Parts keep their targets if each of them is the nearest of its phase to one that was there.
void HeldAreas::take_over_targets(std::vector<Part>& found) const {
  if (found.size() != parts_.size()) return;
  std::vector<char> taken(parts_.size(), 0);
  std::vector<double> targets;
  for (const Part& part : found) {
    std::size_t nearest = parts_.size();
    for (std::size_t k = 0; k < parts_.size(); k++)
      if (parts_[k].is_Ld == part.is_Ld &&
          (nearest == parts_.size() || squared_distance(parts_[k].center, part.center) <
                                           squared_distance(parts_[nearest].center, part.center)))
        nearest = k;
    if (nearest == parts_.size() || taken[nearest]) return;
    taken[nearest] = 1;
    targets.push_back(parts_[nearest].target);
  }
  for (std::size_t k = 0; k < found.size(); k++) found[k].target = targets[k];
}

HeldAreas::Sides HeldAreas::at(std::size_t node) const {
  const int part = part_of_node_[node];
  if (part < 0) return {};
  return parts_[part].is_Ld ? Sides{part, -1} : Sides{-1, part};
}

void HeldAreas::sample(const Grid& grid, const SurfaceGeometry& surface, std::span<const int> point,
                       const Components& vesicles) {
  of_sample_.resize(surface.size());
  for (std::size_t i = 0; i < surface.size(); i++)
    of_sample_[i] = point[i] >= 0      ? of_point_[point[i]]
                    : of_each_domain_  ? at(grid.nearest(surface.point(i)))
                    : of_each_vesicle_ ? Sides{vesicles.of_sample(i), -1}
                                       : Sides{0, -1};
}

HeldAreas::Integrals
HeldAreas::integrate(const SurfaceGeometry& surface, std::span<const double> share,
                     std::span<const double> variation, const PhaseBoundary& boundary,
                     std::span<const double> speed, double drag, const Components& vesicles) const {
  const Eigen::Index n = Eigen::Index(size());
  auto none = [n, &vesicles] {
    return Integrals{MatrixXd::Zero(n, 3 * vesicles.count()), MatrixXd::Zero(n, n),
                     VectorXd::Zero(n), VectorXd::Zero(n), MatrixXd::Zero(n, n)};
  };
  Integrals sum =
      parallel_sum<Integrals>(surface.size(), 8192, [&](std::size_t begin, std::size_t end) {
        Integrals some = none();
        for (std::size_t i = begin; i < end; i++) {
          const auto [ld, lo] = of_sample_[i];
          const double w = surface.weight()[i], KM = surface.KM()[i], K = surface.K()[i],
                       of_ld = ld >= 0 ? share[i] : 0, of_lo = lo >= 0 ? 1 - share[i] : 0;
          if (w == 0) continue;
          const double F = variation.empty() ? 0 : variation[i];
          for (const auto& [part, q] : {std::pair{ld, of_ld}, {lo, of_lo}}) {
            if (q == 0) continue;
            some.area[part] += w * q;
            some.with_surface.block<1, 3>(part, 3 * vesicles.of_sample(i)) +=
                w * q * KM * Eigen::RowVector3d(1, KM, K);
            some.gram(part, part) += w * q * q * KM * KM;
            some.variation[part] += w * q * KM * F;
          }
          if (of_ld == 0 || of_lo == 0) continue;
          some.gram(ld, lo) += w * of_ld * of_lo * KM * KM;
          some.gram(lo, ld) = some.gram(ld, lo);
        }
        return some;
      });
  if (sum.area.size() == 0) sum = none();
  for (std::size_t j = 0; j < of_point_.size(); j++) {
    const auto [ld, lo] = of_point_[j];
    const double w = boundary.points()[j].weight;
    for (const auto& [part, outwards] : {std::pair{ld, 1}, {lo, -1}})
      if (part >= 0) {
        sum.variation[part] += outwards * w * speed[j];
        sum.line_gram(part, part) += w;
      }
    if (ld >= 0 && lo >= 0) sum.line_gram(ld, lo) = sum.line_gram(lo, ld) -= w;
  }
  sum.gram += sum.line_gram / drag;
  return sum;
}

/// What the Ld part at a place has over its Lo part; `else_Ld` where there is no Ld part.
double HeldAreas::across(Sides sides, const VectorXd& of_parts, double else_Ld) const {
  return (sides.ld >= 0 ? of_parts[sides.ld] : else_Ld) - (sides.lo >= 0 ? of_parts[sides.lo] : 0);
}

void HeldAreas::set_tensions(const VectorXd& tensions, const Integrals& integrals,
                             std::span<const double> share, double area) {
  VectorXd Ld = integrals.area, Lo = integrals.area;
  for (std::size_t k = 0; k < size(); k++) (parts_[k].is_Ld ? Lo : Ld)[Eigen::Index(k)] = 0;
  const double area_Ld = Ld.sum(), area_Lo = area - area_Ld;
  mean_Ld_ = area_Ld > 0 ? tensions.dot(Ld) / area_Ld : 0;
  mean_Lo_ = area_Lo > 0 ? tensions.dot(Lo) / area_Lo : 0;
  greatest_ = size() > 0 ? std::max(0.0, tensions.maxCoeff()) : 0;
  tension_.resize(of_sample_.size());
  for (std::size_t i = 0; i < tension_.size(); i++) {
    const auto [ld, lo] = of_sample_[i];
    tension_[i] = share[i] * (ld >= 0 ? tensions[ld] : mean_Ld_) +
                  (lo >= 0 ? (1 - share[i]) * tensions[lo] : 0);
  }
  jump_.clear();
  for (const Sides& sides : of_point_) jump_.push_back(across(sides, tensions, mean_Ld_));
  find_shift(integrals);
}

/// To first order; Ld as a whole is held by other means.
void HeldAreas::find_shift(const Integrals& integrals) {
  shift_.assign(of_point_.size(), 0);
  if (!of_each_domain_ || size() == 0) return;
  VectorXd excess(integrals.area.size());
  for (std::size_t k = 0; k < size(); k++) {
    double& target = parts_[k].target;
    if (target == 0) target = integrals.area[Eigen::Index(k)];
    excess[Eigen::Index(k)] = target - integrals.area[Eigen::Index(k)];
  }
  constexpr double rounding = 1e-9; // a part may have no boundary
  const MatrixXd gram = integrals.line_gram + rounding * integrals.line_gram.trace() *
                                                  MatrixXd::Identity(excess.size(), excess.size());
  const VectorXd moves = gram.ldlt().solve(excess);
  const double longest = longest_shift * spacing_;
  for (std::size_t j = 0; j < shift_.size(); j++)
    shift_[j] = std::clamp(across(of_point_[j], moves, 0), -longest, longest);
}

} // namespace lamella
