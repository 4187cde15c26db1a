// Images as people have them: other spacings, other numbers of nodes, masks.
#include "fields/field_data.h"
#include "fields/image.h"
#include "vtk_test.h"

#include <vtkInformation.h>
#include <vtkMembraneMeasures.h>
#include <vtkMembraneSurface.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVesicleDynamics.h>

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace lamella {
namespace {

using testing::HasSubstr;
using Pipeline = vtkStreamingDemandDrivenPipeline;

const double pi = std::numbers::pi;

/// f at the nodes of an image around a centre.
template <class Array, class F>
vtkSmartPointer<vtkImageData> sampled(const std::array<int, 3>& nodes, const Vec3& spacing,
                                      const Vec3& center, F&& f) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(nodes.data());
  image->SetSpacing(spacing.data());
  Vec3 origin;
  for (int a = 0; a < 3; ++a) origin[a] = center[a] - 0.5 * (nodes[a] - 1) * spacing[a];
  image->SetOrigin(origin.data());
  vtkNew<Array> values;
  values->SetName("phi");
  for (vtkIdType n = 0; n < image->GetNumberOfPoints(); ++n) {
    Vec3 p;
    image->GetPoint(n, p.data());
    for (int a = 0; a < 3; ++a) p[a] -= center[a];
    values->InsertNextValue(typename Array::ValueType(f(p)));
  }
  image->GetPointData()->AddArray(values);
  return image;
}

/// An ellipsoid of revolution, semi-axes 0.5 and 0.4; no distance.
double ellipsoid(const Vec3& p) {
  return 0.5 * (std::hypot(p[0] / 0.5, p[1] / 0.4, p[2] / 0.4) - 1);
}
const double ellipsoid_volume = 4. / 3 * pi * 0.5 * 0.4 * 0.4;

/// Area of the same.
double ellipsoid_area() {
  const double e = std::sqrt(1 - 0.64);
  return 2 * pi * 0.16 * (1 + 0.5 / (0.4 * e) * std::asin(e));
}

vtkSmartPointer<vtkTable> measured(vtkImageData* image, std::string* warning = nullptr) {
  vtkNew<vtkMembraneMeasures> measures;
  measures->SetInputData(image);
  const Reports reports(measures, vtkCommand::WarningEvent);
  measures->Update();
  if (warning) *warning = reports.text();
  return measures->GetOutput();
}

double value(vtkTable* table, const char* column) {
  return table->GetValueByName(0, column).ToDouble();
}

vtkSmartPointer<vtkVesicleDynamics> dynamics_of(vtkImageData* image) {
  auto dynamics = vtkSmartPointer<vtkVesicleDynamics>::New();
  dynamics->SetInputData(image);
  dynamics->SetEndTime(1e-5);
  dynamics->SetOutputFrames(2);
  return dynamics;
}

TEST(Images, WithDifferentSpacingsAreResampled) {
  const auto image =
      sampled<vtkDoubleArray>({60, 48, 21}, {0.025, 0.03, 0.06}, {3, 0, -1}, ellipsoid);
  std::string warning;
  const auto table = measured(image, &warning);
  EXPECT_THAT(warning, HasSubstr("the image has spacings of 0.025, 0.03, 0.06: resampled to 60 x "
                                 "57 x 49 nodes with a spacing of 0.025"));
  EXPECT_NEAR(value(table, "V") / ellipsoid_volume, 1, 2e-4);
  EXPECT_NEAR(value(table, "A") / ellipsoid_area(), 1, 2e-4);
}

TEST(Images, KeepTheirPlaceWhenResampled) {
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputData(
      sampled<vtkDoubleArray>({60, 48, 21}, {0.025, 0.03, 0.06}, {3, 0, -1}, ellipsoid));
  const Reports reports(surface, vtkCommand::WarningEvent);
  surface->Update();
  const double* b = surface->GetOutput()->GetBounds();
  const double expected[6] = {2.5, 3.5, -0.4, 0.4, -1.4, -0.6};
  for (int n = 0; n < 6; ++n) EXPECT_NEAR(b[n], expected[n], 1e-3);
}

TEST(Images, OfAnyNumberOfNodesAreWidened) {
  const auto image =
      sampled<vtkDoubleArray>({37, 30, 33}, {0.04, 0.04, 0.04}, {1, 2, 3}, ellipsoid);
  const auto dynamics = dynamics_of(image);
  const Reports reports(dynamics, vtkCommand::WarningEvent);
  dynamics->Update();
  EXPECT_THAT(reports.text(), HasSubstr("the box was widened from 37 x 30 x 33 to 40 x 32 x 40 "
                                        "nodes, multiples of 8"));
  vtkImageData* output = dynamics->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(), 40 * 32 * 40);
  const int* extent = dynamics->GetOutputInformation(0)->Get(Pipeline::WHOLE_EXTENT());
  const double* origin = dynamics->GetOutputInformation(0)->Get(vtkDataObject::ORIGIN());
  for (int a = 0; a < 3; ++a) {
    EXPECT_EQ(extent[2 * a + 1], output->GetExtent()[2 * a + 1]) << "as announced";
    EXPECT_NEAR(origin[a], output->GetOrigin()[a], 1e-12);
    const double nodes = (output->GetOrigin()[a] - image->GetOrigin()[a]) / 0.04;
    EXPECT_NEAR(nodes, std::round(nodes), 1e-9) << "nodes stay where they are";
  }
  EXPECT_NEAR(field_value(*output, "V").value() / ellipsoid_volume, 1, 1e-4);
}

