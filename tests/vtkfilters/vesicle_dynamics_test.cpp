// Vesicles over time: any time, in any order, interrupted or not.
#include "bad_images.h"
#include "fields/field_data.h"

#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMembraneSurface.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleSource.h>

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace lamella {
namespace {

using Pipeline = vtkStreamingDemandDrivenPipeline;
using testing::HasSubstr;

constexpr double end = 2e-4;

vtkSmartPointer<vtkImageData> start() {
  return image_of({.kind = ShapeKind::prolate, .semi_axis = 0.7, .reduced_volume = 0.8}, 32);
}

/// A run of five stored states.
vtkSmartPointer<vtkVesicleDynamics> dynamics_of(vtkImageData* image) {
  auto dynamics = vtkSmartPointer<vtkVesicleDynamics>::New();
  dynamics->SetInputData(image);
  dynamics->SetEndTime(end);
  dynamics->SetOutputFrames(5);
  return dynamics;
}

std::vector<double> phi_at(vtkVesicleDynamics* dynamics, double time) {
  dynamics->UpdateTimeStep(time);
  const double* phi = values_of(dynamics->GetOutput(), "phi");
  return {phi, phi + dynamics->GetOutput()->GetNumberOfPoints()};
}

double time_of(vtkImageData* image) {
  return image->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
}

double field(vtkVesicleDynamics* dynamics, const char* name) {
  return field_value(*dynamics->GetOutput(), name).value();
}

TEST(VesicleDynamics, OffersTheTimesOfItsStoredStates) {
  const auto dynamics = dynamics_of(start());
  dynamics->UpdateInformation();
  for (int port : {0, 1}) {
    vtkInformation* info = dynamics->GetOutputInformation(port);
    ASSERT_EQ(info->Length(Pipeline::TIME_STEPS()), 5);
    for (int n = 0; n < 5; ++n) EXPECT_DOUBLE_EQ(info->Get(Pipeline::TIME_STEPS())[n], end * n / 4);
    EXPECT_EQ(info->Get(Pipeline::TIME_RANGE())[1], end);
  }
}

TEST(VesicleDynamics, TakesADensityAsText) {
  const auto dynamics = dynamics_of(start()), plain = dynamics_of(start());
  dynamics->SetDensity("a*KM^2 + b*K");
  dynamics->SetParameters("a = 0.25, b = -1.5");
  EXPECT_EQ(dynamics->GetParameters(), std::string("a = 0.25, b = -1.5"));
  dynamics->Update();
  plain->Update();
  const double bending = field(plain, "energy"), pi = std::numbers::pi;
  EXPECT_NEAR(field(dynamics, "energy"), 1.5 * bending - 1.5 * 4 * pi, 0.01 * bending);

  dynamics->SetParameters("a = 0.25, b = c");
  EXPECT_THAT(error_of(dynamics), HasSubstr("[parameters]: \"a = 0.25, b = c\""));
  dynamics->SetParameters("a = 0.25");
  EXPECT_THAT(error_of(dynamics), HasSubstr("[membrane] density: column 10: unknown name b"));
  dynamics->SetDensity(nullptr);
  EXPECT_THAT(error_of(dynamics), HasSubstr("[parameters] a: no density speaks of it"));
  dynamics->SetParameters("");
  EXPECT_EQ(error_of(dynamics), "");
}

TEST(VesicleDynamics, LowersTheEnergyAtFixedVolumeAndArea) {
  const auto dynamics = dynamics_of(start());
  dynamics->Update();
  EXPECT_EQ(time_of(dynamics->GetOutput()), 0);
  const double energy = field(dynamics, "energy"), A = field(dynamics, "A"),
               V = field(dynamics, "V");
  dynamics->UpdateTimeStep(end);
  EXPECT_EQ(time_of(dynamics->GetOutput()), end);
  EXPECT_LT(field(dynamics, "energy"), 0.99 * energy);
  EXPECT_NEAR(field(dynamics, "A") / A, 1, 1e-5);
  EXPECT_NEAR(field(dynamics, "V") / V, 1, 1e-5);
  EXPECT_EQ(field(dynamics, "membrane.bending_modulus"), 1);
}

TEST(VesicleDynamics, GivesTheSameInAnyOrder) {
  const auto forward = dynamics_of(start()), anyhow = dynamics_of(start());
  const auto first = phi_at(forward, 0), middle = phi_at(forward, end / 2),
             last = phi_at(forward, end);
  EXPECT_EQ(phi_at(anyhow, end), last);
  phi_at(anyhow, 0.3 * end);
  EXPECT_EQ(phi_at(anyhow, end / 2), middle);
  EXPECT_EQ(phi_at(anyhow, 0), first);
  EXPECT_EQ(phi_at(anyhow, -1), first);
  EXPECT_EQ(phi_at(anyhow, 10 * end), last);
}

TEST(VesicleDynamics, ReachesTimesBetween) {
  const auto dynamics = dynamics_of(start()), finer = dynamics_of(start());
  finer->SetOutputFrames(9);
  const double time = 3 * end / 8;
  const auto before = phi_at(dynamics, end / 4), phi = phi_at(dynamics, time);
  EXPECT_DOUBLE_EQ(time_of(dynamics->GetOutput()), time);
  EXPECT_NEAR(field(dynamics, "t"), time, 1e-18);
  const auto expected = phi_at(finer, time);
  double moved = 0, error = 0;
  for (std::size_t n = 0; n < phi.size(); ++n) {
    if (std::abs(phi[n]) > 0.1) continue; // the membrane is elsewhere
    moved = std::max(moved, std::abs(phi[n] - before[n]));
    error = std::max(error, std::abs(phi[n] - expected[n]));
  }
  EXPECT_LT(error, 0.15 * moved); // measured 0.125: their steps are not the same
  const double energy = field(finer, "energy");
  EXPECT_NEAR(field(dynamics, "energy") / energy, 1, 1e-3);
}

TEST(VesicleDynamics, LeadsAlongRampsAlsoBetween) {
  const auto at = [](double time, int frames) {
    const auto dynamics = dynamics_of(start());
    dynamics->SetOutputFrames(frames);
    dynamics->SetVolumeConstraint("ramped");
    dynamics->SetVolumeRate(100);
    dynamics->AddVolumeTarget(0.81, 0);
    dynamics->AddVolumeTarget(0.79, end / 2);
    EXPECT_EQ(dynamics->GetNumberOfVolumeTargets(), 2);
    dynamics->UpdateTimeStep(time);
    return field(dynamics, "v");
  };
  for (const double time : {0.1 * end, 0.6 * end})
    EXPECT_NEAR(at(time, 2), at(time, 11), 1e-4) << time;
  EXPECT_NEAR(at(0.4 * end, 5), 0.8 + 100 * 0.4 * end, 1e-4);
}

TEST(VesicleDynamics, TellsTheHistory) {
  const auto dynamics = dynamics_of(start());
  dynamics->UpdateTimeStep(end);
  vtkTable* history = vtkTable::SafeDownCast(dynamics->GetOutputDataObject(1));
  ASSERT_GT(history->GetNumberOfRows(), 5);
  const auto at = [&](vtkIdType row, const char* column) {
    return history->GetValueByName(row, column).ToDouble();
  };
  for (vtkIdType row = 1; row < history->GetNumberOfRows(); ++row) {
    EXPECT_GT(at(row, "t"), at(row - 1, "t"));
    EXPECT_LE(at(row, "energy"), at(row - 1, "energy"));
  }
  EXPECT_EQ(at(history->GetNumberOfRows() - 1, "t"), end);
  EXPECT_EQ(at(history->GetNumberOfRows() - 1, "energy"), field(dynamics, "energy"));
  const vtkIdType rows = history->GetNumberOfRows();
  dynamics->UpdateTimeStep(0);
  EXPECT_EQ(history->GetNumberOfRows(), rows) << "whole, whatever the time";
}

/// Of two balls that touch, in a box that is somewhere else: the neck is sharper than the grid.
TEST(VesicleDynamics, TellsWhatHappened) {
  Frame frame;
  frame.grid = Grid::cube(32, 1);
  for (std::size_t n = 0; n < frame.grid.size(); ++n) {
    const auto [x, y, z] = frame.grid.position(n);
    frame.phi.push_back(std::hypot(std::abs(x) - 0.3, y, z) - 0.31);
  }
  const auto image = image_of(frame);
  image->SetOrigin(image->GetOrigin()[0] + 5, image->GetOrigin()[1], image->GetOrigin()[2]);
  const auto dynamics = dynamics_of(image);
  dynamics->UpdateTimeStep(0);
  vtkTable* events = vtkTable::SafeDownCast(dynamics->GetOutputDataObject(2));
  EXPECT_EQ(events->GetNumberOfColumns(), 19);
  ASSERT_GE(events->GetNumberOfRows(), 1);
  EXPECT_EQ(events->GetValueByName(0, "kind").ToString(), "sharp");
  EXPECT_EQ(events->GetValueByName(0, "t").ToDouble(), 0);
  EXPECT_NEAR(events->GetValueByName(0, "x").ToDouble(), 5, 0.1) << "where the neck is";
  const auto smooth = dynamics_of(start());
  smooth->Update();
  events = vtkTable::SafeDownCast(smooth->GetOutputDataObject(2));
  EXPECT_EQ(events->GetNumberOfRows(), 0);
  EXPECT_EQ(events->GetNumberOfColumns(), 19) << "also without rows";
}

TEST(VesicleDynamics, TellsWhatEachOfSeveralVesiclesHas) {
  Frame frame;
  frame.grid = Grid::cube(32, 1);
  for (std::size_t n = 0; n < frame.grid.size(); ++n) {
    const auto [x, y, z] = frame.grid.position(n);
    frame.phi.push_back(
        std::min(std::hypot(x - 0.45, y, z) - 0.3, std::hypot(x + 0.4, y, z) - 0.4));
  }
  const auto image = image_of(frame);
  image->SetOrigin(image->GetOrigin()[0] + 5, image->GetOrigin()[1], image->GetOrigin()[2]);
  const auto dynamics = dynamics_of(image);
  dynamics->UpdateTimeStep(0);
  vtkTable* vesicles = vtkTable::SafeDownCast(dynamics->GetOutputDataObject(3));
  ASSERT_EQ(vesicles->GetNumberOfRows(), 2);
  for (const auto& [row, x, R] : {std::tuple{0, 4.6, 0.4}, {1, 5.45, 0.3}}) {
    EXPECT_EQ(vesicles->GetValueByName(row, "component").ToDouble(), row + 1);
    EXPECT_NEAR(vesicles->GetValueByName(row, "x").ToDouble(), x, 1e-3);
    EXPECT_NEAR(vesicles->GetValueByName(row, "A").ToDouble() / (4 * M_PI * R * R), 1, 1e-3);
  }
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputConnection(dynamics->GetOutputPort());
  surface->UpdateTimeStep(0);
  EXPECT_FALSE(surface->GetOutput()->GetPointData()->HasArray("velocity"))
      << "each has multipliers of its own";
  dynamics->SetAreaOf("all");
  dynamics->SetVolumeOf("all");
  dynamics->UpdateTimeStep(0);
  vesicles = vtkTable::SafeDownCast(dynamics->GetOutputDataObject(3));
  EXPECT_EQ(vesicles->GetNumberOfRows(), 0);
  surface->UpdateTimeStep(0);
  EXPECT_TRUE(surface->GetOutput()->GetPointData()->HasArray("velocity"));
}

TEST(VesicleDynamics, ComputesAnewOnlyWhatChanges) {
  const auto dynamics = dynamics_of(start());
  dynamics->UpdateTimeStep(end);
  int steps = 0;
  const Watch watch(dynamics, [&] { ++steps; });
  const auto steps_of_update = [&] {
    steps = 0;
    dynamics->UpdateTimeStep(end);
    return steps;
  };
  const int idle = (dynamics->Modified(), steps_of_update()); // VTK's own progress, 0 and 1
  dynamics->SetLineTension(3);                                // of two phases
  EXPECT_EQ(steps_of_update(), idle);
  dynamics->SetBendingModulus(2);
  EXPECT_GT(steps_of_update(), idle + 5);
  EXPECT_EQ(field(dynamics, "membrane.bending_modulus"), 2);
  dynamics->GetInput()->Modified();
  EXPECT_GT(steps_of_update(), idle + 5);
}

TEST(VesicleDynamics, GoesOnAfterAnAbort) {
  const auto whole = dynamics_of(start()), dynamics = dynamics_of(start());
  abort_on_the_way_to(end, dynamics, dynamics);
  EXPECT_GT(dynamics->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_LT(time_of(dynamics->GetOutput()), end);
  EXPECT_EQ(phi_at(dynamics, end), phi_at(whole, end)) << "asked for the same time again";
}

TEST(VesicleDynamics, ComputesAnyTimeAfterAnAbort) {
  const auto whole = dynamics_of(start()), dynamics = dynamics_of(start());
  abort_on_the_way_to(end, dynamics, dynamics);
  for (const double time : {end / 2, end, 0.0}) {
    EXPECT_EQ(phi_at(dynamics, time), phi_at(whole, time));
    EXPECT_EQ(time_of(dynamics->GetOutput()), time);
    EXPECT_EQ(field(dynamics, "t"), time);
  }
  abort_on_the_way_to(0.3 * end, dynamics, dynamics, 2); // between two that are kept
  EXPECT_EQ(field(dynamics, "t"), time_of(dynamics->GetOutput()));
  EXPECT_LT(time_of(dynamics->GetOutput()), 0.3 * end);
  EXPECT_EQ(phi_at(dynamics, 0.3 * end), phi_at(whole, 0.3 * end));
  dynamics->SetSpontaneousCurvature(1);
  whole->SetSpontaneousCurvature(1);
  abort_on_the_way_to(end, dynamics, dynamics);
  EXPECT_EQ(field(dynamics, "t"), time_of(dynamics->GetOutput()));
  EXPECT_EQ(phi_at(dynamics, end), phi_at(whole, end));
}

TEST(VesicleDynamics, AbortsOneUpdateOfAllItsPorts) {
  const auto dynamics = dynamics_of(start());
  abort_on_the_way_to(end, dynamics, dynamics, 1);
  EXPECT_EQ(time_of(dynamics->GetOutput()), 0) << "also at once";
  abort_on_the_way_to(end, dynamics, dynamics);
  const double reached = time_of(dynamics->GetOutput());
  EXPECT_GT(reached, 0);
  for (int port : {1, 2}) {
    dynamics->GetOutputInformation(port)->Set(Pipeline::UPDATE_TIME_STEP(), end);
    dynamics->Update(port);
    EXPECT_EQ(time_of(dynamics->GetOutput()), reached);
    EXPECT_EQ(
        dynamics->GetOutputDataObject(port)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()),
        reached);
  }
  dynamics->Update(1);
  EXPECT_EQ(time_of(dynamics->GetOutput()), end) << "asked again";
}

TEST(VesicleDynamics, TellsTheTimeReachedDownAPipeline) {
  const auto dynamics = dynamics_of(start());
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputConnection(dynamics->GetOutputPort());
  const auto time = [&] {
    return surface->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
  };
  abort_on_the_way_to(end, surface, dynamics);
  EXPECT_LT(time(), end);
  EXPECT_EQ(time(), field(dynamics, "t"));
  surface->UpdateTimeStep(end);
  EXPECT_EQ(time(), end);
}

TEST(VesicleDynamics, RefusesATimeThatIsNoNumber) {
  const auto dynamics = dynamics_of(start());
  const Reports reports(dynamics);
  dynamics->UpdateTimeStep(NAN);
  EXPECT_THAT(reports.text(), HasSubstr("not a number"));
}

TEST(VesicleDynamics, KeepsTheLastGoodStateOfARunThatFails) {
  const auto dynamics = dynamics_of(start());
  dynamics->SetVolumeConstraint("ramped");
  dynamics->AddVolumeTarget(0.2, 0);
  dynamics->SetVolumeRate(200);
  dynamics->SetContactTopologyChanges(false);
  dynamics->SetEndTime(0.05);
  const Reports reports(dynamics);
  dynamics->UpdateTimeStep(0.05);
  EXPECT_THAT(reports.text(), HasSubstr("the run stopped at t = "));
  const double time = time_of(dynamics->GetOutput());
  EXPECT_GT(time, 0);
  EXPECT_LT(time, 0.05);
  EXPECT_EQ(field(dynamics, "t"), time);
  EXPECT_EQ(phi_at(dynamics, time / 2).size(), std::size_t(32 * 32 * 32));
  EXPECT_NEAR(time_of(dynamics->GetOutput()), time / 2, 1e-15) << "earlier times are there";
}

TEST(VesicleDynamics, EndsWhereItsRulesSay) {
  const auto dynamics = dynamics_of(image_of(sphere(0.5), 32));
  dynamics->SetEndTime(1);
  dynamics->SetStopEnergyRate(1);
  dynamics->UpdateTimeStep(1);
  EXPECT_LT(time_of(dynamics->GetOutput()), 0.9);
}

TEST(VesicleDynamics, TakesLevelSetsThatAreNoDistances) {
  const auto image = start(), other = start();
  double* phi = values_of(other, "phi");
  for (vtkIdType n = 0; n < other->GetNumberOfPoints(); ++n)
    phi[n] = 30 * phi[n] * (1 + 0.5 * phi[n]);
  const auto usual = dynamics_of(image), dynamics = dynamics_of(other);
  EXPECT_EQ(error_of(dynamics), "");
  usual->UpdateTimeStep(end);
  dynamics->UpdateTimeStep(end);
  for (const char* name : {"energy", "A", "V"})
    EXPECT_NEAR(field(dynamics, name) / field(usual, name), 1, 2e-3) << name;
}

TEST(VesicleDynamics, TakesBoxesThatAreNoCubes) {
  const auto dynamics = dynamics_of(
      image_of(frame_of({.kind = ShapeKind::prolate, .semi_axis = 0.7, .reduced_volume = 0.8},
                        {{24, 24, 40}, 0.05})));
  const auto phi = phi_at(dynamics, end);
  EXPECT_EQ(phi.size(), std::size_t(24 * 24 * 40));
  EXPECT_NEAR(field(dynamics, "v"), 0.8, 1e-3);
}

TEST(VesicleDynamics, LeavesTheBoxWhereItIs) {
  const auto image = start();
  image->SetOrigin(image->GetOrigin()[0] + 5, image->GetOrigin()[1], image->GetOrigin()[2] - 2);
  const auto dynamics = dynamics_of(image);
  dynamics->UpdateTimeStep(end);
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(dynamics->GetOutput()->GetOrigin()[a], image->GetOrigin()[a], 1e-12);
}

TEST(VesicleDynamics, PassesTimesDownAPipeline) {
  vtkNew<vtkVesicleSource> source;
  source->SetNodes(32, 32, 32);
  source->SetShapeReducedVolume(0.8);
  vtkNew<vtkVesicleDynamics> dynamics;
  dynamics->SetInputConnection(source->GetOutputPort());
  dynamics->SetEndTime(end);
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputConnection(dynamics->GetOutputPort());
  surface->UpdateTimeStep(end);
  EXPECT_EQ(dynamics->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), end);
  EXPECT_TRUE(surface->GetOutput()->GetPointData()->HasArray("velocity"));
  EXPECT_EQ(surface->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), end);
}

