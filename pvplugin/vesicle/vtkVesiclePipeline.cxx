#include "vtkVesiclePipeline.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMembraneSurface.h>
#include <vtkPhaseBoundary.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <algorithm>
#include <exception>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

enum Port
{
  MembranePort,
  BoundaryPort,
  HistoryPort,
  LevelSetPort,
  EventsPort,
  NumberOfPorts
};

constexpr std::chrono::milliseconds Slice{ 200 }; // of computing between two live pictures
constexpr double RunShare = 0.9;                  // of an update's progress

/** The time that a state has come to, which may be less than what was asked for. */
double TimeOf(vtkDataObject& data)
{
  vtkDataArray* time = data.GetFieldData()->GetArray("t");
  return time ? time->GetTuple1(0) : 0;
}

/** The time that the requesting port asks for; 0 where it asks for none. */
double RequestedTime(vtkInformation& request, vtkInformationVector& output)
{
  const int port = std::max(0, request.Get(Pipeline::FROM_OUTPUT_PORT()));
  vtkInformation* info = output.GetInformationObject(port);
  return info->Has(Pipeline::UPDATE_TIME_STEP()) ? info->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
}

bool IsFirstPiece(vtkInformation& request, vtkInformationVector& output)
{
  const int port = std::max(0, request.Get(Pipeline::FROM_OUTPUT_PORT()));
  vtkInformation* info = output.GetInformationObject(port);
  return !info->Has(Pipeline::UPDATE_PIECE_NUMBER()) ||
    info->Get(Pipeline::UPDATE_PIECE_NUMBER()) == 0;
}
}

vtkVesiclePipeline::vtkVesiclePipeline()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(NumberOfPorts);
}

vtkVesiclePipeline::~vtkVesiclePipeline() = default;

int vtkVesiclePipeline::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkPolyData", "vtkPolyData", "vtkTable", "vtkImageData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

bool vtkVesiclePipeline::GetNeedsUpdate()
{
  const bool more = this->Live && !this->Ended;
  if (more)
  {
    this->Modified();
  }
  return more;
}

/** What is wrong with the parameters is said with the data. */
int vtkVesiclePipeline::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  try
  {
    this->Prepare();
  }
  catch (const std::exception&)
  {
  }
  this->GetRun()->UpdateInformation();
  vtkInformation* run = this->GetRun()->GetOutputInformation(0);
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkInformation* info = output->GetInformationObject(port);
    info->Remove(Pipeline::TIME_STEPS());
    info->Remove(Pipeline::TIME_RANGE());
    if (!this->Live)
    {
      info->CopyEntry(run, Pipeline::TIME_STEPS());
      info->CopyEntry(run, Pipeline::TIME_RANGE());
    }
  }
  vtkInformation* image = output->GetInformationObject(LevelSetPort);
  image->CopyEntry(run, Pipeline::WHOLE_EXTENT());
  image->CopyEntry(run, vtkDataObject::ORIGIN());
  image->CopyEntry(run, vtkDataObject::SPACING());
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_DOUBLE, 1);
  return 1;
}

int vtkVesiclePipeline::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* output)
{
  if (!IsFirstPiece(*request, *output))
  {
    return 1;
  }
  try
  {
    this->Prepare();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 1;
  }
  if (this->Live)
  {
    this->UpdateRunForAWhile();
  }
  else
  {
    this->LastTime = -1;
    this->UpdateRun(RequestedTime(*request, *output));
  }
  vtkTable::GetData(output, HistoryPort)->ShallowCopy(this->GetRun()->GetOutputDataObject(1));
  vtkTable::GetData(output, EventsPort)->ShallowCopy(this->GetRun()->GetOutputDataObject(2));
  auto* image = vtkImageData::SafeDownCast(this->GetRun()->GetOutputDataObject(0));
  if (image->GetNumberOfPoints() > 0) // else the run has said what is wrong
  {
    this->Show(*image, *output);
  }
  return 1;
}

void vtkVesiclePipeline::UpdateRun(double time)
{
  vtkAlgorithm* run = this->GetRun();
  run->AbortExecuteOff();
  run->Modified(); // goes on where it was aborted
  const auto observer =
    run->AddObserver(vtkCommand::ProgressEvent, this, &vtkVesiclePipeline::OnProgress);
  run->UpdateTimeStep(time);
  run->RemoveObserver(observer);
}

void vtkVesiclePipeline::UpdateRunForAWhile()
{
  vtkInformation* info = this->GetRun()->GetOutputInformation(0);
  const double end = info->Has(Pipeline::TIME_RANGE()) ? info->Get(Pipeline::TIME_RANGE())[1] : 0;
  this->SliceEnd = Clock::now() + Slice;
  this->UpdateRun(end);
  const double time = TimeOf(*this->GetRun()->GetOutputDataObject(0));
  this->Ended = time >= end || time == this->LastTime;
  this->LastTime = time;
}

void vtkVesiclePipeline::OnProgress()
{
  vtkAlgorithm* run = this->GetRun();
  if (!this->Live)
  {
    this->UpdateProgress(RunShare * run->GetProgress());
  }
  if (this->GetAbortExecute() || (this->Live && Clock::now() > this->SliceEnd))
  {
    run->AbortExecuteOn();
  }
}

void vtkVesiclePipeline::Show(vtkImageData& image, vtkInformationVector& output)
{
  vtkNew<vtkImageData> input; // not the run's own, which would be asked for a time of its own
  input->ShallowCopy(&image);
  vtkImageData::GetData(&output, LevelSetPort)->ShallowCopy(input);

  this->Membrane->SetInputData(input);
  this->Membrane->Update();
  vtkPolyData* membrane = vtkPolyData::GetData(&output, MembranePort);
  membrane->ShallowCopy(this->Membrane->GetOutput());
  membrane->GetFieldData()->ShallowCopy(image.GetFieldData());

  if (image.GetPointData()->HasArray("psi"))
  {
    this->Boundary->SetInputData(input);
    this->Boundary->Update();
    vtkPolyData::GetData(&output, BoundaryPort)->ShallowCopy(this->Boundary->GetOutput());
  }
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkDataObject* data = vtkDataObject::GetData(&output, port);
    data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), TimeOf(image));
  }
}

void vtkVesiclePipeline::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Live: " << (this->Live ? "on" : "off") << "\n";
  this->GetRun()->PrintSelf(os, indent.GetNextIndent());
}
