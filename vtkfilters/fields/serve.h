#pragma once
#include "fields/trajectory.h"

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

/// The time that the requesting port asks for; 0 where it asks for none.
double requested_time(vtkInformation& request, vtkInformationVector& output);

/// Tells the progress of an algorithm towards a time; false once it is aborted.
Trajectory::GoOn until_aborted(vtkAlgorithm* self, double time);

/// Fills the outputs of an algorithm over time: the image (port 0), the history (1) and the events
/// (2) of a scene whose box is around a centre, at the requested time. Where a run ended before by
/// an error, that is the algorithm's.
void serve(vtkAlgorithm* self, Trajectory& trajectory, const Vec3& center, vtkInformation& request,
           vtkInformationVector& output);

} // namespace lamella
