#pragma once
#include "store/frame.h"

#include <vtkImageData.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace lamella {

/// The data that came in is not what is needed; the message says what is wrong with it and what
/// would be right.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Adds to what is to be said of the data that came in.
inline void add_remark(std::string& remark, std::string_view what) {
  if (!remark.empty() && !what.empty()) remark += "; ";
  remark += what;
}

/// A vesicle in an image.
struct ImageVesicle {
  Frame frame;   ///< on a grid centred on the origin, its box not moved
  Vec3 center{}; ///< of the grid's box
  /// What was done to bring the image onto a grid; nothing where it is on one.
  std::string remark{};

  Vec3 in_image(const Vec3& p) const {
    return {p[0] + center[0], p[1] + center[1], p[2] + center[2]};
  }
};

/// What is the inside of a vesicle in an image.
struct Selection {
  std::string phi_array = "phi";
  int label = -1; ///< the value of what is inside, where it is not negative
  bool fill_cavities = false;
};

/// The fields of an image, in point or cell data of one component: phi, from the array of that name
/// or else from the only array there is, and psi and c where there are arrays of these names.
/// Fields with different spacings along the axes are resampled to the smallest; a phi of only two
/// values is a mask, of which the lower is inside where it is negative, else the higher; so is one
/// of which a label is chosen. Throws InputError where there is no closed membrane of finite
/// values.
ImageVesicle vesicle_in(vtkImageData& image, const Selection& selection);

/// The other way round, into arrays phi (the scalars), psi and c, with the time. The origin tells
/// where the box has moved to.
void fill_image(vtkImageData& image, const Frame& frame, const Vec3& center = {});

} // namespace lamella
