#include "vtkVesicleSceneReader.h"

#include "fields/image.h"
#include "fields/report.h"
#include "fields/scene_start.h"
#include "fields/serve.h"
#include "scene/scene_toml.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

vtkStandardNewMacro(vtkVesicleSceneReader);

/** A run, and the scene as it was opened. */
class vtkVesicleSceneReader::Run
{
public:
  explicit Run(const lamella::Scene& scene)
    : Parameters(lamella::to_toml(scene))
    , Scene(scene)
  {
  }

  std::string Parameters;
  lamella::SceneRun Scene;
};

vtkVesicleSceneReader::vtkVesicleSceneReader()
  : Round(std::make_unique<lamella::UpdateRound>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(4);
}

vtkVesicleSceneReader::~vtkVesicleSceneReader() = default;

void vtkVesicleSceneReader::AddOverride(const char* setting)
{
  this->Overrides.emplace_back(setting ? setting : "");
  this->Modified();
}

void vtkVesicleSceneReader::RemoveAllOverrides()
{
  this->Overrides.clear();
  this->Modified();
}

int vtkVesicleSceneReader::GetNumberOfOverrides()
{
  return static_cast<int>(this->Overrides.size());
}

int vtkVesicleSceneReader::CanReadFile(const char* name)
{
  try
  {
    lamella::open_scene(name ? name : "", {});
    return 1;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

int vtkVesicleSceneReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkTable");
  return 1;
}

lamella::Scene vtkVesicleSceneReader::Open() const
{
  if (!this->SceneText.empty())
  {
    return lamella::scene_of_text(this->SceneText, this->Overrides);
  }
  if (this->FileName.empty())
  {
    throw lamella::InputError("no FileName; a scene file (.toml) is needed, or the name of a "
                              "built-in scene");
  }
  return lamella::open_scene(this->FileName, this->Overrides);
}

/** What is wrong with the scene is said with the data. */
int vtkVesicleSceneReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  lamella::offer_grid(*output->GetInformationObject(0), lamella::Scene().grid());
  lamella::withdraw_times(*output);
  try
  {
    const lamella::Scene scene = this->Open();
    lamella::offer_grid(*output->GetInformationObject(0), scene.grid());
    lamella::offer_times(*output, lamella::stored_times(scene));
  }
  catch (const std::exception&)
  {
  }
  return 1;
}

int vtkVesicleSceneReader::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  this->AbortExecute = 0; // an abort was of the update that it stopped
  return 1;
}

int vtkVesicleSceneReader::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* output)
{
  return lamella::answer(this, *this->Round, *request, *output,
    [&](const lamella::TimeRequest& wanted)
    {
      const lamella::Scene scene = this->Open();
      if (!this->Current || this->Current->Parameters != lamella::to_toml(scene))
      {
        this->Current = std::make_unique<Run>(scene);
      }
      lamella::Trajectory* trajectory = this->Current->Scene.begin(
        wanted.begins ? lamella::until_aborted(this, scene.end()) : wanted.go_on);
      if (trajectory)
      {
        lamella::serve(this, *trajectory, {}, wanted, *output);
      }
    });
}

vtkMTimeType vtkVesicleSceneReader::GetMTime()
{
  return this->Round->modification_time(this->Superclass::GetMTime());
}

void vtkVesicleSceneReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "SceneText: " << this->SceneText << "\n";
  for (const std::string& setting : this->Overrides)
  {
    os << indent << "Override: " << setting << "\n";
  }
}
