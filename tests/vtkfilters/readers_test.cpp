// Scenes and stored runs as images over time.
#include "fields/field_data.h"
#include "scene/builtin.h"
#include "scene/scene_toml.h"
#include "stored_run.h"
#include "vtk_test.h"

#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkVesicleRunReader.h>
#include <vtkVesicleSceneReader.h>

#include "dynamics/simulation.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace lamella {
namespace {

namespace fs = std::filesystem;
using Pipeline = vtkStreamingDemandDrivenPipeline;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* text = R"(
[grid]
nodes = 32
[shape]
kind = "prolate"
reduced_volume = 0.8
[run]
end_time = 1e-4
[output]
frames = 3
)";

class Readers : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lamella-readers-" + std::to_string(getpid()));
    fs::create_directories(folder_ / "frames");
    write(folder_ / "scene.toml", text);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static void write(const fs::path& file, const std::string& content) {
    std::ofstream(file) << content;
  }

  void store_run() {
    lamella::store_run(
        folder_, parse_scene(text, "test"),
        {.kind = Event::Kind::fission, .time = 6e-5, .place = {0.25, 0, 0}, .size = 0.03});
  }

  fs::path folder_;
};

std::vector<double> times_of(vtkAlgorithm* reader) {
  reader->UpdateInformation();
  vtkInformation* info = reader->GetOutputInformation(0);
  const double* times = info->Get(Pipeline::TIME_STEPS());
  return times ? std::vector<double>(times, times + info->Length(Pipeline::TIME_STEPS()))
               : std::vector<double>();
}

