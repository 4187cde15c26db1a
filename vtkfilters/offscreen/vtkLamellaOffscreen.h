/**
 * @class vtkLamellaOffscreen
 * @brief choose what vtkRenderWindow draws with
 *
 * One seam for rendering with or without a display:
 *
 * | backend | draws with                                   | needs (Debian)              |
 * |---------|----------------------------------------------|-----------------------------|
 * | osmesa  | OSMesa, in memory                            | libosmesa6                  |
 * | egl     | EGL's surfaceless platform                   | libegl1, libgl1-mesa-dri    |
 * | x       | VTK's own X window                           | a display that can be opened |
 * | auto    | the first of osmesa, egl, x that works here  |                             |
 *
 * After Enable() every vtkRenderWindow::New() of the process gives a window of that kind, windows made
 * by vtkRenderView, vtkContextView or ParaView's views included. Windows that exist already stay what
 * they are.
 *
 * From VTK 9.4 on, VTK selects among windows of its own at run time; Enable() then only tells it which.
 *
 * @warning Choose osmesa or egl only in processes that show no window of their own (batch programs,
 * Python, pvpython): both replace VTK's interactor, too.
 */
#ifndef vtkLamellaOffscreen_h
#define vtkLamellaOffscreen_h

#include "vtkLamellaOffscreenModule.h"
#include <vtkObject.h>

#include <string>

class VTKLAMELLAOFFSCREEN_EXPORT vtkLamellaOffscreen : public vtkObject
{
public:
  static vtkLamellaOffscreen* New();
  vtkTypeMacro(vtkLamellaOffscreen, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Draw with `backend` from now on: "auto", "osmesa", "egl" or "x". False when it cannot be used, or
   * when there is no backend of that name; `why`, if given, then holds one line for the user that says
   * so and names the package to install. Nothing has changed in that case.
   */
  static bool Enable(const std::string& backend, std::string* why = nullptr);

  /** The backend in use: "osmesa", "egl" or "x"; empty before the first Enable() that succeeds. */
  static std::string GetBackend();

protected:
  vtkLamellaOffscreen() = default;
  ~vtkLamellaOffscreen() override = default;

private:
  vtkLamellaOffscreen(const vtkLamellaOffscreen&) = delete;
  void operator=(const vtkLamellaOffscreen&) = delete;
};

#endif
