#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

namespace lamella::render {

struct Color {
  unsigned char r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};

/// An image of 8-bit colours, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Color> pixels;

  const Color& at(int x, int y) const { return pixels[std::size_t(y) * width + x]; }
};

/// The picture made smaller by a whole factor that divides both sides: each pixel is the mean of
/// factor^2.
Picture reduce(const Picture& picture, int factor);

/// Write a PNG file; it appears whole or not at all. Throws StoreError.
void write_png(const std::filesystem::path& file, const Picture& picture);

} // namespace lamella::render