vtkSmartPointer<vtkVesicleSceneReader> scene_reader(const fs::path& file) {
  auto reader = vtkSmartPointer<vtkVesicleSceneReader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

vtkSmartPointer<vtkVesicleRunReader> run_reader(const fs::path& file) {
  auto reader = vtkSmartPointer<vtkVesicleRunReader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

TEST_F(Readers, GiveTheSameForASceneAndItsStoredRun) {
  store_run();
  const auto scene = scene_reader(folder_ / "scene.toml");
  const auto run = run_reader(folder_);
  EXPECT_THAT(times_of(scene), testing::ElementsAre(0, 5e-5, 1e-4));
  EXPECT_EQ(times_of(run), times_of(scene));
  for (const double time : {1e-4, 0.0, 5e-5}) {
    scene->UpdateTimeStep(time);
    run->UpdateTimeStep(time);
    vtkImageData *computed = scene->GetOutput(), *stored = run->GetOutput();
    ASSERT_EQ(computed->GetNumberOfPoints(), 32 * 32 * 32);
    ASSERT_EQ(stored->GetNumberOfPoints(), 32 * 32 * 32);
    for (vtkIdType n = 0; n < stored->GetNumberOfPoints(); ++n)
      ASSERT_EQ(values_of(computed, "phi")[n], values_of(stored, "phi")[n]);
    for (const char* name : {"t", "energy", "P", "sigma", "membrane.bending_modulus"})
      EXPECT_NEAR(field_value(*computed, name).value(), field_value(*stored, name).value(),
                  1e-9 * std::abs(field_value(*stored, name).value()))
          << name;
    const auto rows = [](vtkAlgorithm* reader) {
      return vtkTable::SafeDownCast(reader->GetOutputDataObject(1))->GetNumberOfRows();
    };
    EXPECT_EQ(rows(scene), rows(run)) << time;
    EXPECT_GT(rows(run), 3) << "all of them, at any time";
    EXPECT_EQ(vtkTable::SafeDownCast(scene->GetOutputDataObject(2))->GetNumberOfRows(), 0);
  }
}

TEST_F(Readers, TellTheEventsOfARun) {
  store_run();
  const auto run = run_reader(folder_);
  run->UpdateTimeStep(0);
  vtkTable* events = vtkTable::SafeDownCast(run->GetOutputDataObject(2));
  ASSERT_EQ(events->GetNumberOfRows(), 1);
  EXPECT_EQ(events->GetValueByName(0, "kind").ToString(), "fission");
  EXPECT_EQ(events->GetValueByName(0, "x").ToDouble(), 0.25);
  EXPECT_EQ(events->GetNumberOfColumns(), 19);
  vtkTable* vesicles = vtkTable::SafeDownCast(run->GetOutputDataObject(3));
  EXPECT_EQ(vesicles->GetNumberOfRows(), 0) << "there is one";
  EXPECT_GT(vesicles->GetNumberOfColumns(), 8);
  fs::remove(folder_ / "components.csv");
  EXPECT_EQ(error_of(run_reader(folder_)), "") << "earlier versions wrote none";
  fs::remove(folder_ / "events.csv");
  EXPECT_THAT(error_of(run_reader(folder_)), HasSubstr("events.csv"));
}

TEST_F(Readers, FindARunByAnyOfItsFiles) {
  store_run();
  for (const char* file : {"", "scene.toml", "history.csv", "frames", "frames/frame_0001.hdf"}) {
    EXPECT_TRUE(vtkVesicleRunReader::CanReadFile((folder_ / file).c_str())) << file;
    EXPECT_EQ(times_of(run_reader(folder_ / file)).size(), 3u);
  }
  EXPECT_FALSE(vtkVesicleRunReader::CanReadFile(folder_.parent_path().c_str()));
  EXPECT_FALSE(vtkVesicleRunReader::CanReadFile(nullptr));
}

TEST_F(Readers, GiveTheEarlierFrameBetweenTwo) {
  store_run();
  const auto run = run_reader(folder_);
  run->UpdateTimeStep(9e-5);
  EXPECT_EQ(field_value(*run->GetOutput(), "t"), 5e-5);
}

TEST_F(Readers, SayWhatIsWrongWithARun) {
  EXPECT_THAT(error_of(run_reader("")), HasSubstr("no FileName"));
  EXPECT_THAT(error_of(run_reader(folder_ / "none")), HasSubstr("no such file"));
  EXPECT_THAT(error_of(run_reader(folder_)), HasSubstr("scene.toml and history.csv"));
  store_run();
  write(folder_ / "frames" / "frame_0000.hdf", "nonsense");
  const auto damaged = run_reader(folder_);
  EXPECT_THAT(error_of(damaged), HasSubstr("frame_0000.hdf"));
  EXPECT_EQ(damaged->GetOutput()->GetNumberOfPoints(), 0);
  write(folder_ / "frames" / "frames.hdf.series", "");
  EXPECT_THAT(error_of(run_reader(folder_)), HasSubstr("no frames"));
  write(folder_ / "history.csv", "");
  EXPECT_NE(error_of(run_reader(folder_)), "");
}

TEST_F(Readers, OpenBuiltinScenesWithOverrides) {
  const auto reader = scene_reader("fig3_oblate");
  reader->AddOverride("grid.nodes=48");
  reader->AddOverride("output.frames=2");
  EXPECT_EQ(reader->GetNumberOfOverrides(), 2);
  EXPECT_EQ(times_of(reader).size(), 2u);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 48 * 48 * 48);
  reader->RemoveAllOverrides();
  EXPECT_EQ(times_of(reader).size(), std::size_t(builtin_scene("fig3_oblate").output.frames));
}

TEST_F(Readers, OpenTheTextOfAScene) {
  vtkNew<vtkVesicleSceneReader> reader;
  reader->SetFileName("no such file");
  reader->SetSceneText(text);
  reader->AddOverride("output.frames=2");
  EXPECT_THAT(times_of(reader), testing::ElementsAre(0, 1e-4));
  EXPECT_EQ(error_of(reader), "");
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 32 * 32 * 32);
  reader->SetSceneText("[shape]\nkind = 'spher'");
  EXPECT_THAT(error_of(reader), HasSubstr("scene:2: [shape] kind"));
}

TEST_F(Readers, StartWhereAStoredRunEnds) {
  store_run();
  write(folder_ / "later.toml", "[grid]\nnodes = 32\n[shape]\nkind = \"frame\"\nfile = \".\"\n"
                                "[run]\nend_time = 1e-5\n");
  const auto run = run_reader(folder_);
  run->UpdateTimeStep(1e-4);
  const auto later = scene_reader(folder_ / "later.toml");
  EXPECT_EQ(error_of(later), "");
  EXPECT_NEAR(field_value(*later->GetOutput(), "energy").value(),
              field_value(*run->GetOutput(), "energy").value(), 1e-2);
}

