#pragma once
#include "dynamics/event.h"
#include "dynamics/semi_implicit.h"
#include "dynamics/step_control.h"
#include "dynamics/topology_change.h"
#include "dynamics/vesicle.h"
#include "levelset/gauge.h"
#include "levelset/topology.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <map>
#include <optional>
#include <string>

namespace lamella {

/// All that a simulation needs to go on as if it had never been interrupted, to the last bit.
struct SimulationState {
  Measures measures;
  std::vector<Event> events;
  Vesicle::State vesicle;
  SemiImplicit::Memory stepper;
  std::map<std::string, SemiImplicit::Memory> field_steppers; ///< of those that have one
  Array<double> excess; ///< of each vesicle, four numbers each
  double error = 0, last_dt = 0, response_dt = 0, history_share = 0;
  long steps = 0, renormalised = 0, next_parting = 0, next_search = 0, failures = 0;
  double failed_before = 0;
  long driven = 0; ///< 1: the energy may rise in the next step, as the scene is another one now
  std::array<int, 3> cells{};
  Topology topology;
  std::vector<Domain> domains;
  std::vector<CriticalPoint> inside, outside; ///< without the band entries around them
  std::string why_not_on;
};

/// A vesicle in time: the state of a scene, advanced step by step.
///
/// After construction and after every step the state is on its constraints and measured. The state
/// depends on the scene alone, to the last bit whatever the number of threads.
class Simulation {
public:
  /// Throws RunError where the start shape cannot be represented. `more`: terms of the energy
  /// besides those of the scene (docs/write-an-energy-term.md), as in the other two.
  explicit Simulation(const Scene& scene, const SurfaceTerms& more = {});
  /// From fields in memory, whatever [shape] and [domains] say but for whether there are phases.
  /// RunError also where the fields are not those that the scene needs, on its nodes.
  Simulation(const Scene& scene, const Start& start, const SurfaceTerms& more = {});

  /// Goes on from a state of a simulation of this scene. Throws RunError for one that does not fit.
  Simulation(const Scene& scene, const SimulationState& state, const SurfaceTerms& more = {});
  /// After at least one step (at its start a simulation is its scene), the last of them successful.
  SimulationState state() const;

  /// The most that the energy may rise in an undriven step, over Vesicle::energy_scale(). (Cuts are
  /// no steps; what they do to the energy is in their events.)
  static constexpr double largest_rise = 2e-3;

  /// One time step, not beyond `latest` (> time()). Throws RunError when the run cannot go on;
  /// frame() and measures() then still give the state before the step.
  void step(double latest);

  double time() const { return measures_.time; }
  /// The step that the error control would take next.
  double next_dt() const;
  const Measures& measures() const { return measures_; }
  /// How many vesicles there are that hold something of their own, and the measures of each, after
  /// a step that did not fail.
  int vesicles() const { return vesicle_.components().count(); }
  std::vector<ComponentMeasures> component_measures() const {
    return of_vesicles_.empty() ? measured_vesicles() : of_vesicles_;
  }
  /// What happened so far, in the order of time.
  std::span<const Event> events() const { return events_; }
  /// A constraint is still being led to a target, or will be.
  bool ramping() const { return vesicle_.constraints().ramping(time()); }
  /// Nodal values of the level set.
  Frame frame() const;
  const Grid& grid() const { return vesicle_.grid(); }

private:
  static StepControl control_of(const Scene& scene);
  static int responses_of(const Scene& scene);

  // steps: simulation.cpp
  /// Of a step, and the time that must be passed for it to be overcome.
  struct Failure {
    std::string why;
    double until;
  };
  std::optional<Failure> try_step(double then);
  void take_back(const Failure& failure, double dt);
  void predict_boundary(double dt);
  void step_stretch(double dt);
  void step_materials(double dt);
  void apply_constrained(double time);
  void apply_to_each(const Eigen::Matrix4Xd& factors);
  template <class Rate>
  void extend(Rate&& rate);
  template <class Velocity>
  void extend_rates(Velocity&& v);
  std::vector<double> on_membrane(std::span<const double> coefficients) const;
  int second_response() const;
  ImplicitSymbol implicit_symbol() const;
  double choose_dt(double latest) const;
  double speed() const;
  double last_move() const;
  double dissipated(double dt) const;
  void correct_lag(const EnergyBalance& balance, double lost, double scale);
  double step_error() const;
  double boundary_error() const;
  void go_back();
  double restart();
  void renormalise_if_needed();
  void check(const Measures& m) const;
  std::string why_not_kept() const;
  std::string why_not_risen(const Measures& risen) const;

  // events: simulation_events.cpp
  void note(const Measures& measures);
  std::vector<ComponentMeasures> measured_vesicles() const;
  void find_narrow_places();
  long steps_until_narrow() const;
  void change_topology_if_needed();
  std::optional<Closing> closing_place() const;
  bool part_at(const Closing& place);
  std::pair<bool, const CriticalPoint*> narrowest_place() const;
  bool broke_film(const Measures& m) const;
  void note_spontaneous_change();
  std::vector<Domain> domains() const;
  void note_domains();
  void note_unresolved();
  void recentre_if_needed();
  void move_box(const std::array<int, 3>& cells);
  void note(Event event);
  Event event_now() const;
  Vec3 in_space(Vec3 place) const;
  Vec3 place_of_change() const;
  std::string film_message(const Vec3& place) const;

  Contact contact_;
  StepControl control_;
  Fourier fourier_;
  Vesicle vesicle_;
  Gauge gauge_;
  SemiImplicit stepper_;
  std::vector<double> work_;                    // a number a band entry
  std::vector<CriticalPoint> inside_, outside_; // near the membrane
  std::string why_not_on_;                      // the next step cannot be made
  bool broken_ = false; // the last step failed: the state is the one before it
  Quantities excess_ = Quantities::Zero(4, 1); // of a step beyond first order, as last seen
  Vesicle::Holdings holdings_;                 // before the last step
  double error_ = 0;                           // of the last step
  double last_dt_ = 0;                         // 0: none yet
  double history_share_ = SemiImplicit::share_of_history; // that stiff modes of phi keep
  double response_dt_ = 0; // the step that the responses were found for
  long steps_ = 0, renormalised_ = 0, next_parting_ = 0, next_search_ = 0;
  long failures_ = 0; // of steps from before failed_before_
  double failed_before_ = 0;
  long driven_ = 0;
  std::array<int, 3> cells_{}; // by which the box has moved
  Topology topology_;
  std::vector<Domain> domains_; // of the Ld phase
  Measures measures_;
  std::vector<ComponentMeasures> of_vesicles_; // where there are several
  std::vector<Event> events_;
};

} // namespace lamella
