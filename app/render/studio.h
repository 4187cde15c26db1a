#pragma once
#include "render/picture.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <string>

namespace lamella::render {

/// The one offscreen window that all views of a program are taken with (a new one costs 0.1 s).
class Studio {
public:
  /// Throws RenderError when nothing here can render; see vtkLamellaOffscreen for the backends.
  explicit Studio(const std::string& backend);

  /// What a renderer shows, on a transparent background and with smooth edges. Throws RenderError.
  Picture shoot(vtkRenderer& renderer, int width, int height);

private:
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkNew<vtkUnsignedCharArray> bytes_; ///< of the last picture: memory to use again
};

} // namespace lamella::render
