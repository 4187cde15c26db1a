#pragma once
#include "levelset/narrow_band.h"

#include <span>
#include <vector>

namespace lamella {

/// A connected part of one phase on the membrane.
struct Domain {
  bool is_Ld;
  Vec3 center{};   ///< mean of its nodes
  double area = 0; ///< about, from the number of its nodes
};

struct DomainMap {
  std::vector<Domain> domains;
  /// The domain of each band entry within a spacing of the membrane; elsewhere -1.
  std::vector<int> of_entry;
};

/// The domains on a membrane, by the signs of psi (nodal values) at the band's nodes within a
/// spacing of it: nodes that are neighbours along the axes and have the same sign belong together.
DomainMap domains_of(const NarrowBand& band, std::span<const double> psi);

} // namespace lamella
