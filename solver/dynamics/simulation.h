#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "dynamics/multipliers.h"
#include "dynamics/semi_implicit.h"
#include "dynamics/step_control.h"
#include "dynamics/surface_integrals.h"
#include "levelset/gauge.h"
#include "scene/scene.h"
#include "store/frame.h"

namespace lamella {

/// A vesicle in time: the state of a scene, advanced step by step.
///
/// After construction and after every step the state is on its constraints (volume and area of the
/// scene's shape) and measured. The state depends on the scene alone, to the last bit whatever the number
/// of threads.
class Simulation {
public:
  /// Throws RunError where the start shape cannot be represented.
  explicit Simulation(const Scene& scene);

  /// One time step, not beyond `latest` (> time()). Throws RunError when the run cannot go on;
  /// frame() and measures() then still give the state before the step.
  void step(double latest);

  double time() const { return measures_.time; }
  /// The step that the error control would take next.
  double next_dt() const;
  const Measures& measures() const { return measures_; }
  /// What happened so far, in the order of time.
  std::span<const Event> events() const { return events_; }
  /// Nodal values of the level set.
  Frame frame() const;
  const Grid& grid() const { return phi_.grid(); }

private:
  /// Volume and area beyond what they should be.
  struct Excess {
    double volume = 0, area = 0;
  };
  Excess measure();
  void locate();
  void project();
  void apply_constrained();
  double velocity(std::size_t sample) const;
  double drift() const;
  void measure_forces();
  void check(const Measures& m) const;
  void renormalise_if_needed();
  Measures summarise(double dt) const;
  template <class Velocity>
  void extend_rates(Velocity&& v);
  double step_error() const;
  double choose_dt(double latest) const;

  Helfrich bending_;
  StepControl control_;
  LevelSet phi_;
  Fourier fourier_;
  NarrowBand band_;
  Extension extension_;
  Gauge gauge_;
  SemiImplicit stepper_;
  SurfaceGeometry surface_;
  SurfaceIntegrals integrals_;
  Multipliers multipliers_;
  std::vector<double> variation_;   // F at the samples
  std::vector<double> grad_, work_; // a number a band entry
  bool broken_ = false;             // the last step failed: the state is the one before it
  double area_ = 0, volume_ = 0;    // of the scene's shape
  Excess excess_;                   // of a step beyond first order, as last seen
  double max_force_ = 0, max_speed_ = 0, error_ = 0;
  double response_dt_ = 0; // the step that the response of the tension was found for
  long steps_ = 0, renormalised_ = 0;
  Measures measures_;
  std::vector<Event> events_;
};

} // namespace lamella
