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
constexpr double name_gap = 30;   ///< between the end of a curve and its name
constexpr double start_gap = 110; ///< between t = 0 and the logarithmic part of the axis

/// An energy over time, at the times that count.
struct Curve {
  std::string name; ///< none where it is the only one
  Color color;
  std::vector<Vec2> points; ///< time and energy
};

/// What the whole energy consists of.
struct Term {
  const char* name;
  Color color;
  double energy;
};

std::vector<Term> terms(const Measures& m) {
  std::vector<Term> all;
  if (m.phases)
    all = {{"bending Ld", style::Ld.line, m.phases->bending_energy_Ld},
           {"bending Lo", style::Lo.line, m.phases->bending_energy_Lo},
           {"line", style::line_energy, m.phases->line_energy},
           {"Gaussian", style::gaussian_energy, m.phases->gaussian_energy}};
  else if (m.stretch)
    all = {{"bending", style::membrane.line, m.bending_energy}};
  if (m.stretch) all.push_back({"stretch", style::stretch_energy, m.stretch->energy});
  return all;
}

/// The whole energy, then its terms.
std::vector<Curve> energy_curves(const std::vector<Measures>& history, double bending_modulus) {
  std::vector<Curve> curves(1);
  for (const Measures& row : history) {
    const std::vector<Term> parts = terms(row);
    if (!std::isfinite(row.time) || !std::isfinite(row.energy) ||
        !std::ranges::all_of(parts, [](const Term& t) { return std::isfinite(t.energy); }))
      continue;
    curves.resize(1 + parts.size());
    curves[0].points.push_back({row.time, row.energy / bending_modulus});
    for (std::size_t n = 0; n < parts.size(); ++n) {
      curves[n + 1].name = parts[n].name;
      curves[n + 1].color = parts[n].color;
      curves[n + 1].points.push_back({row.time, parts[n].energy / bending_modulus});
    }
  }
  if (curves[0].points.empty())
    throw RenderError("nothing to plot: the history has no finite energy");
  const bool alone = curves.size() == 1;
  curves[0].name = alone ? "" : "total";
  curves[0].color = alone ? style::membrane.line : style::ink;
  const auto vanishes = [](const Curve& curve) {
    return std::ranges::all_of(curve.points, [](const Vec2& p) { return p[1] == 0; });
  };
  curves.erase(std::remove_if(curves.begin() + 1, curves.end(), vanishes), curves.end());
  return curves;
}

struct Range {
  double low, high;
};

/// The energies with some air; never so narrow that rounding errors look like a change.
Range energy_range(const std::vector<Curve>& curves) {
  double low = curves[0].points[0][1], high = low;
  for (const Curve& curve : curves)
    for (const auto& [t, energy] : curve.points)
      low = std::min(low, energy), high = std::max(high, energy);
  const double least = 0.02 * std::max({std::abs(low), std::abs(high), 1e-300});
  const double extent = std::max(high - low, least);
  const double middle = (low + high) / 2;
  return {middle - 0.58 * extent, middle + 0.58 * extent};
}

/// The first time > 0 at which a part of the whole change of energy has happened.
double time_of_change(const std::vector<Vec2>& energies, double part) {
  const double whole = std::abs(energies.back()[1] - energies.front()[1]);
  for (const auto& [t, energy] : energies)
    if (t > 0 && std::abs(energy - energies.front()[1]) >= part * whole) return t;
  return energies.back()[0];
}

/// Time to a position along the page, linear or logarithmic.
class TimeAxis {
public:
  TimeAxis(const std::vector<Vec2>& energies, double left, double right)
      : left_(left), right_(right) {
    const double end = energies.back()[0];
    const double begin = time_of_change(energies, 0.005);
    logarithmic_ = end > 0 && energies.front()[0] == 0 && end >= 100 * begin &&
                   time_of_change(energies, 0.5) < 0.05 * end;
    if (logarithmic_)
      range_ = {std::log10(begin) - 0.1, std::log10(end) + 0.12};
    else
      range_ = {energies.front()[0], end > energies.front()[0] ? end : energies.front()[0] + 1};
  }

  bool logarithmic() const { return logarithmic_; }
  double log_begin() const { return left_ + start_gap; }

  /// Whether a time has a place: on a logarithmic axis, 0 and what does not lie left of it.
  bool shows(double t) const { return !logarithmic_ || t == 0 || std::log10(t) >= range_.low; }

  double position(double t) const {
    if (!logarithmic_)
      return left_ + (right_ - left_) * (t - range_.low) / (range_.high - range_.low);
    if (t == 0) return left_;
    return log_begin() +
           (right_ - log_begin()) * (std::log10(t) - range_.low) / (range_.high - range_.low);
  }

