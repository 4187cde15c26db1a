#pragma once
#include "render/picture.h"

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace lamella::render {

class Sheet;

/// A renderer with a white background and its place in a picture, in pixels from the upper left
/// corner.
struct Panel {
  vtkSmartPointer<vtkRenderer> renderer;
  int left = 0, top = 0, width = 0, height = 0;
};

/// The one offscreen window that all pictures of a program are taken with (a new one costs 0.1 s).
class Studio {
public:
  /// Throws RenderError when nothing here can render; see vtkLamellaOffscreen for the backends.
  explicit Studio(const std::string& backend);

  /// Print panels and, over them, a sheet with `scale` pixels per unit, on white paper: inks
  /// multiply. Drawn at twice the size and reduced: all edges, lines and letters come out smooth.
  /// Throws RenderError.
  Picture shoot(int width, int height, const std::vector<Panel>& panels, const Sheet& sheet,
                double scale);

private:
  Picture shoot(const Sheet& sheet, double scale, int width, int height);
  Picture shoot(const Panel& panel);
  Picture shoot(vtkRenderer& renderer, int width, int height, int oversampling, int multisamples);

  vtkSmartPointer<vtkRenderWindow> window_;
};

} // namespace lamella::render
