#pragma once
#include "store/frame.h"

#include <vtkImageData.h>

#include <stdexcept>
#include <string>

namespace lamella {

/// The data that came in is not what is needed; the message says what is wrong with it and what
/// would be right.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

/// The fields of an image, in point data of one component: phi, from the array of that name or else
/// from the only array there is, and psi and c where there are arrays of these names. Fields with
/// different spacings along the axes are resampled to the smallest; a phi of only two values is a
/// mask, of which the lower is inside where it is negative, else the higher. Throws InputError
/// where there is no closed membrane of finite values.
ImageVesicle vesicle_in(vtkImageData& image, const std::string& phi_array);

/// The other way round, into arrays phi (the scalars), psi and c, with the time. The origin tells
/// where the box has moved to.
void fill_image(vtkImageData& image, const Frame& frame, const Vec3& center = {});

} // namespace lamella
