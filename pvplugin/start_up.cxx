#include "start_up.h"

#include "colors.h"

#include <vtkLamellaOffscreen.h>
#include <vtkSMSettings.h>
#include <vtkSMTransferFunctionPresets.h>

#include <X11/Xlib.h>

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
  }
}
