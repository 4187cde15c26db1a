#include "render/studio.h"

#include "render/render.h"
#include "render/sheet.h"
#include "vtkLamellaOffscreen.h"

#include <vtkNew.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace lamella::render {
namespace {

constexpr int oversampling = 2;
constexpr int samples = 4; ///< of OpenGL, on top of that, for the rims of surfaces

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

} // namespace

Studio::Studio(const std::string& backend) {
  std::string why;
  if (!vtkLamellaOffscreen::Enable(backend, &why)) throw RenderError(why);
  window_ = vtkSmartPointer<vtkRenderWindow>::New();
  window_->OffScreenRenderingOn();
  window_->SetDPI(72); // a type size is a number of pixels
  window_->SetNumberOfLayers(2);
}

Picture Studio::shoot(int width, int height, const std::vector<Panel>& panels, const Sheet& sheet,
                      double scale) {
  window_->SetMultiSamples(panels.empty() ? 0 : samples);
  window_->SetSize(width * oversampling, height * oversampling);
  vtkNew<vtkRenderer> paper; // clears the whole window
  paper->SetBackground(1, 1, 1);
  paper->EraseOn();
  window_->AddRenderer(paper);
  for (const Panel& panel : panels) {
    panel.renderer->SetViewport(panel.left / width, panel.bottom / height,
                                (panel.left + panel.width) / width,
                                (panel.bottom + panel.height) / height);
    window_->AddRenderer(panel.renderer);
  }
  vtkNew<vtkRenderer> overlay;
  overlay->SetLayer(1);
  sheet.show_in(*overlay, scale * oversampling);
  window_->AddRenderer(overlay);

  window_->Render();
  Picture picture = read_pixels(*window_, width * oversampling, height * oversampling);
  while (vtkRenderer* renderer = window_->GetRenderers()->GetFirstRenderer())
    window_->RemoveRenderer(renderer);
  return reduce(picture, oversampling);
}

} // namespace lamella::render
