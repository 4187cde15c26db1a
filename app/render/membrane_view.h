#pragma once
#include "render/palette.h"
#include "render/sheet.h"
#include "render/surface.h"

#include <vtkRenderer.h>

namespace lamella::render {

/// A rectangle in the plane of a picture, lengths of the box.
struct Extent {
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};

  void include(const Vec2& p);
  void include(const Extent& other);
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
  Vec2 center() const { return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2}; }
};

/// Where membranes are seen from, in parallel projection. z points up.
class Viewpoint {
public:
  /// `elevation` of the eye above the x-y plane, and its `azimuth` around z, in degrees: at 0 it
  /// looks along y, so that x points to the right at full length.
  explicit Viewpoint(double elevation, double azimuth = 0);

  Vec2 project(const Vec3& p) const;
  /// A point, or direction, from its place in the view: right, up, toward the eye.
  Vec3 lift(const Vec3& view) const;

private:
  Vec3 right_, up_, toward_eye_;
};

/// The elevation that suits shapes: flat ones are seen obliquely (their dimples show), tall ones
/// almost from the side (they keep their length).
double suitable_elevation(const std::vector<Surface>& surfaces);

/// What a membrane covers in the plane of its view.
Extent view_extent(const Surface& surface, const Viewpoint& viewpoint);

/// The lit membrane, with a dark line where two phases meet. Its colours are those of its phases,
/// or of a quantity in the surface's point data. `center` is the point of the view plane in the
/// middle of the panel; the panel's `height` and the line's width are lengths of the box.
struct Coloring {
  Quantity quantity = Quantity::phase;
  const Palette* palette = nullptr; ///< of all but phases
};
vtkSmartPointer<vtkRenderer> membrane_view(const Surface& surface, const Viewpoint& viewpoint,
                                           const Vec2& center, double height, double line_width,
                                           const Coloring& coloring = {});

} // namespace lamella::render
