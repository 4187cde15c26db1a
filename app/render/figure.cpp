#include "render/figure.h"

#include "render/cross_section.h"
#include "render/labels.h"
#include "render/membrane_view.h"
#include "render/render.h"
#include "render/sheet.h"
#include "render/style.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamella::render {
namespace {

constexpr double margin = 50, gap = 70, header = 110, footer = 120, legend_width = 260;

std::string time_label(double time) { return "*t* = " + number(time); }

/// A bar of round length (1, 2 or 5 times a power of ten), at most `longest`, and its length in box
/// units L.
void add_scale_bar(Sheet& sheet, const Vec2& right_end, double units_per_length, double longest) {
  const double power = std::pow(10, std::floor(std::log10(longest)));
  const double length =
      longest >= 5 * power ? 5 * power : (longest >= 2 * power ? 2 * power : power);
  const double left = right_end[0] - length * units_per_length;
  sheet.line({{left, right_end[1]}, right_end}, {style::curve_width, style::ink});
  sheet.text({(left + right_end[0]) / 2, right_end[1] + 24}, number(length) + " *L*",
             {style::small_type, style::ink, 0.5});
}

/// Where everything of a figure goes, in units of the page.
struct Layout {
  Extent view, section; ///< of both states together, lengths of the box
  bool beside;          ///< sections beside the 3-D views
  double scale;         ///< page units per length of the box
  double column;        ///< width of a column
  double view_height, section_height, height;

  Layout(const std::array<Extent, 2>& views, const std::array<Extent, 2>& sections) {
    for (const Extent& e : views) view.include(e);
    for (const Extent& e : sections) section.include(e);
    section.low[0] = view.low[0]; // the same x below each other
    section.high[0] = view.high[0];
    beside = view.height() > 1.4 * view.width();
    column = (style::page_width - 2 * margin - gap) / 2;
    const double across = beside ? view.width() + section.width() : view.width();
    const double tallest = std::max(view.height(), section.height());
    scale = std::min((column - (beside ? 3 : 1) * gap) / across, 800 / tallest);
    view_height = scale * view.height() + gap;
    section_height = scale * section.height() + gap;
    height = header + footer +
             (beside ? std::max(view_height, section_height) : view_height + section_height);
  }

  double left(int state) const { return margin + state * (column + gap); }
  /// Middle of the 3-D view, of the section.
  Vec2 view_center(int state) const {
    if (!beside) return {left(state) + column / 2, height - header - view_height / 2};
    return {left(state) + column / 2 - (scale * section.width() + gap) / 2,
            footer + (height - header - footer) / 2};
  }
  Vec2 section_center(int state) const {
    if (!beside) return {left(state) + column / 2, footer + section_height / 2};
    return {left(state) + column / 2 + (scale * view.width() + gap) / 2,
            footer + (height - header - footer) / 2};
  }
};

void add_state(Sheet& sheet, const Layout& layout, int state, double time,
               const std::vector<Outline>& section) {
  const double base_line = layout.height - margin - 0.75 * style::type_size;
  TextStyle letter{style::type_size, style::ink};
  letter.bold = true;
  sheet.text({layout.left(state), base_line}, state == 0 ? "a" : "b", letter);
  sheet.text({layout.left(state) + layout.column / 2, base_line}, time_label(time),
             {style::type_size, style::ink, 0.5});
  const Vec2 middle = layout.section_center(state), center = layout.section.center();
  for (Outline line : section) {
    for (Vec2& p : line.points)
      for (int a = 0; a < 2; ++a) p[a] = middle[a] + layout.scale * (p[a] - center[a]);
    if (!line.closed) sheet.disc(line.points.front(), style::boundary_width, style::ink);
    sheet.line(std::move(line.points), {style::curve_width, hue(line.part).line}, line.closed);
  }
}

/// What the colours of two phases mean, from `left` on.
void add_legend(Sheet& sheet, const Vec2& left) {
  constexpr double radius = 17;
  double x = left[0] + radius;
  for (const auto& [part, name] : {std::pair(Part::Ld, "Ld"), std::pair(Part::Lo, "Lo")}) {
    sheet.disc({x, left[1] + 0.36 * style::small_type}, radius, hue(part).surface);
    sheet.text({x + radius + 14, left[1]}, name, {style::small_type, style::ink});
    x += legend_width / 2;
  }
}

/// Two short arrows that name the axes of the cross-sections.
void add_axes(Sheet& sheet, const Vec2& origin) {
  constexpr double length = 80, head = 14;
  const Stroke stroke{style::hairline, style::ink};
  const auto [x, y] = origin;
  sheet.line({{x + length, y}, {x, y}, {x, y + length}}, stroke);
  sheet.line(
      {{x + length - head, y - head / 2}, {x + length, y}, {x + length - head, y + head / 2}},
      stroke);
  sheet.line(
      {{x - head / 2, y + length - head}, {x, y + length}, {x + head / 2, y + length - head}},
      stroke);
  sheet.text({x + length + 12, y - 16}, "*x*", {style::small_type, style::ink});
  sheet.text({x - 2, y + length + 18}, "*z*", {style::small_type, style::ink, 0.5});
}

/// The view of a membrane with `middle` of the page in the middle of `extent`, which it covers and
/// a rim; `scale` is page units per length, `pixels` pixels per page unit.
Panel place(const Surface& surface, const Viewpoint& viewpoint, const Extent& extent, double scale,
            const Vec2& middle, double page_height, double pixels) {
  constexpr double rim = 10;
  const auto whole = [&](double x) { return int(std::lround(x * pixels)); };
  const double width = scale * extent.width() + 2 * rim, height = scale * extent.height() + 2 * rim;
  const int rows = whole(height);
  return {membrane_view(surface, viewpoint, extent.center(), rows / (scale * pixels),
                        style::boundary_width / scale),
          whole(middle[0] - width / 2), whole(page_height - middle[1] - height / 2), whole(width),
          rows};
}

} // namespace

