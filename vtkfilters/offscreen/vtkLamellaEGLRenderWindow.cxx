#include "vtkLamellaEGLRenderWindow.h"

#include <vtkObjectFactory.h>

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

vtkStandardNewMacro(vtkLamellaEGLRenderWindow);

namespace
{
/** libEGL, its surfaceless display and a configuration for desktop OpenGL. */
class EGLLibrary
{
public:
  decltype(&eglGetPlatformDisplay) GetPlatformDisplay = nullptr;
  decltype(&eglInitialize) Initialize = nullptr;
  decltype(&eglBindAPI) BindAPI = nullptr;
  decltype(&eglChooseConfig) ChooseConfig = nullptr;
  decltype(&eglCreateContext) CreateContext = nullptr;
  decltype(&eglDestroyContext) DestroyContext = nullptr;
  decltype(&eglCreatePbufferSurface) CreatePbufferSurface = nullptr;
  decltype(&eglDestroySurface) DestroySurface = nullptr;
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;
  decltype(&eglGetCurrentContext) GetCurrentContext = nullptr;

  std::string Why; // empty: ready
  EGLDisplay Display = EGL_NO_DISPLAY;
  EGLConfig Config = nullptr;

  static const EGLLibrary& Get()
  {
    static const auto* library = new EGLLibrary; // windows may outlive static objects
    return *library;
  }

private:
  EGLLibrary()
  {
    if (this->Load() && this->Open())
    {
      this->Why.clear();
    }
  }

  template <class Function>
  static bool Find(void* library, const char* name, Function& function)
  {
    function = reinterpret_cast<Function>(dlsym(library, name));
    return function != nullptr;
  }

  bool Load()
  {
    this->Why = "libEGL.so.1 is missing (install libegl1 and libgl1-mesa-dri)";
    void* egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!egl)
    {
      return false;
    }
    this->Why = "libEGL.so.1 is older than EGL 1.5 (install a newer libegl1)";
    return Find(egl, "eglGetPlatformDisplay", this->GetPlatformDisplay) &&
      Find(egl, "eglInitialize", this->Initialize) && Find(egl, "eglBindAPI", this->BindAPI) &&
      Find(egl, "eglChooseConfig", this->ChooseConfig) &&
      Find(egl, "eglCreateContext", this->CreateContext) &&
      Find(egl, "eglDestroyContext", this->DestroyContext) &&
      Find(egl, "eglCreatePbufferSurface", this->CreatePbufferSurface) &&
      Find(egl, "eglDestroySurface", this->DestroySurface) &&
      Find(egl, "eglMakeCurrent", this->MakeCurrent) &&
      Find(egl, "eglGetCurrentContext", this->GetCurrentContext);
  }

  bool Open()
  {
    this->Why = "EGL has no surfaceless platform here (install libegl-mesa0 and libgl1-mesa-dri)";
    this->Display =
      this->GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (this->Display == EGL_NO_DISPLAY || !this->Initialize(this->Display, nullptr, nullptr) ||
      !this->BindAPI(EGL_OPENGL_API))
    {
      return false;
    }
    static const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
      EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
      EGL_NONE };
    EGLint found = 0;
    return this->ChooseConfig(this->Display, wanted, &this->Config, 1, &found) && found == 1;
  }
};

EGLContext NewContext(std::string& why)
{
  static const EGLint wanted[] = { EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
    EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
  const auto& egl = EGLLibrary::Get();
  why = egl.Why;
  if (!why.empty())
  {
    return EGL_NO_CONTEXT;
  }
  egl.BindAPI(EGL_OPENGL_API); // a setting of the thread
  EGLContext context = egl.CreateContext(egl.Display, egl.Config, EGL_NO_CONTEXT, wanted);
  if (context == EGL_NO_CONTEXT)
  {
    why = "EGL gives no OpenGL 3.2 context (install libgl1-mesa-dri)";
  }
  return context;
}
}

vtkLamellaEGLRenderWindow::~vtkLamellaEGLRenderWindow()
{
  this->Finalize();
}

bool vtkLamellaEGLRenderWindow::IsAvailable(std::string& why)
{
  EGLContext context = NewContext(why);
  if (context == EGL_NO_CONTEXT)
  {
    return false;
  }
  EGLLibrary::Get().DestroyContext(EGLLibrary::Get().Display, context);
  return true;
}

bool vtkLamellaEGLRenderWindow::CreateContext(std::string& why)
{
  static const EGLint size[] = { EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE };
  this->Context = NewContext(why);
  if (!this->Context)
  {
    return false;
  }
  const auto& egl = EGLLibrary::Get();
  this->Surface = egl.CreatePbufferSurface(egl.Display, egl.Config, size);
  return true; // without a surface the context is bound alone
}

void vtkLamellaEGLRenderWindow::DestroyContext()
{
  const auto& egl = EGLLibrary::Get();
  egl.DestroyContext(egl.Display, this->Context);
  if (this->Surface)
  {
    egl.DestroySurface(egl.Display, this->Surface);
  }
  this->Context = this->Surface = nullptr;
}

bool vtkLamellaEGLRenderWindow::BindContext()
{
  const auto& egl = EGLLibrary::Get();
  egl.BindAPI(EGL_OPENGL_API);
  return egl.MakeCurrent(egl.Display, this->Surface, this->Surface, this->Context);
}

void vtkLamellaEGLRenderWindow::UnbindContext()
{
  const auto& egl = EGLLibrary::Get();
  egl.MakeCurrent(egl.Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool vtkLamellaEGLRenderWindow::IsCurrent()
{
  return this->Context && EGLLibrary::Get().GetCurrentContext() == this->Context;
}
