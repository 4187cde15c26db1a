#pragma once
#include "fields/report.h"
#include "fields/trajectory.h"
#include "fields/update_round.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>

#include <vector>

namespace lamella {

/// Offers times (ascending) on all output ports.
void offer_times(vtkInformationVector& output, const std::vector<double>& times);

void withdraw_times(vtkInformationVector& output);

/// Tells of an image with its nodes on a grid around a centre.
void offer_grid(vtkInformation& output, const Grid& grid, const Vec3& center = {});

/// The port that makes a request, and the time that it asks for; 0 where it asks for none.
int requesting_port(vtkInformation& request);
double requested_time(vtkInformation& request, vtkInformationVector& output);

/// Throws InputError for a time that is no number.
double valid_time(double time);

/// Tells the progress of an algorithm towards a time; false once it is aborted.
Trajectory::GoOn until_aborted(vtkAlgorithm* self, double time);

/// A request for a state of an algorithm over time.
struct TimeRequest {
  double time;
  bool begins;            ///< a round of requests; what fails is said there
  Trajectory::GoOn go_on; ///< asked on the way to that time
};

/// Fills the outputs of an algorithm over time: the image (port 0), the history (1), the events (2)
/// and the vesicles where there are several (3) of a scene whose box is around a centre, at the
/// requested time or as far as it may go on towards it. Where a run ended before by an error, that
/// is the algorithm's. An algorithm whose history has grown is modified: what comes after it asks
/// for the tables again, whatever the time.
void serve(vtkAlgorithm* self, Trajectory& trajectory, const Vec3& center,
           const TimeRequest& request, vtkInformationVector& output);

/// The modification time of what an algorithm computes from: its parameters, its inputs.
vtkMTimeType parameters_time(vtkAlgorithm& self);

/// Answers a request in a round of them by `work`, which gets a TimeRequest. What it throws becomes
/// the algorithm's error, once a round.
template <class Work>
int answer(vtkAlgorithm* self, UpdateRound& round, vtkInformation& request,
           vtkInformationVector& output, Work&& work) {
  const double asked = requested_time(request, output);
  const bool begins = round.begins(requesting_port(request), asked, parameters_time(*self));
  if (!begins && round.failed()) return 1;
  const bool stays = !begins && round.aborted();
  bool failed = true;
  reporting(self, [&] {
    const auto nowhere = [](double) { return false; };
    const double time = valid_time(asked);
    work(TimeRequest{time, begins, stays ? nowhere : until_aborted(self, time)});
    failed = false;
  });
  round.ends(failed, stays || self->AbortExecute, parameters_time(*self));
  return 1;
}

} // namespace lamella
