#pragma once
#include "fields/sampler.h"
#include "store/frame.h"

namespace lamella::render {

/// How much of the surroundings of a point on the membrane is filled by the vesicle itself, which
/// keeps ambient light away: dimples, necks and narrow gaps are dark, free surfaces are not.
///
/// The inside is blurred over a length `radius`; the value that far above the membrane is compared
/// with what a flat membrane has there. Only the sign of phi counts: phi need not be a distance.
class Occlusion {
public:
  Occlusion(const Frame& frame, double radius);
  Occlusion(const Occlusion&) = delete; // sampler_ refers to inside_
  void operator=(const Occlusion&) = delete;

  /// From 0, no more than on a flat membrane, to 1.
  double at(const Vec3& p, const Vec3& normal) const;

private:
  double radius_;
  Frame inside_; ///< blurred
  Sampler sampler_;
};

} // namespace lamella::render
