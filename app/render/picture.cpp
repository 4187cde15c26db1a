#include "render/picture.h"

#include "parallel.h"

namespace lamella::render {
namespace {

/// The mean of factor x factor pixels, rounded to the nearest, the first of them at `corner`.
template <int factor>
Color mean(const Color* corner, std::size_t width) {
  constexpr int count = factor * factor;
  int r = count / 2, g = count / 2, b = count / 2, a = count / 2;
  for (int j = 0; j < factor; ++j, corner += width)
    for (int i = 0; i < factor; ++i) {
      const Color& c = corner[i];
      r += c.r, g += c.g, b += c.b, a += c.a;
    }
  using Byte = unsigned char;
  return {Byte(r / count), Byte(g / count), Byte(b / count), Byte(a / count)};
}

} // namespace

Picture reduce(std::span<const Color> image, int width, int factor) {
  const int height = int(image.size() / width);
  Picture small{width / factor, height / factor, {}};
  small.pixels.resize(std::size_t(small.width) * small.height);
  parallel_for(small.height, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const Color* corner = &image[(small.height - 1 - y) * factor * width];
      Color* const row = &small.pixels[y * small.width];
      for (int x = 0; x < small.width; ++x, corner += factor)
        row[x] = factor == 2 ? mean<2>(corner, width) : mean<1>(corner, width);
    }
  });
  return small;
}

} // namespace lamella::render