  /// Draws axis, ticks and labels; returns the power of ten that the labels leave to the title.
  int draw(Sheet& sheet) const { return logarithmic_ ? draw_log(sheet) : draw_linear(sheet); }

private:
  int draw_linear(Sheet& sheet) const {
    sheet.line({{left_, bottom}, {right_, bottom}}, {style::hairline, style::ink});
    const Ticks ticks = linear_ticks(range_.low, range_.high);
    for (std::size_t n = 0; n < ticks.positions.size(); ++n)
      draw_bottom_tick(sheet, position(ticks.positions[n]), ticks.labels[n]);
    return ticks.exponent;
  }

  int draw_log(Sheet& sheet) const {
    const double cut = left_ + start_gap / 2, half = 9, slope = 7; // the axis is broken after t = 0
    const Stroke line{style::hairline, style::ink};
    sheet.line({{left_, bottom}, {cut - half, bottom}}, line);
    sheet.line({{cut + half, bottom}, {right_, bottom}}, line);
    for (double x : {cut - half, cut + half})
      sheet.line({{x - slope, bottom - 2 * slope}, {x + slope, bottom + 2 * slope}}, line);
    draw_bottom_tick(sheet, left_, "0");
    const Ticks ticks = log_ticks(range_.low, range_.high);
    for (std::size_t n = 0; n < ticks.positions.size(); ++n)
      draw_bottom_tick(sheet, position(ticks.positions[n]), ticks.labels[n]);
    return 0;
  }

  double left_, right_;
  bool logarithmic_ = false;
  Range range_{}; ///< of the time, or of its decimal logarithm
};

class EnergyAxis {
public:
  explicit EnergyAxis(const std::vector<Curve>& curves)
      : range_(energy_range(curves)), ticks_(linear_ticks(range_.low, range_.high)),
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
  for (const auto& [t, e] : curve.points)
    if (time.shows(t) && !(time.logarithmic() && t == 0))
      line.push_back({time.position(t), energy.position(e)});
  const auto place = [&](const Vec2& p) {
    return Vec2{time.position(p[0]), energy.position(p[1])};
  };
  const Vec2 begin = place(curve.points.front()), end = place(curve.points.back());
  if (time.logarithmic() && !line.empty()) {
    const Vec2& next = line.front(); // the first point that the axis can show
    const double distance = std::hypot(next[0] - begin[0], next[1] - begin[1]);
    const int gaps = int(std::lround(distance / dot_spacing));
    for (int n = 1; n < gaps; ++n) {
      const double s = double(n) / gaps;
      sheet.disc({std::lerp(begin[0], next[0], s), std::lerp(begin[1], next[1], s)},
                 style::hairline, curve.color);
    }
  }
  sheet.line(std::move(line), {style::curve_width, curve.color});
  for (const Vec2& p : {begin, end}) sheet.disc(p, 13, curve.color);
}

/// Room for the names of curves, right of them.
double name_room(const std::vector<Curve>& curves) {
  constexpr double letter = 0.6 * style::small_type; // on average
  std::size_t longest = 0;
  for (const Curve& curve : curves) longest = std::max(longest, curve.name.size());
  return longest == 0 ? 0 : name_gap + letter * double(longest) - (width - right) / 2;
}

/// Names beside the ends of curves, moved apart where curves end close to each other.
void draw_names(Sheet& sheet, std::vector<Curve> curves, const TimeAxis& time,
                const EnergyAxis& energy) {
  constexpr double apart = 1.15 * style::small_type;
  std::ranges::sort(curves, {}, [](const Curve& curve) { return curve.points.back()[1]; });
  std::vector<double> heights;
  for (const Curve& curve : curves) {
    const double own = energy.position(curve.points.back()[1]);
    heights.push_back(heights.empty() ? own : std::max(own, heights.back() + apart));
  }
  double highest = top;
  for (std::size_t n = curves.size(); n-- > 0; highest = heights[n] - apart)
    heights[n] = std::min(heights[n], highest);
  for (std::size_t n = 0; n < curves.size(); ++n)
    sheet.text({time.position(curves[n].points.back()[0]) + name_gap,
                heights[n] - 0.36 * style::small_type},
               curves[n].name, {style::small_type, curves[n].color});
}

} // namespace

Picture draw_energy(Studio& studio, const std::vector<Measures>& history, double bending_modulus,
                    int width) {
  const std::vector<Curve> curves = energy_curves(history, bending_modulus);
  const EnergyAxis energy(curves);
  const double right_side = right - name_room(curves);
  const TimeAxis time(curves[0].points, energy.left(), right_side);
  Sheet sheet;
  energy.draw(sheet);
  const int time_exponent = time.draw(sheet);
  for (const Curve& curve : curves) draw_curve(sheet, curve, time, energy);
  if (!curves[0].name.empty()) draw_names(sheet, curves, time, energy);
  const std::string energy_unit =
      energy.exponent() == 0 ? "*κ*" : fmt::format("({}*κ*)", factor(energy.exponent()));
  draw_titles(sheet, energy.left(), right_side,
              fmt::format("time *t* / ({}*ζL*⁴/*κ*)", factor(time_exponent)),
              fmt::format("energy *E* / {}", energy_unit));
  return print(studio, sheet, width);
}

} // namespace lamella::render
