#include "render/studio.h"

#include "render/render.h"
#include "render/sheet.h"
#include "vtkLamellaOffscreen.h"

#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace lamella::render {
namespace {

/// How a picture is sampled: on a lattice finer than its pixels, and by OpenGL several times on
/// each of its points. Large flat drawings are cheaper by the former, small panels full of
/// triangles by the latter.
struct Sampling {
  int oversampling, multisamples;
};
constexpr Sampling for_surfaces{2, 4}, for_sheets{3, 0};

/// The most that llvmpipe's framebuffers can be wide or high.
constexpr int largest_side = 16384;

/// Sheets are drawn in bands of so many rows: framebuffers of a whole page are slow to come by.
constexpr int band_rows = 256;

/// The window's pixels, rows from the top.
Picture read_pixels(vtkRenderWindow& window, int width, int height) {
  vtkNew<vtkUnsignedCharArray> bytes;
  window.GetPixelData(0, 0, width - 1, height - 1, 0, bytes);
  Picture picture{width, height, std::vector<Color>(std::size_t(width) * height)};
  if (bytes->GetNumberOfValues() != vtkIdType(3 * picture.pixels.size()))
    throw RenderError("the picture could not be read back from OpenGL");
  const auto* row = reinterpret_cast<const Color*>(bytes->GetPointer(0));
  for (int y = height - 1; y >= 0; --y, row += width)
    std::copy_n(row, width, &picture.pixels[std::size_t(y) * width]);
  return picture;
}

/// What transparent inks on white paper give.
Color multiply(const Color& a, const Color& b) {
  const auto channel = [](int x, int y) { return static_cast<unsigned char>((x * y + 127) / 255); };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

void print_over(Picture& paper, const Picture& print, int left, int top) {
  for (int y = std::max(0, -top); y < print.height && top + y < paper.height; ++y)
    for (int x = std::max(0, -left); x < print.width && left + x < paper.width; ++x) {
      Color& color = paper.pixels[std::size_t(top + y) * paper.width + left + x];
      color = multiply(color, print.at(x, y));
    }
}

} // namespace

Studio::Studio(const std::string& backend) {
  std::string why;
  if (!vtkLamellaOffscreen::Enable(backend, &why)) throw RenderError(why);
  window_ = vtkSmartPointer<vtkRenderWindow>::New();
  window_->OffScreenRenderingOn();
  window_->SetDPI(72); // a type size is a number of pixels
}

Picture Studio::shoot(vtkRenderer& renderer, int width, int height, int oversampling,
                      int multisamples) {
  const int w = width * oversampling, h = height * oversampling;
  window_->SetMultiSamples(multisamples);
  window_->SetSize(w, h);
  window_->AddRenderer(&renderer);
  window_->Render();
  const Picture picture = read_pixels(*window_, w, h);
  window_->RemoveRenderer(&renderer);
  return reduce(picture, oversampling);
}

Picture Studio::shoot(const Sheet& sheet, double scale, int width, int height) {
  const int factor = std::clamp(largest_side / width, 1, for_sheets.oversampling);
  Picture paper{width, 0, {}};
  for (int top = 0; top < height; top += band_rows) {
    vtkNew<vtkRenderer> band;
    band->SetBackground(1, 1, 1);
    sheet.show_in(*band, scale * factor, double(height - top - band_rows) * factor);
    const Picture rows = shoot(*band, width, band_rows, factor, for_sheets.multisamples);
    paper.pixels.insert(paper.pixels.end(), rows.pixels.begin(), rows.pixels.end());
  }
  paper.height = height;
  paper.pixels.resize(std::size_t(width) * height);
  return paper;
}

Picture Studio::shoot(const Panel& panel) {
  const int factor =
      std::clamp(largest_side / std::max(panel.width, panel.height), 1, for_surfaces.oversampling);
  return shoot(*panel.renderer, panel.width, panel.height, factor, for_surfaces.multisamples);
}

Picture Studio::shoot(int width, int height, const std::vector<Panel>& panels, const Sheet& sheet,
                      double scale) {
  Picture paper = shoot(sheet, scale, width, height);
  for (const Panel& panel : panels) print_over(paper, shoot(panel), panel.left, panel.top);
  return paper;
}

} // namespace lamella::render
