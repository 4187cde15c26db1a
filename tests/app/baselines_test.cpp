#include "render/still.h"

#include <QImage>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

/// Panels beside pictures of them that somebody has looked at, in tests/app/baselines. To replace
/// these, after a change of the look: LAMELLA_NEW_BASELINES=1 render_test --gtest_filter=Panels.*
namespace lamella::render {
namespace {

namespace fs = std::filesystem;

constexpr int width = 480, height = 360;

template <class Phi>
Frame frame_of(Phi&& phi) {
  Frame frame{Grid::cube(48, 1), 2e-4, {}};
  for (std::size_t n = 0; n < frame.grid.size(); ++n)
    frame.phi.push_back(phi(frame.grid.position(n)));
  return frame;
}

/// Like a red blood cell.
Frame discocyte() {
  return frame_of([](const Vec3& p) {
    const double rho2 = (p[0] * p[0] + p[1] * p[1]) / 0.49;
    const double half = 0.10 + 0.35 * rho2;
    return 0.3 * (rho2 + p[2] * p[2] / (half * half) - 1);
  });
}

/// A pear with a cap of Ld.
Frame pear() {
  Frame frame = frame_of([](const Vec3& p) {
    return std::hypot(p[0], p[1]) / (1 - 0.5 * p[2]) + 0.6 * p[2] * p[2] - 0.32;
  });
  for (std::size_t n = 0; n < frame.grid.size(); ++n)
    frame.fields["psi"].push_back(0.15 - frame.grid.position(n)[2]);
  return frame;
}

Frame torus() {
  return frame_of(
      [](const Vec3& p) { return std::hypot(std::hypot(p[0], p[1]) - 0.5, p[2]) - 0.22; });
}

Picture panel(const Frame& frame, Quantity quantity, double elevation) {
  Studio studio("auto");
  const Surface surface = extract_surface(State{frame}, quantity);
  return Still({surface}, {.elevation = elevation, .color = quantity})
      .draw(surface, studio, width, height);
}

using Lab = std::array<double, 3>;

/// CIE L*a*b* of an sRGB colour: equal distances look equally different, 2.3 just noticeable.
Lab lab_of(const std::array<double, 3>& srgb) {
  std::array<double, 3> rgb{};
  for (int n = 0; n < 3; ++n) {
    const double c = srgb[n] / 255;
    rgb[n] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f((0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.9505);
  const double y = f(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
  const double z = f((0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Of the mean colour of a square of pixels: how fine an edge is drawn does not count.
Lab mean_lab(const QImage& image, int left, int top, int side) {
  std::array<double, 3> sum{};
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x) {
      const QRgb c = image.pixel(x, y);
      sum[0] += qRed(c), sum[1] += qGreen(c), sum[2] += qBlue(c);
    }
  for (double& channel : sum) channel /= side * side;
  return lab_of(sum);
}

struct Difference {
  double mean = 0, largest = 0;
};

Difference difference(const QImage& a, const QImage& b) {
  constexpr int side = 4;
  Difference result;
  for (int y = 0; y < height; y += side)
    for (int x = 0; x < width; x += side) {
      const Lab p = mean_lab(a, x, y, side), q = mean_lab(b, x, y, side);
      const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      result.mean += distance * side * side / (width * height);
      result.largest = std::max(result.largest, distance);
    }
  return result;
}

QImage image_of(const Picture& picture) {
  return QImage(reinterpret_cast<const uchar*>(picture.pixels.data()), picture.width,
                picture.height, QImage::Format_RGBA8888)
      .copy();
}

void expect_as_before(const std::string& name, const Picture& picture) {
  const fs::path file = fs::path(LAMELLA_SOURCE_DIR) / "tests/app/baselines" / (name + ".png");
  if (std::getenv("LAMELLA_NEW_BASELINES")) write_png(file, picture);
  const QImage before(QString::fromStdString(file.string()));
  ASSERT_EQ(before.size(), QSize(width, height)) << file;
  const auto [mean, largest] = difference(image_of(picture), before);
  EXPECT_LT(mean, 0.5);
  EXPECT_LT(largest, 8) << "four pixels together";
}

TEST(Panels, ShowADiscocyte) {
  expect_as_before("discocyte", panel(discocyte(), Quantity::phase, 35));
}

TEST(Panels, ShowTwoPhases) { expect_as_before("two_phases", panel(pear(), Quantity::phase, 12)); }

TEST(Panels, ShowTheCurvatureOfATorus) {
  expect_as_before("torus_curvature", panel(torus(), Quantity::K, 45));
}

TEST(Panels, AreToldApart) {
  const QImage red = image_of(panel(discocyte(), Quantity::phase, 35));
  const QImage turned = image_of(panel(discocyte(), Quantity::phase, 30));
  EXPECT_GT(difference(red, turned).largest, 16) << "five degrees are seen";
}

} // namespace
} // namespace lamella::render
