#pragma once
#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>

#include <string>

namespace lamella::render {

/// What a filter made of an image, and what it said: its last error and its last warning, or
/// nothing.
struct FilterOutput {
  vtkSmartPointer<vtkPolyData> data;
  std::string error, warning;
};

FilterOutput output_of(vtkPolyDataAlgorithm& filter, vtkImageData& image);

} // namespace lamella::render
