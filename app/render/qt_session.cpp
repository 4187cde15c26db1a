#include "render/qt_session.h"

#include "render/render.h"

#include <QApplication>
#include <QFontDatabase>

#include <clocale>
#include <cstdlib>

namespace lamella::render {
namespace {

void begin() {
  static int count = 1;
  static char name[] = "lamella";
  static char* arguments[] = {name, nullptr};
  setenv("QT_QPA_PLATFORM", "offscreen", 1);
  // What Qt remarks on the system, such as on a missing folder for sockets, is not for our users.
  qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  new QApplication(count, arguments); // as long as the process: its parts outlive static objects
  std::setlocale(LC_ALL, "C");        // Qt takes the user's, with other decimal points
}

} // namespace

void begin_qt() {
  static const bool begun = (begin(), true);
  static const bool has_fonts = begun && !QFontDatabase().families().isEmpty();
  if (!has_fonts)
    throw RenderError("no font is installed; DejaVu Sans (Debian: fonts-dejavu-core) is best");
}

} // namespace lamella::render
