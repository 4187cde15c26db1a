#pragma once
#include "scene/scene.h"

#include <cstdint>

namespace lamella {

/// Scene `number` of the series of a seed: a short run, drawn over all that validation accepts:
/// both kinds of phases, every analytic shape, perturbed or not, anywhere in boxes of all
/// proportions, turned, with ramps, pressures, films, stretch and moduli that differ by up to a
/// hundred, in units that differ by six decades. The same for the same numbers on every machine.
Scene random_scene(std::uint64_t seed, int number);

} // namespace lamella
