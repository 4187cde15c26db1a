#include "render/phases.h"

#include <vtkClipPolyData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace lamella::render {
namespace {

bool has_phases(vtkPolyData& mesh) { return mesh.GetPointData()->GetScalars() != nullptr; }

} // namespace

std::vector<Patch> patches(vtkPolyData& mesh) {
  if (!has_phases(mesh)) return {{Part::whole, &mesh}};
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(&mesh);
  clip->SetValue(0);
  clip->GenerateClippedOutputOn();
  clip->Update();
  std::vector<Patch> both{{Part::Ld, clip->GetClippedOutput()}, {Part::Lo, clip->GetOutput()}};
  std::erase_if(both, [](const Patch& patch) { return patch.mesh->GetNumberOfPolys() == 0; });
  return both;
}

} // namespace lamella::render
