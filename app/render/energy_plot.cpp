#include "render/energy_plot.h"

#include "render/render.h"

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

/// A curve: a term, or several together.
struct Part {
  const char* name;
  Color color;
  double energy;
};

/// What the whole energy consists of.
std::vector<Part> parts_of(const Measures& m) {
  std::vector<Part> all;
  bool has_line = false;
  for (const TermInfo& term : energy_term_table) {
    if (!m.terms[term.term]) continue;
    if (term.seat == Seat::boundary) {
      if (!has_line) all.push_back({"line", style::line_energy, m.terms.sum(Seat::boundary)});
      has_line = true;
    } else if (term.term == Term::bending && m.phases) {
      all.push_back({"bending Ld", style::Ld.line, m.phases->bending_energy_Ld});
      all.push_back({"bending Lo", style::Lo.line, m.phases->bending_energy_Lo});
    } else {
      all.push_back({term.label, style::of_term(term.term), m.terms.value(term.term)});
    }
  }
  for (const auto& [name, energy] : m.terms.others())
    all.push_back({name.c_str(), style::other_term, energy});
  return all.size() == 1 ? std::vector<Part>{} : all;
}

/// The whole energy, then its terms.
std::vector<Series> energy_series(const std::vector<Measures>& history, const Units& units) {
  const Notation &t = notation_of("t"), &energy = notation_of("energy");
  std::vector<Series> all(1);
  for (const Measures& row : history) {
    const std::vector<Part> parts = parts_of(row);
    if (!std::isfinite(row.time) || !std::isfinite(row.energy) ||
        !std::ranges::all_of(parts, [](const Part& t) { return std::isfinite(t.energy); }))
      continue;
    all.resize(1 + parts.size());
    const double time = t.value(row.time, units);
    all[0].points.push_back({time, energy.value(row.energy, units)});
    for (std::size_t n = 0; n < parts.size(); ++n) {
      all[n + 1].name = parts[n].name;
      all[n + 1].color = parts[n].color;
      all[n + 1].points.push_back({time, energy.value(parts[n].energy, units)});
    }
  }
  if (all[0].points.empty()) throw RenderError("nothing to plot: the history has no finite energy");
  const bool alone = all.size() == 1;
  all[0].name = alone ? "" : "total";
  all[0].color = alone ? style::membrane.line : style::ink;
  const auto vanishes = [](const Series& series) {
    return std::ranges::all_of(series.points, [](const Vec2& p) { return p[1] == 0; });
  };
  all.erase(std::remove_if(all.begin() + 1, all.end(), vanishes), all.end());
  return all;
}

/// The first time > 0 at which a part of the whole change of energy has happened.
double time_of_change(const std::vector<Vec2>& energies, double part) {
  const double whole = std::abs(energies.back()[1] - energies.front()[1]);
  for (const auto& [t, energy] : energies)
    if (t > 0 && std::abs(energy - energies.front()[1]) >= part * whole) return t;
  return energies.back()[0];
}

Axis time_axis(const std::vector<Vec2>& energies, const Units& units) {
  Axis axis{notation_of("t").title(units)};
  const double begin = time_of_change(energies, 0.005), end = energies.back()[0];
  axis.logarithmic = end > 0 && end >= 100 * begin && time_of_change(energies, 0.5) < 0.05 * end;
  if (axis.logarithmic) axis.range = {begin / 1.2, end * 1.2};
  return axis;
}

} // namespace

Plot energy_plot(const std::vector<Measures>& history, const Units& units) {
  std::vector<Series> series = energy_series(history, units);
  return {
      time_axis(series[0].points, units), {notation_of("energy").title(units)}, std::move(series)};
}

} // namespace lamella::render
