#pragma once
#include "store/folder.h"
#include "store/hdf5.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// HDF5 files that are composed and taken apart in memory, so that errors of the disk come in the
// system's words and never reach HDF5. A checksum follows what HDF5 regards as the file: readers of
// HDF5 do not look there, and ours hands no damaged bytes to HDF5.
namespace lamella {

/// Write a file by filling its root group; about `size` bytes. Whole or not at all; equal contents
/// make equal files. Throws StoreError.
void write_h5(const Place& place, std::size_t size, const std::function<void(hid_t root)>& fill);

// To be called while a file is filled. They fail for want of memory only, which write_h5 reports.

struct H5Failure {};

template <class Id>
Id required(Id result) {
  if (result < 0) throw H5Failure{};
  return result;
}

inline H5Handle owned(hid_t id) { return H5Handle(required(id)); }

/// Creation properties without time stamps.
H5Handle creation(hid_t of_class);
H5Handle create_group(hid_t parent, const char* name);
void write_attribute(hid_t object, const char* name, hid_t file_type, hid_t memory_type,
                     hsize_t count, const void* values);
void write_attribute(hid_t object, const char* name, std::string_view value);

template <std::size_t n>
void write_attribute(hid_t object, const char* name, const std::array<double, n>& values) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, n, values.data());
}

template <std::size_t n>
void write_attribute(hid_t object, const char* name, const std::array<int, n>& values) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT, n, values.data());
}

/// What such a file holds. Every failure is a StoreError that names the file.
class H5Image {
public:
  /// `what` the file is to be: "frame".
  H5Image(const std::filesystem::path& file, std::string_view what);

  hid_t root() const { return file_; }
  /// Of the file: nothing in it is larger, unless it is compressed.
  std::size_t size() const { return size_; }

  [[noreturn]] void refuse(std::string_view why) const;
  H5Handle required(hid_t id, std::string_view why) const;
  bool has(hid_t parent, const char* name) const;
  H5Handle group(hid_t parent, const char* name) const;
  /// Of all that is in a group.
  std::vector<std::string> names(hid_t group) const;
  template <class T, std::size_t n>
  std::array<T, n> attribute(hid_t object, const char* name) const {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, int>);
    std::array<T, n> values{};
    constexpr bool real = std::is_same_v<T, double>;
    read_attribute(object, name, real, n, values.data());
    return values;
  }

  /// Of at most some kilobytes.
  std::string text_attribute(hid_t object, const char* name) const;

private:
  H5Handle open(std::span<const std::byte> bytes) const;
  void read_attribute(hid_t object, const char* name, bool real, std::size_t count,
                      void* values) const;

  std::filesystem::path path_;
  std::string_view what_;
  std::size_t size_ = 0;
  H5Session session_;
  H5Handle file_;
};

} // namespace lamella
