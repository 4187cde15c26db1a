/**
 * @class vtkLamellaEGLRenderWindow
 * @brief a render window that draws through EGL, without a surface on any screen
 *
 * Uses Mesa's surfaceless platform (EGL_PLATFORM_SURFACELESS_MESA) with a tiny pixel buffer. libEGL is
 * loaded at run time, so that nothing depends on it where another backend is used.
 */
#ifndef vtkLamellaEGLRenderWindow_h
#define vtkLamellaEGLRenderWindow_h

#include "vtkLamellaHeadlessRenderWindow.h"

class VTKLAMELLAOFFSCREEN_EXPORT vtkLamellaEGLRenderWindow : public vtkLamellaHeadlessRenderWindow
{
public:
  static vtkLamellaEGLRenderWindow* New();
  vtkTypeMacro(vtkLamellaEGLRenderWindow, vtkLamellaHeadlessRenderWindow);

  /** Whether a context can be had; if not, `why` says what is missing. */
  static bool IsAvailable(std::string& why);

  bool IsCurrent() override;
  void* GetGenericContext() override { return this->Context; }

protected:
  vtkLamellaEGLRenderWindow() = default;
  ~vtkLamellaEGLRenderWindow() override;
  bool CreateContext(std::string& why) override;
  void DestroyContext() override;
  bool BindContext() override;
  void UnbindContext() override;

private:
  vtkLamellaEGLRenderWindow(const vtkLamellaEGLRenderWindow&) = delete;
  void operator=(const vtkLamellaEGLRenderWindow&) = delete;

  void* Context = nullptr; // EGLContext
  void* Surface = nullptr; // EGLSurface
};

#endif
