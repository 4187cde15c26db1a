// A vesicle relaxes in a pipeline: prints the area of its membrane and the largest energy density.
#include <vtkMassProperties.h>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkVesicleDynamics.h>
#include <vtkVesicleSource.h>

#include <iostream>

int main() {
  vtkNew<vtkVesicleSource> source;
  source->SetNodes(32, 32, 32);
  source->SetShapeKind("prolate");
  source->SetShapeReducedVolume(0.8);

  vtkNew<vtkVesicleDynamics> dynamics;
  dynamics->SetInputConnection(source->GetOutputPort());
  dynamics->SetEndTime(2e-4);

  vtkNew<vtkMembraneSurface> surface;
  surface->SetInputConnection(dynamics->GetOutputPort());
  vtkNew<vtkMassProperties> properties;
  properties->SetInputConnection(surface->GetOutputPort());

  for (const double time : {0.0, 1e-4, 2e-4}) {
    surface->UpdateTimeStep(time);
    properties->Update();
    double range[2];
    surface->GetOutput()->GetPointData()->GetArray("energy_density")->GetRange(range);
    std::cout << "t = " << time << ": area " << properties->GetSurfaceArea()
              << ", energy density up to " << range[1] << "\n";
  }
}
