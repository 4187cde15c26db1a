#include "render/energy_plot.h"

#include "render/labels.h"
#include "render/render.h"
#include "render/sheet.h"
#include "render/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

constexpr double page_width = 1400, page_height = 1050;
constexpr double right = 1325, bottom = 180,
                 top = 1005;    // of the plot; its left side follows from the labels
constexpr double title_at = 70; ///< base line of the energy axis' title
constexpr double dot_spacing = 14;
constexpr double tick = 16, minor_tick = 9;
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
  void draw_tick(Sheet& sheet, double x, double length) const {
    sheet.line({{x, bottom}, {x, bottom - length}}, {style::hairline, style::ink});
  }

  void draw_label(Sheet& sheet, double x, const std::string& label) const {
    sheet.text({x, bottom - tick - 14 - 0.73 * style::small_type}, label,
               {style::small_type, style::ink, 0.5});
  }

  int draw_linear(Sheet& sheet) const {
    sheet.line({{left_, bottom}, {right, bottom}}, {style::hairline, style::ink});
    const Ticks ticks = linear_ticks(range_.low, range_.high);
    for (std::size_t n = 0; n < ticks.positions.size(); ++n) {
      draw_tick(sheet, position(ticks.positions[n]), tick);
      draw_label(sheet, position(ticks.positions[n]), ticks.labels[n]);
    }
    return ticks.exponent;
  }

  int draw_log(Sheet& sheet) const {
    const double cut = left_ + start_gap / 2, half = 9, slope = 7; // the axis is broken after t = 0
    const Stroke line{style::hairline, style::ink};
    sheet.line({{left_, bottom}, {cut - half, bottom}}, line);
    sheet.line({{cut + half, bottom}, {right, bottom}}, line);
    for (double x : {cut - half, cut + half})
      sheet.line({{x - slope, bottom - 2 * slope}, {x + slope, bottom + 2 * slope}}, line);
    draw_tick(sheet, left_, tick);
    draw_label(sheet, left_, "0");
    const int first = int(std::floor(range_.low)), last = int(std::floor(range_.high));
    const int every = (last - first) / 7 + 1; // labels stay apart
    for (int exponent = first; exponent <= last; ++exponent)
      for (int m = 1; m < 10; ++m) {
        const double t = m * std::pow(10, exponent);
        if (!shows(t) || std::log10(t) > range_.high) continue;
        draw_tick(sheet, position(t), m == 1 ? tick : minor_tick);
        if (m == 1 && (last - exponent) % every == 0)
          draw_label(sheet, position(t), power_of_ten(exponent));
      }
    return 0;
  }

  double left_;
  bool logarithmic_ = false;
  Range range_{}; ///< of the time, or of its decimal logarithm
};

class EnergyAxis {
public:
  explicit EnergyAxis(const Curve& curve)
      : range_(energy_range(curve)), ticks_(linear_ticks(range_.low, range_.high)) {
    std::size_t longest = 0;
    for (const std::string& label : ticks_.labels) longest = std::max(longest, plain(label).size());
    constexpr double digit = 0.64 * style::small_type; // widest
    left_ = title_at + 80 + double(longest) * digit + tick;
  }

  double left() const { return left_; }
  int exponent() const { return ticks_.exponent; }
  double position(double energy) const {
    return bottom + (top - bottom) * (energy - range_.low) / (range_.high - range_.low);
  }

  void draw(Sheet& sheet) const {
    const Stroke line{style::hairline, style::ink};
    sheet.line({{left_, bottom}, {left_, top}}, line);
    for (std::size_t n = 0; n < ticks_.positions.size(); ++n) {
      const double y = position(ticks_.positions[n]);
      sheet.line({{left_ - tick, y}, {left_, y}}, line);
      sheet.text({left_ - tick - 12, y - 0.36 * style::small_type}, ticks_.labels[n],
                 {style::small_type, style::ink, 1});
    }
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
  sheet.text({(energy.left() + right) / 2, 50},
             fmt::format("time *t* / ({}*ζL*⁴/*κ*)", factor(time_exponent)),
             {style::type_size, style::ink, 0.5});
  TextStyle turned{style::type_size, style::ink, 0.5};
  turned.upright = false;
  const std::string unit =
      energy.exponent() == 0 ? "*κ*" : fmt::format("({}*κ*)", factor(energy.exponent()));
  sheet.text({title_at, (bottom + top) / 2}, fmt::format("energy *E* / {}", unit), turned);
  const double pixels = width / page_width;
  return studio.shoot(width, int(std::lround(page_height * pixels)), {}, sheet, pixels);
}

} // namespace lamella::render
