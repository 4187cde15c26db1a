#include "render/energy_plot.h"

#include "render/labels.h"
#include "render/plot_page.h"
#include "render/render.h"
#include "render/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

using namespace plot_page;

constexpr double dot_spacing = 14;
constexpr double start_gap = 110; ///< between t = 0 and the logarithmic part of the axis

/// Time and energy, at the times that count.
using Curve = std::vector<Vec2>;

Curve energy_curve(const std::vector<Measures>& history, double bending_modulus) {
  Curve curve;
  for (const Measures& row : history)
    if (std::isfinite(row.time) && std::isfinite(row.energy))
      curve.push_back({row.time, row.energy / bending_modulus});
  if (curve.empty()) throw RenderError("nothing to plot: the history has no finite energy");
  return curve;
}

struct Range {
  double low, high;
};

/// The energies with some air; never so narrow that rounding errors look like a change.
Range energy_range(const Curve& curve) {
  const auto [low, high] = std::minmax_element(
      curve.begin(), curve.end(), [](const Vec2& a, const Vec2& b) { return a[1] < b[1]; });
  const double least = 0.02 * std::max({std::abs((*low)[1]), std::abs((*high)[1]), 1e-300});
  const double extent = std::max((*high)[1] - (*low)[1], least);
  const double middle = ((*low)[1] + (*high)[1]) / 2;
  return {middle - 0.58 * extent, middle + 0.58 * extent};
}

/// The first time > 0 at which a part of the whole change of energy has happened.
double time_of_change(const Curve& curve, double part) {
  const double whole = std::abs(curve.back()[1] - curve.front()[1]);
  for (const auto& [t, energy] : curve)
    if (t > 0 && std::abs(energy - curve.front()[1]) >= part * whole) return t;
  return curve.back()[0];
}

/// Time to a position along the page, linear or logarithmic.
class TimeAxis {
public:
  TimeAxis(const Curve& curve, double left) : left_(left) {
    const double end = curve.back()[0];
    const double begin = time_of_change(curve, 0.005);
    logarithmic_ = end > 0 && curve.front()[0] == 0 && end >= 100 * begin &&
                   time_of_change(curve, 0.5) < 0.05 * end;
    if (logarithmic_)
      range_ = {std::log10(begin) - 0.1, std::log10(end) + 0.12};
    else
      range_ = {curve.front()[0], end > curve.front()[0] ? end : curve.front()[0] + 1};
  }

  bool logarithmic() const { return logarithmic_; }
  double log_begin() const { return left_ + start_gap; }

  /// Whether a time has a place: on a logarithmic axis, 0 and what does not lie left of it.
  bool shows(double t) const { return !logarithmic_ || t == 0 || std::log10(t) >= range_.low; }

  double position(double t) const {
    if (!logarithmic_)
      return left_ + (right - left_) * (t - range_.low) / (range_.high - range_.low);
    if (t == 0) return left_;
    return log_begin() +
           (right - log_begin()) * (std::log10(t) - range_.low) / (range_.high - range_.low);
  }

  /// Draws axis, ticks and labels; returns the power of ten that the labels leave to the title.
  int draw(Sheet& sheet) const { return logarithmic_ ? draw_log(sheet) : draw_linear(sheet); }

private:
  int draw_linear(Sheet& sheet) const {
    sheet.line({{left_, bottom}, {right, bottom}}, {style::hairline, style::ink});
    const Ticks ticks = linear_ticks(range_.low, range_.high);
    for (std::size_t n = 0; n < ticks.positions.size(); ++n)
      draw_bottom_tick(sheet, position(ticks.positions[n]), ticks.labels[n]);
    return ticks.exponent;
  }

  int draw_log(Sheet& sheet) const {
    const double cut = left_ + start_gap / 2, half = 9, slope = 7; // the axis is broken after t = 0
    const Stroke line{style::hairline, style::ink};
    sheet.line({{left_, bottom}, {cut - half, bottom}}, line);
    sheet.line({{cut + half, bottom}, {right, bottom}}, line);
    for (double x : {cut - half, cut + half})
      sheet.line({{x - slope, bottom - 2 * slope}, {x + slope, bottom + 2 * slope}}, line);
    draw_bottom_tick(sheet, left_, "0");
    const Ticks ticks = log_ticks(range_.low, range_.high);
    for (std::size_t n = 0; n < ticks.positions.size(); ++n)
      draw_bottom_tick(sheet, position(ticks.positions[n]), ticks.labels[n]);
    return 0;
  }

  double left_;
  bool logarithmic_ = false;
  Range range_{}; ///< of the time, or of its decimal logarithm
};

class EnergyAxis {
public:
  explicit EnergyAxis(const Curve& curve)
      : range_(energy_range(curve)), ticks_(linear_ticks(range_.low, range_.high)),
        left_(left_side(ticks_.labels)) {}

  double left() const { return left_; }
  int exponent() const { return ticks_.exponent; }
  double position(double energy) const {
    return bottom + (top - bottom) * (energy - range_.low) / (range_.high - range_.low);
  }

  void draw(Sheet& sheet) const {
    sheet.line({{left_, bottom}, {left_, top}}, {style::hairline, style::ink});
    for (std::size_t n = 0; n < ticks_.positions.size(); ++n)
      draw_left_tick(sheet, left_, position(ticks_.positions[n]), ticks_.labels[n]);
  }

private:
  Range range_;
  Ticks ticks_;
  double left_;
};

/// "10⁻³ " in front of a unit when the labels leave that factor to the title.
std::string factor(int exponent) { return exponent == 0 ? "" : power_of_ten(exponent) + " "; }

void draw_curve(Sheet& sheet, const Curve& curve, const TimeAxis& time, const EnergyAxis& energy) {
  std::vector<Vec2> line;
  for (const auto& [t, e] : curve)
    if (time.shows(t) && !(time.logarithmic() && t == 0))
      line.push_back({time.position(t), energy.position(e)});
  const Vec2 begin{time.position(curve.front()[0]), energy.position(curve.front()[1])};
  if (time.logarithmic() && !line.empty()) {
    const Vec2& next = line.front(); // the first point that the axis can show
    const double distance = std::hypot(next[0] - begin[0], next[1] - begin[1]);
    const int gaps = int(std::lround(distance / dot_spacing));
    for (int n = 1; n < gaps; ++n) {
      const double s = double(n) / gaps;
      sheet.disc({std::lerp(begin[0], next[0], s), std::lerp(begin[1], next[1], s)},
                 style::hairline, style::membrane_line);
    }
  }
  const Vec2 end{time.position(curve.back()[0]), energy.position(curve.back()[1])};
  sheet.line(std::move(line), {style::curve_width, style::membrane_line});
  for (const Vec2& p : {begin, end}) sheet.disc(p, 13, style::membrane_line);
}

} // namespace

Picture draw_energy(Studio& studio, const std::vector<Measures>& history, double bending_modulus,
                    int width) {
  const Curve curve = energy_curve(history, bending_modulus);
  const EnergyAxis energy(curve);
  const TimeAxis time(curve, energy.left());
  Sheet sheet;
  energy.draw(sheet);
  const int time_exponent = time.draw(sheet);
  draw_curve(sheet, curve, time, energy);
  const std::string energy_unit =
      energy.exponent() == 0 ? "*κ*" : fmt::format("({}*κ*)", factor(energy.exponent()));
  draw_titles(sheet, energy.left(), fmt::format("time *t* / ({}*ζL*⁴/*κ*)", factor(time_exponent)),
              fmt::format("energy *E* / {}", energy_unit));
  return print(studio, sheet, width);
}

} // namespace lamella::render
