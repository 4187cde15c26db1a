#include "vtkVesiclePipeline.h"

#include "fields/serve.h"

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

#include <fmt/format.h>

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
constexpr std::chrono::seconds Memory{ 5 }, LeastMemory{ 2 }; // of a live vesicle's pace
constexpr double RunShare = 0.9;                              // of an update's progress

/** The time that a state has come to, which may be less than what was asked for. */
double TimeOf(vtkDataObject& data)
{
  vtkDataArray* time = data.GetFieldData()->GetArray("t");
  return time ? time->GetTuple1(0) : 0;
}

vtkIdType Steps(vtkAlgorithm& run)
{
  return vtkTable::SafeDownCast(run.GetOutputDataObject(1))->GetNumberOfRows();
}

bool IsFirstPiece(vtkInformation& request, vtkInformationVector& output)
{
  vtkInformation* info = output.GetInformationObject(lamella::requesting_port(request));
  return !info->Has(Pipeline::UPDATE_PIECE_NUMBER()) ||
    info->Get(Pipeline::UPDATE_PIECE_NUMBER()) == 0;
}
}

vtkVesiclePipeline::vtkVesiclePipeline()
  : Round(std::make_unique<lamella::UpdateRound>())
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

int vtkVesiclePipeline::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  this->AbortExecute = 0; // an abort was of the update that it stopped
  return 1;
}

int vtkVesiclePipeline::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* output)
{
  if (!IsFirstPiece(*request, *output))
  {
    return 1;
  }
  return lamella::answer(this, *this->Round, *request, *output,
    [&](const lamella::TimeRequest& wanted)
    {
      if (wanted.begins)
      {
        this->Ended = true; // a live run, where it fails
        this->LiveState.clear();
        this->Prepare();
        this->Compute(wanted.time);
      }
      this->Fill(*output);
    });
}

vtkMTimeType vtkVesiclePipeline::GetMTime()
{
  return this->Round->modification_time(this->Superclass::GetMTime());
}

void vtkVesiclePipeline::Compute(double time)
{
  if (this->Live)
  {
    this->UpdateRunForAWhile();
  }
  else
  {
    this->UpdateRun(time);
  }
}

void vtkVesiclePipeline::UpdateRun(double time)
{
  vtkAlgorithm* run = this->GetRun();
  run->Modified(); // also where it has failed at that time before, and said so
  const auto observer =
    run->AddObserver(vtkCommand::ProgressEvent, this, &vtkVesiclePipeline::OnProgress);
  const vtkIdType steps = Steps(*run);
  run->UpdateTimeStep(time);
  run->RemoveObserver(observer);
  if (Steps(*run) != steps)
  {
    this->Modified(); // the history is another one, also for those that ask for no time
  }
}

/** A run that was not stopped has come to its end. */
void vtkVesiclePipeline::UpdateRunForAWhile()
{
  vtkInformation* info = this->GetRun()->GetOutputInformation(0);
  const double end = info->Has(Pipeline::TIME_RANGE()) ? info->Get(Pipeline::TIME_RANGE())[1] : 0;
  this->SliceEnd = Clock::now() + Slice;
  this->UpdateRun(end);
  this->Ended = this->AbortExecute || !this->GetRun()->GetAbortExecute();
  this->TellLiveState(end);
}

void vtkVesiclePipeline::TellLiveState(double end)
{
  const double time = TimeOf(*this->GetRun()->GetOutputDataObject(0));
  const auto now = Clock::now();
  if (!this->Lately.empty() && time < this->Lately.back().Time) // another run
  {
    this->Lately.clear();
  }
  this->Lately.push_back({ now, time });
  while (now - this->Lately.front().When > Memory)
  {
    this->Lately.pop_front();
  }
  this->LiveState = this->Ended
    ? fmt::format("ended at t = {:.4g} of {:.4g}", time, end)
    : fmt::format("t = {:.4g} of {:.4g}{}", time, end, this->TimeLeft(end));
}

/** At the pace of late; nothing where that is not known yet. */
std::string vtkVesiclePipeline::TimeLeft(double end) const
{
  const Milestone &first = this->Lately.front(), &last = this->Lately.back();
  if (last.Time <= first.Time || last.When - first.When < LeastMemory)
  {
    return "";
  }
  const std::chrono::duration<double> passed = last.When - first.When;
  const double seconds = passed.count() * (end - last.Time) / (last.Time - first.Time);
  return seconds < 90 ? fmt::format(", {:.0f} s left at this pace", seconds)
    : seconds < 5400  ? fmt::format(", {:.0f} min left at this pace", seconds / 60)
                      : fmt::format(", {:.0f} h left at this pace", seconds / 3600);
}

void vtkVesiclePipeline::OnProgress()
{
  vtkAlgorithm* run = this->GetRun();
  if (!this->Live)
  {
    this->UpdateProgress(RunShare * run->GetProgress());
  }
  const double progress = run->GetProgress();
  const bool goesOn = progress > 0 && progress < 1; // a step was made, and there is more to do
  if (this->AbortExecute || (this->Live && goesOn && Clock::now() > this->SliceEnd))
  {
    run->AbortExecuteOn();
  }
}

void vtkVesiclePipeline::Fill(vtkInformationVector& output)
{
  vtkTable::GetData(&output, HistoryPort)->ShallowCopy(this->GetRun()->GetOutputDataObject(1));
  vtkTable::GetData(&output, EventsPort)->ShallowCopy(this->GetRun()->GetOutputDataObject(2));
  auto* image = vtkImageData::SafeDownCast(this->GetRun()->GetOutputDataObject(0));
  if (image->GetNumberOfPoints() > 0) // else the run has said what is wrong
  {
    this->Show(*image, output);
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
