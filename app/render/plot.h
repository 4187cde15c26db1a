#pragma once
#include "render/sheet.h"
#include "render/style.h"

#include <optional>
#include <string>
#include <vector>

namespace lamella::render {

struct Axis {
  std::string title; ///< with its unit, as Sheet::text() sets it
  bool logarithmic = false;
  std::optional<std::array<double, 2>> range{}; ///< else that of the data, with some air
};

/// Points joined in their order.
struct Series {
  std::string name; ///< beside its last point; none: not named
  Color color = style::ink;
  std::vector<Vec2> points{};
  double width = style::curve_width; ///< 0: points alone
  bool dashed = false;
  bool dots = false;          ///< at all points
  std::vector<bool> hollow{}; ///< which of the dots are; empty: none
};

/// A word in a plot; `offset` from its point in units of the sheet.
struct Note {
  Vec2 point;
  std::string text;
  TextStyle style;
  Vec2 offset{};
};

/// Series over axes. What is not finite, or not above 0 on a logarithmic axis, is left out.
struct Plot {
  Axis x, y;
  std::vector<Series> series;
  std::vector<Note> notes{};
};

/// Throws RenderError where there is nothing to plot.
void draw(Sheet& sheet, const Box& place, Plot plot);

/// A plot alone on a sheet 1400 units wide and 3/4 as high.
Sheet sheet_of(const Plot& plot);

} // namespace lamella::render
