#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace lamella::render {

/// A colour, multiplied by its opacity `a`.
struct Color {
  unsigned char r = 0, g = 0, b = 0, a = 255;
  bool operator==(const Color&) const = default;
};

/// An image, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Color> pixels;

  const Color& at(int x, int y) const { return pixels[std::size_t(y) * width + x]; }
};

/// An image as OpenGL has it, rows from the bottom, made smaller by a whole factor that divides
/// both sides: each pixel is the mean of factor^2.
Picture reduce(std::span<const Color> image, int width, int factor);

} // namespace lamella::render
