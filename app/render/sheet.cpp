#include "render/sheet.h"

#include "render/qt_color.h"
#include "render/qt_session.h"

#include <qcustomplot.h>

#include <sstream>

namespace lamella::render {
namespace {

QFont font(Face face, double size) {
  QFont font("DejaVu Sans");
  font.setPixelSize(int(std::lround(size)));
  font.setBold(face == Face::bold);
  font.setItalic(face == Face::oblique);
  font.setHintingPreference(QFont::PreferNoHinting); // letters keep their distances at any scale
  return font;
}

/// A part of a text in one face, on the base line or below it.
struct Run {
  QString text;
  Face face;
  bool lowered = false;

  QFont font(double size) const { return render::font(face, lowered ? 0.7 * size : size); }
  double drop(double size) const { return lowered ? 0.18 * size : 0; }
  double advance(double size) const { return QFontMetricsF(font(size)).horizontalAdvance(text); }
};

std::vector<Run> runs_of(const std::string& text, Face face) {
  std::vector<Run> runs{{"", face}};
  const QString all = QString::fromStdString(text);
  for (int i = 0; i < all.size(); ++i) {
    const Run& now = runs.back();
    const QChar next = i + 1 < all.size() ? all[i + 1] : QChar();
    if (all[i] == '*') {
      const Face marked = next == '*' ? Face::bold : Face::oblique;
      i += next == '*' ? 1 : 0;
      runs.push_back({"", now.face == marked ? face : marked, now.lowered});
    } else if (all[i] == '_' && next == '{') {
      runs.push_back({"", now.face, true});
      ++i;
    } else if (all[i] == '}' && now.lowered) {
      runs.push_back({"", now.face, false});
    } else {
      runs.back().text += all[i];
    }
  }
  return runs;
}

} // namespace

Sheet::Sheet(double width, double height) : width_(width), height_(height) { begin_qt(); }

void Sheet::line(const std::vector<Vec2>& points, const Stroke& stroke, bool closed) {
  QPolygonF polygon;
  for (const auto& [x, y] : points) polygon << QPointF(x, y);
  mark([=](QCPPainter& painter) {
    painter.setPen(QPen(qt(stroke.color), stroke.width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    if (closed)
      painter.drawPolygon(polygon);
    else
      painter.drawPolyline(polygon);
  });
}

void Sheet::disc(Vec2 center, double radius, Color color) {
  mark([=](QCPPainter& painter) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(qt(color));
    painter.drawEllipse(QPointF(center[0], center[1]), radius, radius);
  });
}

void Sheet::text(Vec2 anchor, const std::string& text, const TextStyle& style) {
  mark([=](QCPPainter& painter) {
    painter.save();
    painter.translate(anchor[0], anchor[1]);
    if (!style.upright) painter.rotate(-90);
    painter.setPen(qt(style.color));
    double x = -style.align * text_width(text, style);
    for (const Run& run : runs_of(text, style.face)) {
      painter.setFont(run.font(style.size));
      painter.drawText(QPointF(x, run.drop(style.size)), run.text);
      x += run.advance(style.size);
    }
    painter.restore();
  });
}

void Sheet::picture(const Box& place, const Picture& picture) {
  const QImage image = QImage(reinterpret_cast<const uchar*>(picture.pixels.data()), picture.width,
                              picture.height, QImage::Format_RGBA8888_Premultiplied)
                           .copy();
  mark([=](QCPPainter& painter) {
    painter.drawImage(QRectF(place.left, place.top, place.width, place.height), image);
  });
}

void Sheet::paint(QCPPainter& painter) const {
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing |
                         QPainter::SmoothPixmapTransform | QPainter::LosslessImageRendering);
  for (const auto& mark : marks_) mark(painter);
}

double text_width(const std::string& text, const TextStyle& style) {
  begin_qt();
  double width = 0;
  for (const Run& run : runs_of(text, style.face)) width += run.advance(style.size);
  return width;
}

std::vector<std::string> wrapped(const std::string& text, const TextStyle& style, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && text_width(longer, style) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

} // namespace lamella::render
