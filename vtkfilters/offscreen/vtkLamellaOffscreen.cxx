#include "vtkLamellaOffscreen.h"

#include <vtkObjectFactory.h>
#include <vtkVersion.h>

#include <cstdlib>
#include <dlfcn.h>
#include <functional>
#include <vector>

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#define LAMELLA_OWN_WINDOWS 1
#include "vtkLamellaEGLRenderWindow.h"
#include "vtkLamellaOSMesaRenderWindow.h"
#endif

#ifndef VTK_FUTURE_CONST // since VTK 9.3
#define VTK_FUTURE_CONST
#endif

vtkStandardNewMacro(vtkLamellaOffscreen);

namespace
{
struct Backend
{
  std::string Name;
  /** Can it be used here? If not, the reason, naming the package to install. */
  std::function<bool(std::string&)> IsAvailable;
  std::function<void()> Select;
};

std::string& BackendInUse()
{
  static std::string name;
  return name;
}

/** A display that VTK could open: VTK itself ends the process where it cannot. */
bool IsDisplayAvailable(std::string& why)
{
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display)
  {
    why = "no X display: DISPLAY is not set";
    return false;
  }
  void* x11 = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
  auto open = x11 ? reinterpret_cast<void* (*)(const char*)>(dlsym(x11, "XOpenDisplay")) : nullptr;
  auto close = x11 ? reinterpret_cast<int (*)(void*)>(dlsym(x11, "XCloseDisplay")) : nullptr;
  if (!open || !close)
  {
    why = "no X display: libX11.so.6 is missing (install libx11-6)";
    return false;
  }
  void* connection = open(nullptr);
  if (!connection)
  {
    why = std::string("no X display: cannot open \"") + display + "\"";
    return false;
  }
  close(connection);
  return true;
}

#ifdef LAMELLA_OWN_WINDOWS
/** Makes windows of the selected class whenever a vtkRenderWindow is asked for. */
class OffscreenFactory : public vtkObjectFactory
{
public:
  static OffscreenFactory* New()
  {
    auto* factory = new OffscreenFactory;
    factory->InitializeObjectBase();
    return factory;
  }
  vtkTypeMacro(OffscreenFactory, vtkObjectFactory);
  const char* GetVTKSourceVersion() VTK_FUTURE_CONST override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() VTK_FUTURE_CONST override { return "Lamella's offscreen windows"; }

  static vtkObject* (*Create)();

protected:
  OffscreenFactory()
  {
    this->RegisterOverride("vtkRenderWindow", "vtkLamellaHeadlessRenderWindow",
      "window without a display", 1, [] { return Create(); });
  }
};
vtkObject* (*OffscreenFactory::Create)() = nullptr;

/** The first enabled override wins, so VTK's own ones are switched off, and on again for "x". */
void UseOwnWindows(bool own)
{
  static OffscreenFactory* factory = nullptr;
  vtkObjectFactory::SetAllEnableFlags(!own, "vtkRenderWindow");
  vtkObjectFactory::SetAllEnableFlags(!own, "vtkRenderWindowInteractor");
  if (!factory && own)
  {
    factory = OffscreenFactory::New();
    vtkObjectFactory::RegisterFactory(factory);
    factory->Delete(); // the list of factories keeps it
  }
  if (factory)
  {
    factory->SetEnableFlag(own, "vtkRenderWindow", "vtkLamellaHeadlessRenderWindow");
  }
}

template <class Window>
Backend OwnBackend(const char* name)
{
  return { name, &Window::IsAvailable,
    []
    {
      OffscreenFactory::Create = []() -> vtkObject* { return Window::New(); };
      UseOwnWindows(true);
    } };
}

const std::vector<Backend>& Backends()
{
  static const std::vector<Backend> backends = {
    OwnBackend<vtkLamellaOSMesaRenderWindow>("osmesa"),
    OwnBackend<vtkLamellaEGLRenderWindow>("egl"),
    { "x", &IsDisplayAvailable, [] { UseOwnWindows(false); } },
  };
  return backends;
}
#else
/** A window of VTK's own: available if VTK can load the library. */
Backend VtkBackend(const char* name, const char* library, const char* package, const char* window)
{
  return { name,
    [library, package](std::string& why)
    {
      if (dlopen(library, RTLD_NOW | RTLD_LOCAL))
      {
        return true;
      }
      why = std::string(library) + " is missing (install " + package + ")";
      return false;
    },
    [window] { setenv("VTK_DEFAULT_OPENGL_WINDOW", window, 1); } };
}

const std::vector<Backend>& Backends()
{
  static const std::vector<Backend> backends = {
    VtkBackend("osmesa", "libOSMesa.so.8", "libosmesa6", "vtkOSOpenGLRenderWindow"),
    VtkBackend("egl", "libEGL.so.1", "libegl1 and libgl1-mesa-dri", "vtkEGLRenderWindow"),
    { "x", &IsDisplayAvailable,
      [] { setenv("VTK_DEFAULT_OPENGL_WINDOW", "vtkXOpenGLRenderWindow", 1); } },
  };
  return backends;
}
#endif
}

bool vtkLamellaOffscreen::Enable(const std::string& name, std::string* why)
{
  std::string reasons;
  bool known = name == "auto";
  for (const Backend& backend : Backends())
  {
    if (name != "auto" && name != backend.Name)
    {
      continue;
    }
    known = true;
    std::string reason;
    if (backend.IsAvailable(reason))
    {
      backend.Select();
      BackendInUse() = backend.Name;
      return true;
    }
    reasons += (reasons.empty() ? "" : "; ") + backend.Name + ": " + reason;
  }
  if (why)
  {
    *why = known ? "cannot render here: " + reasons
                 : "unknown rendering backend \"" + name + "\": use auto, osmesa, egl or x";
  }
  return false;
}

std::string vtkLamellaOffscreen::GetBackend()
{
  return BackendInUse();
}

void vtkLamellaOffscreen::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Backend: " << GetBackend() << "\n";
}
