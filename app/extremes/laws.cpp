#include "extremes/laws.h"

#include "dynamics/simulation.h"
#include "error.h"
#include "extremes/verdict.h"
#include "parallel.h"
#include "scene/units.h"
#include "store/history.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lamella {

namespace {

constexpr long followed_steps = 60;
constexpr long steps_of_twins = 4 * followed_steps; // they may take others
constexpr int larger_by = 16;                       // nodes along each axis
// The box: on their way two runs differ by what unequal steps do, measured 5e-4; near rest by 1e-4
// (box_test.cpp).
constexpr double box_tolerance = 1e-3, unit_tolerance = 1e-8, axes_tolerance = 1e-5;
constexpr double later =
    1.2; // of the time at which a run stops; its twin has until then to stop too
constexpr double infinity = std::numeric_limits<double>::infinity();

double number_of(const Field& field) {
  if (auto* const* number = std::get_if<double*>(&field.value)) return **number;
  if (auto* const* count = std::get_if<int*>(&field.value)) return **count;
  return 0;
}

/// Of all terms of the energy, without their signs.
double energy_scale(Measures m) {
  double scale = 0;
  for (const Field& field : row_of(m))
    if (field.unit == "energy") scale = std::max(scale, std::abs(number_of(field)));
  return scale;
}

/// The largest difference between the columns of two runs that take the same steps, each over the
/// largest number in it; of dimensionless ones absolute. `change`: of the units of `b`.
double largest_difference(const Trace& a, const Trace& b, const UnitChange& change) {
  if (a.history.size() != b.history.size()) return infinity;
  double largest = 0;
  std::vector<double> scale, difference;
  for (std::size_t n = 0; n < a.history.size(); n++) {
    Measures ma = a.history[n], mb = b.history[n];
    const Row ra = row_of(ma), rb = row_of(mb);
    if (ra.size() != rb.size()) return infinity;
    scale.resize(ra.size());
    difference.resize(ra.size());
    for (std::size_t i = 0; i < ra.size(); i++) {
      const double factor = change.factor(ra[i].unit), x = number_of(ra[i]);
      scale[i] = std::max(scale[i], ra[i].unit.empty() ? 1 : std::abs(x));
      difference[i] = std::max(difference[i], std::abs(number_of(rb[i]) / factor - x));
    }
  }
  for (std::size_t i = 0; i < scale.size(); i++)
    if (difference[i] > 0) largest = std::max(largest, difference[i] / scale[i]);
  return largest;
}

/// Of the energies at the end, over the largest of its terms.
double energy_difference(const Measures& a, const Measures& b) {
  return std::abs(a.energy - b.energy) / energy_scale(a);
}

Scene in_larger_box(Scene scene) {
  const int shortest = std::ranges::min(scene.nodes);
  scene.half_width *= double(shortest + larger_by) / shortest;
  for (int& n : scene.nodes) n += larger_by;
  return scene;
}

template <class T>
std::array<T, 3> renamed(const std::array<T, 3>& v) {
  return {v[2], v[0], v[1]};
}

/// x, y, z become y, z, x: a turn by 120 degrees about (1, 1, 1).
Scene with_axes_renamed(Scene scene) {
  const double degrees = std::numbers::pi / 180;
  Shape& shape = scene.shape;
  const auto [x, y, z] = shape.rotation_axis;
  const Eigen::AngleAxisd own(shape.rotation_angle * degrees,
                              Eigen::Vector3d(x, y, z).normalized());
  const Eigen::AngleAxisd rename(120 * degrees, Eigen::Vector3d(1, 1, 1).normalized());
  const Eigen::AngleAxisd both(rename * own);
  shape.rotation_axis = {both.axis().x(), both.axis().y(), both.axis().z()};
  shape.rotation_angle = both.angle() / degrees;
  shape.center = renamed(shape.center);
  scene.nodes = renamed(scene.nodes);
  scene.domains.direction = renamed(scene.domains.direction);
  for (Vec3& direction : scene.domains.directions) direction = renamed(direction);
  return scene;
}

bool is_at_side(const std::string& message) {
  return message.find("side of the box") != message.npos;
}

class Checks {
public:
  explicit Checks(LawReport& report) : report_(report), run_(report.run) {}

  void numbers() {
    for (const Measures& row : run_.history) {
      Measures m = row;
      for (const Field& field : row_of(m))
        if (!std::isfinite(number_of(field)))
          return broken("finite numbers", fmt::format("{} at t = {:.6g}", field.column, m.time));
    }
  }

