// Nothing is left of a pipeline when it goes, of any class.
#include "stored_run.h"
#include "vtk_test.h"

#include <vtkMembraneMeasures.h>
#include <vtkMembraneSurface.h>
#include <vtkPhaseBoundary.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleFromImage.h>
#include <vtkVesicleFromSurface.h>
#include <vtkVesicleRunReader.h>
#include <vtkVesicleSceneReader.h>
#include <vtkVesicleSource.h>
#include <vtkWeakPointer.h>

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <malloc.h>
#include <unistd.h>

namespace lamella {
namespace {

using Watched = std::vector<vtkWeakPointer<vtkObject>>;

/// Bytes in use, after what is only kept for reuse was given back.
double memory_in_use() {
  malloc_trim(0);
  const struct mallinfo2 info = mallinfo2();
  return double(info.uordblks) + double(info.hblkhd);
}

class Leaks : public testing::Test {
protected:
  /// Runs something often. `run` adds the objects that must not outlive it.
  template <class Run>
  void expect_none(Run&& run) {
    constexpr int rounds = 50;
    constexpr double allowed = 1000; // bytes a round: 16^3 numbers are 32768
    Watched watched;
    for (int n = 0; n < 3; ++n) run(watched); // what is made once
    // A leak grows every time. What the threads keep for themselves, they keep once.
    double least = std::numeric_limits<double>::infinity();
    for (int batch = 0; batch < 3 && least >= allowed; ++batch) {
      const double before = memory_in_use();
      for (int n = 0; n < rounds; ++n) run(watched);
      watched.shrink_to_fit();
      least = std::min(least, (memory_in_use() - before) / rounds);
    }
    EXPECT_LT(least, allowed);
    ASSERT_FALSE(watched.empty());
    for (const auto& object : watched) EXPECT_EQ(object, nullptr) << object->GetClassName();
  }

  /// An algorithm, its executive and what it puts out.
  static void watch(vtkAlgorithm* algorithm, Watched& watched) {
    watched.emplace_back(algorithm);
    watched.emplace_back(algorithm->GetExecutive());
    for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port) {
      ASSERT_NE(algorithm->GetOutputDataObject(port), nullptr);
      watched.emplace_back(algorithm->GetOutputDataObject(port));
    }
  }

  static vtkSmartPointer<vtkVesicleSource> source() {
    auto source = vtkSmartPointer<vtkVesicleSource>::New();
    source->SetNodes(16, 16, 16);
    source->SetShapeKind("sphere");
    source->SetDomainsKind("cap");
    return source;
  }

  /// A filter after the source.
  template <class Filter>
  void expect_none_after_source() {
    expect_none([](Watched& watched) {
      const auto input = source();
      vtkNew<Filter> filter;
      filter->SetInputConnection(input->GetOutputPort());
      filter->Update();
      watch(input, watched);
      watch(filter, watched);
    });
  }
};

TEST_F(Leaks, OfSources) {
  expect_none([](Watched& watched) {
    const auto input = source();
    input->Update();
    watch(input, watched);
  });
}

TEST_F(Leaks, OfSurfaces) { expect_none_after_source<vtkMembraneSurface>(); }
TEST_F(Leaks, OfBoundaries) { expect_none_after_source<vtkPhaseBoundary>(); }
TEST_F(Leaks, OfImages) { expect_none_after_source<vtkVesicleFromImage>(); }
TEST_F(Leaks, OfMeasures) { expect_none_after_source<vtkMembraneMeasures>(); }

TEST_F(Leaks, OfSurfacesThatComeIn) {
  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputData(image_of(sphere(0.5), 16));
  surface->Update();
  expect_none([&](Watched& watched) {
    vtkNew<vtkVesicleFromSurface> vesicle;
    vesicle->SetInputData(surface->GetOutput());
    vesicle->SetNodes(16, 16, 16);
    vesicle->Update();
    watch(vesicle, watched);
  });
}

TEST_F(Leaks, OfDynamicsAtStoredTimesAndBetween) {
  expect_none([](Watched& watched) {
    const auto input = source();
    vtkNew<vtkVesicleDynamics> dynamics;
    dynamics->SetInputConnection(input->GetOutputPort());
    dynamics->SetEndTime(1e-6);
    dynamics->SetOutputFrames(3);
    for (const double time : {5e-7, 2e-7}) dynamics->UpdateTimeStep(time);
    watch(dynamics, watched);
  });
}

TEST_F(Leaks, OfErrors) {
  vtkNew<vtkImageData> nonsense;
  expect_none([&](Watched& watched) {
    vtkNew<vtkVesicleDynamics> dynamics;
    dynamics->SetInputData(nonsense);
    EXPECT_NE(error_of(dynamics), "");
    watch(dynamics, watched);
  });
}

TEST_F(Leaks, OfReaders) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("lamella-leaks-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string text = "[grid]\nnodes = 16\n[shape]\nkind = \"sphere\"\n"
                           "[run]\nend_time = 1e-6\n[output]\nframes = 3\n";
  write_text_atomically(folder / "scene.toml", text);
  store_run(folder, parse_scene(text, "test"), {});
  const auto read = [&](auto& reader, Watched& watched) {
    reader.SetFileName((folder / "scene.toml").c_str());
    reader.UpdateTimeStep(5e-7);
    EXPECT_EQ(reader.GetOutput()->GetNumberOfPoints(), 16 * 16 * 16);
    watch(&reader, watched);
  };
  expect_none([&](Watched& watched) { read(*vtkNew<vtkVesicleRunReader>(), watched); });
  expect_none([&](Watched& watched) { read(*vtkNew<vtkVesicleSceneReader>(), watched); });
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace lamella
