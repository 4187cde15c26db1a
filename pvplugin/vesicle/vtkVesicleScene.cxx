#include "vtkVesicleScene.h"

#include <vtkObjectFactory.h>
#include <vtkVesicleSceneReader.h>

vtkStandardNewMacro(vtkVesicleScene);

vtkVesicleScene::vtkVesicleScene() = default;
vtkVesicleScene::~vtkVesicleScene() = default;

vtkAlgorithm* vtkVesicleScene::GetRun()
{
  return this->Reader;
}

void vtkVesicleScene::SetFileName(const char* name)
{
  this->Reader->SetFileName(name);
  this->Modified();
}

const char* vtkVesicleScene::GetFileName()
{
  return this->Reader->GetFileName();
}

void vtkVesicleScene::AddOverride(const char* setting)
{
  this->Reader->AddOverride(setting);
  this->Modified();
}

void vtkVesicleScene::RemoveAllOverrides()
{
  this->Reader->RemoveAllOverrides();
  this->Modified();
}
