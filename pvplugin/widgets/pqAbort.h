#pragma once
#include <QElapsedTimer>
#include <QObject>

class QAbstractButton;
class pqPipelineSource;
class vtkObject;

/// Makes ParaView's Abort button stop vesicles that compute in this process (builtin server): while
/// one computes, clicks on the button, and repainting, are let through; nothing else is.
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

  QElapsedTimer SinceEvents;
  bool Aborted = false;
};