TEST_F(Readers, StartWhereABuiltinSceneEnds) {
  write(folder_ / "later.toml", "[grid]\nnodes = 32\n[shape]\nkind = \"frame\"\n"
                                "file = \"sphere\"\n[run]\nend_time = 1e-5\n");
  const auto earlier = scene_reader("sphere"), later = scene_reader(folder_ / "later.toml");
  earlier->AddOverride("grid.nodes=32");
  earlier->UpdateTimeStep(1);
  EXPECT_EQ(error_of(later), "");
  EXPECT_NEAR(field_value(*later->GetOutput(), "energy").value(),
              field_value(*earlier->GetOutput(), "energy").value(), 0.1);
}

/// It never starts from what is not the end.
TEST_F(Readers, GoOnAfterAnAbortOnTheWayToTheirStart) {
  write(folder_ / "later.toml", "[grid]\nnodes = 32\n[shape]\nkind = \"frame\"\n"
                                "file = \"sphere\"\n[run]\nend_time = 1e-5\n");
  const auto whole = scene_reader(folder_ / "later.toml"),
             aborted = scene_reader(folder_ / "later.toml");
  whole->UpdateTimeStep(0);
  for (int count : {2, 3}) {
    abort_on_the_way_to(0, aborted, aborted, count);
    EXPECT_EQ(aborted->GetOutput()->GetNumberOfPoints(), 0);
  }
  aborted->UpdateTimeStep(0);
  EXPECT_EQ(field_value(*aborted->GetOutput(), "energy"),
            field_value(*whole->GetOutput(), "energy"));
}

TEST_F(Readers, ComputeAnyTimeAfterAnAbort) {
  const auto reader = scene_reader(folder_ / "scene.toml");
  abort_on_the_way_to(1e-4, reader, reader, 3);
  EXPECT_LT(field_value(*reader->GetOutput(), "t").value(), 1e-4);
  for (const double time : {1e-4, 5e-5, 1e-4}) {
    reader->UpdateTimeStep(time);
    EXPECT_EQ(field_value(*reader->GetOutput(), "t"), time);
  }
}

TEST_F(Readers, SayWhatIsWrongWithAScene) {
  write(folder_ / "bad.toml", "[membrane]\nbending_modulus = -1\n");
  const auto bad = scene_reader(folder_ / "bad.toml");
  EXPECT_THAT(error_of(bad), AllOf(HasSubstr("bad.toml:2"), HasSubstr("[membrane]")));
  EXPECT_EQ(bad->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(times_of(bad).empty());
  EXPECT_FALSE(vtkVesicleSceneReader::CanReadFile((folder_ / "bad.toml").c_str()));
  EXPECT_TRUE(vtkVesicleSceneReader::CanReadFile((folder_ / "scene.toml").c_str()));
  EXPECT_THAT(error_of(scene_reader("")), HasSubstr("no FileName"));
  EXPECT_THAT(error_of(scene_reader("fig3_oblat")), HasSubstr("did you mean \"fig3_oblate\"?"));
  EXPECT_THAT(error_of(scene_reader(folder_ / "none.toml")), HasSubstr("none.toml"));
  const auto reader = scene_reader(folder_ / "scene.toml");
  reader->AddOverride("grid.nodes=33");
  EXPECT_THAT(error_of(reader), HasSubstr("grid.nodes"));
  reader->RemoveAllOverrides();
  reader->AddOverride(nullptr);
  EXPECT_NE(error_of(reader), "");
  reader->RemoveAllOverrides();
  EXPECT_EQ(error_of(reader), "");
}

TEST_F(Readers, ComputeAnewOnlyWhatChanges) {
  const auto reader = scene_reader(folder_ / "scene.toml");
  reader->UpdateTimeStep(1e-4);
  const double energy = field_value(*reader->GetOutput(), "energy").value();
  reader->AddOverride("membrane.spontaneous_curvature=-5");
  reader->UpdateTimeStep(1e-4);
  EXPECT_NE(field_value(*reader->GetOutput(), "energy"), energy);
  reader->RemoveAllOverrides();
  reader->UpdateTimeStep(1e-4);
  EXPECT_EQ(field_value(*reader->GetOutput(), "energy"), energy);
}

} // namespace
} // namespace lamella
