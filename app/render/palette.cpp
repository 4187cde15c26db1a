#include "render/palette.h"

#include "render/style.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace lamella::render {
namespace {

constexpr int steps = 256;

/// Where the colours turn, if anywhere.
std::optional<double> middle(const Quantity& quantity) {
  if (quantity == Quantity::c) return 1;
  if (quantity == Quantity::K_M || quantity == Quantity::K || quantity == Quantity::velocity)
    return 0;
  return {};
}

void add(vtkColorTransferFunction& function, double at, const Color& color) {
  function.AddRGBPoint(at, color.r / 255.0, color.g / 255.0, color.b / 255.0);
}

} // namespace

Palette::Palette(const Quantity& quantity, ValueRange range) : range_(range) {
  vtkNew<vtkColorTransferFunction> function;
  if (middle(quantity)) {
    function->SetColorSpaceToDiverging();
    add(*function, 0, style::Lo.line);
    add(*function, 1, style::Ld.line);
  } else {
    function->SetColorSpaceToLab();
    add(*function, 0, {250, 240, 222});
    add(*function, 0.5, {236, 138, 92});
    add(*function, 1, {88, 22, 62});
  }
  for (int n = 0; n < steps; ++n) {
    double rgb[3];
    function->GetColor(double(n) / (steps - 1), rgb);
    const auto byte = [](double x) { return static_cast<unsigned char>(std::lround(255 * x)); };
    colors_.push_back({byte(rgb[0]), byte(rgb[1]), byte(rgb[2])});
  }
}

const Color& Palette::at(double value) const {
  const double s = (value - range_.low) / (range_.high - range_.low);
  return colors_[std::size_t(std::lround(std::clamp(s, 0.0, 1.0) * (steps - 1)))];
}

ValueRange range_of(const Quantity& quantity, const std::vector<Surface>& surfaces) {
  std::vector<double> values;
  for (const Surface& surface : surfaces) {
    vtkDataArray* array = surface.mesh->GetPointData()->GetArray(quantity.name.c_str());
    for (vtkIdType n = 0; n < array->GetNumberOfTuples(); ++n)
      if (std::isfinite(array->GetTuple1(n))) values.push_back(array->GetTuple1(n));
  }
  if (values.empty()) return {-1, 1};
  std::ranges::sort(values);
  const double low = values[values.size() / 100],
               high = values[values.size() - 1 - values.size() / 100];
  const double least = 1e-6 * std::max({std::abs(low), std::abs(high), 1e-300});
  if (const auto centre = middle(quantity)) {
    const double reach = std::max({std::abs(low - *centre), std::abs(high - *centre), least});
    return {*centre - reach, *centre + reach};
  }
  return {low, std::max(high, low + least)};
}

} // namespace lamella::render
