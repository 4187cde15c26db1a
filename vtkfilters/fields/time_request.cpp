#include "fields/time_request.h"

#include <vtkStreamingDemandDrivenPipeline.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace lamella {
namespace {

using Pipeline = vtkStreamingDemandDrivenPipeline;

} // namespace

void offer_times(vtkInformationVector& output, const std::vector<double>& times) {
  const double range[2] = {times.front(), times.back()};
  for (int port = 0; port < output.GetNumberOfInformationObjects(); ++port) {
    vtkInformation* info = output.GetInformationObject(port);
    info->Set(Pipeline::TIME_STEPS(), times.data(), int(times.size()));
    info->Set(Pipeline::TIME_RANGE(), range, 2);
  }
}

double requested_time(vtkInformation& request, vtkInformationVector& output) {
  const int port = std::max(0, request.Get(Pipeline::FROM_OUTPUT_PORT()));
  vtkInformation* info = output.GetInformationObject(port);
  return info->Has(Pipeline::UPDATE_TIME_STEP()) ? info->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
}

Trajectory::GoOn until_aborted(vtkAlgorithm* self, double time) {
  return [self, time, begin = std::optional<double>()](double now) mutable {
    if (!begin) begin = now;
    if (time > *begin) self->UpdateProgress(std::clamp((now - *begin) / (time - *begin), 0.0, 1.0));
    return !self->GetAbortExecute(); // after CheckAbort() VTK would empty the output
  };
}

void report_failure(vtkAlgorithm* self, const Trajectory& trajectory, double time) {
  if (trajectory.failure() && time > trajectory.time())
    vtkErrorWithObjectMacro(self, << fmt::format("the run stopped at t = {:.6g}: {}",
                                                 trajectory.time(), *trajectory.failure()));
}

} // namespace lamella
