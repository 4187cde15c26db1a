#pragma once
#include "render/block.h"
#include "render/cross_section.h"
#include "render/membrane_view.h"

#include <optional>

namespace lamella::render {

/// How membranes are looked at.
struct View {
  std::optional<double> elevation{}; ///< degrees; none: what suits the shapes
  double azimuth = 0;                ///< degrees
  Quantity color = Quantity::phase;
  std::optional<ValueRange> range{}; ///< of the colours; none: what suits the surfaces
  bool section = false;              ///< cross-sections too
};

/// Membranes side by side, all at the same scale, with their times, a scale bar and what the
/// colours mean; cross-sections stand below, or beside where there is room, or shapes are tall.
class Strip : public Block {
public:
  /// No view is higher than `tallest`, in units of the sheet.
  Strip(Heading heading, std::vector<Surface> states, const View& view, double tallest = 800);
  double height(double width) const override;
  void draw(Sheet& sheet, const Box& place, Camera camera) const override;

private:
  struct Layout;
  void draw_state(Sheet& sheet, const Layout& layout, std::size_t n, const Box& place,
                  Camera camera) const;
  void draw_footer(Sheet& sheet, const Layout& layout, const Box& place) const;
  bool has_phases() const;
  const Units& units() const { return states_.front().units; }
  bool sections_stand_beside() const;

  Heading heading_;
  std::vector<Surface> states_;
  View view_;
  double tallest_;
  Viewpoint viewpoint_;
  Extent seen_, cut_; ///< of all states together, lengths of the box
  std::vector<std::vector<Outline>> sections_;
  std::optional<Palette> palette_;
};

/// Along the upper side of a box: what colours mean, if anything, and at its right end a scale bar,
/// not longer than `longest`. `scale`: units of the sheet per length of the box.
void draw_keys(Sheet& sheet, const Box& place, double scale, const Palette* palette,
               const Quantity& quantity, const Units& units, bool phases, double longest);

} // namespace lamella::render
