#include "extremes/known_answer.h"

#include "extremes/equilibrium_tables.h"
#include "scene/builtin.h"
#include "scene/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace lamella {

namespace {

double sphere_radius(double area) { return std::sqrt(area / (4 * std::numbers::pi)); }

/// Of bending modulus 1: int K_M^2 dA is twice the energy.
ReferenceState with_energy(double energy) { return {.energy = energy, .int_KM2 = 2 * energy}; }

/// The row of a reduced volume, to a thousandth, scaled to the size of the vesicle.
ReferenceState equilibrium(std::string_view table, const Measures& end) {
  std::istringstream lines{std::string(table)};
  std::string line;
  std::getline(lines, line);
  const double Rs = sphere_radius(end.area);
  while (std::getline(lines, line)) {
    double v = 0, E = 0, int_KM2 = 0, P = 0, sigma = 0;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &v, &E, &int_KM2, &P, &sigma) == 5 &&
        std::abs(v - end.reduced_volume) < 1e-3)
      return {.energy = int_KM2 / 2,
              .int_KM2 = int_KM2,
              .P = P / std::pow(Rs, 3),
              .sigma = sigma / std::pow(Rs, 2)};
  }
  throw std::logic_error(fmt::format("no equilibrium of v = {:g} is known", end.reduced_volume));
}

/// The table is that of fig3_oblate: time is scaled by the fourth power of the size.
ReferenceState relaxation(const Measures& end) {
  const Scene scene = builtin_scene("fig3_oblate");
  const double size = std::sqrt(end.area / exact_area(scene.shape));
  const ReferenceState exact = builtin_reference(scene)->at(end.time / std::pow(size, 4));
  return {.energy = exact.int_KM2 / 2,
          .int_KM2 = exact.int_KM2,
          .P = exact.P / std::pow(size, 3),
          .sigma = exact.sigma / std::pow(size, 2)};
}

} // namespace

ReferenceState known_answer(const ExtremeCase& which, const Measures& end) {
  constexpr double sphere_energy = 8 * std::numbers::pi;
  switch (which.known) {
  case Known::oblate:
    return equilibrium(oblate_equilibria, end);
  case Known::prolate:
    return equilibrium(prolate_equilibria, end);
  case Known::relaxation:
    return relaxation(end);
  case Known::sphere:
    return with_energy(sphere_energy);
  case Known::pear:
    return with_energy(1.472113 * sphere_energy);
  case Known::triangle:
    return with_energy(1.96706 * sphere_energy);
  case Known::nothing:
    break;
  }
  return {};
}

// At rest, what the numbers of a vesicle should be good to. On the way there the beginning counts,
// whose rim is sharp.
AllowedErrors allowed_errors(Known known) {
  return known == Known::relaxation ? AllowedErrors{1e-3, 2e-2} : AllowedErrors{3e-4, 2e-2};
}

std::string_view to_string(Known known) {
  constexpr std::string_view words[]{
      "",       "oblate at rest", "prolate at rest",         "oblate, exact over time",
      "sphere", "pear at rest",   "rounded triangle at rest"};
  return words[int(known)];
}

} // namespace lamella
