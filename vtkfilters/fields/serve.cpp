#include "fields/serve.h"

#include "fields/state_data.h"

#include <vtkImageData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

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

void withdraw_times(vtkInformationVector& output) {
  for (int port = 0; port < output.GetNumberOfInformationObjects(); ++port) {
    output.GetInformationObject(port)->Remove(Pipeline::TIME_STEPS());
    output.GetInformationObject(port)->Remove(Pipeline::TIME_RANGE());
  }
}

void offer_grid(vtkInformation& output, const Grid& grid, const Vec3& center) {
  int extent[6];
  for (int a = 0; a < 3; ++a) extent[2 * a] = 0, extent[2 * a + 1] = std::max(1, grid.nodes[a]) - 1;
  output.Set(Pipeline::WHOLE_EXTENT(), extent, 6);
  output.Set(vtkDataObject::ORIGIN(), grid.origin(0) + center[0], grid.origin(1) + center[1],
             grid.origin(2) + center[2]);
  output.Set(vtkDataObject::SPACING(), grid.spacing, grid.spacing, grid.spacing);
  vtkDataObject::SetPointDataActiveScalarInfo(&output, VTK_DOUBLE, 1);
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

void serve(vtkAlgorithm* self, Trajectory& trajectory, const Vec3& center, vtkInformation& request,
           vtkInformationVector& output) {
  const double time = requested_time(request, output);
  const State state = trajectory.at(time, until_aborted(self, time));
  fill_state(*vtkImageData::GetData(&output, 0), state.frame, state.measures, trajectory.scene(),
             center);
  fill_history(*vtkTable::GetData(&output, 1), trajectory.history(), state.frame.time);
  fill_events(*vtkTable::GetData(&output, 2), trajectory.events(), state.frame.time, center);
  if (trajectory.failure() && time > trajectory.time())
    vtkErrorWithObjectMacro(self, << fmt::format("the run stopped at t = {:.6g}: {}",
                                                 trajectory.time(), *trajectory.failure()));
}

} // namespace lamella
