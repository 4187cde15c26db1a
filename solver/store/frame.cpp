#include "store/frame.h"

#include "error.h"
#include "store/frame_h5.h"
#include "store/place_frame.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lamella {
namespace {

constexpr int most_nodes_along_axis = 1024;
constexpr std::size_t most_nodes = std::size_t(1) << 28;
constexpr int most_cells = 1'000'000;

constexpr const char* membrane = "phi"; ///< the data array that is in every frame

/// Without an early end, so that it vectorises: what is checked is finite.
bool all_finite(std::span<const double> values) {
  constexpr std::uint64_t exponent = 0x7ffULL << 52;
  bool bad = false;
  for (const double x : values) bad |= (std::bit_cast<std::uint64_t>(x) & exponent) == exponent;
  return !bad;
}

void write_field(hid_t group, const char* name, const Grid& grid,
                 const std::vector<double>& values) {
  const std::array<hsize_t, 3> size{hsize_t(grid.nz()), hsize_t(grid.ny()), hsize_t(grid.nx())};
  const H5Handle properties = creation(H5P_DATASET_CREATE);
  const H5Handle space = owned(H5Screate_simple(3, size.data(), nullptr));
  const H5Handle data =
      owned(H5Dcreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  required(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

/// Where there are several fields, says which of them readers show first.
void write_fields(hid_t points, const Frame& frame) {
  write_field(points, membrane, frame.grid, frame.phi);
  for (const auto& [name, values] : frame.fields)
    write_field(points, name.c_str(), frame.grid, values);
  if (!frame.fields.empty()) write_attribute(points, "Scalars", membrane);
}

} // namespace

std::span<const double> Frame::field(std::string_view name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? std::span<const double>() : found->second;
}

void check_frame(const std::filesystem::path& file, const Frame& frame) {
  const auto refuse = [&](std::string_view why) {
    throw StoreError(fmt::format("{}: not written: {}", file.string(), why));
  };
  if (std::ranges::any_of(frame.grid.nodes,
                          [](int n) { return n < 1 || n > most_nodes_along_axis; }) ||
      frame.grid.size() > most_nodes)
    refuse(fmt::format("a grid of {} x {} x {} nodes is out of range", frame.grid.nx(),
                       frame.grid.ny(), frame.grid.nz()));
  if (!(frame.grid.spacing > 0) || !std::isfinite(frame.grid.spacing))
    refuse(fmt::format("the grid spacing is {}", frame.grid.spacing));
  const auto check = [&](std::string_view name, std::span<const double> values) {
    if (values.size() != frame.grid.size())
      refuse(fmt::format("{} has {} values, the grid {} nodes", name, values.size(),
                         frame.grid.size()));
    if (!all_finite(values)) refuse(fmt::format("{} has values that are not finite", name));
  };
  check(membrane, frame.phi);
  for (const auto& [name, values] : frame.fields) check(name, values);
  if (std::ranges::any_of(frame.cells, [](int n) { return std::abs(n) > most_cells; }))
    refuse(fmt::format("the box has moved by ({}) cells", fmt::join(frame.cells, ", ")));
  if (!std::isfinite(frame.time)) refuse(fmt::format("the time is {}", frame.time));
}

void put_frame(hid_t root, const Frame& frame) {
  const Grid& grid = frame.grid;
  const H5Handle vtk = create_group(root, "VTKHDF");
  write_attribute(vtk, "Version", std::array{1, 0});
  write_attribute(vtk, "Type", "ImageData");
  write_attribute(vtk, "WholeExtent",
                  std::array{0, grid.nx() - 1, 0, grid.ny() - 1, 0, grid.nz() - 1});
  Vec3 origin;
  for (int i = 0; i < 3; ++i) origin[i] = grid.origin(i) + frame.cells[i] * grid.spacing;
  write_attribute(vtk, "Origin", origin);
  write_attribute(vtk, "Spacing", Vec3{grid.spacing, grid.spacing, grid.spacing});
  write_attribute(vtk, "Direction", std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  const H5Handle points = create_group(vtk, "PointData");
  write_fields(points, frame);
  const H5Handle lamella = create_group(root, "lamella");
  write_attribute(lamella, "time", std::array{frame.time});
}

void write_frame(const std::filesystem::path& file, const Frame& frame) {
  write_frame(Place(file), frame);
}

void write_frame(const Place& place, const Frame& frame) {
  check_frame(place.path(), frame);
  const std::size_t size = (1 + frame.fields.size()) * frame.phi.size() * sizeof(double);
  write_h5(place, size, [&](hid_t root) { put_frame(root, frame); });
}

namespace {

/// Reads the frame in a file.
class FrameReader {
public:
  explicit FrameReader(const H5Image& image) : image_(image) {}

  Frame read() const {
    const H5Handle vtk = image_.group(image_.root(), "VTKHDF");
    Frame frame;
    frame.grid = read_grid(vtk);
    frame.cells = read_cells(vtk, frame.grid);
    const H5Handle lamella = image_.group(image_.root(), "lamella");
    frame.time = image_.attribute<double, 1>(lamella, "time")[0];
    if (!std::isfinite(frame.time)) image_.refuse("it has values that are not finite");
    const H5Handle points = image_.group(vtk, "PointData");
    frame.phi = read_field(points, membrane, frame.grid);
    for (const std::string& name : image_.names(points))
      if (name != membrane) frame.fields[name] = read_field(points, name.c_str(), frame.grid);
    return frame;
  }

private:
  Grid read_grid(hid_t vtk) const {
    const auto extent = image_.attribute<int, 6>(vtk, "WholeExtent");
    const auto spacing = image_.attribute<double, 3>(vtk, "Spacing");
    Grid grid{{}, spacing[0]};
    for (int i = 0; i < 3; ++i) {
      if (extent[2 * i] != 0 || extent[2 * i + 1] < 0 || extent[2 * i + 1] >= most_nodes_along_axis)
        image_.refuse("WholeExtent is out of range");
      grid.nodes[i] = extent[2 * i + 1] + 1;
    }
    if (grid.size() > most_nodes) image_.refuse("WholeExtent is out of range");
    if (!(spacing[0] > 0) || !std::isfinite(spacing[0]) || spacing[1] != spacing[0] ||
        spacing[2] != spacing[0])
      image_.refuse("the grid spacing must be positive and the same along all axes");
    return grid;
  }

  std::array<int, 3> read_cells(hid_t vtk, const Grid& grid) const {
    const auto origin = image_.attribute<double, 3>(vtk, "Origin");
    std::array<int, 3> cells{};
    for (int i = 0; i < 3; ++i) {
      const double moved = (origin[i] - grid.origin(i)) / grid.spacing, whole = std::round(moved);
      if (!(std::abs(whole) <= most_cells && std::abs(moved - whole) <= 1e-6))
        image_.refuse("Origin is not a whole number of cells from that of a centred grid");
      cells[i] = int(whole);
    }
    return cells;
  }

  std::vector<double> read_field(hid_t points, const char* name, const Grid& grid) const {
    const auto trouble = [&](const char* what) {
      return fmt::format("PointData/{} {}", name, what);
    };
    const H5Handle data =
        image_.required(H5Dopen2(points, name, H5P_DEFAULT), trouble("is missing"));
    const H5Handle type = image_.required(H5Dget_type(data), trouble("has no type"));
    const H5Handle space = image_.required(H5Dget_space(data), trouble("has no size"));
    const H5Handle layout = image_.required(H5Dget_create_plist(data), trouble("has no layout"));
    const std::array<hsize_t, 3> expected{hsize_t(grid.nz()), hsize_t(grid.ny()),
                                          hsize_t(grid.nx())};
    std::array<hsize_t, 3> size{};
    if (H5Tget_class(type) != H5T_FLOAT || H5Tget_size(type) != sizeof(double))
      image_.refuse(trouble("is not of doubles"));
    if (H5Sget_simple_extent_ndims(space) != 3 ||
        H5Sget_simple_extent_dims(space, size.data(), nullptr) != 3 || size != expected)
      image_.refuse(trouble("does not agree with WholeExtent"));
    if (H5Pget_layout(layout) != H5D_CONTIGUOUS || grid.size() > image_.size() / sizeof(double))
      image_.refuse(trouble("is larger than what the file can hold"));
    std::vector<double> values(grid.size());
    if (H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      image_.refuse(trouble("is damaged"));
    if (!all_finite(values)) image_.refuse(trouble("has values that are not finite"));
    return values;
  }

  const H5Image& image_;
};

} // namespace

Frame read_frame(const std::filesystem::path& file) {
  const H5Image image(file, "frame");
  return FrameReader(image).read();
}

} // namespace lamella