TEST(Images, SayOnceWhatIsDoneToThem) {
  const auto dynamics =
      dynamics_of(sampled<vtkDoubleArray>({37, 30, 33}, {0.04, 0.04, 0.04}, {1, 2, 3}, ellipsoid));
  {
    const Reports reports(dynamics, vtkCommand::WarningEvent);
    dynamics->Update();
  }
  const Reports reports(dynamics, vtkCommand::WarningEvent);
  dynamics->UpdateTimeStep(1e-5);
  EXPECT_EQ(reports.text(), "");
}

// The volume is that of the mask, itself off by up to 2e-3; areas of balls are off as much.
TEST(Images, OfTwoValuesAreMasks) {
  const auto inside = [](const Vec3& p) { return ellipsoid(p) < 0; };
  const Vec3 spacing{0.025, 0.025, 0.025};
  const auto usual = sampled<vtkUnsignedCharArray>({64, 64, 64}, spacing, {}, inside);
  const auto bytes = sampled<vtkUnsignedCharArray>(
      {64, 64, 64}, spacing, {}, [&](const Vec3& p) { return inside(p) ? 255 : 0; });
  const auto signs = sampled<vtkDoubleArray>({64, 64, 64}, spacing, {},
                                             [&](const Vec3& p) { return inside(p) ? -1 : 1; });
  for (const auto& [image, text] :
       {std::pair{usual, "phi is 0 or 1: taken for a mask, inside where it is 1"},
        std::pair{bytes, "phi is 0 or 255: taken for a mask, inside where it is 255"},
        std::pair{signs, "phi is -1 or 1: taken for a mask, inside where it is -1"}}) {
    std::string warning;
    const auto table = measured(image, &warning);
    EXPECT_THAT(warning, HasSubstr(text));
    EXPECT_NEAR(value(table, "V") / ellipsoid_volume, 1, 2e-3);
    EXPECT_NEAR(value(table, "A") / ellipsoid_area(), 1, 1e-2);
    EXPECT_EQ(value(table, "components"), 1);
    EXPECT_EQ(value(table, "genus"), 0);
  }
}

TEST(Images, OfFlatVoxelsMayBeMasks) {
  const auto image = sampled<vtkUnsignedCharArray>({64, 64, 24}, {0.02, 0.02, 0.06}, {},
                                                   [](const Vec3& p) { return ellipsoid(p) < 0; });
  std::string warning;
  const auto table = measured(image, &warning);
  EXPECT_THAT(warning, testing::AllOf(HasSubstr("resampled to 64 x 64 x 70"), HasSubstr("a mask")));
  EXPECT_NEAR(value(table, "V") / ellipsoid_volume, 1, 1e-2);
  EXPECT_NEAR(value(table, "A") / ellipsoid_area(), 1, 2e-2);
}

TEST(Images, ThatAreMasksRelax) {
  const auto image = sampled<vtkUnsignedCharArray>({50, 50, 50}, {0.03, 0.03, 0.03}, {},
                                                   [](const Vec3& p) { return ellipsoid(p) < 0; });
  const auto dynamics = dynamics_of(image);
  dynamics->SetEndTime(2e-4);
  const Reports warnings(dynamics, vtkCommand::WarningEvent);
  EXPECT_EQ(error_of(dynamics), "");
  const double first = field_value(*dynamics->GetOutput(), "energy").value();
  dynamics->UpdateTimeStep(2e-4);
  const double last = field_value(*dynamics->GetOutput(), "energy").value();
  EXPECT_LT(last, first);
  EXPECT_GT(last, 8 * pi);
  EXPECT_LT(last, 8 * pi * 1.1); // an ellipsoid of semi-axes 0.5 and 0.4: 8 pi 1.02
}

TEST(Images, ThatAreMasksOfNextToNothingAreRefused) {
  const auto image = sampled<vtkUnsignedCharArray>(
      {32, 32, 32}, {1, 1, 1}, {}, [](const Vec3& p) { return std::hypot(p[0], p[1], p[2]) < 1; });
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputData(image);
  EXPECT_THAT(error_of(surface), HasSubstr("nothing is left of the inside of the mask"));
  EXPECT_EQ(surface->GetOutput()->GetNumberOfPoints(), 0);
}

} // namespace
} // namespace lamella
