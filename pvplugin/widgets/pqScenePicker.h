#pragma once
#include <pqPropertyWidget.h>

class QComboBox;

/// Offers the built-in scenes, each with a picture of what it comes to; the chosen one's parameters
/// become those of the proxy.
class pqScenePicker : public pqPropertyWidget
{
  Q_OBJECT
public:
  pqScenePicker(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private:
  void pick(int index);

  QComboBox* Box;
};
