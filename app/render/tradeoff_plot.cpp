#include "render/tradeoff_plot.h"

#include "render/labels.h"
#include "render/plot_page.h"
#include "render/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lamella::render {
namespace {

using namespace plot_page;

constexpr double dot = 14, ring = 23;
constexpr double air = 0.12, name_room = 0.25; ///< beside the trades, in parts of their extent
constexpr Color white{255, 255, 255}, beyond{214, 214, 220};

/// From coarse to fine grids: from a pale to a dark shade of the membrane's colour.
Color shade(std::size_t n, std::size_t count) {
  const double s = count == 1 ? 0.5 : double(n) / double(count - 1);
  const auto mix = [s](int pale, int dark) {
    return static_cast<unsigned char>(std::lerp(pale, dark, s));
  };
  return {mix(244, 96), mix(166, 20), mix(120, 44)};
}

/// A logarithmic axis from `begin` to `end` on the page.
struct LogAxis {
  double low, high; ///< decimal logarithms
  double begin = 0, end = 0;

  double position(double value) const {
    return begin + (end - begin) * (std::log10(value) - low) / (high - low);
  }
};

/// The values with a share of air below and above, at least half a decade.
LogAxis axis_of(std::span<const Trade> trades, double Trade::*value, double below, double above) {
  const auto [least, most] = std::ranges::minmax(trades, {}, value);
  const double low = std::log10(least.*value), high = std::log10(most.*value);
  const double extent = std::max(high - low, 0.4), middle = (low + high) / 2;
  return {middle - (0.5 + below) * extent, middle + (0.5 + above) * extent};
}

std::string grid_label(const std::array<int, 3>& nodes) {
  const auto& [x, y, z] = nodes;
  return x == y && y == z ? fmt::format("{}³", x) : fmt::format("{}×{}×{}", x, y, z);
}

class TradeoffPlot {
public:
  explicit TradeoffPlot(std::vector<Trade> trades)
      : trades_(std::move(trades)), time_(axis_of(trades_, &Trade::seconds, name_room, air)),
        error_(axis_of(trades_, &Trade::error, air, air)) {
    const Ticks ticks = log_ticks(error_.low, error_.high);
    time_.begin = left_side(ticks.labels), time_.end = right;
    error_.begin = bottom, error_.end = top;
    for (const Trade& trade : trades_) lines_[trade.nodes].push_back(trade);
  }

  void draw(Sheet& sheet) const {
    draw_front(sheet);
    draw_axes(sheet);
    std::size_t n = 0;
    for (const auto& [nodes, trades] : lines_)
      draw_line(sheet, grid_label(nodes), trades, shade(n++, lines_.size()));
  }

private:
  Vec2 place(const Trade& trade) const {
    return {time_.position(trade.seconds), error_.position(trade.error)};
  }

  void draw_axes(Sheet& sheet) const {
    const Stroke line{style::hairline, style::ink};
    sheet.line({{time_.begin, top}, {time_.begin, bottom}, {right, bottom}}, line);
    const Ticks times = log_ticks(time_.low, time_.high);
    for (std::size_t n = 0; n < times.positions.size(); ++n)
      draw_bottom_tick(sheet, time_.position(times.positions[n]), times.labels[n]);
    const Ticks errors = log_ticks(error_.low, error_.high);
    for (std::size_t n = 0; n < errors.positions.size(); ++n)
      draw_left_tick(sheet, time_.begin, error_.position(errors.positions[n]), errors.labels[n]);
    draw_titles(sheet, time_.begin, right, "wall time / s", "relative error");
  }

  /// The border between what some run achieves and what none does: a staircase.
  void draw_front(Sheet& sheet) const {
    std::vector<Trade> front;
    std::ranges::copy_if(trades_, std::back_inserter(front), &Trade::on_front);
    if (front.empty()) return;
    std::ranges::sort(front, {}, &Trade::seconds);
    std::vector<Vec2> border;
    for (const Trade& trade : front) {
      const Vec2 corner = place(trade);
      border.push_back({corner[0], border.empty() ? top : border.back()[1]});
      border.push_back(corner);
    }
    border.push_back({right, border.back()[1]});
    sheet.line(std::move(border), {style::curve_width, beyond});
  }

  void draw_line(Sheet& sheet, const std::string& grid, const std::vector<Trade>& trades,
                 Color color) const {
    std::vector<Vec2> line;
    for (const Trade& trade : trades) line.push_back(place(trade));
    for (std::size_t n = 0; n < line.size(); ++n) {
      const Vec2& p = line[n];
      if (!trades[n].name.empty()) {
        sheet.disc(p, ring, style::ink);
        sheet.disc(p, ring - style::hairline, white);
        sheet.text({p[0] - ring, p[1] - ring - 0.5 * style::small_type}, trades[n].name,
                   {style::small_type, style::ink, 1});
      }
      sheet.disc(p, dot, color);
      if (!trades[n].on_front) sheet.disc(p, dot - 5, white);
    }
    const Vec2 end = line.back();
    sheet.text({end[0] + ring, end[1] + 0.4 * ring}, grid, {style::small_type, color, 0, true});
    sheet.line(std::move(line), {style::curve_width / 2, color});
  }

  std::vector<Trade> trades_;
  LogAxis time_, error_;
  std::map<std::array<int, 3>, std::vector<Trade>> lines_;
};

} // namespace

Picture draw_tradeoff(Studio& studio, std::span<const Trade> trades, int width) {
  std::vector<Trade> drawn;
  std::ranges::copy_if(trades, std::back_inserter(drawn), [](const Trade& trade) {
    return trade.error > 0 && std::isfinite(trade.error) && trade.seconds > 0;
  });
  if (drawn.empty()) throw RenderError("nothing to plot: no run reached its end with an error");
  Sheet sheet;
  TradeoffPlot(std::move(drawn)).draw(sheet);
  return print(studio, sheet, width);
}

} // namespace lamella::render
