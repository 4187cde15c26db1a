#pragma once
#include <QActionGroup>

/// The toolbar Lamella: what one wants to see of a vesicle, with one click.
class pqVesicleActions : public QActionGroup
{
  Q_OBJECT
public:
  explicit pqVesicleActions(QObject* parent);

private:
  void updateStates();
  void plotHistory();
  void colorBy(const char* array);

  QAction* History;
  QAction* Phases;
  QAction* Curvature;
};
