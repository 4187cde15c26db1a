#include "render/plot.h"

#include "render/labels.h"
#include "render/qt_color.h"
#include "render/render.h"

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace lamella::render {
namespace {

constexpr double tick = 14, label_gap = 12, dot = 26; ///< dot: its diameter
constexpr double air = 0.06;                          ///< beside the data, in parts of their extent

using Range = std::array<double, 2>;

bool is_shown(double value, const Axis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

void leave_out_what_cannot_be_shown(Plot& plot) {
  for (Series& series : plot.series) {
    std::vector<Vec2> points;
    std::vector<bool> hollow;
    for (std::size_t n = 0; n < series.points.size(); ++n) {
      const auto& [x, y] = series.points[n];
      if (!is_shown(x, plot.x) || !is_shown(y, plot.y)) continue;
      points.push_back({x, y});
      hollow.push_back(n < series.hollow.size() && series.hollow[n]);
    }
    series.points = std::move(points);
    series.hollow = std::move(hollow);
  }
  std::erase_if(plot.series, [](const Series& series) { return series.points.empty(); });
  if (plot.series.empty()) throw RenderError("nothing to plot: there is no finite value");
}

double scaled(double value, const Axis& axis) {
  return axis.logarithmic ? std::log10(value) : value;
}
double unscaled(double value, const Axis& axis) {
  return axis.logarithmic ? std::pow(10, value) : value;
}

/// Of one coordinate of all data. Never so narrow that rounding errors look like a change.
Range range_of(const Plot& plot, int coordinate, const Axis& axis, double margin) {
  if (axis.range) return *axis.range;
  double low = 1e300, high = -1e300;
  for (const Series& series : plot.series)
    for (const Vec2& point : series.points) {
      low = std::min(low, scaled(point[coordinate], axis));
      high = std::max(high, scaled(point[coordinate], axis));
    }
  const double least =
      axis.logarithmic ? 0.4 : 0.02 * std::max({std::abs(low), std::abs(high), 1e-300});
  const double lacking = std::max(0.0, least - (high - low)) / 2;
  low -= lacking, high += lacking;
  const double rim = margin * (high - low);
  return {unscaled(low - rim, axis), unscaled(high + rim, axis)};
}

Ticks ticks_of(const Range& range, const Axis& axis, const LabelRoom& room) {
  return axis.logarithmic ? log_ticks(std::log10(range[0]), std::log10(range[1]), room)
                          : linear_ticks(range[0], range[1], room);
}

/// Puts our ticks on an axis; those without a label are minor ones.
class Ticker : public QCPAxisTicker {
public:
  explicit Ticker(Ticks ticks) : ticks_(std::move(ticks)) {}

  void generate(const QCPRange&, const QLocale&, QChar, int, QVector<double>& ticks,
                QVector<double>* minor, QVector<QString>* labels) override {
    ticks.clear();
    if (minor) minor->clear();
    if (labels) labels->clear();
    for (std::size_t n = 0; n < ticks_.positions.size(); ++n) {
      if (ticks_.labels[n].empty()) {
        if (minor) minor->push_back(ticks_.positions[n]);
        continue;
      }
      ticks.push_back(ticks_.positions[n]);
      if (labels) labels->push_back(QString::fromStdString(ticks_.labels[n]));
    }
  }

private:
  Ticks ticks_;
};

TextStyle label_style() { return {style::small_type, style::ink}; }

/// Of a label with the gap to the next.
double width_along_axis(const std::string& label) {
  return text_width(label, label_style()) + 0.5 * style::small_type;
}
double height_along_axis(const std::string&) { return 1.5 * style::small_type; }

double longest(const std::vector<std::string>& texts) {
  double width = 0;
  for (const std::string& text : texts) width = std::max(width, text_width(text, label_style()));
  return width;
}

std::vector<std::string> names_of(const Plot& plot) {
  std::vector<std::string> names;
  for (const Series& series : plot.series) names.push_back(series.name);
  return names;
}

/// The title with the power of ten that the labels leave to it: "*t* / (10⁻³ *s*)".
std::string title_of(const Axis& axis, int exponent) {
  if (exponent == 0) return axis.title;
  const std::size_t slash = axis.title.find(" / ");
  if (slash == std::string::npos) return axis.title + " / " + power_of_ten(exponent);
  std::string unit = axis.title.substr(slash + 3);
  if (unit.starts_with('(')) unit = unit.substr(1, unit.size() - 2);
  return axis.title.substr(0, slash) + " / (" + with_power(exponent, unit) + ")";
}

void set_up(QCPAxis& axis, const Axis& wanted, const Range& range, const Ticks& ticks) {
  if (wanted.logarithmic) axis.setScaleType(QCPAxis::stLogarithmic);
  axis.setRange(range[0], range[1]);
  axis.setTicker(QSharedPointer<Ticker>::create(ticks));
  axis.grid()->setVisible(false);
  const QPen pen(qt(style::ink), style::hairline);
  axis.setBasePen(pen);
  axis.setTickPen(pen);
  axis.setSubTickPen(pen);
  axis.setTickLength(0, int(tick));
  axis.setSubTickLength(0, int(0.6 * tick));
  axis.setTickLabelPadding(int(label_gap));
  axis.setTickLabelColor(qt(style::ink));
  QFont font("DejaVu Sans");
  font.setPixelSize(int(style::small_type));
  font.setHintingPreference(QFont::PreferNoHinting);
  axis.setTickLabelFont(font);
}

void add_dots(QCustomPlot& chart, const Series& series, bool hollow) {
  auto* dots = new QCPCurve(chart.xAxis, chart.yAxis);
  for (std::size_t n = 0; n < series.points.size(); ++n)
    if (series.hollow[n] == hollow) dots->addData(series.points[n][0], series.points[n][1]);
  dots->setLineStyle(QCPCurve::lsNone);
  dots->setPen(Qt::NoPen);
  dots->setScatterStyle(
      QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(qt(series.color), 0.2 * dot),
                      hollow ? QBrush(Qt::white) : QBrush(qt(series.color)), 0.8 * dot));
}

void add(QCustomPlot& chart, const Series& series) {
  auto* curve = new QCPCurve(chart.xAxis, chart.yAxis);
  for (const auto& [x, y] : series.points) curve->addData(x, y);
  curve->setPen(series.width == 0 ? QPen(Qt::NoPen)
                                  : QPen(qt(series.color), series.width,
                                         series.dashed ? Qt::DashLine : Qt::SolidLine, Qt::FlatCap,
                                         Qt::RoundJoin));
  if (!series.dots) return;
  add_dots(chart, series, false);
  add_dots(chart, series, true);
}

/// Beside the last points, moved apart where these are close to each other.
void draw_names(Sheet& sheet, const Plot& plot, const std::function<Vec2(const Vec2&)>& place,
                const Range& heights, double left) {
  constexpr double apart = 1.15 * style::small_type, middle = 0.36 * style::small_type;
  std::vector<const Series*> named;
  for (const Series& series : plot.series)
    if (!series.name.empty()) named.push_back(&series);
  const auto own = [&](const Series* series) { return place(series->points.back())[1]; };
  std::ranges::sort(named, {}, own);
  std::vector<double> at;
  for (const Series* series : named)
    at.push_back(at.empty() ? std::max(own(series), heights[0])
                            : std::max(own(series), at.back() + apart));
  double lowest = heights[1];
  for (std::size_t n = at.size(); n-- > 0; lowest = at[n] - apart) at[n] = std::min(at[n], lowest);
  for (std::size_t n = 0; n < named.size(); ++n)
    sheet.text({left, at[n] + middle}, named[n]->name, {style::small_type, named[n]->color});
}

} // namespace

void draw(Sheet& sheet, const Box& place, Plot plot) {
  leave_out_what_cannot_be_shown(plot);
  const Range x = range_of(plot, 0, plot.x, plot.x.logarithmic ? air : 0);
  const Range y = range_of(plot, 1, plot.y, 1.3 * air);
  const double names = longest(names_of(plot));

  constexpr double title_room = 1.5 * style::type_size;
  const double right = names > 0 ? names + 1.5 * dot : 1.2 * style::small_type;
  const double top = dot;
  const double bottom = tick + label_gap + 1.2 * style::small_type + title_room;
  const Ticks y_ticks = ticks_of(y, plot.y, {place.height - top - bottom, height_along_axis});
  const double left = title_room + longest(y_ticks.labels) + label_gap + tick;
  const Ticks x_ticks = ticks_of(x, plot.x, {place.width - left - right, width_along_axis});

  const auto chart = std::make_shared<QCustomPlot>();
  chart->setBackground(Qt::NoBrush);
  chart->setAntialiasedElements(QCP::aeAll);
  QCPAxisRect& rect = *chart->axisRect();
  rect.setAutoMargins(QCP::msNone);
  rect.setMargins(QMargins(int(left), int(top), int(right), int(bottom)));
  set_up(*chart->xAxis, plot.x, x, x_ticks);
  set_up(*chart->yAxis, plot.y, y, y_ticks);
  rect.setRangeDrag({});
  for (const Series& series : plot.series) add(*chart, series);
  chart->setViewport(QRect(0, 0, int(place.width), int(place.height)));
  chart->replot(QCustomPlot::rpImmediateRefresh);
  sheet.mark([=](QCPPainter& painter) {
    painter.save();
    painter.translate(place.left, place.top);
    chart->toPainter(&painter, int(place.width), int(place.height));
    painter.restore();
  });

  const auto at = [=](const Vec2& point) {
    return Vec2{place.left + chart->xAxis->coordToPixel(point[0]),
                place.top + chart->yAxis->coordToPixel(point[1])};
  };
  draw_names(sheet, plot, at, {place.top + top, place.bottom() - bottom},
             place.right() - right + dot);
  for (const Note& note : plot.notes) {
    const Vec2 p = at(note.point);
    sheet.text({p[0] + note.offset[0], p[1] + note.offset[1]}, note.text, note.style);
  }
  TextStyle title{style::type_size, style::ink, 0.5};
  sheet.text(
      {place.left + (left + place.width - right) / 2, place.bottom() - 0.35 * style::type_size},
      title_of(plot.x, x_ticks.exponent), title);
  title.upright = false;
  sheet.text({place.left + 0.9 * style::type_size, place.top + (top + place.height - bottom) / 2},
             title_of(plot.y, y_ticks.exponent), title);
}

Sheet sheet_of(const Plot& plot) {
  constexpr double width = 1400, height = 1050, margin = 40;
  Sheet sheet(width, height);
  draw(sheet, {margin, margin, width - 2 * margin, height - 2 * margin}, plot);
  return sheet;
}

} // namespace lamella::render
