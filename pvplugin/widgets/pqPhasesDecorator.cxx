#include "widgets/pqPhasesDecorator.h"

#include <pqCoreUtilities.h>

#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSourceProxy.h>

pqPhasesDecorator::pqPhasesDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent)
  : pqPropertyWidgetDecorator(xml, parent)
{
  vtkSMProxy* filter = parent->proxy();
  if (auto* input = vtkSMPropertyHelper(filter, "Input").GetAsProxy())
  {
    pqCoreUtilities::connect(input, vtkCommand::UpdateDataEvent, this, SIGNAL(visibilityChanged()));
  }
}

bool pqPhasesDecorator::canShowWidget(bool) const
{
  const vtkSMPropertyHelper input(this->parentWidget()->proxy(), "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  if (!source)
  {
    return true;
  }
  const bool two = source->GetDataInformation(input.GetOutputPort())
                     ->GetArrayInformation("psi", vtkDataObject::POINT) != nullptr;
  int phases = 2;
  this->xml()->GetScalarAttribute("phases", &phases);
  return two == (phases == 2);
}
