/**
 * @class vtkLamellaOSMesaRenderWindow
 * @brief a render window that draws through OSMesa, in memory
 *
 * For VTK builds whose OpenGL calls go through libglvnd (libGL, libOpenGL, GLEW), as Debian's do. Such
 * a build knows only GLX; OSMesa is made to answer its calls by presenting it to libglvnd's
 * dispatcher as one more vendor, see vtkLamellaOSMesaLibrary.
 */
#ifndef vtkLamellaOSMesaRenderWindow_h
#define vtkLamellaOSMesaRenderWindow_h

#include "vtkLamellaHeadlessRenderWindow.h"

class VTKLAMELLAOFFSCREEN_EXPORT vtkLamellaOSMesaRenderWindow
  : public vtkLamellaHeadlessRenderWindow
{
public:
  static vtkLamellaOSMesaRenderWindow* New();
  vtkTypeMacro(vtkLamellaOSMesaRenderWindow, vtkLamellaHeadlessRenderWindow);

  /** Whether a context can be had; if not, `why` says what is missing. */
  static bool IsAvailable(std::string& why);

  bool IsCurrent() override;
  void* GetGenericContext() override { return this->Context; }

protected:
  vtkLamellaOSMesaRenderWindow() = default;
  ~vtkLamellaOSMesaRenderWindow() override;
  bool CreateContext(std::string& why) override;
  void DestroyContext() override;
  bool BindContext() override;
  void UnbindContext() override;

private:
  vtkLamellaOSMesaRenderWindow(const vtkLamellaOSMesaRenderWindow&) = delete;
  void operator=(const vtkLamellaOSMesaRenderWindow&) = delete;

  void* Context = nullptr;
  static constexpr int BufferSide = 16; // pixels
  unsigned char Buffer[BufferSide * BufferSide * 4];
};

#endif
