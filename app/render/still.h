#pragma once
#include "render/block.h"
#include "render/paper.h"
#include "render/strip.h"

namespace lamella::render {

/// Pictures of one membrane at a time, all in the same place and at the same scale: those of a
/// movie. Each has its time and a scale bar.
class Still {
public:
  /// Framed so that all the surfaces fit in; with `turning`, from all azimuths.
  Still(const std::vector<Surface>& surfaces, const View& view, bool turning = false);

  /// `azimuth` in degrees, beyond that of the view. Throws RenderError.
  Picture draw(const Surface& surface, Studio& studio, int width, int height, double azimuth = 0,
               Background background = Background::white) const;

private:
  View view_;
  double elevation_;
  Extent extent_; ///< of all there is to see, lengths of the box
  bool has_phases_;
  std::optional<Palette> palette_;
};

} // namespace lamella::render
