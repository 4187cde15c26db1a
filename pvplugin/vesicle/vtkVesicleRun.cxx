#include "vtkVesicleRun.h"

#include <vtkObjectFactory.h>
#include <vtkVesicleRunReader.h>

vtkStandardNewMacro(vtkVesicleRun);

vtkVesicleRun::vtkVesicleRun() = default;
vtkVesicleRun::~vtkVesicleRun() = default;

vtkAlgorithm* vtkVesicleRun::GetRun()
{
  return this->Reader;
}

int vtkVesicleRun::CanReadFile(const char* name)
{
  return vtkVesicleRunReader::CanReadFile(name);
}

void vtkVesicleRun::SetFileName(const char* name)
{
  this->Reader->SetFileName(name);
  this->Modified();
}

const char* vtkVesicleRun::GetFileName()
{
  return this->Reader->GetFileName();
}
