#pragma once
#include <QObject>
#include <QString>

class pqAbort;
class pqPipelineSource;
class pqRepresentation;

/// What the plugin does all the time in ParaView's window: the Abort button, and the first look at a
/// membrane from aside, where budding is seen, in place of along its axis; a legend of phases by name; how
/// far a live vesicle has come, in the status bar; all buttons of the toolbar in sight.
class pqLamellaStart : public QObject
{
  Q_OBJECT
public:
  explicit pqLamellaStart(QObject* parent = nullptr);

  void startup();
  void shutdown();

private:
  void look(pqRepresentation* representation);
  void tellLiveState(pqPipelineSource* source);
  void showWholeToolBar();

  pqAbort* Abort = nullptr;
  QString LiveState; // as told last
};
