#pragma once
#include <QElapsedTimer>
#include <QObject>

#include <vtkWeakPointer.h>

class pqPipelineSource;
class vtkAlgorithm;
class vtkObject;

/// Makes ParaView's Abort button stop vesicles that compute in this process (builtin server): while
/// one computes, clicks on the button, and repainting, are let through; nothing else is. It stops all
/// that a click has set off, also the animation, whose time is then that of the state that was
/// reached. Live vesicles compute in short pieces, and let ParaView handle its events between.
class pqAbort : public QObject
{
  Q_OBJECT
public:
  explicit pqAbort(QObject* parent);

  bool eventFilter(QObject* receiver, QEvent* event) override;

private Q_SLOTS:
  void onProgress(vtkObject* algorithm);
  void onEnd();

private:
  void watch(pqPipelineSource* source);
  void letEventsThrough();
  void abort();
  void showTimeReached();

  QElapsedTimer SinceEvents;
  bool Aborted = false;
  int Tries = 0; // to show the time reached
  vtkWeakPointer<vtkAlgorithm> Running;
};
