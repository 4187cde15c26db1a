#pragma once
#include "energy/energy_terms.h"

#include "grid/grid.h"

#include <optional>

namespace lamella {

/// What is known of the two phases of a membrane and of the boundary between them.
struct PhaseMeasures {
  double bending_energy_Ld = 0, bending_energy_Lo = 0; ///< kappa/2 int (K_M - C)^2 dA of each
  double line_energy = 0;                              ///< of all line moduli
  double sigma_Ld = 0, sigma_Lo = 0;                   ///< tensions
  double area_Ld = 0, area_Lo = 0;
  double area_Ld_drift = 0;           ///< A_Ld over what it should be, less 1
  double line_length = 0;             ///< of the phase boundary
  double line_radius = 0;             ///< smallest line_length / 2 pi of a single closed boundary
  double max_line_speed = 0;          ///< largest |velocity of the boundary along the membrane|
  int domains_Ld = 0, domains_Lo = 0; ///< connected parts of each phase
};

/// What is known of the local stretch of a membrane.
struct StretchMeasures {
  double least = 1, greatest = 1; ///< of c
};

/// Where the energy went in a step: it changes by work - dissipated, but for the error of the step.
struct EnergyBalance {
  double work = 0;       ///< of the multipliers of what is held, where that changes
  double dissipated = 0; ///< int u^2 dA / dt, u how far the step moved the membrane
};

/// What is known of a state; one row of history.csv.
struct Measures {
  double time = 0;
  double dt = 0;      ///< the step that led here; 0 for the start
  double energy = 0;  ///< all terms; falls with time
  double int_KM2 = 0; ///< int K_M^2 dA (the number that Tables 1 and 2 of the paper list)
  double P = 0;       ///< pressure: multiplier of the volume
  double sigma = 0;   ///< tension: multiplier of the area; with phases, their mean by area
  double K_multiplier =
      0; ///< multiplier of the area difference: coefficient of K in v_N, 2 h sigma_DA
  double area = 0, volume = 0;
  double reduced_volume = 0;                ///< V / (4/3 pi Rs^3), Rs = sqrt(A / 4 pi)
  double area_difference = 0;               ///< reduced: -int K_M dA / (8 pi Rs), 1 for a sphere
  double area_drift = 0;                    ///< A over what it should be, less 1
  double volume_drift = 0;                  ///< of the volume, where it is held
  double max_speed = 0;                     ///< largest |normal velocity|
  int components = 0;                       ///< connected parts of the inside
  int genus = 0;                            ///< sum over the components
  EnergyTerms terms{};                      ///< what `energy` is the sum of
  std::optional<PhaseMeasures> phases{};    ///< where the scene has domains
  std::optional<StretchMeasures> stretch{}; ///< where the scene has a stretch modulus

  /// Of the step that led here, where there is one phase without stretch: else what moves along the
  /// membrane dissipates too. Nothing in what earlier versions stored.
  std::optional<EnergyBalance> balance{};

  /// Of the step that led here, over Vesicle::energy_scale() before it; 0 where the energy fell or
  /// the step was driven. Nothing in what earlier versions stored.
  std::optional<double> energy_rise{};
};

/// What is known of one of several vesicles; a row of components.csv.
struct ComponentMeasures {
  double time = 0;
  int component = 0; ///< its number, from 1
  Vec3 center{};     ///< of its volume
  double volume = 0, area = 0;
  double reduced_volume = 0; ///< V / (4/3 pi Rs^3), Rs = sqrt(A / 4 pi)
  double P = 0, sigma = 0;   ///< with phases, sigma is their mean by area
  double K_multiplier = 0;
  double int_KM = 0;               ///< int K_M dA
  std::optional<double> area_Ld{}; ///< where the scene has domains

  bool operator==(const ComponentMeasures&) const = default;
};

} // namespace lamella
