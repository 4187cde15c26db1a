// Measures of membranes, against exact ones and the solver's.
#include "bad_images.h"
#include "dynamics/simulation.h"
#include "fields/field_data.h"

#include <vtkMembraneMeasures.h>
#include <vtkTable.h>
#include <vtkVesicleDynamics.h>

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace lamella {
namespace {

using testing::HasSubstr;

const double pi = std::numbers::pi;

vtkSmartPointer<vtkTable> measures_of(vtkImageData* image) {
  vtkNew<vtkMembraneMeasures> measures;
  measures->SetInputData(image);
  measures->Update();
  return measures->GetOutput();
}

double value(vtkTable* table, const char* column, vtkIdType row = 0) {
  vtkAbstractArray* array = table->GetColumnByName(column);
  return array ? array->GetVariantValue(row).ToDouble() : NAN;
}

TEST(MembraneMeasures, OfASphereAreExact) {
  const double r = 0.5;
  vtkNew<vtkMembraneMeasures> measures;
  measures->SetInputData(image_of(sphere(r, {0.05, 0.02, -0.04})));
  measures->SetBendingModulus(3);
  measures->SetSpontaneousCurvature(-1);
  measures->Update();
  vtkTable* table = measures->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 1);
  const auto expect = [&](const char* column, double expected) {
    EXPECT_NEAR(value(table, column) / expected, 1, 1e-5) << column;
  };
  expect("A", 4 * pi * r * r);
  expect("V", 4. / 3 * pi * r * r * r);
  expect("v", 1);
  expect("Da", 1);
  expect("int_KM2", 16 * pi);
  expect("bending_energy", 1.5 * 4 * pi * r * r * (-2 / r + 1) * (-2 / r + 1));
  expect("energy", value(table, "bending_energy"));
  expect("components", 1);
  EXPECT_EQ(value(table, "genus"), 0);
  EXPECT_TRUE(std::isnan(value(table, "neck_radius")));
  EXPECT_EQ(table->GetColumnByName("A_Ld"), nullptr);
}

TEST(MembraneMeasures, CountHandlesAndParts) {
  const auto torus =
      measures_of(image_of({.kind = ShapeKind::torus, .ring_radius = 0.5, .tube_radius = 0.2}, 48));
  EXPECT_EQ(value(torus, "genus"), 1);
  EXPECT_EQ(value(torus, "components"), 1);
  EXPECT_TRUE(std::isnan(value(torus, "neck_radius"))) << "its tube is as wide everywhere";
}

TEST(MembraneMeasures, AgreeWithTheSolver) {
  Scene scene;
  scene.shape = {.kind = ShapeKind::oblate, .semi_axis = 0.7, .reduced_volume = 0.8};
  const Simulation simulation(scene);
  const Measures& m = simulation.measures();
  const auto table = measures_of(image_of(simulation.frame()));
  const auto expect = [&](const char* column, double expected, double tolerance) {
    EXPECT_NEAR(value(table, column) / expected, 1, tolerance) << column;
  };
  expect("A", m.area, 1e-5);
  expect("V", m.volume, 1e-5);
  expect("v", m.reduced_volume, 1e-5);
  expect("Da", m.area_difference, 1e-5);
  expect("bending_energy", m.terms.value(Term::bending), 1e-5);
  expect("P", m.P, 1e-3);
  expect("sigma", m.sigma, 1e-3);
}

/// A body of revolution about x whose radius is r + amplitude (1 - cos) between two bulges.
TEST(MembraneMeasures, FindTheThinnestNeck) {
  const double neck = 0.12, bulge = 0.3, spread = 0.35;
  Frame frame;
  frame.grid = Grid::cube(64, 1);
  for (std::size_t n = 0; n < frame.grid.size(); ++n) {
    const auto [x, y, z] = frame.grid.position(n);
    const double narrowing = (bulge * bulge - neck * neck) * std::exp(-x * x / 0.02);
    const double end = std::max(0.0, std::abs(x) - spread);
    frame.phi.push_back((y * y + z * z + end * end - bulge * bulge + narrowing) / (2 * bulge));
  }
  const auto table = measures_of(image_of(frame));
  EXPECT_NEAR(value(table, "neck_radius"), neck, 0.02 * neck);
}

TEST(MembraneMeasures, TellPhasesApart) {
  const double r = 0.5, z0 = 0.2;
  Frame frame = frame_of(sphere(r), Grid::cube(64, 1));
  for (std::size_t n = 0; n < frame.phi.size(); ++n)
    frame.fields["psi"].push_back(0.3 * std::tanh((z0 - frame.grid.position(n)[2]) / 0.3));
  const auto image = image_of(frame);
  set_field_value(*image, "lo.bending_modulus", 5);
  set_field_value(*image, "sigma", 17);
  set_field_value(*image, "kn_energy", -3);
  const auto table = measures_of(image);
  const double cap = 2 * pi * r * (r - z0), rest = 4 * pi * r * r - cap;
  EXPECT_NEAR(value(table, "A_Ld") / cap, 1, 1e-4);
  EXPECT_NEAR(value(table, "A_Lo") / rest, 1, 1e-4);
  EXPECT_NEAR(value(table, "bending_Ld") / (0.5 * 16 * cap), 1, 1e-4);
  EXPECT_NEAR(value(table, "bending_Lo") / (0.5 * 5 * 16 * rest), 1, 1e-4);
  EXPECT_NEAR(value(table, "line_length") / (2 * pi * std::sqrt(r * r - z0 * z0)), 1, 1e-5);
  EXPECT_TRUE(std::isnan(value(table, "P"))) << "not that of a single phase";
  EXPECT_EQ(value(table, "sigma"), 17) << "known";
  EXPECT_EQ(value(table, "kn_energy"), -3) << "known";
  EXPECT_EQ(table->GetColumnByName("kg_energy"), nullptr);
}

TEST(MembraneMeasures, AgreeWithTheSolverOnPhases) {
  Scene scene;
  scene.shape = {.kind = ShapeKind::prolate, .semi_axis = 0.7, .reduced_volume = 0.85};
  scene.domains = {.kind = DomainsKind::caps, .directions = {{0, 0, 1}, {1, 0.2, -0.3}}};
  scene.domains.half_angle = 35;
  scene.line.tension = 1;
  const Simulation simulation(scene);
  const PhaseMeasures& m = *simulation.measures().phases;
  const auto table = measures_of(image_of(simulation.frame()));
  EXPECT_NEAR(value(table, "A_Ld") / m.area_Ld, 1, 1e-3);
  EXPECT_NEAR(value(table, "A_Lo") / m.area_Lo, 1, 1e-3);
  EXPECT_NEAR(value(table, "bending_Ld") / m.bending_energy_Ld, 1, 2e-3);
  EXPECT_NEAR(value(table, "bending_Lo") / m.bending_energy_Lo, 1, 2e-3);
  EXPECT_NEAR(value(table, "line_length") / m.line_length, 1, 1e-3);
}

TEST(MembraneMeasures, HaveARowForEachTime) {
  vtkNew<vtkVesicleDynamics> dynamics;
  dynamics->SetInputData(
      image_of({.kind = ShapeKind::prolate, .semi_axis = 0.7, .reduced_volume = 0.8}, 32));
  dynamics->SetEndTime(1e-4);
  dynamics->SetOutputFrames(4);
  vtkNew<vtkMembraneMeasures> measures;
  measures->SetInputConnection(dynamics->GetOutputPort());
  for (int round : {1, 2}) {
    measures->Modified();
    measures->Update();
    vtkTable* table = measures->GetOutput();
    ASSERT_EQ(table->GetNumberOfRows(), 4) << round;
    for (vtkIdType row = 0; row < 4; ++row) {
      dynamics->UpdateTimeStep(1e-4 * double(row) / 3);
      EXPECT_DOUBLE_EQ(value(table, "t", row), 1e-4 * double(row) / 3);
      EXPECT_EQ(value(table, "energy", row), field_value(*dynamics->GetOutput(), "energy"));
      EXPECT_NEAR(value(table, "A", row) / value(table, "A"), 1, 1e-4);
    }
  }
}

TEST(MembraneMeasures, MeasureAllTimesAfterAnAbort) {
  vtkNew<vtkVesicleDynamics> dynamics;
  dynamics->SetInputData(image_of(sphere(0.5), 16));
  dynamics->SetEndTime(1e-5);
  dynamics->SetOutputFrames(3);
  vtkNew<vtkMembraneMeasures> measures;
  measures->SetInputConnection(dynamics->GetOutputPort());
  abort_on_the_way_to(0, measures, measures, 2);
  EXPECT_EQ(measures->GetOutput()->GetNumberOfRows(), 1);
  measures->Update();
  EXPECT_EQ(measures->GetOutput()->GetNumberOfRows(), 3);
}

TEST(MembraneMeasures, SayWhatIsWrongWithAnImage) {
  for (const BadImage& bad : bad_images()) {
    vtkNew<vtkMembraneMeasures> measures;
    measures->SetInputData(bad.image);
    EXPECT_THAT(error_of(measures), HasSubstr(bad.complaint));
    EXPECT_EQ(measures->GetOutput()->GetNumberOfRows(), 0);
  }
}

} // namespace
} // namespace lamella
