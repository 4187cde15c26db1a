#include "store/frame.h"

#include "error.h"
#include "store/atomic_file.h"
#include "store/hdf5.h"
#include "store/posix_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

// A frame is composed in memory by HDF5 and written by us, so that errors of the disk come in the
// system's words and never reach HDF5. A checksum follows what HDF5 regards as the file: readers of
// HDF5 do not look there, and read_frame hands no damaged bytes to HDF5.

namespace lamella {
namespace {

constexpr int most_nodes_along_axis = 1024;
constexpr std::size_t most_nodes = std::size_t(1) << 28;
constexpr int most_cells = 1'000'000;
constexpr std::size_t most_inflation = 1100; // deflate reaches 1032
constexpr int deflate_level = 1;
constexpr hsize_t chunk_planes = 8;

/// Values at the nodes, and the name of their data array.
struct NodalField {
  const char* name;
  std::vector<double> Frame::*values;
};
/// The first one is in every frame.
constexpr std::array<NodalField, 3> fields{
    {{"phi", &Frame::phi}, {"psi", &Frame::psi}, {"c", &Frame::c}}};

bool is_optional(const NodalField& field) { return &field != &fields.front(); }

constexpr std::string_view trailer_mark = "lamella frame, FNV-1a ";
constexpr std::size_t trailer_size = trailer_mark.size() + 16 + 1;

/// FNV-1a over 64 bits.
std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte b : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3;
  return hash;
}

std::string trailer(std::span<const std::byte> image) {
  return fmt::format("{}{:016x}\n", trailer_mark, checksum(image));
}

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

/// Throws StoreError for a frame that no reader would take.
void check(const std::filesystem::path& file, const Frame& frame) {
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
  for (const NodalField& field : fields) {
    const std::vector<double>& values = frame.*field.values;
    if (values.size() != frame.grid.size() && !(values.empty() && is_optional(field)))
      refuse(fmt::format("{} has {} values, the grid {} nodes", field.name, values.size(),
                         frame.grid.size()));
    if (!all_finite(values)) refuse(fmt::format("{} has values that are not finite", field.name));
  }
  if (std::ranges::any_of(frame.cells, [](int n) { return std::abs(n) > most_cells; }))
    refuse(fmt::format("the box has moved by ({}) cells", fmt::join(frame.cells, ", ")));
  if (!std::isfinite(frame.time)) refuse(fmt::format("the time is {}", frame.time));
}

// Writing: HDF5 works in memory here and can fail for want of memory only.

struct H5Failure {};

template <class Id>
Id required(Id result) {
  if (result < 0) throw H5Failure{};
  return result;
}

H5Handle owned(hid_t id) { return H5Handle(required(id)); }

/// Creation properties without time stamps: equal frames make equal files.
H5Handle creation(hid_t of_class) {
  H5Handle properties = owned(H5Pcreate(of_class));
  required(H5Pset_obj_track_times(properties, false));
  return properties;
}

H5Handle create_group(hid_t parent, const char* name) {
  const H5Handle properties = creation(H5P_GROUP_CREATE);
  return owned(H5Gcreate2(parent, name, H5P_DEFAULT, properties, H5P_DEFAULT));
}

void write_attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type,
                     hsize_t count, const void* values) {
  const H5Handle space = owned(H5Screate_simple(1, &count, nullptr));
  const H5Handle attribute =
      owned(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT));
  required(H5Awrite(attribute, memory_type, values));
}

template <std::size_t n>
void write_attribute(hid_t object, const char* name, const std::array<double, n>& values) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, n, values.data());
}

template <std::size_t n>
void write_attribute(hid_t object, const char* name, const std::array<int, n>& values) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT, n, values.data());
}

