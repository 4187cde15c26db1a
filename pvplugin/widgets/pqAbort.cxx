#include "widgets/pqAbort.h"

#include <pqAnimationManager.h>
#include <pqAnimationScene.h>
#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqProgressWidget.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>
#include <pqTimeKeeper.h>

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkSMProxy.h>
#include <vtkVesiclePipeline.h>

#include <QApplication>
#include <QEvent>
#include <QMainWindow>
#include <QOpenGLWidget>
#include <QStatusBar>
#include <QTimer>
#include <QToolButton>
#include <QWindow>

namespace
{
constexpr int Pause = 50;          // milliseconds between looking for events
constexpr int MostTries = 100;     // to show the time reached
constexpr int MessageTime = 10000; // milliseconds

pqAnimationScene* AnimationScene()
{
  return pqPVApplicationCore::instance()->animationManager()->getActiveScene();
}

bool IsLive(vtkAlgorithm* algorithm)
{
  auto* vesicle = vtkVesiclePipeline::SafeDownCast(algorithm);
  return vesicle && vesicle->GetLive();
}

pqProgressManager* ProgressManager()
{
  return pqApplicationCore::instance()->getProgressManager();
}

bool IsAbortButton(const QObject* object)
{
  const auto* widget = qobject_cast<const pqProgressWidget*>(object->parent());
  return widget && widget->abortButton() == object;
}

bool IsOfMouseButton(const QEvent& event)
{
  return event.type() == QEvent::MouseButtonPress || event.type() == QEvent::MouseButtonRelease ||
    event.type() == QEvent::MouseMove;
}

/** Would act on ParaView's objects, which are at work. */
bool Acts(const QEvent& event)
{
  switch (event.type())
  {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::Wheel:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::Shortcut:
    case QEvent::ShortcutOverride:
    case QEvent::ContextMenu:
    case QEvent::TouchBegin:
    case QEvent::TouchUpdate:
    case QEvent::TouchEnd:
    case QEvent::DragEnter:
    case QEvent::Drop:
    case QEvent::Close:
    case QEvent::Timer: // goes off again later
      return true;
    default:
      return false;
  }
}
}

pqAbort::pqAbort(QObject* parent)
  : QObject(parent)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this, &pqAbort::watch);
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
  QObject::connect(ProgressManager(), &pqProgressManager::abort, this, &pqAbort::abort);
}

void pqAbort::watch(pqPipelineSource* source)
{
  auto* algorithm = vtkAlgorithm::SafeDownCast(source->getProxy()->GetClientSideObject());
  if (algorithm && (algorithm->IsA("vtkVesiclePipeline") || algorithm->IsA("vtkVesicleDynamics")))
  {
    pqCoreUtilities::connect(
      algorithm, vtkCommand::ProgressEvent, this, SLOT(onProgress(vtkObject*)));
    pqCoreUtilities::connect(algorithm, vtkCommand::EndEvent, this, SLOT(onEnd()));
  }
}

void pqAbort::onProgress(vtkObject* caller)
{
  auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
  if (IsLive(algorithm))
  {
    return;
  }
  this->Running = algorithm;
  ProgressManager()->setEnableAbort(true);
  if (!this->SinceEvents.isValid() || this->SinceEvents.elapsed() >= Pause)
  {
    this->letEventsThrough();
    this->SinceEvents.start();
  }
  if (this->Aborted)
  {
    algorithm->AbortExecuteOn();
  }
}

void pqAbort::onEnd()
{
  ProgressManager()->setEnableAbort(false);
}

void pqAbort::abort()
{
  if (!this->Running || this->Aborted)
  {
    return;
  }
  this->Aborted = true;
  this->Tries = 0;
  AnimationScene()->getProxy()->InvokeCommand("Stop");
  QTimer::singleShot(1, this, &pqAbort::showTimeReached); // when nothing runs any more
}

/** What is shown is said to be of its own time. */
void pqAbort::showTimeReached()
{
  vtkInformation* data =
    this->Running ? this->Running->GetOutputDataObject(0)->GetInformation() : nullptr;
  if (!data || !data->Has(vtkDataObject::DATA_TIME_STEP()))
  {
    this->Aborted = false;
    return;
  }
  pqAnimationScene* scene = AnimationScene();
  const double time = data->Get(vtkDataObject::DATA_TIME_STEP());
  const double before = scene->getServer()->getTimeKeeper()->getTime();
  scene->setAnimationTime(time);
  if (scene->getServer()->getTimeKeeper()->getTime() == before && before != time &&
    ++this->Tries < MostTries)
  {
    scene->setAnimationTime(before); // still at work on what was aborted, and takes no other
    QTimer::singleShot(Pause, this, &pqAbort::showTimeReached);
    return;
  }
  this->Aborted = false;
  if (auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
  {
    window->statusBar()->showMessage(
      tr("Aborted at t = %1. Play goes on from there.").arg(time), MessageTime);
  }
}

void pqAbort::letEventsThrough()
{
  const bool before = ProgressManager()->unblockEvents(true); // this filter is in its place
  qApp->installEventFilter(this);
  QCoreApplication::processEvents(QEventLoop::ExcludeSocketNotifiers);
  qApp->removeEventFilter(this);
  ProgressManager()->unblockEvents(before);
}

bool pqAbort::eventFilter(QObject* receiver, QEvent* event)
{
  if (IsOfMouseButton(*event) && (qobject_cast<QWindow*>(receiver) || IsAbortButton(receiver)))
  {
    return false; // a window hands it on to the widget below
  }
  return Acts(*event) ||
    (event->type() == QEvent::Paint && qobject_cast<QOpenGLWidget*>(receiver)); // draws data
}
