#include "summary.h"

#include "kernels/kernels.h"
#include "parallel.h"
#include "progress.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace lamella {

namespace {

std::string_view word_for(Constraint constraint) {
  constexpr std::string_view words[]{"fixed", "ramped", "free"};
  return words[int(constraint)];
}

/// Of the whole area or that of a phase, whichever is larger.
double area_drift_of(const Measures& m) {
  return std::max(std::abs(m.area_drift), m.phases ? std::abs(m.phases->area_Ld_drift) : 0);
}

std::string row(std::string_view name, std::string_view symbol, double from, double to,
                std::string_view constraint = "") {
  return fmt::format("{:<22} {:<14} {:>14.8g} {:>14.8g}{}{}\n", name, symbol, from, to,
                     constraint.empty() ? "" : "   ", constraint);
}

/// "*k*_{g}" without its marks: "kg".
std::string plain(std::string symbol) {
  std::erase_if(symbol, [](char c) { return c == '*' || c == '_' || c == '{' || c == '}'; });
  return symbol;
}

std::string energy_rows(const Measures& start, const Measures& end) {
  std::string text = row("energy", "E", start.energy, end.energy);
  const auto& phases = start.phases;
  if (phases) {
    text += row("  bending", "of Ld", phases->bending_energy_Ld, end.phases->bending_energy_Ld);
    text += row("", "of Lo", phases->bending_energy_Lo, end.phases->bending_energy_Lo);
    text += row("  phase boundary", "", phases->line_energy, end.phases->line_energy);
  }
  const auto is_there = [&](Term term) { return start.terms[term] && end.terms[term]; };
  const bool is_alone = std::ranges::count_if(energy_term_table, [&](const TermInfo& term) {
                          return is_there(term.term);
                        }) == 1;
  for (const TermInfo& term : energy_term_table) {
    const bool is_told = term.term == Term::bending && (phases || is_alone);
    if (is_told || !is_there(term.term)) continue;
    const auto &from = start.terms[term.term], &to = end.terms[term.term];
    const bool of_line = term.seat == Seat::boundary;
    text += row(fmt::format("{}{}", of_line ? "    " : "  ", term.label), plain(term.symbol), *from,
                *to);
  }
  return text + row("", "int K_M^2 dA", start.int_KM2, end.int_KM2);
}

std::string tension_rows(const Measures& start, const Measures& end) {
  if (!start.phases) return row("tension", "sigma", start.sigma, end.sigma);
  return row("tension", "sigma_Ld", start.phases->sigma_Ld, end.phases->sigma_Ld) +
         row("", "sigma_Lo", start.phases->sigma_Lo, end.phases->sigma_Lo);
}

std::string area_rows(const Measures& start, const Measures& end) {
  if (!start.phases) return row("area", "A", start.area, end.area, "fixed");
  return row("area", "A_Ld", start.phases->area_Ld, end.phases->area_Ld, "fixed") +
         row("", "A_Lo", start.phases->area_Lo, end.phases->area_Lo, "fixed");
}

std::string boundary_rows(const PhaseMeasures& start, const PhaseMeasures& end) {
  return row("phase boundary", "length", start.line_length, end.line_length) +
         row("", "least radius", start.line_radius, end.line_radius) +
         row("", "largest speed", start.max_line_speed, end.max_line_speed) +
         row("domains", "of Ld", start.domains_Ld, end.domains_Ld) +
         row("", "of Lo", start.domains_Lo, end.domains_Lo);
}

/// The start and the end in numbers.
std::string table(const Scene& scene, const Measures& start, const Measures& end) {
  std::string text = fmt::format("{:<22} {:<14} {:>14} {:>14}\n", "", "", "start", "end");
  text += energy_rows(start, end);
  text += row("pressure", "P", start.P, end.P);
  text += tension_rows(start, end);
  text += row("multiplier of Da", "K coefficient", start.K_multiplier, end.K_multiplier);
  text += area_rows(start, end);
  text += row("volume", "V", start.volume, end.volume, word_for(scene.volume.constraint));
  text += row("reduced volume", "v", start.reduced_volume, end.reduced_volume);
  text += row("area difference", "Da", start.area_difference, end.area_difference,
              word_for(scene.area_difference.constraint));
  text += row("largest speed", "max |v_N|", start.max_speed, end.max_speed);
  if (start.phases) text += boundary_rows(*start.phases, *end.phases);
  if (start.stretch) {
    text += row("lipid per area", "least c", start.stretch->least, end.stretch->least);
    text += row("", "greatest c", start.stretch->greatest, end.stretch->greatest);
  }
  text += row("components", "", start.components, end.components);
  return text + row("genus", "", start.genus, end.genus);
}

/// Those that are there at the end, each with what it holds.
std::string vesicle_table(std::span<const ComponentMeasures> vesicles) {
  std::string text = fmt::format("\n{:<9} {:^29} {:>12} {:>12} {:>10} {:>12} {:>12}\n", "Vesicles",
                                 "centre", "V", "A", "v", "P", "sigma");
  for (const ComponentMeasures& m : vesicles)
    text += fmt::format("{:<9} {:>9.4f} {:>9.4f} {:>9.4f} {:>12.6g} {:>12.6g} {:>10.5f} {:>12.6g} "
                        "{:>12.6g}\n",
                        m.component, m.center[0], m.center[1], m.center[2], m.volume, m.area,
                        m.reduced_volume, m.P, m.sigma);
  return text;
}

/// The end time that a scene has by default.
double fitting_end(Scene scene) {
  scene.end_time = 0;
  return scene.end();
}

/// Of the energy where nothing drove the vesicle.
std::string rise_text(const Course& course) {
  if (course.rises() == 0) return "Energy: never rose in a step that nothing drove\n";
  return fmt::format(
      "Energy: rose in {} step{} that nothing drove, at most by {:.1e} (relative), at "
      "t = {:.6g}\n",
      course.rises(), course.rises() == 1 ? "" : "s", course.energy_rise(), course.time_of_rise());
}

/// How well steps obey the energy law; nothing where there was nothing to lose.
std::string balance_text(const Course& course) {
  constexpr double least = 1e-6; // of the energy
  if (course.lost() <= least * std::abs(course.start().energy)) return {};
  return fmt::format("Energy law: {:.6g} lost, {:.6g} dissipated ({:+.2f} %)\n", course.lost(),
                     course.dissipated(), 100 * (course.dissipated() / course.lost() - 1));
}

} // namespace