Picture draw_figure(Studio& studio, const Surface& start, const Surface& end, int width) {
  const std::array<const Surface*, 2> states{&start, &end};
  const std::array sections{cross_section(start), cross_section(end)};
  const Viewpoint viewpoint = Viewpoint::suited_to({&start, &end});
  const Layout layout({view_extent(start, viewpoint), view_extent(end, viewpoint)},
                      {extent_of(sections[0]), extent_of(sections[1])});
  const double pixels = width / style::page_width; // per unit
  Sheet sheet;
  std::vector<Panel> panels;
  for (int s : {0, 1}) {
    add_state(sheet, layout, s, states[s]->fine.time, sections[s]);
    const Extent& view = layout.view;
    panels.push_back(place(*states[s], viewpoint, view, layout.scale, layout.view_center(s),
                           layout.height, pixels));
  }
  add_axes(sheet, {margin + 10, margin});
  if (start.has_phases() || end.has_phases())
    add_legend(sheet, {style::page_width / 2 - legend_width / 2, margin});
  add_scale_bar(sheet, {style::page_width - margin, margin}, layout.scale,
                0.45 * layout.column / layout.scale);
  return studio.shoot(width, int(std::lround(layout.height * pixels)), panels, sheet, pixels);
}

Picture draw_membrane(Studio& studio, const Surface& surface, int width, int height) {
  const double pixels = width / style::page_width; // per unit
  const double page_height = height / pixels;
  const Viewpoint viewpoint = Viewpoint::suited_to({&surface});
  const Extent extent = view_extent(surface, viewpoint);
  const double scale =
      0.9 * std::min((style::page_width - 2 * margin) / extent.width(),
                     (page_height - 2 * header) / extent.height()); // units per length
  Sheet sheet;
  sheet.text({margin, page_height - margin - 0.75 * style::type_size},
             time_label(surface.fine.time), {style::type_size, style::ink});
  add_scale_bar(sheet, {style::page_width - margin, margin}, scale,
                0.25 * style::page_width / scale);
  if (surface.has_phases()) add_legend(sheet, {margin, margin});
  const Vec2 middle{style::page_width / 2, page_height / 2};
  const Panel panel = place(surface, viewpoint, extent, scale, middle, page_height, pixels);
  return studio.shoot(width, height, {panel}, sheet, pixels);
}

} // namespace lamella::render
