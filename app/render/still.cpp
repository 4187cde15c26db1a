#include "render/still.h"

#include "render/style.h"

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

constexpr double page_width = 1400; ///< of a picture in units of a sheet: type as in plots
constexpr double margin = 40, head = 110, foot = 130;

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
  const Viewpoint viewpoint(elevation_, view_.azimuth + azimuth);
  const double shift = (foot - head) / (2 * scale); // to the middle between head and foot
  const Vec2 center{extent_.center()[0], extent_.center()[1] - shift};
  const auto renderer =
      membrane_view(surface, viewpoint, center, page_height / scale, style::boundary_width / scale,
                    {view_.color, palette_ ? &*palette_ : nullptr});
  Sheet sheet(page_width, page_height);
  sheet.picture({0, 0, page_width, page_height}, studio.shoot(*renderer, width, height));
  sheet.text({margin, margin + 0.8 * style::type_size}, time_label(surface.time),
             {style::type_size, style::ink});
  draw_keys(sheet, {margin, page_height - margin, page_width - 2 * margin, 0}, scale,
            palette_ ? &*palette_ : nullptr, view_.color, has_phases_, 0.25 * page_width);
  return print(sheet, width, background);
}

} // namespace lamella::render
