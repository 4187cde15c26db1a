#include "render/still.h"

#include "render/style.h"

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

constexpr double page_width = 1400; ///< of a picture in units of a sheet: type as in plots
constexpr double margin = 40, head = 110, foot = 130;

/// The part of a page that a view fills: whole pixels of the page, and no more than it needs.
struct Window {
  int columns, rows;
  Box place;   ///< on the page
  Vec2 center; ///< of what is seen there, lengths of the box

  /// An extent with a margin around it, its middle at a place on the page.
  Window(const Extent& extent, double scale, const Vec2& middle, double pixels) {
    const auto edge = [&](double at) { return int(std::lround(at * pixels)); };
    const double across = scale * extent.width() / 2 + margin,
                 up = scale * extent.height() / 2 + margin;
    const int left = edge(middle[0] - across), top = edge(middle[1] - up);
    columns = edge(middle[0] + across) - left;
    rows = edge(middle[1] + up) - top;
    place = {left / pixels, top / pixels, columns / pixels, rows / pixels};
    center = {extent.center()[0] + (place.left + place.width / 2 - middle[0]) / scale,
              extent.center()[1] - (place.top + place.height / 2 - middle[1]) / scale};
  }
};

} // namespace

Still::Still(const std::vector<Surface>& surfaces, const View& view, bool turning)
    : view_(view), elevation_(view.elevation ? *view.elevation : suitable_elevation(surfaces)),
      has_phases_(std::ranges::any_of(surfaces, &Surface::has_phases)) {
  for (const Surface& surface : surfaces)
    for (double turn = 0; turn < (turning ? 360 : 1); turn += 15)
      extent_.include(view_extent(surface, Viewpoint(elevation_, view.azimuth + turn)));
  if (view.color != Quantity::phase)
    palette_.emplace(view.color, view.range ? *view.range : range_of(view.color, surfaces));
}

Picture Still::draw(const Surface& surface, Studio& studio, int width, int height, double azimuth,
                    Background background) const {
  const double pixels = width / page_width, page_height = height / pixels;
  const double scale = std::min((page_width - 2 * margin) / extent_.width(),
                                (page_height - head - foot) / extent_.height());
  const Window window(extent_, scale, {page_width / 2, (head + page_height - foot) / 2}, pixels);
  const auto renderer =
      membrane_view(surface, Viewpoint(elevation_, view_.azimuth + azimuth), window.center,
                    window.place.height / scale, style::boundary_width / scale,
                    {view_.color, palette_ ? &*palette_ : nullptr});
  Sheet sheet(page_width, page_height);
  sheet.picture(window.place, studio.shoot(*renderer, window.columns, window.rows));
  sheet.text({margin, margin + 0.8 * style::type_size}, time_label(surface.time, surface.units),
             {style::type_size, style::ink});
  draw_keys(sheet, {margin, page_height - margin, page_width - 2 * margin, 0}, scale,
            palette_ ? &*palette_ : nullptr, view_.color, surface.units, has_phases_,
            0.25 * page_width);
  return print(sheet, width, background);
}

} // namespace lamella::render
