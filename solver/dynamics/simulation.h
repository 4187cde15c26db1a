#pragma once
#include "dynamics/constraints.h"
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "dynamics/semi_implicit.h"
#include "dynamics/step_control.h"
#include "dynamics/surface_integrals.h"
#include "dynamics/topology_change.h"
#include "energy/film.h"
#include "levelset/gauge.h"
#include "levelset/topology.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <optional>

namespace lamella {

/// A vesicle in time: the state of a scene, advanced step by step.
///
/// After construction and after every step the state is on its constraints and measured. The state
/// depends on the scene alone, to the last bit whatever the number of threads.
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
  /// A constraint is still being led to a target, or will be.
  bool ramping() const { return constraints_.ramping(time()); }
  /// Nodal values of the level set.
  Frame frame() const;
  const Grid& grid() const { return phi_.grid(); }

private:
  void place_start(const Scene& scene);
  Quantities measure(double time);
  void locate();
  void lead_to_constraints(double time);
  void set_directions();
  void evaluate_on_membrane(std::span<const double> change, std::vector<double>& moves);
  Eigen::Matrix3d effect_of_directions() const;
  void displace(const Eigen::Vector3d& u);
  bool try_step(double dt, double latest);
  void go_back();
  std::string why_not_kept() const;
  void apply_constrained(double time);
  void push_films_apart();
  double velocity(std::size_t sample) const;
  double drift(double time) const;
  void measure_forces(double time);
  void check(const Measures& m) const;
  void renormalise_if_needed();
  void recentre_if_needed();
  void move_box(const std::array<int, 3>& cells);
  void change_topology_if_needed();
  void find_narrow_places();
  std::optional<Closing> closing_place() const;
  void note_spontaneous_change();
  std::string place_text(const Vec3& place) const;
  std::string film_message(const Vec3& place) const;
  bool part_at(const Closing& place);
  double measure_anew();
  Event event_now() const;
  void note_unresolved();
  void note(Event event);
  Vec3 in_space(Vec3 place) const;
  Measures summarise(double dt) const;
  template <class Velocity>
  void extend_rates(Velocity&& v);
  double step_error() const;
  double choose_dt(double latest) const;
  std::span<const double> grad_of_entries();

  Helfrich bending_;
  Film film_;
  Contact contact_;
  Constraints constraints_;
  StepControl control_;
  LevelSet phi_;
  Fourier fourier_;
  NarrowBand band_;
  Extension extension_;
  Gauge gauge_;
  SemiImplicit stepper_;
  SurfaceGeometry surface_;
  SurfaceIntegrals integrals_;
  Multipliers multipliers_ = Multipliers::Zero();
  /// One way to displace the membrane.
  struct Direction {
    std::vector<double> nodal; ///< change of phi at the band entries, tapered
    std::vector<double> moves; ///< the displacement at the samples
  };
  std::array<Direction, 3> directions_;
  Array<double> field_;                         // on the grid; 0 off the band
  std::vector<double> variation_;               // F at the samples
  std::vector<double> grad_, work_;             // a number a band entry
  std::vector<CriticalPoint> inside_, outside_; // near the membrane
  std::string why_not_on_;                      // the next step cannot be made
  bool broken_ = false; // the last step failed: the state is the one before it
  Quantities start_ = Quantities::Zero();
  Quantities excess_ = Quantities::Zero(); // of a step beyond first order, as last seen
  double film_energy_ = 0, most_film_pressure_ = 0;
  double max_force_ = 0, max_speed_ = 0, error_ = 0;
  double last_dt_ = 0;     // 0: none yet
  double response_dt_ = 0; // the step that the responses were found for
  long steps_ = 0, renormalised_ = 0, next_parting_ = 0;
  std::array<int, 3> cells_{}; // by which the box has moved
  Topology topology_;
  Measures measures_;
  std::vector<Event> events_;
};

} // namespace lamella
