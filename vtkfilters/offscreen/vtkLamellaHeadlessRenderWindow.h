/**
 * @class vtkLamellaHeadlessRenderWindow
 * @brief what OpenGL windows without a display have in common
 *
 * A vtkOpenGLRenderWindow that is never shown. Subclasses supply the OpenGL context; this class does
 * the rest: making it current, starting GLEW and VTK's OpenGL state, and finalizing windows that are
 * still alive when the process exits, before Mesa's own exit handlers run (a context must not be
 * touched after those).
 *
 * VTK draws into framebuffer objects, so the context's own drawable may be tiny.
 */
#ifndef vtkLamellaHeadlessRenderWindow_h
#define vtkLamellaHeadlessRenderWindow_h

#include "vtkLamellaOffscreenModule.h"
#include <vtkOpenGLRenderWindow.h>

#include <string>

class VTKLAMELLAOFFSCREEN_EXPORT vtkLamellaHeadlessRenderWindow : public vtkOpenGLRenderWindow
{
public:
  vtkAbstractTypeMacro(vtkLamellaHeadlessRenderWindow, vtkOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Initialize() override;
  void Finalize() override;
  void Start() override;
  void MakeCurrent() override;
  void ReleaseCurrent() override;
  void OpenGLInitContext() override;
  void SetSize(int width, int height) override;
  void SetSize(int size[2]) override { this->SetSize(size[0], size[1]); }
  int* GetScreenSize() VTK_SIZEHINT(2) override;
  vtkTypeBool IsDirect() override { return 0; }

  ///@{
  /** There is no display, no parent, no cursor and there are no events: these do nothing. */
  void WindowRemap() override {}
  void SetFullScreen(vtkTypeBool) override {}
  void HideCursor() override {}
  void ShowCursor() override {}
  vtkTypeBool GetEventPending() override { return 0; }
  void SetDisplayId(void*) override {}
  void SetWindowId(void*) override {}
  void SetNextWindowId(void*) override {}
  void SetParentId(void*) override {}
  void* GetGenericDisplayId() override { return nullptr; }
  void* GetGenericWindowId() override { return nullptr; }
  void* GetGenericParentId() override { return nullptr; }
  void* GetGenericDrawable() override { return nullptr; }
  void SetWindowInfo(const char*) override {}
  void SetNextWindowInfo(const char*) override {}
  void SetParentInfo(const char*) override {}
  ///@}

protected:
  vtkLamellaHeadlessRenderWindow();
  ~vtkLamellaHeadlessRenderWindow() override;

  ///@{
  /** For subclasses: the context. GetGenericContext() is null while there is none. */
  virtual bool CreateContext(std::string& why) = 0;
  virtual void DestroyContext() = 0;
  virtual bool BindContext() = 0;
  virtual void UnbindContext() = 0;
  ///@}

  void CreateAWindow() override;
  void DestroyWindow() override;

private:
  vtkLamellaHeadlessRenderWindow(const vtkLamellaHeadlessRenderWindow&) = delete;
  void operator=(const vtkLamellaHeadlessRenderWindow&) = delete;
};

#endif