TEST(VesicleDynamics, MovesTwoPhases) {
  vtkNew<vtkVesicleSource> source;
  source->SetNodes(32, 32, 32);
  source->SetShapeKind("sphere");
  source->SetShapeRadius(0.6);
  source->SetDomainsKind("cap");
  source->SetDomainsAreaFraction(0.3);
  source->Update();
  const auto dynamics = dynamics_of(source->GetOutput());
  dynamics->SetLineTension(20);
  dynamics->SetLoBendingModulus(2);
  dynamics->UpdateTimeStep(0);
  const double length = field(dynamics, "line_length"), A_Ld = field(dynamics, "A_Ld"),
               energy = field(dynamics, "energy");
  for (const double time : {end, 0.3 * end}) { // a stored one, and one between
    dynamics->UpdateTimeStep(time);
    EXPECT_EQ(field(dynamics, "lo.bending_modulus"), 2);
    EXPECT_LT(field(dynamics, "line_length"), length);
    EXPECT_LT(field(dynamics, "energy"), energy);
    EXPECT_NEAR(field(dynamics, "A_Ld") / A_Ld, 1, 1e-3);
    ASSERT_NE(values_of(dynamics->GetOutput(), "psi"), nullptr);
  }
}

TEST(VesicleDynamics, SaysWhatIsWrongWithAnImage) {
  for (const BadImage& bad : bad_images()) {
    const auto dynamics = dynamics_of(bad.image);
    EXPECT_THAT(error_of(dynamics), HasSubstr(bad.complaint));
    EXPECT_EQ(dynamics->GetOutput()->GetNumberOfPoints(), 0);
  }
  EXPECT_THAT(error_of(dynamics_of(image_of(frame_of(sphere(0.2), Grid{{520, 16, 16}, 0.05})))),
              HasSubstr("520 x 16 x 16 nodes; along each axis the solver takes an integer multiple "
                        "of 8 from 16 to 512"));
}

