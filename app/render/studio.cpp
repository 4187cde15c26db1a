#include "render/studio.h"

#include "render/render.h"
#include "vtkLamellaOffscreen.h"

#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace lamella::render {
namespace {

/// Views are sampled on a lattice finer than their pixels. OpenGL's own multisampling on top of it
/// takes four times as long in software.
constexpr int oversampling = 2;

/// The most that llvmpipe's framebuffers can be wide or high.
constexpr int largest_side = 16384;

/// The window's pixels, rows from the top.
Picture read_pixels(vtkRenderWindow& window, int width, int height) {
  vtkNew<vtkUnsignedCharArray> bytes;
  window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, bytes);
  Picture picture{width, height, std::vector<Color>(std::size_t(width) * height)};
  if (bytes->GetNumberOfValues() != vtkIdType(4 * picture.pixels.size()))
    throw RenderError("the picture could not be read back from OpenGL");
  const auto* row = reinterpret_cast<const Color*>(bytes->GetPointer(0));
  for (int y = height - 1; y >= 0; --y, row += width)
    std::copy_n(row, width, &picture.pixels[std::size_t(y) * width]);
  return picture;
}

} // namespace

Studio::Studio(const std::string& backend) {
  std::string why;
  if (!vtkLamellaOffscreen::Enable(backend, &why)) throw RenderError(why);
  window_ = vtkSmartPointer<vtkRenderWindow>::New();
  window_->OffScreenRenderingOn();
  window_->SetAlphaBitPlanes(1);
  window_->SetMultiSamples(0);
}

Picture Studio::shoot(vtkRenderer& renderer, int width, int height) {
  const int factor = std::clamp(largest_side / std::max(width, height), 1, oversampling);
  renderer.SetBackground(0, 0, 0); // and transparent: where the two mix, colours are multiplied
  renderer.SetBackgroundAlpha(0);  // by their opacity
  window_->SetSize(width * factor, height * factor);
  window_->AddRenderer(&renderer);
  window_->Render();
  const Picture picture = read_pixels(*window_, width * factor, height * factor);
  window_->RemoveRenderer(&renderer);
  return reduce(picture, factor);
}

} // namespace lamella::render
