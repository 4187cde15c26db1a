#include "widgets/pqLamellaStart.h"

#include "widgets/pqAbort.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqRepresentation.h>
#include <pqServerManagerModel.h>

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSMTransferFunctionManager.h>

#include <QMainWindow>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>

#include <array>
#include <cstring>

namespace
{
constexpr std::array<double, 3> Aside{ 0.4, -0.8, 0.45 }, Up{ 0, 0, 1 };
constexpr int LookAgain = 100; // milliseconds until the window may be there

/** A view that shows nothing, and looks along z as it was made to. */
bool IsUntouched(pqView& view)
{
  double position[3], focus[3];
  vtkSMPropertyHelper(view.getProxy(), "CameraPosition").Get(position, 3);
  vtkSMPropertyHelper(view.getProxy(), "CameraFocalPoint").Get(focus, 3);
  return view.getNumberOfVisibleDataRepresentations() == 0 && position[0] == focus[0] &&
    position[1] == focus[1] && position[2] > focus[2];
}

bool IsLegendOfPhases(vtkSMProxy& representation)
{
  if (std::strcmp(representation.GetXMLName(), "ScalarBarWidgetRepresentation") != 0)
  {
    return false;
  }
  vtkSMProxy* table = vtkSMPropertyHelper(&representation, "LookupTable").GetAsProxy();
  return table &&
    vtkNew<vtkSMTransferFunctionManager>()->GetColorTransferFunction(
      "psi", representation.GetSessionProxyManager()) == table;
}
}

pqLamellaStart::pqLamellaStart(QObject* parent)
  : QObject(parent)
{
}

void pqLamellaStart::startup()
{
  this->Abort = new pqAbort(this);
  QTimer::singleShot(0, this, &pqLamellaStart::showWholeToolBar);
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::representationAdded, this, &pqLamellaStart::look);
  QObject::connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::dataUpdated, this, &pqLamellaStart::tellLiveState);
}

void pqLamellaStart::shutdown()
{
  delete this->Abort;
  this->Abort = nullptr;
}

/** ParaView appends it to a line that is full where the window is less than 1400 pixels wide. */
void pqLamellaStart::showWholeToolBar()
{
  auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  if (!window || !window->isVisible())
  {
    QTimer::singleShot(LookAgain, this, &pqLamellaStart::showWholeToolBar);
    return;
  }
  auto* toolBar = window->findChild<QToolBar*>("Lamella");
  if (toolBar && toolBar->width() < toolBar->sizeHint().width())
  {
    window->removeToolBar(toolBar);
    window->addToolBar(toolBar); // to the last line
    toolBar->show();
  }
}

void pqLamellaStart::tellLiveState(pqPipelineSource* source)
{
  vtkSMProxy* proxy = source->getProxy();
  vtkSMProperty* state = proxy->GetProperty("LiveState");
  auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  if (!state || !window)
  {
    return;
  }
  if (vtkSMPropertyHelper(proxy, "Live").GetAsInt() != 0)
  {
    proxy->UpdatePropertyInformation(state);
    this->LiveState =
      QString("%1: %2").arg(source->getSMName(), vtkSMPropertyHelper(state).GetAsString());
    window->statusBar()->showMessage(this->LiveState);
  }
  else if (window->statusBar()->currentMessage() == this->LiveState)
  {
    window->statusBar()->clearMessage(); // it is of the past
  }
}

void pqLamellaStart::look(pqRepresentation* representation)
{
  if (IsLegendOfPhases(*representation->getProxy()))
  {
    for (const char* labels : { "DrawTickLabels", "DrawTickMarks", "AddRangeLabels" })
    {
      vtkSMPropertyHelper(representation->getProxy(), labels).Set(0); // Ld and Lo say all
    }
    representation->getProxy()->UpdateVTKObjects();
    return;
  }
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  const bool membrane =
    std::strcmp(representation->getProxy()->GetXMLName(), "MembraneRepresentation") == 0;
  if (!membrane || !view || !IsUntouched(*view))
  {
    return;
  }
  vtkSMProxy* proxy = view->getProxy();
  double focus[3];
  vtkSMPropertyHelper(proxy, "CameraFocalPoint").Get(focus, 3);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    vtkSMPropertyHelper(proxy, "CameraPosition").Set(axis, focus[axis] + Aside[axis]);
  }
  vtkSMPropertyHelper(proxy, "CameraViewUp").Set(Up.data(), 3);
  proxy->UpdateVTKObjects(); // Apply then sets the distance
}
