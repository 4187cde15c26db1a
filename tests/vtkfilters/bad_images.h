#pragma once
#include "vtk_test.h"

#include <cmath>
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
  add("the image has no data", [](vtkImageData& image) { image.GetPointData()->Initialize(); });
  add("not finite", set_phi(std::numeric_limits<double>::quiet_NaN()));
  add("1 of the 32768 values of \"phi\" are not finite", [](vtkImageData& image) {
    image.GetPointData()->GetArray("phi")->SetComponent(7, 0, INFINITY);
  });
  add("there is no membrane: phi is 1 everywhere", set_phi(1));
  add("phi is -1 everywhere", set_phi(-1));
  add("phi is 0 everywhere", set_phi(0));
  const auto change_phi = [](auto&& f) {
    return [f](vtkImageData& image) {
      vtkDataArray* phi = image.GetPointData()->GetArray("phi");
      for (vtkIdType n = 0; n < phi->GetNumberOfTuples(); ++n)
        phi->SetComponent(n, 0, f(phi->GetComponent(n, 0)));
    };
  };
  add("nowhere negative", change_phi([](double x) { return x * x; }));
  add("nowhere positive", change_phi([](double x) { return -std::abs(x); }));
  const auto scale_phi = [&](double factor) {
    return change_phi([factor](double x) { return factor * x; });
  };
  add("about a distance", scale_phi(1e200));
  add("about a distance", scale_phi(1e-200));
  add("the membrane is not closed: phi is not positive everywhere at the sides of the image; it "
      "must "
      "be negative inside, positive outside (vtkImageMathematics",
      scale_phi(-1));
  add("spacings of 0.1, 0, 0.1; they must be positive",
      [](vtkImageData& image) { image.SetSpacing(.1, 0, .1); });
  add("would have 32 x 32 x 3100004 nodes",
      [](vtkImageData& image) { image.SetSpacing(1e-5, 1e-5, 1); });
  add("the image is turned",
      [](vtkImageData& image) { image.SetDirectionMatrix(.6, .8, 0, -.8, .6, 0, 0, 0, 1); });
  add("the image's direction matrix is not that of a rotation",
      [](vtkImageData& image) { image.SetDirectionMatrix(1, 1, 0, 0, 0, 0, 0, 0, 1); });
  add("2 components", [](vtkImageData& image) {
    vtkNew<vtkDoubleArray> vectors;
    vectors->SetName("phi");
    vectors->SetNumberOfComponents(2);
    vectors->SetNumberOfTuples(image.GetNumberOfPoints());
    vectors->Fill(0);
    image.GetPointData()->Initialize();
    image.GetPointData()->AddArray(vectors);
  });
  add("the image is flat: it has 64 x 64 x 1 nodes", [](vtkImageData& image) {
    image.SetDimensions(64, 64, 1);
    image.GetPointData()->Initialize();
    image.GetPointData()->AddArray(array_of("phi", std::vector<double>(4096, 1.0)));
  });
  add("8 are the least", [](vtkImageData& image) {
    image.SetDimensions(32, 4, 32);
    std::vector<double> phi(4096, 1.0);
    phi[2000] = -1.5;
    image.GetPointData()->Initialize();
    image.GetPointData()->AddArray(array_of("phi", phi));
    image.GetPointData()->GetArray("phi")->SetComponent(7, 0, 2);
  });
  return bad;
}

} // namespace lamella
