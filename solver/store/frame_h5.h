#pragma once
#include "store/frame.h"
#include "store/h5_image.h"

namespace lamella {

/// Throws StoreError, naming the file it is for, for a frame that no reader would take.
void check_frame(const std::filesystem::path& file, const Frame& frame);
/// Puts a frame into the root group of a file.
void put_frame(hid_t root, const Frame& frame);

} // namespace lamella
