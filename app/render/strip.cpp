#include "render/strip.h"

#include "render/labels.h"
#include "render/style.h"

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

constexpr double label_height = 80, footer_height = 130, gap = 60, rim = 10;

/// A bar of round length (1, 2 or 5 times a power of ten), at most `longest`, and its length in box
/// units L.
void add_scale_bar(Sheet& sheet, const Vec2& right_end, double units_per_length, double longest) {
  const double power = std::pow(10, std::floor(std::log10(longest)));
  const double length =
      longest >= 5 * power ? 5 * power : (longest >= 2 * power ? 2 * power : power);
  const double left = right_end[0] - length * units_per_length;
  sheet.line({{left, right_end[1]}, right_end}, {style::curve_width, style::ink});
  sheet.text({(left + right_end[0]) / 2, right_end[1] - 22}, number(length) + " *L*",
             {style::small_type, style::ink, 0.5});
}

constexpr double legend_width = 250;

/// What the colours of two phases mean, from `left` on.
void add_legend(Sheet& sheet, const Vec2& left) {
  constexpr double radius = 17;
  double x = left[0] + radius;
  for (const auto& [part, name] : {std::pair(Part::Ld, "Ld"), std::pair(Part::Lo, "Lo")}) {
    sheet.disc({x, left[1] - 0.36 * style::small_type}, radius, hue(part).surface);
    sheet.text({x + radius + 14, left[1]}, name, {style::small_type, style::ink});
    x += legend_width / 2;
  }
}

/// The colours of a quantity and their values, from `left` on.
void add_color_bar(Sheet& sheet, const Vec2& left, const Palette& palette, const Quantity& quantity,
                   const Units& units) {
  constexpr double length = 360, thickness = 26;
  const auto [low, high] = palette.range();
  Picture bar{256, 1, {}};
  for (int n = 0; n < bar.width; ++n)
    bar.pixels.push_back(palette.at(std::lerp(low, high, n / 255.0)));
  const double top = left[1] - thickness;
  const TextStyle small{style::small_type, style::ink};
  double x = left[0];
  sheet.text({x, left[1]}, number(low, 2), small);
  x += text_width(number(low, 2), small) + 16;
  sheet.picture({x, top, length, thickness}, bar);
  sheet.text({x + length / 2, top - 16}, notation_on_membrane(quantity.name).title(units),
             {style::small_type, style::ink, 0.5});
  sheet.text({x + length + 16, left[1]}, number(high, 2), small);
}

/// Two short arrows that name the axes of the cross-sections.
void add_axes(Sheet& sheet, const Vec2& origin) {
  constexpr double length = 60, head = 13;
  const Stroke stroke{style::hairline, style::ink};
  const auto [x, y] = origin;
  sheet.line({{x + length, y}, {x, y}, {x, y - length}}, stroke);
  sheet.line(
      {{x + length - head, y - head / 2}, {x + length, y}, {x + length - head, y + head / 2}},
      stroke);
  sheet.line(
      {{x - head / 2, y - length + head}, {x, y - length}, {x + head / 2, y - length + head}},
      stroke);
  sheet.text({x + length + 12, y + 14}, "*x*", {style::small_type, style::ink});
  sheet.text({x + 22, y - length + 22}, "*z*", {style::small_type, style::ink});
}

} // namespace

/// Where everything goes, from the upper left corner of the strip.
struct Strip::Layout {
  bool beside = false;                  ///< sections beside the views
  double cell = 0;                      ///< width of a state
  double scale = 0;                     ///< page units per length of the box
  double top = 0, rows = 0;             ///< of the views; height of views and sections together
  double type_size = style::small_type; ///< of the times, smaller where states are narrow
  Vec2 view, section;                   ///< their middles, from the upper left corner of a state

  Layout(const Strip& strip, double width) {
    const Extent &seen = strip.seen_, &cut = strip.cut_;
    const bool sections = strip.view_.section;
    beside = sections && strip.sections_stand_beside();
    const double count = double(strip.states_.size());
    cell = (width - (count - 1) * gap) / count;
    const double across = beside ? seen.width() + cut.width() + 0.4 * seen.width() : seen.width();
    const double tallest = sections ? std::max(seen.height(), cut.height()) : seen.height();
    scale = std::min((cell - 2 * rim) / across, strip.tallest_ / tallest);
    const double view_height = scale * seen.height() + 2 * rim;
    const double section_height = sections ? scale * cut.height() + 2 * rim : 0;
    top = strip.heading_.height() + label_height;
    double widest = 0;
    for (const Surface& state : strip.states_)
      widest = std::max(widest,
                        text_width(time_label(state.time, state.units), {type_size, style::ink}));
    type_size *= std::min(1.0, cell / widest);
    if (beside) {
      rows = std::max(view_height, section_height);
      const double half = 0.5 * scale * across;
      view = {cell / 2 - half + 0.5 * scale * seen.width(), rows / 2};
      section = {cell / 2 + half - 0.5 * scale * cut.width(), rows / 2};
    } else {
      rows = view_height + (sections ? gap + section_height : 0);
      view = {cell / 2, view_height / 2};
      section = {cell / 2, rows - section_height / 2};
    }
  }