  void constraints() {
    double drift = 0;
    for (const Measures& m : run_.history)
      drift = std::max({drift, std::abs(m.area_drift), std::abs(m.volume_drift),
                        m.phases ? std::abs(m.phases->area_Ld_drift) : 0});
    if (drift > largest_drift) broken("kept volume and areas", fmt::format("off by {:.1e}", drift));
  }

  void energy() {
    double rise = 0;
    for (const Measures& m : run_.history) rise = std::max(rise, m.energy_rise.value_or(0));
    if (rise > Simulation::largest_rise)
      broken("falling energy", fmt::format("it rises by {:.1e} in a step", rise));
  }

  void larger_box() {
    const double end = run_.history.back().time;
    const Scene larger = in_larger_box(run_.scene);
    const Trace twin = trace(larger, steps_of_twins, end);
    if (twin.history.empty() || twin.history.back().time < end)
      return broken("a larger box", "there it stops: " + twin.message);
    const double difference = energy_difference(run_.history.back(), twin.history.back());
    if (difference > box_tolerance)
      broken("a larger box", fmt::format("the energy differs by {:.1e}", difference));
    if (!run_.message.empty() && !is_at_side(run_.message) &&
        trace(larger, steps_of_twins, later * end).message.empty())
      broken("a larger box", "there it does not stop: " + run_.message);
    for (const Event& event : run_.events)
      if (event.kind != Event::Kind::recentred && event.time < end &&
          std::ranges::count(twin.events, event.kind, &Event::kind) == 0)
        return broken("a larger box",
                      "there is no such event: " + to_text(event, run_.scene.grid().spacing));
  }

  void other_units() {
    const UnitChange change{4, 0.125};
    const Scene scene = in_units(run_.scene, change);
    try {
      validate(scene);
    } catch (const SceneError&) {
      return; // beyond the numbers that scenes may have
    }
    same("other units", scene, change, unit_tolerance);
  }

  void axes() {
    const Trace twin =
        trace(with_axes_renamed(run_.scene), steps_of_twins, run_.history.back().time);
    const double difference = twin.history.empty()
                                  ? infinity
                                  : energy_difference(run_.history.back(), twin.history.back());
    if (difference > axes_tolerance)
      broken("renamed axes", fmt::format("the energy differs by {:.1e}", difference));
  }

  void threads() {
    const int threads = thread_count();
    set_thread_count(threads == 1 ? 2 : 1);
    same("threads", run_.scene, {}, 0);
    set_thread_count(threads);
  }

private:
  void broken(std::string law, std::string how) {
    report_.broken.push_back({std::move(law), std::move(how)});
  }

  void same(const std::string& law, const Scene& scene, const UnitChange& change,
            double tolerance) {
    const Trace twin = trace(scene, followed_steps, scene.end());
    const double difference = largest_difference(run_, twin, change);
    if (difference > tolerance)
      broken(law, std::isfinite(difference)
                      ? fmt::format("the history differs by {:.1e}", difference)
                      : fmt::format("{} steps in place of {}", twin.history.size(),
                                    run_.history.size()));
    else if (twin.events.size() != run_.events.size())
      broken(law, "other events");
  }

  LawReport& report_;
  const Trace& run_;
};

} // namespace

Trace trace(const Scene& scene, long most_steps, double end_time) {
  Trace result;
  result.scene = scene;
  try {
    Simulation sim(scene);
    result.history.push_back(sim.measures());
    const auto note = [&] { result.events.assign(sim.events().begin(), sim.events().end()); };
    note();
    for (long step = 0; step < most_steps && sim.time() < end_time; step++) {
      sim.step(end_time);
      result.history.push_back(sim.measures());
      note();
    }
  } catch (const RunError& e) {
    result.message = e.what();
  }
  return result;
}

LawReport check_laws(const Scene& scene, const std::function<bool()>& go_on) {
  LawReport report;
  report.run = trace(scene, followed_steps, scene.end());
  if (report.run.history.empty()) {
    if (report.run.message.empty()) report.broken.push_back({"a message", "it stops without one"});
    return report;
  }
  Checks checks(report);
  checks.numbers();
  checks.constraints();
  checks.energy();
  using Twin = void (Checks::*)();
  for (const Twin twin :
       {&Checks::larger_box, &Checks::other_units, &Checks::axes, &Checks::threads})
    if (go_on()) (checks.*twin)();
  return report;
}

} // namespace lamella