// As it lies in the middle of a box with room, the energy is the same.
TEST(VesicleDynamics, MakesRoomAroundAMembrane) {
  const auto energy = [](const Vec3& center, const std::array<int, 3>& nodes) {
    const auto dynamics = dynamics_of(image_of(frame_of(sphere(0.3, center), Grid{nodes, 0.04})));
    const Reports warnings(dynamics, vtkCommand::WarningEvent);
    EXPECT_EQ(error_of(dynamics), "");
    return field(dynamics, "energy");
  };
  EXPECT_NEAR(energy({0.3, -0.3, 0}, {32, 32, 18}) / energy({0, 0, 0}, {32, 32, 32}), 1, 1e-3);
}

TEST(VesicleDynamics, IsModifiedOnlyByWhatChanges) {
  vtkNew<vtkVesicleDynamics> dynamics;
  const auto modifies = [&](auto&& set) {
    const vtkMTimeType before = dynamics->GetMTime();
    set();
    return dynamics->GetMTime() > before;
  };
  EXPECT_FALSE(modifies([&] { dynamics->SetBendingModulus(dynamics->GetBendingModulus()); }));
  EXPECT_FALSE(modifies([&] { dynamics->SetVolumeConstraint("fixed"); }));
  EXPECT_FALSE(modifies([&] { dynamics->RemoveAllVolumeTargets(); }));
  EXPECT_FALSE(modifies([&] { dynamics->SetPhiArray("phi"); }));
  EXPECT_TRUE(modifies([&] { dynamics->SetBendingModulus(2); }));
  EXPECT_TRUE(modifies([&] { dynamics->SetVolumeConstraint("ramped"); }));
  EXPECT_TRUE(modifies([&] { dynamics->AddVolumeTarget(0.8, 0); }));
  EXPECT_TRUE(modifies([&] { dynamics->RemoveAllVolumeTargets(); }));
  EXPECT_TRUE(modifies([&] { dynamics->SetPhiArray("level"); }));
}

