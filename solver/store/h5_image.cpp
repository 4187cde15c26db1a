#include "store/h5_image.h"

#include "error.h"
#include "grid/memory.h"
#include "regular_file.h"
#include "store/atomic_file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace lamella {

namespace {

constexpr const char* in_memory = "file in memory";
constexpr std::size_t longest_text = 1 << 16;
constexpr std::uintmax_t largest_file = std::uintmax_t(1) << 36;

constexpr std::string_view trailer_mark = "lamella frame, XXH3 ";
constexpr std::size_t trailer_size = trailer_mark.size() + 16 + 1;

std::string trailer(std::span<const std::byte> image) {
  return fmt::format("{}{:016x}\n", trailer_mark, XXH3_64bits(image.data(), image.size()));
}

/// Memory for a file that HDF5 composes, which outlives the file: no copy is made of it.
class ImageMemory {
public:
  /// Sets HDF5 up to write to this memory, of at first `size` bytes.
  H5Handle file_access(std::size_t size) {
    bytes_.reserve(size + trailer_size);
    H5Handle access = owned(H5Pcreate(H5P_FILE_ACCESS));
    required(H5Pset_fapl_core(access, size, false));
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.udata = this;
    callbacks.udata_copy = [](void* memory) { return memory; };
    callbacks.udata_free = [](void*) { return herr_t(0); };
    callbacks.image_malloc = [](std::size_t bytes, H5FD_file_image_op_t, void* memory) {
      return resize(memory, bytes);
    };
    callbacks.image_realloc = [](void*, std::size_t bytes, H5FD_file_image_op_t, void* memory) {
      return resize(memory, bytes);
    };
    callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) { return herr_t(0); };
    required(H5Pset_file_image_callbacks(access, &callbacks));
    return access;
  }

  Array<std::byte> take(std::size_t size) {
    bytes_.resize(size);
    return std::move(bytes_);
  }

private:
  static void* resize(void* memory, std::size_t bytes) {
    try {
      Array<std::byte>& own = static_cast<ImageMemory*>(memory)->bytes_;
      own.resize(bytes);
      return own.data();
    } catch (const std::bad_alloc&) {
      return nullptr; // HDF5 is not made for exceptions
    }
  }

  Array<std::byte> bytes_;
};

/// The bytes of an HDF5 file.
Array<std::byte> compose(std::size_t size, const std::function<void(hid_t)>& fill) {
  const H5Session session;
  ImageMemory memory;
  std::size_t length = 0;
  {
    const H5Handle access = memory.file_access(size + (1 << 16));
    const H5Handle creator = creation(H5P_FILE_CREATE);
    const H5Handle file = owned(H5Fcreate(in_memory, H5F_ACC_TRUNC, creator, access));
    fill(file);
    required(H5Fflush(file, H5F_SCOPE_GLOBAL));
    length = static_cast<std::size_t>(required(H5Fget_file_image(file, nullptr, 0)));
  }
  return memory.take(length);
}

/// The content of a file without its trailer, which must fit.
std::vector<std::byte> verified(const std::filesystem::path& file, std::string_view what) {
  const auto refuse = [&](std::string_view why) {
    throw StoreError(fmt::format("{}: cannot be read as a {}: {}", file.string(), what, why));
  };
  const RegularFile source(file);
  const std::uintmax_t size = source.size();
  if (size <= trailer_size || size > largest_file) refuse("its size is out of range");
  std::string end(trailer_size, ' ');
  source.read(size - trailer_size,
              std::as_writable_bytes(std::span(end))); // before anything is allocated
  if (!end.starts_with(trailer_mark)) refuse("it is not one, or it is cut off");
  std::vector<std::byte> bytes(size - trailer_size);
  source.read(0, bytes);
  if (end != trailer(bytes)) refuse("it is damaged (the checksum does not fit)");
  return bytes;
}

} // namespace

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