Course::Course(const Measures& start)
    : start_(start), end_(start), area_drift_(area_drift_of(start)),
      volume_drift_(std::abs(start.volume_drift)), energies_{{start.time, start.energy}} {}

void Course::add(const Measures& measures) {
  constexpr double rounding = 1e-9;
  const double rise = measures.energy_rise.value_or(0);
  if (rise > rounding) rises_++;
  if (rise > energy_rise_) {
    energy_rise_ = rise;
    time_of_rise_ = measures.time;
  }
  if (measures.balance && measures.components == end_.components && measures.genus == end_.genus) {
    lost_ += end_.energy - measures.energy + measures.balance->work;
    dissipated_ += measures.balance->dissipated;
  }
  way_ += measures.dt * std::max(end_.max_speed, measures.max_speed);
  energies_.push_back({measures.time, measures.energy});
  end_ = measures;
  steps_++;
  area_drift_ = std::max(area_drift_, area_drift_of(measures));
  volume_drift_ = std::max(volume_drift_, std::abs(measures.volume_drift));
}

double Course::settled_at() const {
  constexpr double of_change = 1e-3, of_energy = 1e-6;
  const auto [first, last] =
      std::ranges::minmax(energies_, {}, [](const auto& point) { return point[1]; });
  const double little =
      std::max(of_change * (last[1] - first[1]), of_energy * std::abs(end_.energy));
  const auto far = std::ranges::find_if(energies_.rbegin(), energies_.rend(), [&](const auto& p) {
    return std::abs(p[1] - end_.energy) > little;
  });
  return far == energies_.rend() ? start_.time : (*far)[0];
}

std::string words_for(const Outcome& outcome, double time) {
  switch (outcome.code) {
  case success:
    return outcome.reason.empty() ? fmt::format("reached the end, t = {:.6g}", time)
                                  : fmt::format("{} at t = {:.6g}", outcome.reason, time);
  case resumable:
    return fmt::format("was interrupted at t = {:.6g}", time);
  default:
    return fmt::format("stopped at t = {:.6g}: {}", time, outcome.reason);
  }
}

std::string caution(std::span<const Event> events) {
  const auto first = std::ranges::find_if(events, &Event::is_under_resolved);
  if (first == events.end()) return {};
  return fmt::format("the grid did not resolve the membrane everywhere, first at t = {:.6g}; take "
                     "what follows with caution, more grid.nodes help",
                     first->time);
}

std::string word_on_end_time(const Scene& scene, const Course& course, bool ramping) {
  constexpr double little_way = 0.05; // grid spacings
  constexpr double long_ago = 0.1;    // of the run
  const double h = scene.grid().spacing, end = course.end().time;
  if (ramping)
    return fmt::format("at the end, t = {:.6g}, a constraint was still on its way to its target; a "
                       "later run.end_time, or a higher rate, lets it arrive",
                       end);
  if (course.way() < little_way * h)
    return fmt::format(
        "nothing can have moved by more than {:.2g} grid spacings until the end, t = "
        "{:.6g}; shapes of the size of this box change within about {:.2g}, which "
        "run.end_time = 0 stands for",
        course.way() / h, end, fitting_end(scene));
  if (const double settled = course.settled_at(); settled < long_ago * end)
    return fmt::format("all was over at t = {:.2g}, a {:.0f}th of the run; an earlier run.end_time "
                       "shows more of it, and stop.energy_rate ends runs at rest",
                       settled, end / settled);
  return {};
}

std::string summary(const Scene& scene, const Course& course, std::span<const Event> events,
                    const Outcome& outcome, bool ramping, double seconds,
                    std::span<const ComponentMeasures> vesicles) {
  const Grid grid = scene.grid();
  std::string text = fmt::format("{}\nscene {}, {} x {} x {} nodes, spacing {:.5g}\n\n",
                                 scene.title.empty() ? scene.name : scene.title, scene.name,
                                 grid.nx(), grid.ny(), grid.nz(), grid.spacing);
  text += fmt::format("The run {}\n{} steps in {} on {} thread{}, {} kernels\n\n",
                      words_for(outcome, course.end().time), course.steps(), duration_text(seconds),
                      thread_count(), thread_count() == 1 ? "" : "s", kernels().name);
  text += table(scene, course.start(), course.end());
  text += fmt::format("\nLargest drift over the run: area {:.1e}, volume {:.1e} (relative)\n",
                      course.area_drift(), course.volume_drift());
  text += rise_text(course);
  text += balance_text(course);
  if (vesicles.size() > 1) text += vesicle_table(vesicles);
  if (!events.empty()) text += "\nEvents\n";
  for (const Event& event : events) text += fmt::format("  {}\n", to_text(event, grid.spacing));
  const std::string warning = caution(events);
  if (!warning.empty()) text += fmt::format("\nWarning: {}\n", warning);
  const std::string word = outcome.code == success && outcome.reason.empty()
                               ? word_on_end_time(scene, course, ramping)
                               : "";
  if (!word.empty()) text += fmt::format("\nNote: {}\n", word);
  return text;
}

} // namespace lamella
