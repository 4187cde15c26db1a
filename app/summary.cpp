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

} // namespace

Course::Course(const Measures& start)
    : start_(start), end_(start), area_drift_(std::abs(start.area_drift)),
      volume_drift_(std::abs(start.volume_drift)) {}

void Course::add(const Measures& measures) {
  end_ = measures;
  steps_++;
  area_drift_ = std::max(area_drift_, std::abs(measures.area_drift));
  volume_drift_ = std::max(volume_drift_, std::abs(measures.volume_drift));
}

std::string words_for(const Outcome& outcome, double time) {
  switch (outcome.code) {
  case success:
    return outcome.reason.empty() ? fmt::format("reached the end, t = {:.6g}", time)
                                  : fmt::format("{} at t = {:.6g}", outcome.reason, time);
  case interrupted:
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

std::string summary(const Scene& scene, const Course& course, std::span<const Event> events,
                    const Outcome& outcome, double seconds) {
  const Measures &start = course.start(), &end = course.end();
  const Grid grid = scene.grid();
  std::string text = fmt::format("{}\nscene {}, {} x {} x {} nodes, spacing {:.5g}\n\n",
                                 scene.title.empty() ? scene.name : scene.title, scene.name,
                                 grid.nx(), grid.ny(), grid.nz(), grid.spacing);
  text += fmt::format("The run {}\n{} steps in {} on {} thread{}, {} kernels\n\n",
                      words_for(outcome, end.time), course.steps(), duration_text(seconds),
                      thread_count(), thread_count() == 1 ? "" : "s", kernels().name);
  const auto row = [&](const char* name, const char* symbol, double from, double to,
                       std::string_view constraint = "") {
    text += fmt::format("{:<22} {:<14} {:>14.8g} {:>14.8g}{}{}\n", name, symbol, from, to,
                        constraint.empty() ? "" : "   ", constraint);
  };
  text += fmt::format("{:<22} {:<14} {:>14} {:>14}\n", "", "", "start", "end");
  row("energy", "E", start.energy, end.energy);
  row("", "int K_M^2 dA", start.int_KM2, end.int_KM2);
  row("pressure", "P", start.P, end.P);
  row("tension", "sigma", start.sigma, end.sigma);
  row("multiplier of Da", "K coefficient", start.K_multiplier, end.K_multiplier);
  row("area", "A", start.area, end.area, "fixed");
  row("volume", "V", start.volume, end.volume, word_for(scene.volume.constraint));
  row("reduced volume", "v", start.reduced_volume, end.reduced_volume);
  row("area difference", "Da", start.area_difference, end.area_difference,
      word_for(scene.area_difference.constraint));
  row("largest speed", "max |v_N|", start.max_speed, end.max_speed);
  row("components", "", start.components, end.components);
  row("genus", "", start.genus, end.genus);
  text += fmt::format("\nLargest drift over the run: area {:.1e}, volume {:.1e} (relative)\n",
                      course.area_drift(), course.volume_drift());
  if (!events.empty()) text += "\nEvents\n";
  for (const Event& event : events) text += fmt::format("  {}\n", to_text(event, grid.spacing));
  const std::string warning = caution(events);
  if (!warning.empty()) text += fmt::format("\nWarning: {}\n", warning);
  return text;
}

} // namespace lamella
