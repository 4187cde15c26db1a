#pragma once
#include <hdf5.h>

#include <mutex>
#include <utility>

namespace lamella {

/// Owns an HDF5 identifier, whatever it stands for.
class H5Handle {
public:
  explicit H5Handle(hid_t id) : id_(id) {}
  ~H5Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  H5Handle(H5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  H5Handle& operator=(H5Handle&&) = delete;

  operator hid_t() const { return id_; }

private:
  hid_t id_;
};

/// For as long as it lives, HDF5 prints nothing and belongs to this thread.
class H5Session {
public:
  H5Session() : lock_(mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~H5Session() { H5Eset_auto2(H5E_DEFAULT, print_, print_data_); }
  H5Session(const H5Session&) = delete;
  H5Session& operator=(const H5Session&) = delete;

private:
  static std::mutex& mutex() {
    static std::mutex shared;
    return shared;
  }
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

} // namespace lamella
