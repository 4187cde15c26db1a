#pragma once
#include <vtkAlgorithm.h>

#include <exception>
#include <string>

namespace lamella {

/// Does the work of a request. What it throws becomes the algorithm's error; the output is then
/// empty, and the filters after it run and see that.
template <class Work>
int reporting(vtkAlgorithm* self, Work&& work) {
  try {
    work();
  } catch (const std::exception& error) {
    vtkErrorWithObjectMacro(self, << error.what());
  }
  return 1;
}

/// Says what is done to the data, where something is, as a warning.
inline void remark(vtkAlgorithm* self, const std::string& what) {
  if (!what.empty()) vtkWarningWithObjectMacro(self, << what);
}

} // namespace lamella
