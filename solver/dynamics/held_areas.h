#pragma once
#include "dynamics/components.h"
#include "geometry/phase_boundary.h"
#include "geometry/surface_geometry.h"
#include "levelset/domains.h"

#include <Eigen/Core>

#include <span>
#include <utility>
#include <vector>

namespace lamella {

/// Squared grid spacings: smaller domains hold nothing.
inline constexpr double least_holding_domain = 8;

/// The parts of the phases whose areas are held, and the tensions that hold them: all of Ld, or
/// that of each vesicle that keeps its own lipid; or, where lipid resists local stretch and so
/// cannot get from one domain into another, every domain of both phases but the largest of Lo of
/// each vesicle, which has what is left (at most 100; specks hold nothing).
class HeldAreas {
public:
  /// What a tension in each part alone does: it gives the membrane the normal velocity q K_M, q the
  /// share of the part, and its boundary one of 1 / drag inwards.
  struct Integrals {
    Eigen::MatrixXd with_surface; ///< rows: int q K_M (1, K_M, K) dA over each vesicle in turn
    Eigen::MatrixXd gram;         ///< of the parts among themselves, the boundary included
    Eigen::VectorXd variation;    ///< int q K_M F dA, and oint of the boundary's speed outwards
    Eigen::VectorXd area;
    Eigen::MatrixXd line_gram; ///< the boundary's share of the gram matrix, times the drag

    Integrals& operator+=(const Integrals& other);
  };

  HeldAreas(bool of_each_domain, bool of_each_vesicle, double spacing)
      : of_each_domain_(of_each_domain), of_each_vesicle_(of_each_vesicle), spacing_(spacing) {}

  /// Finds the parts on a membrane that moved. Domains that met or parted begin with the areas that
  /// they then have.
  void find(const NarrowBand& band, const DomainMap& domains, const PhaseBoundary& boundary,
            const Components& vesicles);
  /// Finds the parts of samples; `point`: of the boundary, next to each sample, -1 where there is
  /// none near.
  void sample(const Grid& grid, const SurfaceGeometry& surface, std::span<const int> point,
              const Components& vesicles);
  /// `share` of Ld and variation F at the samples (F empty: 0), `speed` along n at the boundary's
  /// points without tensions, `drag` of the boundary.
  Integrals integrate(const SurfaceGeometry& surface, std::span<const double> share,
                      std::span<const double> variation, const PhaseBoundary& boundary,
                      std::span<const double> speed, double drag, const Components& vesicles) const;

  /// Tensions of the parts, above that of the rest; `area` of the membrane.
  void set_tensions(const Eigen::VectorXd& tensions, const Integrals& integrals,
                    std::span<const double> share, double area);
  /// At the samples.
  std::span<const double> tension() const { return tension_; }
  /// That of Ld over that of Lo at the boundary's points.
  std::span<const double> jump() const { return jump_; }
  /// Means by area; of all parts the greatest, or 0.
  double mean_Ld() const { return mean_Ld_; }
  double mean_Lo() const { return mean_Lo_; }
  double greatest() const { return greatest_; }
  /// How far the boundary's points are to move along n for every domain to have its area again.
  std::span<const double> shift() const { return shift_; }

  std::size_t size() const { return parts_.size(); }

  struct Part {
    bool is_Ld = true;
    Vec3 center{};
    double target = 0; ///< area; 0: not known yet

    bool operator==(const Part&) const = default;
  };
  const std::vector<Part>& parts() const { return parts_; }
  /// Goes on from stored parts.
  void restore(std::vector<Part> parts) { parts_ = std::move(parts); }

private:
  /// Indices of the parts at a place; -1: none.
  struct Sides {
    int ld = -1, lo = -1;
  };
  void find_domains(const NarrowBand& band, const DomainMap& domains, const Components& vesicles);
  void take_over_targets(std::vector<Part>& found) const;
  Sides at(std::size_t node) const;
  double across(Sides sides, const Eigen::VectorXd& of_parts, double else_Ld) const;
  void find_shift(const Integrals& integrals);

  bool of_each_domain_, of_each_vesicle_;
  double spacing_;
  std::vector<Part> parts_;
  std::vector<signed char> part_of_node_;
  std::vector<Sides> of_point_, of_sample_;
  std::vector<double> tension_, jump_, shift_;
  double mean_Ld_ = 0, mean_Lo_ = 0, greatest_ = 0;
};

} // namespace lamella
