#pragma once
#include <QObject>

class pqAbort;
class pqRepresentation;

/// What the plugin does all the time in ParaView's window: the Abort button, and the first look at a
/// membrane from aside, where budding is seen, in place of along its axis; a legend of phases by name.
class pqLamellaStart : public QObject
{
  Q_OBJECT
public:
  explicit pqLamellaStart(QObject* parent = nullptr);

  void startup();
  void shutdown();

private:
  void look(pqRepresentation* representation);

  pqAbort* Abort = nullptr;
};
