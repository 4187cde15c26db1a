#pragma once
#include "render/fonts.h"
#include "render/picture.h"

#include <array>
#include <string>
#include <vector>

class vtkContext2D;
class vtkRenderer;

namespace lamella::render {

using Vec2 = std::array<double, 2>;

struct Stroke {
  double width = 4;
  Color color;
};

struct TextStyle {
  double size = 50; ///< of the type, its em
  Color color;
  double align = 0; ///< 0: starts at the anchor, 0.5: centred on it, 1: ends there
  bool bold = false;
  bool upright = true; ///< false: turned by 90 degrees, reading upwards
};

/// Marks on a page: lines, discs and text, drawn in the order of the calls over whatever lies
/// below. Lengths are in units of the page, x to the right and y up from the lower left corner.
class Sheet {
public:
  /// A broken line with mitred corners; `closed` joins its ends.
  void line(std::vector<Vec2> points, const Stroke& stroke, bool closed = false);
  void disc(Vec2 center, double radius, Color color);
  /// Text on a base line through the anchor. Letters between asterisks are oblique: "*E* / *κ*".
  void text(Vec2 anchor, std::string text, const TextStyle& style);

  /// Draw through VTK; `scale` is pixels per unit.
  void paint(vtkContext2D& painter, double scale) const;
  /// Show the sheet from `bottom` (in pixels) upward in a renderer. The sheet must outlive it.
  void show_in(vtkRenderer& renderer, double scale, double bottom) const;

private:
  struct Line {
    std::vector<Vec2> points;
    Stroke stroke;
    bool closed;
  };
  struct Disc {
    Vec2 center;
    double radius;
    Color color;
  };
  struct Text {
    Vec2 anchor;
    std::string text;
    TextStyle style;
  };
  static void paint(const Line& line, vtkContext2D& painter, double scale);
  static void paint(const Text& text, vtkContext2D& painter, double scale);

  std::vector<Line> lines_;
  std::vector<Disc> discs_;
  std::vector<Text> texts_;
};

} // namespace lamella::render
