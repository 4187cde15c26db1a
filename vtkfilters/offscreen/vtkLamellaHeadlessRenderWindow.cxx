#include "vtkLamellaHeadlessRenderWindow.h"

#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtk_glew.h>

#include <cstdlib>
#include <mutex>
#include <set>

namespace
{
/** Windows that own a context. Never freed: windows may be deleted during static destruction. */
class LiveWindows
{
public:
  static LiveWindows& Get()
  {
    static auto* windows = new LiveWindows;
    return *windows;
  }

  bool IsExiting() const { return this->Exiting; }

  /** Call with the context current. Exit handlers run last in, first out, so ours is registered after
   * those of every OpenGL library in use: once for each class of window. */
  void Add(vtkLamellaHeadlessRenderWindow* window)
  {
    std::lock_guard<std::mutex> lock(this->Mutex);
    this->Windows.insert(window);
    if (this->Classes.insert(window->GetClassName()).second)
    {
      std::atexit([] { Get().FinalizeAll(); });
    }
  }

  void Remove(vtkLamellaHeadlessRenderWindow* window)
  {
    std::lock_guard<std::mutex> lock(this->Mutex);
    this->Windows.erase(window);
  }

private:
  void FinalizeAll()
  {
    this->Exiting = true;
    while (auto* window = this->Take())
    {
      window->Finalize();
    }
  }

  vtkLamellaHeadlessRenderWindow* Take()
  {
    std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Windows.empty() ? nullptr : this->Windows.extract(this->Windows.begin()).value();
  }

  std::mutex Mutex;
  std::set<vtkLamellaHeadlessRenderWindow*> Windows;
  std::set<std::string> Classes;
  bool Exiting = false;
};

/** The window whose context is current in this thread: it must let go before another one binds, or
 * two OpenGL libraries would each believe to be the current one. */
thread_local vtkLamellaHeadlessRenderWindow* CurrentWindow = nullptr;
}

vtkLamellaHeadlessRenderWindow::vtkLamellaHeadlessRenderWindow()
{
  this->ShowWindow = false;
  this->UseOffScreenBuffers = true;
  this->DoubleBuffer = 0;
}

vtkLamellaHeadlessRenderWindow::~vtkLamellaHeadlessRenderWindow()
{
  vtkCollectionSimpleIterator it;
  this->Renderers->InitTraversal(it);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(it))
  {
    renderer->SetRenderWindow(nullptr);
  }
}

void vtkLamellaHeadlessRenderWindow::CreateAWindow()
{
  if (this->Size[0] <= 0 || this->Size[1] <= 0)
  {
    this->Size[0] = this->Size[1] = 300;
  }
  if (!this->GetGenericContext())
  {
    if (LiveWindows::Get().IsExiting())
    {
      return;
    }
    std::string why;
    if (!this->CreateContext(why))
    {
      vtkErrorMacro("No OpenGL context: " << why);
      return;
    }
    this->MakeCurrent();
    LiveWindows::Get().Add(this);
  }
  this->MakeCurrent();
  vtkCollectionSimpleIterator it;
  this->Renderers->InitTraversal(it);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(it))
  {
    renderer->SetRenderWindow(nullptr); // forget what belongs to a former context
    renderer->SetRenderWindow(this);
  }
  this->OpenGLInit();
  this->Mapped = 0;
}

void vtkLamellaHeadlessRenderWindow::DestroyWindow()
{
  if (!this->GetGenericContext())
  {
    return;
  }
  this->MakeCurrent();
  this->ReleaseGraphicsResources(this);
  this->ReleaseCurrent();
  this->DestroyContext();
  this->Initialized = false;
  LiveWindows::Get().Remove(this);
}

void vtkLamellaHeadlessRenderWindow::Initialize()
{
  if (!this->GetGenericContext())
  {
    this->CreateAWindow();
  }
}

void vtkLamellaHeadlessRenderWindow::Finalize()
{
  this->DestroyWindow();
}

void vtkLamellaHeadlessRenderWindow::Start()
{
  this->Initialize();
  this->Superclass::Start();
}

void vtkLamellaHeadlessRenderWindow::MakeCurrent()
{
  if (!this->GetGenericContext() || this->IsCurrent())
  {
    return;
  }
  if (CurrentWindow && CurrentWindow != this)
  {
    CurrentWindow->ReleaseCurrent();
  }
  if (this->BindContext())
  {
    CurrentWindow = this;
  }
  else
  {
    vtkErrorMacro("The OpenGL context could not be made current.");
  }
}

void vtkLamellaHeadlessRenderWindow::ReleaseCurrent()
{
  if (this->GetGenericContext())
  {
    this->UnbindContext();
  }
  if (CurrentWindow == this)
  {
    CurrentWindow = nullptr;
  }
}

void vtkLamellaHeadlessRenderWindow::OpenGLInitContext()
{
  this->ContextCreationTime.Modified();
  if (this->Initialized)
  {
    return;
  }
  const GLenum result = glewInit();
  // A GLX build of GLEW loads every entry point, then reports that there is no X display: expected here.
  this->GlewInitValid = result == GLEW_OK;
#ifdef GLEW_ERROR_NO_GLX_DISPLAY
  this->GlewInitValid = this->GlewInitValid || result == GLEW_ERROR_NO_GLX_DISPLAY;
#endif
  if (!this->GlewInitValid)
  {
    vtkErrorMacro("GLEW: " << reinterpret_cast<const char*>(glewGetErrorString(result)));
    return;
  }
  if (!GLEW_VERSION_3_2)
  {
    vtkErrorMacro("OpenGL 3.2 is needed.");
    return;
  }
  this->Initialized = true;
  GLfloat range[2] = { 1, 1 };
  glGetFloatv(
    this->LineSmoothing ? GL_SMOOTH_LINE_WIDTH_RANGE : GL_ALIASED_LINE_WIDTH_RANGE, range);
  this->MaximumHardwareLineWidth = glGetError() == GL_NO_ERROR ? range[1] : 1.0f;
}

void vtkLamellaHeadlessRenderWindow::SetSize(int width, int height)
{
  if (this->Size[0] != width || this->Size[1] != height)
  {
    this->Superclass::SetSize(width, height);
    this->Modified();
  }
}

int* vtkLamellaHeadlessRenderWindow::GetScreenSize()
{
  // There is no screen; as large as llvmpipe's framebuffers may be.
  this->ScreenSize[0] = this->ScreenSize[1] = 16384;
  return this->ScreenSize;
}

void vtkLamellaHeadlessRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Context: " << this->GetGenericContext() << "\n";
}
