#include "render/sheet.h"

#include "render/labels.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTransform2D.h>

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

/// Lets a vtkContextScene draw a sheet.
class SheetItem : public vtkContextItem {
public:
  static SheetItem* New() { VTK_STANDARD_NEW_BODY(SheetItem); }
  const Sheet* sheet = nullptr;
  double scale = 1;
  vtkNew<vtkTransform2D> place;

  bool Paint(vtkContext2D* painter) override {
    painter->PushMatrix();
    painter->AppendTransform(place);
    sheet->paint(*painter, scale);
    painter->PopMatrix();
    return true;
  }
};

Vec2 direction(const Vec2& from, const Vec2& to) {
  const double x = to[0] - from[0], y = to[1] - from[1], length = std::hypot(x, y);
  return length > 0 ? Vec2{x / length, y / length} : Vec2{0, 0};
}

/// Half-width vector of a stroke's corner: along the bisector of both normals, lengthened to the
/// mitre (at most twice the half-width).
Vec2 mitre(const Vec2& in, const Vec2& out, double half_width) {
  const Vec2 sum{-in[1] - out[1], in[0] + out[0]};
  const double square = sum[0] * sum[0] + sum[1] * sum[1];
  if (square == 0) return {-in[1] * half_width, in[0] * half_width};
  const double factor = half_width * std::min(2 / square, 2 / std::sqrt(square));
  return {sum[0] * factor, sum[1] * factor};
}

/// How far VTK's lower edge of a line of DejaVu Sans lies below its base line, in type sizes.
constexpr double descent = 0.236;

struct Run {
  std::string text;
  bool oblique;
};

std::vector<Run> split_runs(const std::string& text) {
  std::vector<Run> runs;
  bool oblique = false;
  for (std::size_t begin = 0; begin <= text.size(); oblique = !oblique) {
    const std::size_t end = std::min(text.find('*', begin), text.size());
    if (end > begin) runs.push_back({text.substr(begin, end - begin), oblique});
    begin = end + 1;
  }
  return runs;
}

double ink_width(vtkContext2D& painter, const std::string& text) {
  std::array<float, 4> bounds{};
  painter.ComputeStringBounds(text.c_str(), bounds.data());
  return bounds[2];
}

/// How far a text moves the pen, spaces at its ends included (bounds are those of the ink).
double advance(vtkContext2D& painter, const std::string& text) {
  return ink_width(painter, "|" + text + "|") - ink_width(painter, "||");
}

} // namespace

void Sheet::line(std::vector<Vec2> points, const Stroke& stroke, bool closed) {
  if (points.size() > 1) lines_.push_back({std::move(points), stroke, closed});
}

void Sheet::disc(Vec2 center, double radius, Color color) {
  discs_.push_back({center, radius, color});
}

void Sheet::text(Vec2 anchor, std::string text, const TextStyle& style) {
  texts_.push_back({anchor, std::move(text), style});
}

void Sheet::paint(const Line& line, vtkContext2D& painter, double scale) {
  const std::vector<Vec2>& p = line.points;
  const std::size_t n = p.size();
  std::vector<float> strip; // pairs of points left and right of the line
  for (std::size_t k = 0; k < n + (line.closed ? 1 : 0); ++k) {
    const std::size_t i = k % n;
    const bool first = !line.closed && i == 0, last = !line.closed && i == n - 1;
    Vec2 in = first ? Vec2{} : direction(p[(i + n - 1) % n], p[i]);
    Vec2 out = last ? Vec2{} : direction(p[i], p[(i + 1) % n]);
    if (first) in = out;
    if (last) out = in;
    const Vec2 side = mitre(in, out, line.stroke.width / 2);
    for (double s : {1.0, -1.0})
      for (int a = 0; a < 2; ++a) strip.push_back(float((p[i][a] + s * side[a]) * scale));
  }
  const Color& c = line.stroke.color;
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  painter.GetBrush()->SetColor(c.r, c.g, c.b, 255);
  painter.DrawQuadStrip(strip.data(), int(strip.size() / 2));
}

void Sheet::paint(const Text& text, vtkContext2D& painter, double scale) {
  vtkTextProperty& property = *painter.GetTextProp();
  property.SetColor(text.style.color.r / 255.0, text.style.color.g / 255.0,
                    text.style.color.b / 255.0);
  property.SetFontSize(int(std::lround(text.style.size * scale)));
  property.SetJustificationToLeft();
  property.SetVerticalJustificationToBottom();

  std::vector<Run> runs = split_runs(text.text);
  std::vector<double> widths;
  double total = 0;
  const auto select = [&](const Run& run) {
    const Face face = run.oblique ? Face::oblique : text.style.bold ? Face::bold : Face::regular;
    return set_face(property, face);
  };
  property.SetOrientation(0);
  for (Run& run : runs) {
    if (!select(run)) run.text = plain(run.text);
    widths.push_back(advance(painter, run.text));
    total += widths.back();
  }

  const Vec2 along = text.style.upright ? Vec2{1, 0} : Vec2{0, 1};
  property.SetOrientation(text.style.upright ? 0 : 90);
  const double down = descent * text.style.size * scale;
  double offset = -text.style.align * total;
  for (std::size_t r = 0; r < runs.size(); offset += widths[r++]) {
    select(runs[r]);
    painter.DrawString(float(text.anchor[0] * scale + offset * along[0] + down * along[1]),
                       float(text.anchor[1] * scale + offset * along[1] - down * along[0]),
                       runs[r].text.c_str());
  }
}

void Sheet::paint(vtkContext2D& painter, double scale) const {
  for (const Line& line : lines_) paint(line, painter, scale);
  for (const Disc& disc : discs_) {
    painter.GetPen()->SetLineType(vtkPen::NO_PEN);
    painter.GetBrush()->SetColor(disc.color.r, disc.color.g, disc.color.b, 255);
    const float r = float(disc.radius * scale);
    painter.DrawEllipse(float(disc.center[0] * scale), float(disc.center[1] * scale), r, r);
  }
  for (const Text& text : texts_) paint(text, painter, scale);
}

void Sheet::show_in(vtkRenderer& renderer, double scale, double bottom) const {
  vtkNew<SheetItem> item;
  item->sheet = this;
  item->scale = scale;
  item->place->Translate(0, -bottom);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  renderer.AddActor(actor);
}

} // namespace lamella::render