void write_attribute(hid_t object, const char* name, std::string_view value) {
  const H5Handle type = owned(H5Tcopy(H5T_C_S1));
  required(H5Tset_size(type, value.size()));
  required(H5Tset_strpad(type, H5T_STR_NULLPAD));
  const H5Handle space = owned(H5Screate(H5S_SCALAR));
  const H5Handle attribute = owned(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
  required(H5Awrite(attribute, type, value.data()));
}

void write_h5(const Place& place, std::size_t size, const std::function<void(hid_t root)>& fill) {
  Array<std::byte> image;
  try {
    image = compose(size, fill);
  } catch (const H5Failure&) {
    throw StoreError(fmt::format("{}: not written: HDF5 ran out of memory", place.path().string()));
  }
  const std::string end = trailer(image);
  const auto end_bytes = std::as_bytes(std::span(end));
  image.insert(image.end(), end_bytes.begin(), end_bytes.end());
  write_atomically(place, image);
}

H5Image::H5Image(const std::filesystem::path& file, std::string_view what)
    : path_(file), what_(what), file_([&] {
        const std::vector<std::byte> bytes = verified(file, what);
        size_ = bytes.size();
        return open(bytes);
      }()) {}

H5Handle H5Image::open(std::span<const std::byte> bytes) const {
  const H5Handle access = required(H5Pcreate(H5P_FILE_ACCESS), "no memory");
  if (H5Pset_fapl_core(access, 1 << 16, false) < 0 ||
      H5Pset_file_image(access, const_cast<std::byte*>(bytes.data()), bytes.size()) < 0)
    refuse("no memory");
  return required(H5Fopen(in_memory, H5F_ACC_RDONLY, access), "not an HDF5 file");
}

void H5Image::refuse(std::string_view why) const {
  throw StoreError(fmt::format("{}: cannot be read as a {}: {}", path_.string(), what_, why));
}

H5Handle H5Image::required(hid_t id, std::string_view why) const {
  if (id < 0) refuse(why);
  return H5Handle(id);
}

bool H5Image::has(hid_t parent, const char* name) const {
  return H5Lexists(parent, name, H5P_DEFAULT) > 0;
}

H5Handle H5Image::group(hid_t parent, const char* name) const {
  return required(H5Gopen2(parent, name, H5P_DEFAULT), fmt::format("no group {}", name));
}

std::vector<std::string> H5Image::names(hid_t group) const {
  H5G_info_t info{};
  if (H5Gget_info(group, &info) < 0) refuse("a group is damaged");
  std::vector<std::string> all;
  for (hsize_t i = 0; i < info.nlinks; i++) {
    const auto name = [&](char* text, std::size_t size) {
      return H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, text, size, H5P_DEFAULT);
    };
    const ssize_t length = name(nullptr, 0);
    if (length < 0 || std::size_t(length) > longest_text) refuse("a name is damaged");
    std::string& text = all.emplace_back(std::size_t(length), ' ');
    if (name(text.data(), text.size() + 1) < 0) refuse("a name is damaged");
  }
  return all;
}

std::string H5Image::text_attribute(hid_t object, const char* name) const {
  const std::string trouble = fmt::format("attribute {} is missing or no text", name);
  const H5Handle attribute = required(H5Aopen(object, name, H5P_DEFAULT), trouble);
  const H5Handle type = required(H5Aget_type(attribute), trouble);
  const H5Handle space = required(H5Aget_space(attribute), trouble);
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || size > longest_text ||
      H5Sget_simple_extent_npoints(space) != 1)
    refuse(trouble);
  std::string text(size, ' ');
  if (H5Aread(attribute, type, text.data()) < 0) refuse(trouble);
  return text;
}

void H5Image::read_attribute(hid_t object, const char* name, bool real, std::size_t count,
                             void* values) const {
  const std::string trouble = fmt::format("attribute {} is missing or of the wrong type", name);
  const H5Handle attribute = required(H5Aopen(object, name, H5P_DEFAULT), trouble);
  const H5Handle type = required(H5Aget_type(attribute), trouble);
  const H5Handle space = required(H5Aget_space(attribute), trouble);
  if (H5Tget_class(type) != (real ? H5T_FLOAT : H5T_INTEGER) ||
      H5Sget_simple_extent_npoints(space) != hssize_t(count) ||
      H5Aread(attribute, real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT, values) < 0)
    refuse(trouble);
}

} // namespace lamella
