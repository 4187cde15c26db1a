#pragma once

namespace lamella {

/// What is known of a state; one row of history.csv.
struct Measures {
  double time = 0;
  double dt = 0;             ///< the step that led here; 0 for the start
  double energy = 0;         ///< all terms; falls with time
  double bending_energy = 0; ///< kappa/2 int (K_M - C)^2 dA
  double int_KM2 = 0;        ///< int K_M^2 dA (the number that Tables 1 and 2 of the paper list)
  double P = 0;              ///< pressure: multiplier of the volume
  double sigma = 0;          ///< tension: multiplier of the area
  double K_multiplier =
      0; ///< multiplier of the area difference: coefficient of K in v_N, 2 h sigma_DA
  double area = 0, volume = 0;
  double reduced_volume = 0;  ///< V / (4/3 pi Rs^3), Rs = sqrt(A / 4 pi)
  double area_difference = 0; ///< reduced: -int K_M dA / (8 pi Rs), 1 for a sphere
  double area_drift = 0;      ///< A over what it should be, less 1
  double volume_drift = 0;    ///< of the volume, where it is held
  double max_speed = 0;       ///< largest |normal velocity|
  int components = 0;         ///< connected parts of the inside
  int genus = 0;              ///< sum over the components
};

} // namespace lamella
