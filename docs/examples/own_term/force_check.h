#pragma once
#include <lamella/energy/surface_energy.h>
#include <lamella/scene/shapes.h>

#include <cmath>

/// An ellipsoid, moved a little by a wave through space: phi is `amount` times the wave more.
class Ellipsoid {
public:
  explicit Ellipsoid(double amount) {
    lamella::Shape shape;
    shape.kind = lamella::ShapeKind::ellipsoid;
    shape.semi_axes = {0.7, 0.55, 0.45};
    std::vector<double> nodal = lamella::initial_phi(shape, grid_);
    for (std::size_t i = 0; i < nodal.size(); i++) nodal[i] += amount * wave(grid_.position(i));
    lamella::Fourier fourier(grid_);
    phi_.fit(nodal, fourier);
    phi_.update_nodal();
    band_.update(phi_);
    surface_.sample(phi_, band_);
    surface_.jets(phi_, band_, lamella::Derivatives::all);
  }

  double energy(const lamella::SurfaceEnergy& energy) const {
    double sum = 0;
    for (std::size_t i = 0; i < surface_.size(); i++)
      sum += surface_.weight()[i] * energy.density(surface_.KM()[i], surface_.K()[i]);
    return sum;
  }

  /// The change of energy by `amount`, as the forces have it, and the sum of its sizes.
  std::pair<double, double> work(lamella::SurfaceEnergy& energy) const {
    std::vector<double> F(surface_.size());
    energy.find_forces(surface_, {}, {}, F);
    std::pair<double, double> sum;
    for (std::size_t i = 0; i < F.size(); i++) {
      const double u = -wave(surface_.point(i)) / surface_.grad()[i]; // along the normal
      sum.first += surface_.weight()[i] * F[i] * u;
      sum.second += surface_.weight()[i] * std::abs(F[i] * u);
    }
    return sum;
  }

private:
  static double wave(const lamella::Vec3& x) {
    return std::cos(3 * x[0] + 0.3) * std::sin(2.5 * x[1] + 0.7) + 0.4 * std::cos(4 * x[2]);
  }

  lamella::Grid grid_ = lamella::Grid::cube(64, 1);
  lamella::LevelSet phi_{grid_};
  lamella::NarrowBand band_{grid_, 4.2}; // spacings
  lamella::SurfaceGeometry surface_;
};

/// How far the force of a term is from the difference of its energy, relative: about 1e-3 where the
/// term says what it needs.
inline double force_error(std::shared_ptr<const lamella::SurfaceTerm> term) {
  lamella::SurfaceModuli none;
  none.bending_modulus = 1e-30;
  lamella::SurfaceEnergy energy(none);
  energy.add(std::move(term));
  constexpr double e = 5e-3;
  const double difference = (Ellipsoid(e).energy(energy) - Ellipsoid(-e).energy(energy)) / (2 * e);
  const auto [work, size] = Ellipsoid(0).work(energy);
  return std::abs(difference - work) / size;
}
