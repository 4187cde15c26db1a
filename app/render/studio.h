#pragma once
#include "render/picture.h"

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace lamella::render {

class Sheet;

/// A renderer and its place in a picture, in pixels from the lower left corner.
struct Panel {
  vtkSmartPointer<vtkRenderer> renderer;
  double left = 0, bottom = 0, width = 0, height = 0;
};

/// The one offscreen window that all pictures of a program are taken with (a new one costs 0.1 s).
class Studio {
public:
  /// Throws RenderError when nothing here can render; see vtkLamellaOffscreen for the backends.
  explicit Studio(const std::string& backend);

  /// Draw panels and, over them, a sheet with `scale` pixels per unit, on white. Drawn at twice the
  /// size and reduced: all edges, lines and letters come out smooth. Throws RenderError.
  Picture shoot(int width, int height, const std::vector<Panel>& panels, const Sheet& sheet,
                double scale);

private:
  vtkSmartPointer<vtkRenderWindow> window_;
};

} // namespace lamella::render
