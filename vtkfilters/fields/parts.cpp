#include "fields/parts.h"

#include "fields/image.h"
#include "fields/measure.h"
#include "fields/smooth.h"
#include "levelset/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace lamella {
namespace {

constexpr double ball = 4. / 3 * std::numbers::pi; // volume of that of radius 1

/// Adds to phi what moves each sheet outward by its distance, smoothly from one to the next.
void move(const Grid& grid, const std::vector<double>& distances, const std::vector<int>& nearest,
          std::vector<double>& phi) {
  constexpr double width = 2; // spacings, of the change between two sheets
  std::vector<double> shift(phi.size());
  for (std::size_t n = 0; n < phi.size(); ++n) shift[n] = distances[nearest[n]];
  if (distances.size() > 1) blur(grid, width, shift);
  for (std::size_t n = 0; n < phi.size(); ++n) phi[n] -= shift[n];
}

[[noreturn]] void refuse(std::string_view what, std::string_view remedy) {
  throw InputError(fmt::format("{}; {}", what, remedy));
}

/// Connected parts of the inside and of the outside.
struct Count {
  int insides, outsides;
};
Count count_in(const Grid& grid, const std::vector<double>& phi) {
  std::vector<double> outside(phi.size());
  std::ranges::transform(phi, outside.begin(), std::negate<>());
  return {count_components(grid, phi), count_components(grid, outside)};
}

Count count_of(const std::vector<Part>& parts) {
  const int hollow = int(std::ranges::count_if(parts, &Part::is_hollow));
  return {int(parts.size()) - hollow, 1 + hollow};
}

/// Throws where parts have become one, or are gone.
void check_count(const Count& count, const Count& expected, std::string_view remedy) {
  if (count.insides < expected.insides)
    refuse(fmt::format("parts of the inside are too thin for the grid, or too near each other: of "
                       "{} there would be {}",
                       expected.insides, count.insides),
           remedy);
  if (count.outsides < expected.outsides)
    refuse(fmt::format("walls are too thin for the grid: of {} cavit{} there would be {}",
                       expected.outsides - 1, expected.outsides == 2 ? "y" : "ies",
                       std::max(0, count.outsides - 1)),
           remedy);
}

} // namespace

double least_volume(double blur) { return ball * std::pow(2 * std::max(blur, 1.0), 3); }

double radius_of(double volume) { return std::cbrt(volume / ball); }

void keep_volumes(const Grid& grid, const std::vector<Part>& parts, const std::vector<int>& nearest,
                  std::string_view remedy, std::vector<double>& phi, std::string& remark) {
  constexpr int most_rounds = 20;               // each leaves a small part: the slope is about 1
  constexpr double kept = 1e-7, allowed = 1e-3; // of a volume
  const Count expected = count_of(parts);
  check_count(count_in(grid, phi), expected, remedy);
  for (int round = 0;; ++round) {
    const std::vector<Size> sizes =
        sizes_of({.grid = grid, .phi = phi}, nearest, int(parts.size()));
    std::vector<double> distances;
    double worst = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const double sign = parts[p].is_hollow ? -1 : 1,
                   missing = sign * parts[p].volume - sizes[p].volume; // of the inside
      worst = std::max(worst, std::abs(missing) / parts[p].volume);
      distances.push_back(
          std::clamp(missing / (sizes[p].area + 1e-300), -grid.spacing, grid.spacing));
    }
    if (worst < kept || round == most_rounds) {
      if (worst > allowed)
        refuse("a part of the inside is too thin for the grid, or too near another: its volume "
               "cannot be kept",
               remedy);
      break;
    }
    move(grid, distances, nearest, phi);
  }
  const Count count = count_in(grid, phi);
  check_count(count, expected, remedy);
  if (count.insides > expected.insides)
    add_remark(remark,
               fmt::format("bridges are too thin for the grid and go: of {} part{} there "
                           "are {}",
                           expected.insides, expected.insides == 1 ? "" : "s", count.insides));
}

} // namespace lamella
