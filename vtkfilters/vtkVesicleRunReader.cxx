#include "vtkVesicleRunReader.h"

#include "fields/image.h"
#include "fields/report.h"
#include "fields/run_files.h"
#include "fields/serve.h"
#include "fields/state_data.h"
#include "scene/scene_toml.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkVesicleRunReader);

namespace
{
constexpr double Rounding = 1e-9; // relative, of times in tables of 12 digits

/** The last frame that is not later than a time, or the first. */
const lamella::SeriesEntry& FrameAt(const lamella::RunFiles& run, double time)
{
  const auto later = std::find_if(run.frames.begin(), run.frames.end(),
    [&](const lamella::SeriesEntry& entry) { return entry.time > time * (1 + Rounding); });
  return later == run.frames.begin() ? run.frames.front() : *std::prev(later);
}

/** The row of a history that is nearest to a time. */
const lamella::Measures& RowAt(const std::vector<lamella::Measures>& history, double time)
{
  return *std::min_element(history.begin(), history.end(),
    [&](const lamella::Measures& a, const lamella::Measures& b)
    { return std::abs(a.time - time) < std::abs(b.time - time); });
}
}

vtkVesicleRunReader::vtkVesicleRunReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(4);
}

int vtkVesicleRunReader::CanReadFile(const char* name)
{
  try
  {
    lamella::find_run_files(name ? name : "");
    return 1;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

int vtkVesicleRunReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkTable");
  return 1;
}

/** What is wrong with the run is said with the data. */
int vtkVesicleRunReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  lamella::offer_grid(*output->GetInformationObject(0), lamella::Scene().grid());
  lamella::withdraw_times(*output);
  try
  {
    const lamella::RunFiles run = lamella::find_run_files(this->FileName);
    std::vector<double> times;
    for (const lamella::SeriesEntry& entry : run.frames)
    {
      times.push_back(entry.time);
    }
    lamella::offer_times(*output, times);
    lamella::offer_grid(*output->GetInformationObject(0), lamella::read_scene(run.scene).grid());
  }
  catch (const std::exception&)
  {
  }
  return 1;
}

int vtkVesicleRunReader::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* output)
{
  return lamella::reporting(this,
    [&]
    {
      if (this->FileName.empty())
      {
        throw lamella::InputError("no FileName; the folder of a run is needed, or a file in it");
      }
      const lamella::RunFiles run = lamella::find_run_files(this->FileName);
      const auto history = lamella::read_history(run.history);
      if (history.empty())
      {
        throw lamella::InputError(run.history.string() + ": the history has no rows");
      }
      const lamella::Scene scene = lamella::read_scene(run.scene);
      const auto vesicles = lamella::read_components(run.components);
      const auto& [file, time] =
        FrameAt(run, lamella::valid_time(lamella::requested_time(*request, *output)));
      const lamella::Measures measures = RowAt(history, time);
      const auto now =
        std::ranges::count(vesicles, measures.time, &lamella::ComponentMeasures::time);
      lamella::fill_state(*vtkImageData::GetData(output, 0), lamella::read_frame(file), measures,
        scene, std::max(1, int(now)));
      lamella::fill_history(*vtkTable::GetData(output, 1), history);
      lamella::fill_events(*vtkTable::GetData(output, 2), lamella::read_events(run.events));
      lamella::fill_components(*vtkTable::GetData(output, 3), vesicles);
    });
}

void vtkVesicleRunReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