  double height() const { return top + rows + footer_height; }
};

Strip::Strip(Heading heading, std::vector<Surface> states, const View& view, double tallest)
    : heading_(std::move(heading)), states_(std::move(states)), view_(view), tallest_(tallest),
      viewpoint_(view.elevation ? *view.elevation : suitable_elevation(states_), view.azimuth) {
  for (const Surface& state : states_) {
    seen_.include(view_extent(state, viewpoint_));
    if (!view_.section) continue;
    sections_.push_back(cross_section(state, view_.azimuth));
    cut_.include(extent_of(sections_.back()));
  }
  if (view_.section && !sections_stand_beside()) { // the same x below each other
    cut_.low[0] = seen_.low[0];
    cut_.high[0] = seen_.high[0];
  }
  if (view_.color != Quantity::phase)
    palette_.emplace(view_.color, view_.range ? *view_.range : range_of(view_.color, states_));
}

void draw_keys(Sheet& sheet, const Box& place, double scale, const Palette* palette,
               const Quantity& quantity, const Units& units, bool phases, double longest) {
  if (palette)
    add_color_bar(sheet, {place.left, place.top}, *palette, quantity, units);
  else if (phases)
    add_legend(sheet, {place.left, place.top});
  add_scale_bar(sheet, {place.right(), place.top}, scale, longest / scale);
}

double Strip::height(double width) const { return Layout(*this, width).height(); }

bool Strip::sections_stand_beside() const {
  const double tall = states_.size() == 1 ? 0.9 : 1.4; // a single state has the room
  return seen_.height() > tall * seen_.width();
}

bool Strip::has_phases() const { return std::ranges::any_of(states_, &Surface::has_phases); }

void Strip::draw_state(Sheet& sheet, const Layout& layout, std::size_t n, const Box& place,
                       Camera camera) const {
  const double left = place.left + double(n) * (layout.cell + gap), top = place.top + layout.top;
  sheet.text({left + layout.cell / 2, top - 0.5 * style::type_size},
             time_label(states_[n].time, units()), {layout.type_size, style::ink, 0.5});
  const int columns = int(std::ceil((layout.scale * seen_.width() + 2 * rim) * camera.pixels));
  const int rows = int(std::ceil((layout.scale * seen_.height() + 2 * rim) * camera.pixels));
  const double width = columns / camera.pixels, height = rows / camera.pixels;
  const auto view = membrane_view(states_[n], viewpoint_, seen_.center(), height / layout.scale,
                                  style::boundary_width / layout.scale,
                                  {view_.color, palette_ ? &*palette_ : nullptr});
  sheet.picture(
      {left + layout.view[0] - width / 2, top + layout.view[1] - height / 2, width, height},
      camera.studio.shoot(*view, columns, rows));
  if (!view_.section) return;
  const Vec2 center = cut_.center();
  for (const Outline& outline : sections_[n]) {
    std::vector<Vec2> points;
    for (const Vec2& p : outline.points)
      points.push_back({left + layout.section[0] + layout.scale * (p[0] - center[0]),
                        top + layout.section[1] - layout.scale * (p[1] - center[1])});
    sheet.line(points, {style::curve_width, hue(outline.part).line}, outline.closed);
    if (!outline.closed) sheet.disc(points.front(), style::boundary_width, style::ink);
  }
}

void Strip::draw_footer(Sheet& sheet, const Layout& layout, const Box& place) const {
  const double base = place.top + layout.height() - 30;
  if (view_.section && view_.azimuth == 0) add_axes(sheet, {place.left + 10, base});
  const double indent = view_.section ? 160 : 0, longest = std::min(place.width, 1.3 * layout.cell);
  draw_keys(sheet, {place.left + indent, base, place.width - indent, 0}, layout.scale,
            palette_ ? &*palette_ : nullptr, view_.color, units(), has_phases(), 0.33 * longest);
}

void Strip::draw(Sheet& sheet, const Box& place, Camera camera) const {
  const Layout layout(*this, place.width);
  heading_.draw(sheet, place);
  for (std::size_t n = 0; n < states_.size(); ++n) draw_state(sheet, layout, n, place, camera);
  draw_footer(sheet, layout, place);
}

} // namespace lamella::render
