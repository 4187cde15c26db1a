#include "fields/serve.h"

#include "fields/image.h"
#include "fields/state_data.h"

#include <vtkImageData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella {

using Pipeline = vtkStreamingDemandDrivenPipeline;

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

int requesting_port(vtkInformation& request) {
  return std::max(0, request.Get(Pipeline::FROM_OUTPUT_PORT()));
}

double requested_time(vtkInformation& request, vtkInformationVector& output) {
  vtkInformation* info = output.GetInformationObject(requesting_port(request));
  return info->Has(Pipeline::UPDATE_TIME_STEP()) ? info->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
}

double valid_time(double time) {
  if (std::isnan(time)) throw InputError("the time that is asked for is not a number");
  return time;
}

Trajectory::GoOn until_aborted(vtkAlgorithm* self, double time) {
  return [self, time, begin = std::optional<double>()](double now) mutable {
    if (!begin) begin = now;
    if (time > *begin) self->UpdateProgress(std::clamp((now - *begin) / (time - *begin), 0.0, 1.0));
    return !self->GetAbortExecute(); // after CheckAbort() VTK would empty the output
  };
}

vtkMTimeType parameters_time(vtkAlgorithm& self) {
  vtkMTimeType time = self.vtkObject::GetMTime(); // without that of an update that was aborted
  for (int port = 0; port < self.GetNumberOfInputPorts(); ++port)
    for (int index = 0; index < self.GetNumberOfInputConnections(port); ++index)
      time = std::max(time, self.GetInputDataObject(port, index)->GetMTime());
  return time;
}

void serve(vtkAlgorithm* self, Trajectory& trajectory, const Vec3& center,
           const TimeRequest& request, vtkInformationVector& output) {
  const std::size_t steps = trajectory.history().size();
  const State state = trajectory.at(request.time, request.go_on);
  if (trajectory.history().size() > steps) self->Modified();
  fill_state(*vtkImageData::GetData(&output, 0), state.frame, state.measures, trajectory.scene(),
             state.vesicles, center);
  fill_history(*vtkTable::GetData(&output, 1), trajectory.history());
  fill_events(*vtkTable::GetData(&output, 2), trajectory.events(), center);
  fill_components(*vtkTable::GetData(&output, 3), trajectory.components(), center);
  for (int port = 0; port < output.GetNumberOfInformationObjects(); ++port)
    vtkDataObject::GetData(&output, port)
        ->GetInformation()
        ->Set(vtkDataObject::DATA_TIME_STEP(), state.frame.time);
  if (request.begins && trajectory.failure() && request.time > trajectory.time())
    vtkErrorWithObjectMacro(self, << fmt::format("the run stopped at t = {:.6g}: {}",
                                                 trajectory.time(), *trajectory.failure()));
}

} // namespace lamella
