#include "fields/image_lattice.h"

#include "fields/image.h"

#include <vtkMatrix3x3.h>

#include <Eigen/Core>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double rounding = 1e-4; // of a direction: over 512 nodes, a twentieth of a spacing

Matrix3d directions_of(vtkImageData& image) {
  Matrix3d directions;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      directions(row, column) = image.GetDirectionMatrix()->GetElement(row, column);
  return directions;
}

/// The signed axes of space that are next to directions, one each.
Matrix3d next_axes(const Matrix3d& directions) {
  return directions.unaryExpr([](double x) { return std::abs(x) > 0.5 ? std::copysign(1, x) : 0; });
}

std::string numbers(const Vector3d& x) {
  return fmt::format("{:.10g}, {:.10g}, {:.10g}", x[0], x[1], x[2]);
}

[[noreturn]] void refuse_turned(const Matrix3d& turn, vtkImageData& image) {
  if (!((turn * turn.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-3))
    throw InputError("the image's direction matrix is not that of a rotation");
  const Vector3d origin(image.GetOrigin()), from = origin - turn.transpose() * origin;
  throw InputError(fmt::format(
      "the image is turned: its axes are not x, y and z; vtkImageReslice with "
      "SetResliceAxesDirectionCosines({}, {}, {}), SetResliceAxesOrigin({}) and AutoCropOutputOn() "
      "brings a mask onto them; for a level set also SetInterpolationModeToCubic() and "
      "SetBackgroundLevel() with its largest value",
      numbers(turn.row(0)), numbers(turn.row(1)), numbers(turn.row(2)), numbers(from)));
}

} // namespace

ImageLattice::ImageLattice(vtkImageData& image, bool of_cells) {
  int extent[6];
  image.GetExtent(extent);
  if (image.GetNumberOfPoints() == 0) throw InputError("the image is empty");
  std::array<int, 3> nodes;
  image.GetDimensions(nodes.data());
  if (std::ranges::min(nodes) < 2)
    throw InputError(fmt::format("the image is flat: it has {} nodes, and a membrane needs three "
                                 "dimensions",
                                 fmt::join(nodes, " x ")));
  Vec3 spacing;
  image.GetSpacing(spacing.data());
  if (!std::ranges::all_of(spacing, [](double h) { return h > 0 && std::isfinite(h); }))
    throw InputError(fmt::format("the image has spacings of {:g}; they must be positive",
                                 fmt::join(spacing, ", ")));
  const Matrix3d turn = directions_of(image), axes = next_axes(turn);
  if (!((turn - axes).cwiseAbs().maxCoeff() <= rounding) || !axes.isUnitary())
    refuse_turned(turn, image);
  double first[3]; // index of the node that comes first
  for (int a = 0; a < 3; ++a) {
    int own = 0;
    axes.row(a).cwiseAbs().maxCoeff(&own);
    axis_[a] = own;
    flipped_[a] = axes(a, own) < 0;
    lattice_.nodes[a] = nodes[own] - of_cells;
    lattice_.spacing[a] = spacing[own];
    first[own] =
        flipped_[a] ? extent[2 * own + 1] - 0.5 * of_cells : extent[2 * own] + 0.5 * of_cells;
  }
  image.TransformContinuousIndexToPhysicalPoint(first, lattice_.first.data());
  if (!std::ranges::all_of(lattice_.first, [](double x) { return std::isfinite(x); }))
    throw InputError("the image's origin is not finite");
}

std::vector<double> ImageLattice::in_order(std::vector<double> values) const {
  if (values.empty() ||
      (axis_ == std::array{0, 1, 2} && flipped_ == std::array{false, false, false}))
    return values;
  const std::array<int, 3>& nodes = lattice_.nodes;
  std::array<int, 3> own; // nodes along the image's axes
  for (int a = 0; a < 3; ++a) own[axis_[a]] = nodes[a];
  const std::array<std::ptrdiff_t, 3> strides{1, own[0], std::ptrdiff_t(own[0]) * own[1]};
  std::ptrdiff_t start = 0;
  std::array<std::ptrdiff_t, 3> step;
  for (int a = 0; a < 3; ++a) {
    step[a] = flipped_[a] ? -strides[axis_[a]] : strides[axis_[a]];
    if (flipped_[a]) start += (nodes[a] - 1) * strides[axis_[a]];
  }
  std::vector<double> out;
  out.reserve(values.size());
  for (int k = 0; k < nodes[2]; ++k)
    for (int j = 0; j < nodes[1]; ++j)
      for (int i = 0; i < nodes[0]; ++i)
        out.push_back(values[start + i * step[0] + j * step[1] + k * step[2]]);
  return out;
}

} // namespace lamella
