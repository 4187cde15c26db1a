#pragma once
#include "render/picture.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class QCPPainter;

namespace lamella::render {

using Vec2 = std::array<double, 2>;

/// A rectangle on a sheet.
struct Box {
  double left = 0, top = 0, width = 0, height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct Stroke {
  double width = 4;
  Color color;
};

enum class Face { regular, bold, oblique };

struct TextStyle {
  double size = 50; ///< of the type, its em
  Color color;
  double align = 0; ///< 0: starts at the anchor, 0.5: centred on it, 1: ends there
  Face face = Face::regular;
  bool upright = true; ///< false: turned by 90 degrees, reading upwards
};

/// Marks on a page: lines, discs, text and pictures, each drawn over those before. Lengths are in
/// units of 1/400 inch, x to the right and y down from the upper left corner. Begins Qt.
class Sheet {
public:
  explicit Sheet(double width = 0, double height = 0);

  double width() const { return width_; }
  double height() const { return height_; }
  void set_height(double height) { height_ = height; }

  /// A broken line with round corners; `closed` joins its ends.
  void line(const std::vector<Vec2>& points, const Stroke& stroke, bool closed = false);
  void disc(Vec2 center, double radius, Color color);
  /// Text on a base line through the anchor. Letters between asterisks are oblique, between two
  /// of them bold; those in _{...} stand lower: "*E* / *κ*_{Ld}".
  void text(Vec2 anchor, const std::string& text, const TextStyle& style);
  void picture(const Box& place, const Picture& picture);
  /// What else draws with Qt, in units of the sheet.
  void mark(std::function<void(QCPPainter&)> paint) { marks_.push_back(std::move(paint)); }

  /// Into the painter's own coordinates.
  void paint(QCPPainter& painter) const;

private:
  double width_, height_;
  std::vector<std::function<void(QCPPainter&)>> marks_;
};

/// As Sheet::text() sets it.
double text_width(const std::string& text, const TextStyle& style);

/// The text in lines that are no wider than that.
std::vector<std::string> wrapped(const std::string& text, const TextStyle& style, double width);

} // namespace lamella::render
