#pragma once
#include "grid/grid.h"

#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// A closed sheet of a membrane and all that lies within it.
struct Part {
  double volume = 0;      ///< that the sheet encloses
  bool is_hollow = false; ///< it lies within an odd number of others: outside is right within it
};

/// Moves each sheet of a level set by a distance of its own, until it encloses its volume.
/// `nearest` tells the part next to each node. Throws InputError, which ends with the remedy, where
/// the level set has fewer parts, or one does not come to its volume: it is too thin, or too near
/// another. Where it has more, since bridges are too thin, the remark says so.
void keep_volumes(const Grid& grid, const std::vector<Part>& parts, const std::vector<int>& nearest,
                  std::string_view remedy, std::vector<double>& phi, std::string& remark);

/// The least volume of a part that is left by a blur of so many spacings, in cubes of a spacing:
/// that of a ball whose radius is twice the blur, or two spacings.
double least_volume(double blur);

/// Radius of the ball of a volume.
double radius_of(double volume);

} // namespace lamella
