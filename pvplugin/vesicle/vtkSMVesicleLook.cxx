#include "vtkSMVesicleLook.h"

#include <vtkObjectFactory.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <sstream>
#include <string>

vtkStandardNewMacro(vtkSMVesicleLook);

void vtkSMVesicleLook::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType initializationTimeStamp)
{
  for (unsigned int n = 0; n < xml->GetNumberOfNestedElements(); ++n)
  {
    vtkPVXMLElement* element = xml->GetNestedElement(n);
    vtkSMProperty* property = proxy->GetProperty(element->GetAttributeOrEmpty("name"));
    if (!property || property->GetMTime() > initializationTimeStamp)
    {
      continue;
    }
    vtkSMPropertyHelper helper(property);
    std::istringstream values(element->GetAttributeOrEmpty("values"));
    double value;
    for (unsigned int index = 0; values >> value; ++index)
    {
      helper.Set(index, value);
    }
  }
  proxy->UpdateVTKObjects();
}
