// Images as people have them: other spacings, other numbers of nodes, masks.
#include "fields/field_data.h"
#include "fields/image.h"
#include "vtk_test.h"

#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkMembraneMeasures.h>
#include <vtkMembraneSurface.h>
#include <vtkShortArray.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleFromImage.h>

#include <cmath>
#include <functional>
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
  EXPECT_THAT(warning, testing::AllOf(HasSubstr("resampled to 74 x 64 x 70"), HasSubstr("a mask")));
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
  for (const double radius : {0.5, 1., 3.}) {
    const auto image =
        sampled<vtkUnsignedCharArray>({33, 33, 33}, {1, 1, 1}, {}, [&](const Vec3& p) {
          return std::hypot(p[0], p[1], p[2]) <= radius;
        });
    vtkNew<vtkMembraneSurface> surface;
    surface->SetInputData(image);
    EXPECT_THAT(error_of(surface), HasSubstr("nothing is left of the inside of the mask"));
    EXPECT_EQ(surface->GetOutput()->GetNumberOfPoints(), 0);
  }
}

const Vec3 unit{1, 1, 1};
double distance(const Vec3& p, const Vec3& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// A mask of voxels of size 1.
template <class F>
vtkSmartPointer<vtkImageData> mask(const std::array<int, 3>& nodes, F&& is_inside) {
  return sampled<vtkUnsignedCharArray>(nodes, unit, {}, std::forward<F>(is_inside));
}

/// What comes of an image, and what is said of it.
struct Result {
  vtkSmartPointer<vtkVesicleFromImage> filter = vtkSmartPointer<vtkVesicleFromImage>::New();
  std::string error, warning;
  vtkSmartPointer<vtkTable> table;

  explicit Result(vtkImageData* image, int label = -1, bool fill = false) {
    filter->SetInputData(image);
    filter->SetLabel(label);
    filter->SetFillCavities(fill);
    const Reports warnings(filter, vtkCommand::WarningEvent);
    error = error_of(filter);
    warning = warnings.text();
    if (error.empty()) table = measured(filter->GetOutput());
  }
  double operator[](const char* column) const { return value(table, column); }
};

/// The number of voxels with a value.
double voxels(vtkImageData* image, double value = 1) {
  vtkDataArray* array = image->GetPointData()->GetArray(0);
  double count = 0;
  for (vtkIdType n = 0; n < array->GetNumberOfTuples(); ++n)
    count += array->GetComponent(n, 0) == value;
  return count;
}

// The axes of the image, in any order and sign, and to rounding: the field is a function of space.
TEST(Images, WithAxesInAnyOrderAndSignKeepTheirPlace) {
  const auto phi = [](const Vec3& p) {
    return 0.5 * (std::hypot((p[0] - 1) / 0.5, (p[1] - 2) / 0.4, (p[2] - 3) / 0.3) - 1);
  };
  for (const std::array<double, 9>& d : {std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                         {1, 1e-9, 0, -1e-9, 1, 0, 0, 0, 1},
                                         {1, 3e-5, 0, -3e-5, 1, 0, 0, 0, 1},
                                         {-1, 0, 0, 0, -1, 0, 0, 0, 1},
                                         {0, 0, 1, 1, 0, 0, 0, 1, 0},
                                         {0, -1, 0, 1, 0, 0, 0, 0, -1},
                                         {0, 1, 0, 0, 0, -1, 1, 0, 0},
                                         {-1, 0, 0, 0, -1, 0, 0, 0, -1}}) {
    vtkNew<vtkImageData> image;
    image->SetDirectionMatrix(d.data());
    image->SetExtent(3, 42, -5, 34, 0, 39);
    image->SetSpacing(0.04, 0.04, 0.04);
    Vec3 middle; // to have it there
    image->TransformContinuousIndexToPhysicalPoint(22.5, 14.5, 19.5, middle.data());
    image->SetOrigin(1 - middle[0], 2 - middle[1], 3 - middle[2]);
    vtkNew<vtkDoubleArray> values;
    values->SetName("phi");
    for (vtkIdType n = 0; n < image->GetNumberOfPoints(); ++n) {
      Vec3 p;
      image->GetPoint(n, p.data());
      values->InsertNextValue(phi(p));
    }
    image->GetPointData()->AddArray(values);
    vtkNew<vtkMembraneSurface> surface;
    surface->SetInputData(image);
    EXPECT_EQ(error_of(surface), "");
    const double* b = surface->GetOutput()->GetBounds();
    const double expected[6] = {0.5, 1.5, 1.6, 2.4, 2.7, 3.3};
    for (int n = 0; n < 6; ++n) EXPECT_NEAR(b[n], expected[n], 1e-3);
    const auto dynamics = dynamics_of(image);
    EXPECT_EQ(error_of(dynamics), "");
    for (vtkIdType n = 0; n < dynamics->GetOutput()->GetNumberOfPoints(); n += 37) {
      Vec3 p;
      dynamics->GetOutput()->GetPoint(n, p.data());
      if (std::abs(phi(p)) < 0.1) {
        EXPECT_NEAR(values_of(dynamics->GetOutput(), "phi")[n], phi(p), 0.05);
      }
    }
  }
}

TEST(Images, OfCellsAreTaken) {
  const auto points = sampled<vtkUnsignedCharArray>({40, 40, 40}, {0.03, 0.03, 0.03}, {1, 2, 3},
                                                    [](const Vec3& p) { return ellipsoid(p) < 0; });
  vtkNew<vtkImageData> cells; // around those points
  cells->SetDimensions(41, 41, 41);
  cells->SetSpacing(0.03, 0.03, 0.03);
  const double* origin = points->GetOrigin();
  cells->SetOrigin(origin[0] - 0.015, origin[1] - 0.015, origin[2] - 0.015);
  cells->GetCellData()->AddArray(points->GetPointData()->GetArray(0));
  const Result of_points(points), of_cells(cells);
  ASSERT_EQ(of_points.error + of_cells.error, "");
  EXPECT_EQ(of_cells["V"], of_points["V"]);
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(of_cells.filter->GetOutput()->GetOrigin()[a],
                of_points.filter->GetOutput()->GetOrigin()[a], 1e-12);
}

// 25 voxels across; the volume is that of the voxels, to the bound of a part's.
TEST(Images, ThatAreMasksMayHaveAnyMargin) {
  for (const int margin : {0, 1, 3, 8}) {
    const int nodes = 25 + 2 * margin;
    const auto image =
        mask({nodes, nodes, nodes}, [](const Vec3& p) { return distance(p, {}) <= 12; });
    const Result result(image);
    ASSERT_EQ(result.error, "");
    EXPECT_NEAR(result["V"] / voxels(image), 1, 1e-5);
    EXPECT_NEAR(result["A"] / (4 * pi * 144), 1, 0.02);
    if (margin == 0)
      EXPECT_THAT(result.warning, HasSubstr("the inside reaches the sides of the image"));
    else
      EXPECT_THAT(result.warning, Not(HasSubstr("reaches the sides")));
    const auto dynamics = dynamics_of(image);
    const Reports warnings(dynamics, vtkCommand::WarningEvent);
    EXPECT_EQ(error_of(dynamics), "");
    EXPECT_NEAR(field_value(*dynamics->GetOutput(), "V").value() / voxels(image), 1, 1e-3);
    const int* announced = dynamics->GetOutputInformation(0)->Get(Pipeline::WHOLE_EXTENT());
    for (int n = 0; n < 6; ++n) EXPECT_EQ(announced[n], dynamics->GetOutput()->GetExtent()[n]);
  }
}

TEST(Images, ThatAreInvertedMasksAreTurnedRoundByALabel) {
  const auto image = mask({40, 40, 40}, [](const Vec3& p) { return distance(p, {}) > 12; });
  const Result inverted(image);
  EXPECT_THAT(inverted.error, HasSubstr("covers 100 % of the sides of the image: it seems to be "
                                        "inverted; vtkVesicleFromImage with SetLabel(0)"));
  const Result right(image, 0);
  ASSERT_EQ(right.error, "");
  EXPECT_NEAR(right["V"] / voxels(image, 0), 1, 1e-5);
  const Result wrong(image, 1);
  EXPECT_THAT(wrong.error, HasSubstr("SetLabel() must be that of the inside"));
}

TEST(Images, OfLabelsNameThem) {
  const auto image = sampled<vtkShortArray>({40, 40, 40}, unit, {0, 0, 0}, [](const Vec3& p) {
    return distance(p, {}) <= 6 ? 7 : distance(p, {}) <= 12 ? 3 : 0;
  });
  const Result unchosen(image);
  EXPECT_THAT(unchosen.error,
              testing::AllOf(HasSubstr("the image has labels in place of a level set: 0 ("),
                             HasSubstr("7 (912 voxels)"),
                             HasSubstr("vtkVesicleFromImage with SetLabel(3) takes one")));
  const Result missing(image, 5);
  EXPECT_THAT(missing.error, HasSubstr("no voxel has the label 5; the image has 0 ("));
  const Result core(image, 7);
  ASSERT_EQ(core.error, "");
  EXPECT_THAT(core.warning, HasSubstr("912 voxels of label 7 are inside"));
  EXPECT_NEAR(core["V"] / voxels(image, 7), 1, 1e-5);
  const Result shell(image, 3);
  ASSERT_EQ(shell.error, "");
  EXPECT_THAT(shell.warning, HasSubstr("FillCavitiesOn() fills it"));
  EXPECT_NEAR(shell["V"] / voxels(image, 3), 1, 1e-5);
  const Result filled(image, 3, true);
  ASSERT_EQ(filled.error, "");
  EXPECT_NEAR(filled["V"] / (voxels(image, 3) + voxels(image, 7)), 1, 1e-5);
  EXPECT_EQ(filled["components"], 1);
}

TEST(Images, OfLabelsMayHaveABackgroundBelowZero) {
  const auto image = sampled<vtkShortArray>({40, 40, 40}, unit, {0, 0, 0}, [](const Vec3& p) {
    return distance(p, {}) <= 6 ? 2 : distance(p, {}) <= 12 ? 1 : -1;
  });
  EXPECT_THAT(Result(image).error, HasSubstr("vtkVesicleFromImage with SetLabel(1) takes one"));
  const Result result(image, 2);
  ASSERT_EQ(result.error, "");
  EXPECT_NEAR(result["V"] / voxels(image, 2), 1, 1e-5);
}

// A level set of whole numbers is none of labels.
TEST(Images, OfWholeNumbersMayBeLevelSets) {
  const auto image = sampled<vtkShortArray>({40, 40, 40}, unit, {}, [](const Vec3& p) {
    return std::lround(10 * (distance(p, {}) - 12));
  });
  const Result result(image);
  ASSERT_EQ(result.error + result.warning, "");
  EXPECT_NEAR(result["V"] / (4. / 3 * pi * 12 * 12 * 12), 1, 1e-3);
}

TEST(Images, ThatMarkTheMembraneAloneAreFilled) {
  const auto whole = mask({36, 36, 36}, [](const Vec3& p) { return distance(p, {}) <= 13; });
  for (const double thickness : {1.2, 3.}) {
    const auto image = mask({36, 36, 36}, [&](const Vec3& p) {
      const double r = distance(p, {});
      return r <= 13 && r > 13 - thickness;
    });
    const Result as_it_is(image);
    EXPECT_THAT(as_it_is.error + as_it_is.warning,
                HasSubstr("if only the membrane is marked, vtkVesicleFromImage with "
                          "FillCavitiesOn() fills it"));
    const Result filled(image, -1, true);
    ASSERT_EQ(filled.error, "");
    EXPECT_THAT(filled.warning, HasSubstr("1 cavity is filled"));
    EXPECT_NEAR(filled["V"] / voxels(whole), 1, 1e-5);
    EXPECT_NEAR(filled["A"] / (4 * pi * 13 * 13), 1, 0.02);
  }
}

TEST(Images, ThatMarkAMembraneWithGapsSaySo) {
  const auto image = mask({36, 36, 36}, [&](const Vec3& p) {
    const double r = distance(p, {});
    return r <= 13 && r > 9 && std::hypot(p[0], p[1]) > 2.5;
  });
  EXPECT_THAT(Result(image).warning, HasSubstr("the inside is nowhere thicker than"));
  EXPECT_THAT(Result(image, -1, true).warning, HasSubstr("there is no cavity to fill"));
}

// Of 1 to 33 voxels, as segmentations have them; and cavities.
TEST(Images, ThatAreMasksLoseTheirSpecks) {
  const auto is_speck = [](const Vec3& p) {
    const auto off = [](double x) { return std::abs(std::remainder(x, 32)); };
    return std::hypot(16 - off(p[0]), 16 - off(p[1]), 16 - off(p[2])) < 2.1;
  };
  const auto clean = mask({41, 41, 41}, [](const Vec3& p) { return distance(p, {}) <= 12; });
  const auto image = mask({41, 41, 41}, [&](const Vec3& p) {
    return (distance(p, {}) <= 12 && distance(p, {5, 0, 0}) > 2) || is_speck(p);
  });
  const Result result(image);
  ASSERT_EQ(result.error, "");
  EXPECT_THAT(result.warning,
              testing::AllOf(HasSubstr("8 parts of the inside of up to 33 voxels are left out: 269 "
                                       "voxels are the least"),
                             HasSubstr("1 cavity of less than 269 voxels is filled")));
  EXPECT_NEAR(result["V"] / voxels(clean), 1, 1e-5);
  EXPECT_EQ(result["components"], 1);
}

/// The volume of the inside where f is true.
template <class F>
double volume_where(vtkImageData* image, F&& f) {
  vtkNew<vtkImageData> part;
  part->DeepCopy(image);
  for (vtkIdType n = 0; n < part->GetNumberOfPoints(); ++n) {
    Vec3 p;
    part->GetPoint(n, p.data());
    if (!f(p)) values_of(part, "phi")[n] = std::abs(values_of(part, "phi")[n]) + 1e-3;
  }
  return value(measured(part), "V");
}

TEST(Images, ThatAreMasksKeepTheVolumeOfEachPart) {
  const auto large = [](const Vec3& p) { return distance(p, {-8, 0, 0}) <= 12; };
  const auto small = [](const Vec3& p) { return distance(p, {14, 0, 0}) <= 5; };
  const auto image = mask({56, 40, 40}, [&](const Vec3& p) { return large(p) || small(p); });
  const Result result(image);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result["components"], 2);
  const auto is_left = [](const Vec3& p) { return p[0] < 6.5; };
  EXPECT_NEAR(volume_where(result.filter->GetOutput(), is_left) / voxels(mask({56, 40, 40}, large)),
              1, 1e-4);
  EXPECT_NEAR(volume_where(result.filter->GetOutput(), std::not_fn(is_left)) /
                  voxels(mask({56, 40, 40}, small)),
              1, 1e-4);
}

TEST(Images, ThatAreMasksOfPartsTooNearAreRefused) {
  const auto image = mask({64, 40, 40}, [](const Vec3& p) {
    return distance(p, {-12.5, 0, 0}) <= 12 || distance(p, {12.5, 0, 0}) <= 12;
  });
  EXPECT_THAT(
      Result(image).error,
      testing::AnyOf(testing::IsEmpty(), HasSubstr("too near each other: of 2 there would be 1")));
}

TEST(Images, ThatNoLevelSetIsInAreNotFilled) {
  EXPECT_THAT(Result(image_of(sphere(0.5), 32), -1, true).error, HasSubstr("nothing to fill"));
}

} // namespace
} // namespace lamella
