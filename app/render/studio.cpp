#include "render/studio.h"

#include "render/render.h"
#include "vtkLamellaOffscreen.h"

#include <algorithm>

namespace lamella::render {
namespace {

/// Views are sampled on a lattice finer than their pixels. OpenGL's own multisampling on top of it
/// takes four times as long in software.
constexpr int oversampling = 2;

/// The most that llvmpipe's framebuffers can be wide or high.
constexpr int largest_side = 16384;

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
  window_->GetRGBACharPixelData(0, 0, width * factor - 1, height * factor - 1, 0, bytes_);
  window_->RemoveRenderer(&renderer);
  const std::size_t count = std::size_t(width) * height * factor * factor;
  if (bytes_->GetNumberOfValues() != vtkIdType(4 * count))
    throw RenderError("the picture could not be read back from OpenGL");
  const auto* pixels = reinterpret_cast<const Color*>(bytes_->GetPointer(0));
  return reduce({pixels, count}, width * factor, factor);
}

} // namespace lamella::render
