#pragma once
#include <pqPropertyWidgetDecorator.h>

/// Shows a property of a filter only where its input has as many phases as the property is about:
/// <PropertyWidgetDecorator type="lamella_phases" phases="2"/>. Two where there is an array psi.
class pqPhasesDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT
public:
  pqPhasesDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);

  bool canShowWidget(bool showAdvanced) const override;
};
