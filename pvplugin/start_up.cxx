#include "start_up.h"

#include "colors.h"

#include <vtkCommand.h>
#include <vtkLamellaOffscreen.h>
#include <vtkOutputWindow.h>
#include <vtkPVView.h>
#include <vtkRenderWindow.h>
#include <vtkSMProxy.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSettings.h>
#include <vtkSMTransferFunctionPresets.h>
#include <vtkSmartPointer.h>

#include <X11/Xlib.h>

#include <cstring>
#include <string>

namespace
{
constexpr double BelowThoseOfUsers = 0.1; // priority of settings

void AddPreset(const char* name, const std::string& preset)
{
  auto* presets = vtkSMTransferFunctionPresets::GetInstance();
  if (!presets->HasPreset(name)) // ParaView keeps those of earlier sessions
  {
    presets->AddPreset(name, preset);
  }
}

/** ParaView's windows in a batch use the context of another window, for which OpenGL was loaded; they load
 * it again, and without X that says that it fails. */
class OpenGLIsLoaded : public vtkCommand
{
public:
  static OpenGLIsLoaded* New() { return new OpenGLIsLoaded; }
  void Execute(vtkObject*, unsigned long, void* data) override
  {
    const char* text = static_cast<const char*>(data);
    if (!std::strstr(text, "GLEW could not be initialized"))
    {
      vtkOutputWindowDisplayErrorText(text);
    }
  }
};

/** Watches the windows of views to come. */
class Views : public vtkCommand
{
public:
  static Views* New() { return new Views; }
  void Execute(vtkObject*, unsigned long, void* data) override
  {
    auto* proxy = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(data)->Proxy;
    auto* view = proxy ? vtkPVView::SafeDownCast(proxy->GetClientSideObject()) : nullptr;
    if (view && view->GetRenderWindow() &&
      !view->GetRenderWindow()->HasObserver(vtkCommand::ErrorEvent))
    {
      view->GetRenderWindow()->AddObserver(
        vtkCommand::ErrorEvent, vtkSmartPointer<OpenGLIsLoaded>::New());
    }
  }
};

bool HasDisplay()
{
  Display* display = XOpenDisplay(nullptr);
  if (display)
  {
    XCloseDisplay(display);
  }
  return display != nullptr;
}
}

void lamellaStartUp()
{
  using namespace lamella;
  AddPreset(colors::phases_name, colors::phases);
  AddPreset(colors::curvature_name, colors::curvature);
  vtkSMSettings::GetInstance()->AddCollectionFromString(colors::settings, BelowThoseOfUsers);
  if (!HasDisplay())
  {
    vtkLamellaOffscreen::Enable("auto"); // else as ParaView does by itself
    vtkSMProxyManager::GetProxyManager()->AddObserver(
      vtkCommand::RegisterEvent, vtkSmartPointer<Views>::New());
  }
}
