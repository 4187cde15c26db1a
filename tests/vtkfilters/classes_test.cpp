// What all classes have in common.
#include "vtk_test.h"

#include <vtkMembraneMeasures.h>
#include <vtkMembraneSurface.h>
#include <vtkPhaseBoundary.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleFromImage.h>
#include <vtkVesicleFromSurface.h>
#include <vtkVesicleRunReader.h>
#include <vtkVesicleSceneReader.h>
#include <vtkVesicleSource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

namespace lamella {
namespace {

template <class Class>
class Classes : public testing::Test {};

using All = testing::Types<vtkMembraneMeasures, vtkMembraneSurface, vtkPhaseBoundary,
                           vtkVesicleDynamics, vtkVesicleFromImage, vtkVesicleFromSurface,
                           vtkVesicleRunReader, vtkVesicleSceneReader, vtkVesicleSource>;
TYPED_TEST_SUITE(Classes, All);

TYPED_TEST(Classes, MakeAndPrintThemselves) {
  vtkNew<TypeParam> object;
  const auto other = vtk::TakeSmartPointer(object->NewInstance());
  EXPECT_EQ(object->GetClassName(), std::string(other->GetClassName()));
  EXPECT_TRUE(object->IsA("vtkAlgorithm"));
  std::ostringstream text;
  object->Print(text);
  EXPECT_THAT(text.str(), testing::HasSubstr(object->GetClassName()));
}

TYPED_TEST(Classes, SayThatAnInputIsMissing) {
  vtkNew<TypeParam> object;
  if (object->GetNumberOfInputPorts() == 0) return;
  const Reports reports(object->GetExecutive());
  object->Update();
  EXPECT_THAT(reports.text(), testing::HasSubstr("0 connections"));
}

} // namespace
} // namespace lamella
