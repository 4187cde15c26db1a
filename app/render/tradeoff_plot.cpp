#include "render/tradeoff_plot.h"

#include "render/labels.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lamella::render {
namespace {

constexpr Color beyond{214, 214, 220};

/// From coarse to fine grids: from a pale to a dark shade of the membrane's colour.
Color shade(std::size_t n, std::size_t count) {
  const double s = count == 1 ? 0.5 : double(n) / double(count - 1);
  const auto mix = [s](int pale, int dark) {
    return static_cast<unsigned char>(std::lerp(pale, dark, s));
  };
  return {mix(244, 96), mix(166, 20), mix(120, 44)};
}

/// Half a decade at least, with room for names on the left.
std::array<double, 2> time_range(const std::vector<Trade>& trades) {
  const auto [least, most] = std::ranges::minmax(trades, {}, &Trade::seconds);
  const double extent = std::max(std::log10(most.seconds / least.seconds), 0.4);
  return {least.seconds * std::pow(10, -0.25 * extent), most.seconds * std::pow(10, 0.12 * extent)};
}

/// The border between what some run achieves and what none does: a staircase.
Series front(const std::vector<Trade>& trades, double end) {
  std::vector<Trade> best;
  std::ranges::copy_if(trades, std::back_inserter(best), &Trade::on_front);
  std::ranges::sort(best, {}, &Trade::seconds);
  Series border{"", beyond};
  if (best.empty()) return border;
  border.points.push_back({best.front().seconds, 10 * best.front().error});
  for (const Trade& trade : best) {
    border.points.push_back({trade.seconds, border.points.back()[1]});
    border.points.push_back({trade.seconds, trade.error});
  }
  border.points.push_back({end, border.points.back()[1]});
  return border;
}

Series line_of(const std::vector<Trade>& trades, Color color) {
  Series line{"", color};
  line.width = style::curve_width / 2;
  line.dots = true;
  for (const Trade& trade : trades) {
    line.points.push_back({trade.seconds, trade.error});
    line.hollow.push_back(!trade.on_front);
  }
  return line;
}

} // namespace

Plot tradeoff_plot(std::span<const Trade> all) {
  std::vector<Trade> trades;
  std::ranges::copy_if(all, std::back_inserter(trades), [](const Trade& trade) {
    return trade.error > 0 && std::isfinite(trade.error) && trade.seconds > 0;
  });
  if (trades.empty()) throw RenderError("nothing to plot: no run reached its end with an error");
  const auto [least, most] = std::ranges::minmax(trades, {}, &Trade::error);
  const double extent = std::pow(most.error / least.error, 0.12);
  Plot plot{{"wall time / s", true, time_range(trades)},
            {"relative error", true, {{least.error / extent / 1.2, most.error * extent * 1.2}}},
            {}};
  plot.series.push_back(front(trades, (*plot.x.range)[1]));
  std::map<std::array<int, 3>, std::vector<Trade>> grids;
  for (const Trade& trade : trades) grids[trade.nodes].push_back(trade);
  std::size_t n = 0;
  for (const auto& [nodes, on_grid] : grids) {
    const Color color = shade(n++, grids.size());
    plot.series.push_back(line_of(on_grid, color));
    const Trade& last = on_grid.back();
    plot.notes.push_back({{last.seconds, last.error},
                          grid_label(nodes),
                          {style::small_type, color, 0, Face::bold},
                          {24, -18}});
  }
  for (const Trade& trade : trades)
    if (!trade.name.empty())
      plot.notes.push_back({{trade.seconds, trade.error},
                            trade.name,
                            {style::small_type, style::ink, 1},
                            {-24, 50}});
  return plot;
}

} // namespace lamella::render
