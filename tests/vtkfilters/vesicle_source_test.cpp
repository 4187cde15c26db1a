// Start shapes as images, and the parameters of scenes as properties.
#include "vtk_test.h"

#include "dynamics/start.h"
#include "scene/keys.h"

#include <vtkVesicleSource.h>

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

namespace lamella {
namespace {

using testing::HasSubstr;

std::vector<double> values(vtkImageData* image, const char* name) {
  const double* first = values_of(image, name);
  return first ? std::vector<double>(first, first + image->GetNumberOfPoints())
               : std::vector<double>();
}

TEST(VesicleSource, MakesWhatScenesStartFrom) {
  Scene scene;
  scene.nodes = {48, 40, 32};
  scene.half_width = 1.2;
  scene.shape = {.kind = ShapeKind::ellipsoid,
                 .semi_axes = {0.7, 0.6, 0.5},
                 .center = {0.1, 0, -0.1},
                 .rotation_axis = {0, 1, 1},
                 .rotation_angle = 30};
  scene.perturbation = {.amplitude = 0.02, .seed = 7};
  vtkNew<vtkVesicleSource> source;
  source->SetNodes(48, 40, 32);
  source->SetHalfWidth(1.2);
  source->SetShapeKind("ellipsoid");
  source->SetShapeSemiAxes(0.7, 0.6, 0.5);
  source->SetShapeCenter(0.1, 0, -0.1);
  source->SetShapeRotationAxis(0, 1, 1);
  source->SetShapeRotationAngle(30);
  source->SetPerturbationAmplitude(0.02);
  source->SetPerturbationSeed(7);
  source->SetShapeTubeRadius(-1); // not of an ellipsoid
  EXPECT_EQ(error_of(source), "");
  vtkImageData* image = source->GetOutput();
  EXPECT_EQ(values(image, "phi"), start_of(scene).phi);
  EXPECT_EQ(image->GetPointData()->GetScalars()->GetName(), std::string("phi"));
  EXPECT_FALSE(image->GetPointData()->HasArray("psi"));
  const Vec3 first = scene.grid().position(0);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(image->GetPoint(0)[a], first[a], 1e-15);
}

TEST(VesicleSource, MakesDomains) {
  Scene scene;
  scene.shape = {.kind = ShapeKind::sphere, .radius = 0.6};
  scene.domains = {
      .kind = DomainsKind::caps, .directions = {{0, 0, 1}, {0, 1, -1}}, .half_angle = 25};
  vtkNew<vtkVesicleSource> source;
  source->SetShapeKind("sphere");
  source->SetShapeRadius(0.6);
  source->SetDomainsKind("caps");
  source->AddDomain(1, 0, 0);
  source->RemoveAllDomains();
  source->AddDomain(0, 0, 1);
  source->AddDomain(0, 1, -1);
  source->SetDomainsHalfAngle(25);
  EXPECT_EQ(source->GetNumberOfDomains(), 2);
  EXPECT_EQ(error_of(source), "");
  EXPECT_EQ(values(source->GetOutput(), "psi"), start_of(scene).fields.at("psi"));
}

TEST(VesicleSource, SaysWhatIsWrongWithParameters) {
  vtkNew<vtkVesicleSource> source;
  source->SetShapeSemiAxis(0.99);
  EXPECT_THAT(error_of(source), HasSubstr("[shape] semi_axis"));
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
  source->SetShapeSemiAxis(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(error_of(source), HasSubstr("[shape] semi_axis"));
  source->SetShapeSemiAxis(0.7);
  source->SetNodes(50, 50, -50);
  EXPECT_THAT(error_of(source), HasSubstr("[grid] nodes"));
  source->SetNodes(64, 64, 64);
  source->SetHalfWidth(0);
  EXPECT_THAT(error_of(source), HasSubstr("[grid] half_width"));
  source->SetHalfWidth(1);
  source->SetDomainsKind("caps");
  EXPECT_THAT(error_of(source), HasSubstr("[domains] directions"));
  source->SetDomainsKind("none");
  EXPECT_EQ(error_of(source), "");
  EXPECT_GT(source->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VesicleSource, RefusesKindsThatThereAreNot) {
  vtkNew<vtkVesicleSource> source;
  for (const char* kind : {"oblat", "", static_cast<const char*>(nullptr)}) {
    source->SetShapeKind(kind);
    EXPECT_EQ(source->GetShapeKind(), std::string(kind ? kind : ""));
    EXPECT_THAT(error_of(source), HasSubstr("allowed: \"sphere\", \"oblate\""));
    EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
  }
  source->SetShapeKind("frame");
  EXPECT_THAT(error_of(source), HasSubstr("stored frames"));
}

TEST(VesicleSource, ChangesOnlyWhenItsParametersDo) {
  vtkNew<vtkVesicleSource> source;
  const vtkMTimeType before = source->GetMTime();
  source->SetHalfWidth(source->GetHalfWidth());
  source->SetNodes(64, 64, 64);
  EXPECT_EQ(source->GetMTime(), before);
  source->SetHalfWidth(1.1);
  EXPECT_GT(source->GetMTime(), before);
}

TEST(VesicleSource, PrintsItsParameters) {
  vtkNew<vtkVesicleSource> source;
  std::ostringstream text;
  source->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("[shape] semi_axis = 0.7"));
}

TEST(Properties, AreThereForAllParametersOfScenes) {
  std::string headers;
  for (const char* name : {"vtkVesicleSource.h", "vtkVesicleDynamics.h"}) {
    std::ifstream file(std::string(LAMELLA_SOURCE_DIR "/vtkfilters/") + name);
    headers.append(std::istreambuf_iterator<char>(file), {});
  }
  for (const Key& key : scene_keys()) {
    if (key.section.empty() || key.name == "file" || key.name == "start_times") continue;
    EXPECT_THAT(headers, HasSubstr("/** " + key.label() + ": "));
  }
}

} // namespace
} // namespace lamella