void write_attribute(hid_t object, const char* name, std::string_view value) {
  const H5Handle type = owned(H5Tcopy(H5T_C_S1));
  required(H5Tset_size(type, value.size()));
  required(H5Tset_strpad(type, H5T_STR_NULLPAD));
  const H5Handle space = owned(H5Screate(H5S_SCALAR));
  const H5Handle attribute = owned(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  required(H5Awrite(attribute, type, value.data()));
}

void write_field(hid_t group, const char* name, const Grid& grid,
                 const std::vector<double>& values) {
  const std::array<hsize_t, 3> size{hsize_t(grid.nz()), hsize_t(grid.ny()), hsize_t(grid.nx())};
  const std::array<hsize_t, 3> chunk{std::min(size[0], chunk_planes), size[1], size[2]};
  const H5Handle properties = creation(H5P_DATASET_CREATE);
  required(H5Pset_chunk(properties, 3, chunk.data()));
  required(H5Pset_shuffle(properties));
  required(H5Pset_deflate(properties, deflate_level));
  const H5Handle space = owned(H5Screate_simple(3, size.data(), nullptr));
  const H5Handle data =
      owned(H5Dcreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  required(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

/// Where there are several fields, says which of them readers show first.
void write_fields(hid_t points, const Frame& frame) {
  for (const NodalField& field : fields)
    if (const std::vector<double>& values = frame.*field.values; !values.empty())
      write_field(points, field.name, frame.grid, values);
  if (!frame.psi.empty() || !frame.c.empty())
    write_attribute(points, "Scalars", fields.front().name);
}

void write_contents(hid_t file, const Frame& frame) {
  const Grid& grid = frame.grid;
  const H5Handle vtk = create_group(file, "VTKHDF");
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
  const H5Handle lamella = create_group(file, "lamella");
  write_attribute(lamella, "time", std::array{frame.time});
}

/// The bytes of an HDF5 file.
std::vector<std::byte> compose(const Frame& frame) {
  const H5Session session;
  const H5Handle access = owned(H5Pcreate(H5P_FILE_ACCESS));
  const std::size_t growth = std::max<std::size_t>(1 << 16, frame.phi.size());
  required(H5Pset_fapl_core(access, growth, false));
  const H5Handle creator = creation(H5P_FILE_CREATE);
  const H5Handle file = owned(H5Fcreate("frame in memory", H5F_ACC_TRUNC, creator, access));
  write_contents(file, frame);
  required(H5Fflush(file, H5F_SCOPE_GLOBAL));
  std::vector<std::byte> image(
      static_cast<std::size_t>(required(H5Fget_file_image(file, nullptr, 0))));
  required(H5Fget_file_image(file, image.data(), image.size()));
  return image;
}

} // namespace

void write_frame(const std::filesystem::path& file, const Frame& frame) {
  check(file, frame);
  std::vector<std::byte> image;
  try {
    image = compose(frame);
  } catch (const H5Failure&) {
    throw StoreError(fmt::format("{}: not written: HDF5 ran out of memory", file.string()));
  }
  const std::string end = trailer(image);
  const auto end_bytes = std::as_bytes(std::span(end));
  image.insert(image.end(), end_bytes.begin(), end_bytes.end());
  write_atomically(file, image);
}

namespace {

/// Reads one frame. Every failure is a StoreError that names the file.
class FrameReader {
public:
  explicit FrameReader(const std::filesystem::path& file) : file_(file), image_(verified_image()) {}

  Frame read() {
    const H5Session session;
    const H5Handle access = required(H5Pcreate(H5P_FILE_ACCESS), "no memory");
    if (H5Pset_fapl_core(access, 1 << 16, false) < 0 ||
        H5Pset_file_image(access, image_.data(), image_.size()) < 0)
      refuse("no memory");
    const H5Handle file =
        required(H5Fopen("frame in memory", H5F_ACC_RDONLY, access), "not an HDF5 file");
    const H5Handle vtk = required(H5Gopen2(file, "VTKHDF", H5P_DEFAULT), "no group VTKHDF");
    Frame frame;
    frame.grid = read_grid(vtk);
    frame.cells = read_cells(vtk, frame.grid);
    const H5Handle lamella = required(H5Gopen2(file, "lamella", H5P_DEFAULT), "no group lamella");
    frame.time = read_attribute<double, 1>(lamella, "time")[0];
    if (!std::isfinite(frame.time)) refuse("it has values that are not finite");
    const H5Handle points = required(H5Gopen2(vtk, "PointData", H5P_DEFAULT), "no PointData");
    for (const NodalField& field : fields)
      if (!is_optional(field) || H5Lexists(points, field.name, H5P_DEFAULT) > 0)
        frame.*field.values = read_field(points, field.name, frame.grid);
    return frame;
  }

private:
  [[noreturn]] void refuse(std::string_view why) const {
    throw StoreError(fmt::format("{}: cannot be read as a frame: {}", file_.string(), why));
  }

  H5Handle required(hid_t id, std::string_view why) const {
    if (id < 0) refuse(why);
    return H5Handle(id);
  }

  /// The file without its trailer, which must fit.
  std::vector<std::byte> verified_image() const {
    std::error_code error;
    const auto size = std::filesystem::file_size(file_, error);
    if (error)
      throw StoreError(fmt::format("{}: cannot be read: {}", file_.string(), error.message()));
    if (size <= trailer_size || size > most_nodes * sizeof(double) * (fields.size() + 1))
      refuse("its size is out of range");
    std::ifstream stream(file_, std::ios::binary);
    std::vector<std::byte> bytes(size);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
      throw_system_error(file_, "read");
    const std::string end(reinterpret_cast<const char*>(bytes.data()) + size - trailer_size,
                          trailer_size);
    bytes.resize(size - trailer_size);
    if (!end.starts_with(trailer_mark)) refuse("it is not one, or it is cut off");
    if (end != trailer(bytes)) refuse("it is damaged (the checksum does not fit)");
    return bytes;
  }

  template <class T, std::size_t n>
  std::array<T, n> read_attribute(hid_t object, const char* name) const {
    constexpr bool is_real = std::is_floating_point_v<T>;
    const std::string trouble = fmt::format("attribute {} is missing or of the wrong type", name);
    const H5Handle attribute = required(H5Aopen(object, name, H5P_DEFAULT), trouble);
    const H5Handle type = required(H5Aget_type(attribute), trouble);
    const H5Handle space = required(H5Aget_space(attribute), trouble);
    std::array<T, n> values{};
    if (H5Tget_class(type) != (is_real ? H5T_FLOAT : H5T_INTEGER) ||
        H5Sget_simple_extent_npoints(space) != hssize_t(n) ||
        H5Aread(attribute, is_real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT, values.data()) < 0)
      refuse(trouble);
    return values;
  }

  Grid read_grid(hid_t vtk) const {
    const auto extent = read_attribute<int, 6>(vtk, "WholeExtent");
    const auto spacing = read_attribute<double, 3>(vtk, "Spacing");
    Grid grid{{}, spacing[0]};
    for (int i = 0; i < 3; ++i) {
      if (extent[2 * i] != 0 || extent[2 * i + 1] < 0 || extent[2 * i + 1] >= most_nodes_along_axis)
        refuse("WholeExtent is out of range");
      grid.nodes[i] = extent[2 * i + 1] + 1;
    }
    if (grid.size() > most_nodes) refuse("WholeExtent is out of range");
    if (!(spacing[0] > 0) || !std::isfinite(spacing[0]) || spacing[1] != spacing[0] ||
        spacing[2] != spacing[0])
      refuse("the grid spacing must be positive and the same along all axes");
    return grid;
  }

  std::array<int, 3> read_cells(hid_t vtk, const Grid& grid) const {
    const auto origin = read_attribute<double, 3>(vtk, "Origin");
    std::array<int, 3> cells{};
    for (int i = 0; i < 3; ++i) {
      const double moved = (origin[i] - grid.origin(i)) / grid.spacing, whole = std::round(moved);
      if (!(std::abs(whole) <= most_cells && std::abs(moved - whole) <= 1e-6))
        refuse("Origin is not a whole number of cells from that of a centred grid");
      cells[i] = int(whole);
    }
    return cells;
  }

  std::vector<double> read_field(hid_t points, const char* name, const Grid& grid) const {
    const auto trouble = [&](const char* what) {
      return fmt::format("PointData/{} {}", name, what);
    };
    const H5Handle data = required(H5Dopen2(points, name, H5P_DEFAULT), trouble("is missing"));
    const H5Handle type = required(H5Dget_type(data), trouble("has no type"));
    const H5Handle space = required(H5Dget_space(data), trouble("has no size"));
    const H5Handle layout = required(H5Dget_create_plist(data), trouble("has no layout"));
    const std::array<hsize_t, 3> expected{hsize_t(grid.nz()), hsize_t(grid.ny()),
                                          hsize_t(grid.nx())};
    std::array<hsize_t, 3> size{}, chunk{};
    if (H5Tget_class(type) != H5T_FLOAT || H5Tget_size(type) != sizeof(double))
      refuse(trouble("is not of doubles"));
    if (H5Sget_simple_extent_ndims(space) != 3 ||
        H5Sget_simple_extent_dims(space, size.data(), nullptr) != 3 || size != expected)
      refuse(trouble("does not agree with WholeExtent"));
    if (H5Pget_layout(layout) != H5D_CHUNKED || H5Pget_chunk(layout, 3, chunk.data()) != 3 ||
        !std::ranges::equal(chunk, size, std::ranges::less_equal{}))
      refuse(trouble("is not chunked as frames are"));
    if (grid.size() * sizeof(double) > most_inflation * image_.size())
      refuse(trouble("is larger than what the file can hold"));
    std::vector<double> values(grid.size());
    if (H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      refuse(trouble("is damaged"));
    if (!all_finite(values)) refuse(trouble("has values that are not finite"));
    return values;
  }

  std::filesystem::path file_;
  std::vector<std::byte> image_;
};

} // namespace

Frame read_frame(const std::filesystem::path& file) { return FrameReader(file).read(); }

} // namespace lamella
