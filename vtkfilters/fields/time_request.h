#pragma once
#include "fields/trajectory.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>

#include <vector>

namespace lamella {

/// Offers times (ascending) on all output ports.
void offer_times(vtkInformationVector& output, const std::vector<double>& times);

/// The time that the requesting port asks for; 0 where it asks for none.
double requested_time(vtkInformation& request, vtkInformationVector& output);

/// Tells the progress of an algorithm towards a time; false once it is aborted.
Trajectory::GoOn until_aborted(vtkAlgorithm* self, double time);

/// An error where a run ended by one before a time.
void report_failure(vtkAlgorithm* self, const Trajectory& trajectory, double time);

} // namespace lamella
