#include "render/picture.h"

namespace lamella::render {

Picture reduce(const Picture& picture, int factor) {
  Picture small{picture.width / factor, picture.height / factor, {}};
  small.pixels.resize(std::size_t(small.width) * small.height);
  const int count = factor * factor;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      int r = count / 2, g = count / 2, b = count / 2, a = count / 2; // rounds to the nearest
      for (int j = 0; j < factor; ++j)
        for (int i = 0; i < factor; ++i) {
          const Color& c = picture.at(x * factor + i, y * factor + j);
          r += c.r, g += c.g, b += c.b, a += c.a;
        }
      using Byte = unsigned char;
      small.pixels[std::size_t(y) * small.width + x] = {Byte(r / count), Byte(g / count),
                                                        Byte(b / count), Byte(a / count)};
    }
  return small;
}

} // namespace lamella::render
