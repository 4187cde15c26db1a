#include "render/block.h"

#include "render/style.h"

#include <algorithm>
#include <numeric>

namespace lamella::render {
namespace {

constexpr double margin = 50, gap = 60; ///< of pages
constexpr double plot_aspect = 0.68;    ///< height over width
constexpr double line_height = 1.35 * style::small_type;
constexpr double cell_gap = 40, row_height = 1.6 * style::small_type;
constexpr double capital_height = 0.73; ///< of letters, in the size of their type

TextStyle small() { return {style::small_type, style::ink}; }

void rule(Sheet& sheet, const Box& place, double y, double width) {
  sheet.line({{place.left, y}, {place.right(), y}}, {width, style::ink});
}

std::vector<double> column_widths(const TableCells& cells) {
  std::vector<double> widths(cells.front().size(), 0);
  for (const auto& row : cells)
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], text_width(row[c], small()));
  return widths;
}

} // namespace

double Heading::height() const {
  return letter.empty() && title.empty() ? 0 : 1.5 * style::type_size;
}

void Heading::draw(Sheet& sheet, const Box& place) const {
  const double base = place.top + 0.85 * style::type_size;
  sheet.text({place.left, base}, letter, {style::type_size, style::ink, 0, Face::bold});
  const double indent = letter.empty() ? 0 : 1.1 * style::type_size;
  sheet.text({place.left + indent, base}, title, small());
}

double PlotBlock::height(double width) const { return heading_.height() + plot_aspect * width; }

void PlotBlock::draw(Sheet& sheet, const Box& place, Camera) const {
  heading_.draw(sheet, place);
  const double top = heading_.height();
  render::draw(sheet, {place.left, place.top + top, place.width, plot_aspect * place.width}, plot_);
}

double TableBlock::height(double) const {
  return heading_.height() + row_height * double(cells_.size()) + 0.6 * row_height;
}

/// As wide as the text wants where there is room, closer where there is not, then smaller.
void TableBlock::draw(Sheet& sheet, const Box& place, Camera) const {
  heading_.draw(sheet, place);
  std::vector<double> widths = column_widths(cells_);
  const double gaps = std::max<double>(double(widths.size()) - 1, 1);
  const double wanted = std::accumulate(widths.begin(), widths.end(), 0.0);
  const double shrink = std::min(1.0, place.width / (wanted + gaps * 0.6 * cell_gap));
  for (double& width : widths) width *= shrink;
  const double total = shrink * wanted;
  const double between = std::min(2.5 * cell_gap, (place.width - total) / gaps);
  const Box used{place.left, place.top, total + between * double(widths.size() - 1), place.height};
  double y = place.top + heading_.height();
  rule(sheet, used, y, style::hairline * 1.5);
  for (std::size_t r = 0; r < cells_.size(); ++r) {
    y += row_height;
    double right = used.left - between;
    for (std::size_t c = 0; c < cells_[r].size(); ++c) {
      const double left = right + between;
      right = left + widths[c];
      TextStyle style = small();
      style.size *= shrink;
      style.align = c == 0 ? 0 : 1;
      const double base = y - (row_height - capital_height * style.size) / 2;
      sheet.text({c == 0 ? left : right, base}, cells_[r][c], style);
    }
    if (r + 1 == heads_) rule(sheet, used, y, style::hairline);
  }
  rule(sheet, used, y, style::hairline * 1.5);
}

double TextBlock::height(double width) const {
  return line_height * double(wrapped(text_, small(), width).size());
}

void TextBlock::draw(Sheet& sheet, const Box& place, Camera) const {
  double base = place.top + 0.8 * line_height;
  for (const std::string& line : wrapped(text_, small(), place.width)) {
    sheet.text({place.left, base}, line, small());
    base += line_height;
  }
}

void Page::add_row(std::vector<Part> parts, double weights) {
  rows_.push_back({std::move(parts), weights});
}

void Page::add(std::unique_ptr<Block> block) {
  std::vector<Part> parts;
  parts.push_back({std::move(block)});
  add_row(std::move(parts), 1);
}

Sheet Page::draw(Camera camera) const {
  Sheet sheet(width_);
  double top = margin;
  for (const Row& row : rows_) {
    const double unit = (width_ - 2 * margin + gap) / row.weights;
    double left = margin, height = 0;
    for (const Part& part : row.parts) {
      const double width = part.weight * unit - gap;
      const Box place{left, top, width, part.block->height(width)};
      part.block->draw(sheet, place, camera);
      height = std::max(height, place.height);
      left += part.weight * unit;
    }
    top += height + gap;
  }
  sheet.set_height(top - gap + margin);
  return sheet;
}

} // namespace lamella::render
