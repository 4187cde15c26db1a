#pragma once
#include "render/picture.h"
#include "render/surface.h"

#include <string>
#include <vector>

namespace lamella::render {

/// Values that the ends of a palette stand for.
struct ValueRange {
  double low, high;
};

/// Colours of a quantity on membranes, the same to all eyes: from blue through grey to red about a
/// middle, or from pale to dark where there is none.
class Palette {
public:
  Palette(const Quantity& quantity, ValueRange range);

  /// Of a value; those beyond the range have the colour of its end.
  const Color& at(double value) const;
  const ValueRange& range() const { return range_; }

private:
  ValueRange range_;
  std::vector<Color> colors_; ///< in equal steps
};

/// A range for all but the most extreme hundredths of a quantity on several surfaces; symmetric
/// about 0, or 1 for c, where the quantity has a middle there.
ValueRange range_of(const Quantity& quantity, const std::vector<Surface>& surfaces);

} // namespace lamella::render
