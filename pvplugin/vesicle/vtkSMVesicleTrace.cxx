#include "vtkSMVesicleTrace.h"

#include <vtkObjectFactory.h>
#include <vtkPVPluginTracker.h>
#include <vtkSMTrace.h>

#include <cstring>
#include <string>

vtkStandardNewMacro(vtkSMVesicleTrace);

namespace
{
std::string PluginFile()
{
  vtkPVPluginTracker* plugins = vtkPVPluginTracker::GetInstance();
  for (unsigned int n = 0; n < plugins->GetNumberOfPlugins(); ++n)
  {
    if (std::strcmp(plugins->GetPluginName(n), "Lamella") == 0)
    {
      return plugins->GetPluginFileName(n);
    }
  }
  return "";
}
}

void vtkSMVesicleTrace::PostInitializeProxy(vtkSMProxy*, vtkPVXMLElement*, vtkMTimeType)
{
  vtkSMTrace* tracer = vtkSMTrace::GetActiveTracer();
  const std::string file = PluginFile();
  if (tracer && tracer->GetCurrentTrace().find("LoadPlugin('" + file) == std::string::npos)
  {
    SM_SCOPED_TRACE(LoadPlugin).arg(file.c_str()).arg(0);
  }
}
