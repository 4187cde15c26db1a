#pragma once
#include "scene/keys.h"
#include "scene/scene.h"
#include "store/checkpoint.h"

#include <span>
#include <string>
#include <vector>

namespace lamella {

/// The keys in which two scenes differ.
std::vector<const Key*> differences(const Scene& a, const Scene& b);

/// "[run] end_time: 0.001 -> 0.002", one for each, for people.
std::string difference_text(std::span<const Key* const> keys, const Scene& from, const Scene& to);

/// Throws UsageError for a change that a state of `from` cannot take part in: of its grid, its
/// start, its phases or what is held.
void refuse_unbranchable(std::span<const Key* const> changed, const Scene& from, const Scene& to);

/// The state as another scene takes it over: where the physics or the numerics change, without what
/// it remembers of earlier steps.
SimulationState branched(SimulationState state, std::span<const Key* const> changed);

} // namespace lamella
