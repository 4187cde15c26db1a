#include "widgets/pqVesicleActions.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqObjectBuilder.h>
#include <pqOutputPort.h>
#include <pqPipelineSource.h>
#include <pqView.h>

#include <vtkDataObject.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMParaViewPipelineControllerWithRendering.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>
#include <vtkSMTransferFunctionProxy.h>
#include <vtkSMViewProxy.h>

#include <QAction>
#include <QIcon>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace
{
pqOutputPort* PortNamed(pqPipelineSource* source, const char* name)
{
  for (int port = 0; source && port < source->getNumberOfOutputPorts(); ++port)
  {
    if (std::strcmp(source->getSourceProxy()->GetOutputPortName(port), name) == 0)
    {
      return source->getOutputPort(port);
    }
  }
  return nullptr;
}

/** The membrane of the active source, as far as it is shown. */
pqDataRepresentation* ShownMembrane()
{
  auto& active = pqActiveObjects::instance();
  pqPipelineSource* source = active.activeSource();
  pqOutputPort* port = PortNamed(source, "Membrane");
  port = port ? port : active.activePort();
  return port && active.activeView() ? port->getRepresentation(active.activeView()) : nullptr;
}

vtkPVArrayInformation* PointArray(pqDataRepresentation* shown, const char* name)
{
  return shown ? shown->getOutputPortFromInput()->getDataInformation()->GetArrayInformation(
                   name, vtkDataObject::POINT)
               : nullptr;
}

/** The colours' middle is where the array is 0. */
void CenterColors(vtkSMProxy* representation, vtkPVArrayInformation& array)
{
  const double* range = array.GetComponentRange(0);
  const double most = std::max(std::abs(range[0]), std::abs(range[1]));
  vtkSMProxy* table = vtkSMPropertyHelper(representation, "LookupTable").GetAsProxy();
  vtkSMPropertyHelper(table, "AutomaticRescaleRangeMode").Set(-1); // stays in the middle
  vtkSMTransferFunctionProxy::RescaleTransferFunction(table, -most, most);
}

/** Of lists such as (name, r, g, b, name, ...). */
void SetOfSeries(vtkSMProxy& chart, const char* list, const std::string& name,
  const std::vector<const char*>& values)
{
  vtkSMPropertyHelper helper(&chart, list);
  const auto stride = static_cast<unsigned int>(values.size() + 1);
  for (unsigned int n = 0; n + stride <= helper.GetNumberOfElements(); n += stride)
  {
    for (unsigned int m = 1; name == helper.GetAsString(n) && m < stride; ++m)
    {
      helper.Set(n + m, values[m - 1]);
    }
  }
}

void ShowEnergy(vtkSMProxy& chart, vtkSMProxy& view)
{
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", &chart);
  vtkSMPropertyHelper(&chart, "UseIndexForXAxis").Set(0);
  vtkSMPropertyHelper(&chart, "XArrayName").Set("t");
  vtkSMPropertyHelper visible(&chart, "SeriesVisibility");
  for (unsigned int n = 0; n + 1 < visible.GetNumberOfElements(); n += 2)
  {
    visible.Set(n + 1, std::strcmp(visible.GetAsString(n), "energy") == 0 ? "1" : "0");
  }
  SetOfSeries(chart, "SeriesColor", "energy", { "0.745", "0.243", "0.173" });
  SetOfSeries(chart, "SeriesLineThickness", "energy", { "3" });
  chart.UpdateVTKObjects();

  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", &view);
  vtkSMPropertyHelper(&view, "LeftAxisTitle").Set("energy");
  vtkSMPropertyHelper(&view, "BottomAxisTitle").Set("time");
  view.UpdateVTKObjects();
}
}

pqVesicleActions::pqVesicleActions(QObject* parent)
  : QActionGroup(parent)
  , History(this->addAction(QIcon(":/lamella/icons/History.svg"), tr("Plot Energy Over Time")))
  , Phases(this->addAction(QIcon(":/lamella/icons/Phases.svg"), tr("Color By Phase")))
  , Curvature(this->addAction(QIcon(":/lamella/icons/Curvature.svg"), tr("Color By Curvature")))
{
  this->setExclusive(false);
  this->History->setObjectName("PlotEnergy");
  this->Phases->setObjectName("ColorByPhase");
  this->Curvature->setObjectName("ColorByCurvature");
  QObject::connect(this->History, &QAction::triggered, this, &pqVesicleActions::plotHistory);
  QObject::connect(this->Phases, &QAction::triggered, this, [this] { this->colorBy("psi"); });
  QObject::connect(this->Curvature, &QAction::triggered, this, [this] { this->colorBy("K_M"); });

  auto* active = &pqActiveObjects::instance();
  QObject::connect(active, &pqActiveObjects::dataUpdated, this, &pqVesicleActions::updateStates);
  QObject::connect(active, &pqActiveObjects::sourceChanged, this, &pqVesicleActions::updateStates);
  QObject::connect(active, &pqActiveObjects::viewChanged, this, &pqVesicleActions::updateStates);
  this->updateStates();
}

void pqVesicleActions::updateStates()
{
  pqDataRepresentation* membrane = ShownMembrane();
  this->History->setEnabled(
    PortNamed(pqActiveObjects::instance().activeSource(), "History") != nullptr);
  this->Phases->setEnabled(PointArray(membrane, "psi") != nullptr);
  this->Curvature->setEnabled(PointArray(membrane, "K_M") != nullptr);
}

void pqVesicleActions::plotHistory()
{
  pqOutputPort* history = PortNamed(pqActiveObjects::instance().activeSource(), "History");
  if (!history)
  {
    return;
  }
  pqView* view = pqApplicationCore::instance()->getObjectBuilder()->createView(
    "XYChartView", history->getServer());
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->AssignViewToLayout(view->getViewProxy());
  vtkSMProxy* chart =
    controller->Show(history->getSourceProxy(), history->getPortNumber(), view->getViewProxy());

  ShowEnergy(*chart, *view->getViewProxy());
  view->resetDisplay();
  view->render();
}

void pqVesicleActions::colorBy(const char* array)
{
  pqDataRepresentation* membrane = ShownMembrane();
  vtkPVArrayInformation* information = PointArray(membrane, array);
  if (!information)
  {
    return;
  }
  vtkSMProxy* proxy = membrane->getProxy();
  vtkSMPVRepresentationProxy::SetScalarColoring(proxy, array, vtkDataObject::POINT);
  if (std::strcmp(array, "K_M") == 0)
  {
    CenterColors(proxy, *information);
  }
  vtkSMPVRepresentationProxy::SetScalarBarVisibility(
    proxy, membrane->getView()->getViewProxy(), true);
  membrane->renderViewEventually();
}
