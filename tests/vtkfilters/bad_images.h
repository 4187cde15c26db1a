#pragma once
#include "vtk_test.h"

#include <vtkCellData.h>
#include <vtkMatrix3x3.h>

#include <limits>

namespace lamella {

/// An image that is no vesicle, and a part of what is to be said about it.
struct BadImage {
  std::string complaint;
  vtkSmartPointer<vtkImageData> image;
};

/// Images that no filter can do anything with.
inline std::vector<BadImage> bad_images() {
  std::vector<BadImage> bad;
  const auto add = [&](const char* complaint, auto&& spoil) {
    bad.push_back({complaint, image_of(sphere(0.5), 32)});
    spoil(*bad.back().image);
  };
  const auto set_phi = [](double value) {
    return [value](vtkImageData& image) { image.GetPointData()->GetArray("phi")->Fill(value); };
  };
  add("the image is empty", [](vtkImageData& image) { image.Initialize(); });
  add("no point data", [](vtkImageData& image) { image.GetPointData()->Initialize(); });
  add("the image has cell data only", [](vtkImageData& image) {
    image.GetCellData()->AddArray(array_of("phi", std::vector<double>(31 * 31 * 31, 1.0)));
    image.GetPointData()->Initialize();
  });
  add("not finite", set_phi(std::numeric_limits<double>::quiet_NaN()));
  add("1 of the 32768 values of \"phi\" are not finite", [](vtkImageData& image) {
    image.GetPointData()->GetArray("phi")->SetComponent(7, 0, INFINITY);
  });
  add("nowhere negative", set_phi(1));
  add("nowhere positive", set_phi(-1));
  add("there is no membrane", set_phi(0));
  const auto scale_phi = [](double factor) {
    return [factor](vtkImageData& image) {
      vtkDataArray* phi = image.GetPointData()->GetArray("phi");
      for (vtkIdType n = 0; n < phi->GetNumberOfTuples(); ++n)
        phi->SetComponent(n, 0, factor * phi->GetComponent(n, 0));
    };
  };
  add("about a distance", scale_phi(1e200));
  add("about a distance", scale_phi(1e-200));
  add("the membrane is not closed", scale_phi(-1));
  add("spacings of 0.1, 0, 0.1; they must be positive",
      [](vtkImageData& image) { image.SetSpacing(.1, 0, .1); });
  add("would have 32 x 32 x 3100004 nodes",
      [](vtkImageData& image) { image.SetSpacing(1e-5, 1e-5, 1); });
  add("the image is turned",
      [](vtkImageData& image) { image.SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1); });
  add("2 components", [](vtkImageData& image) {
    vtkNew<vtkDoubleArray> vectors;
    vectors->SetName("phi");
    vectors->SetNumberOfComponents(2);
    vectors->SetNumberOfTuples(image.GetNumberOfPoints());
    vectors->Fill(0);
    image.GetPointData()->Initialize();
    image.GetPointData()->AddArray(vectors);
  });
  add("8 are the least", [](vtkImageData& image) {
    image.SetDimensions(64, 64, 1);
    image.GetPointData()->Initialize();
    image.GetPointData()->AddArray(array_of("phi", std::vector<double>(4096, 1.0)));
  });
  return bad;
}

} // namespace lamella