TEST(VesicleDynamics, SaysWhatIsWrongWithParameters) {
  const auto dynamics = dynamics_of(start());
  dynamics->SetEndTime(-1);
  EXPECT_THAT(error_of(dynamics), HasSubstr("[run] end_time"));
  dynamics->SetEndTime(end);
  dynamics->SetOutputFrames(0);
  EXPECT_THAT(error_of(dynamics), HasSubstr("[output] frames"));
  dynamics->SetOutputFrames(5);
  dynamics->SetBendingModulus(NAN);
  EXPECT_THAT(error_of(dynamics), HasSubstr("[membrane] bending_modulus"));
  dynamics->SetBendingModulus(1);
  dynamics->SetVolumeConstraint("fixd");
  EXPECT_STREQ(dynamics->GetVolumeConstraint(), "fixd");
  EXPECT_THAT(error_of(dynamics), HasSubstr("did you mean \"fixed\"?"));
  dynamics->SetVolumeConstraint("free");
  dynamics->SetVolumeConstraint("fixed");
  EXPECT_EQ(error_of(dynamics), "");
}

TEST(VesicleDynamics, PrintsItsParameters) {
  std::ostringstream text;
  vtkNew<vtkVesicleDynamics>()->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("[run] end_time = 0"));
}

} // namespace
} // namespace lamella
