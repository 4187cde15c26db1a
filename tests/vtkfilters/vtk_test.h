#pragma once
#include "fields/image.h"
#include "scene/shapes.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <string>
#include <vector>

namespace lamella {

inline Frame frame_of(const Shape& shape, const Grid& grid) {
  return {.grid = grid, .phi = initial_phi(shape, grid)};
}

inline vtkSmartPointer<vtkImageData> image_of(const Frame& frame) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  fill_image(*image, frame);
  return image;
}

inline vtkSmartPointer<vtkImageData> image_of(const Shape& shape, int nodes = 64) {
  return image_of(frame_of(shape, Grid::cube(nodes, 1)));
}

inline Shape sphere(double radius, const Vec3& center = {}) {
  return {.kind = ShapeKind::sphere, .radius = radius, .center = center};
}

/// What an object reports while this lives; nothing is printed.
class Reports {
public:
  explicit Reports(vtkObject* object, unsigned long event = vtkCommand::ErrorEvent) {
    command_->SetClientData(this);
    command_->SetCallback([](vtkObject*, unsigned long, void* self, void* text) {
      static_cast<Reports*>(self)->text_ += static_cast<const char*>(text);
    });
    observed_ = object;
    tag_ = object->AddObserver(event, command_);
  }
  ~Reports() { observed_->RemoveObserver(tag_); }
  Reports(const Reports&) = delete;
  void operator=(const Reports&) = delete;
  const std::string& text() const { return text_; }

private:
  vtkSmartPointer<vtkObject> observed_;
  unsigned long tag_ = 0;
  vtkNew<vtkCallbackCommand> command_;
  std::string text_;
};

/// What an algorithm that cannot do its work says.
inline std::string error_of(vtkAlgorithm* algorithm) {
  const Reports reports(algorithm);
  algorithm->Update();
  return reports.text();
}

/// Calls a function at every progress of an algorithm.
class Watch {
public:
  Watch(vtkAlgorithm* algorithm, std::function<void()> action)
      : algorithm_(algorithm), action_(std::move(action)) {
    command_->SetClientData(&action_);
    command_->SetCallback([](vtkObject*, unsigned long, void* action, void*) {
      (*static_cast<std::function<void()>*>(action))();
    });
    tag_ = algorithm->AddObserver(vtkCommand::ProgressEvent, command_);
  }
  ~Watch() { algorithm_->RemoveObserver(tag_); }
  Watch(const Watch&) = delete;
  void operator=(const Watch&) = delete;

private:
  vtkSmartPointer<vtkAlgorithm> algorithm_;
  std::function<void()> action_;
  vtkNew<vtkCallbackCommand> command_;
  unsigned long tag_;
};

/// Asks for a time, and aborts at the `count`-th progress.
inline void abort_on_the_way_to(double time, vtkAlgorithm* asked, vtkAlgorithm* aborted,
                                int count = 4) {
  int steps = 0;
  const Watch watch(aborted, [&] {
    if (++steps == count) aborted->AbortExecuteOn();
  });
  asked->UpdateTimeStep(time);
}

inline vtkSmartPointer<vtkDoubleArray> array_of(const std::string& name,
                                                const std::vector<double>& values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  for (const double value : values) array->InsertNextValue(value);
  return array;
}

inline double* values_of(vtkDataSet* data, const char* name) {
  auto* array = vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray(name));
  return array ? array->GetPointer(0) : nullptr;
}

} // namespace lamella
