#include "vtkVesicleSource.h"

#include "dynamics/start.h"
#include "fields/image.h"
#include "fields/report.h"
#include "fields/scene_properties.h"
#include "fields/serve.h"

#include <vtkImageData.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>

#include <array>
#include <sstream>

vtkStandardNewMacro(vtkVesicleSource);

namespace
{
constexpr std::array<std::string_view, 4> SceneSections = { "grid", "shape", "perturbation",
  "domains" };
}

lamellaVectorProperty(vtkVesicleSource, Nodes, int, nodes);
lamellaProperty(vtkVesicleSource, HalfWidth, double, half_width);
lamellaChoiceProperty(vtkVesicleSource, ShapeKind, "shape", "kind");
lamellaProperty(vtkVesicleSource, ShapeRadius, double, shape.radius);
lamellaProperty(vtkVesicleSource, ShapeSemiAxis, double, shape.semi_axis);
lamellaProperty(vtkVesicleSource, ShapeReducedVolume, double, shape.reduced_volume);
lamellaVectorProperty(vtkVesicleSource, ShapeSemiAxes, double, shape.semi_axes);
lamellaProperty(vtkVesicleSource, ShapeRingRadius, double, shape.ring_radius);
lamellaProperty(vtkVesicleSource, ShapeTubeRadius, double, shape.tube_radius);
lamellaVectorProperty(vtkVesicleSource, ShapeCenter, double, shape.center);
lamellaVectorProperty(vtkVesicleSource, ShapeRotationAxis, double, shape.rotation_axis);
lamellaProperty(vtkVesicleSource, ShapeRotationAngle, double, shape.rotation_angle);
lamellaProperty(vtkVesicleSource, PerturbationAmplitude, double, perturbation.amplitude);
lamellaProperty(vtkVesicleSource, PerturbationWavelength, double, perturbation.wavelength);
lamellaProperty(vtkVesicleSource, PerturbationSeed, int, perturbation.seed);
lamellaProperty(vtkVesicleSource, PerturbationFold, int, perturbation.fold);
lamellaChoiceProperty(vtkVesicleSource, DomainsKind, "domains", "kind");
lamellaProperty(vtkVesicleSource, DomainsAreaFraction, double, domains.area_fraction);
lamellaVectorProperty(vtkVesicleSource, DomainsDirection, double, domains.direction);
lamellaProperty(vtkVesicleSource, DomainsHalfAngle, double, domains.half_angle);
lamellaProperty(vtkVesicleSource, DomainsBulge, double, domains.bulge);

void vtkVesicleSource::AddDomain(double x, double y, double z)
{
  this->Scene->domains.directions.push_back({ x, y, z });
  this->Modified();
}

void vtkVesicleSource::RemoveAllDomains()
{
  this->Scene->domains.directions.clear();
  this->Modified();
}

int vtkVesicleSource::GetNumberOfDomains()
{
  return static_cast<int>(this->Scene->domains.directions.size());
}

vtkVesicleSource::vtkVesicleSource()
  : Scene(std::make_unique<lamella::PropertyScene>())
{
  this->SetNumberOfInputPorts(0);
}

vtkVesicleSource::~vtkVesicleSource() = default;

int vtkVesicleSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  // Nonsense is refused with the data.
  lamella::offer_grid(*output->GetInformationObject(0), this->Scene->grid());
  return 1;
}

int vtkVesicleSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  return lamella::reporting(this,
    [&]
    {
      lamella::check_choices(*this->Scene);
      if (this->Scene->shape.kind == lamella::ShapeKind::frame ||
        this->Scene->domains.kind == lamella::DomainsKind::frame)
      {
        throw lamella::InputError("stored frames are opened by vtkVesicleRunReader, not here");
      }
      lamella::Scene scene = *this->Scene;
      scene.volume.constraint = lamella::Constraint::free; // whatever is then made of the start
      lamella::validate(scene);
      lamella::Start start = lamella::start_of(*this->Scene);
      lamella::fill_image(*vtkImageData::GetData(output),
        { .grid = this->Scene->grid(),
          .phi = std::move(start.phi),
          .fields = std::move(start.fields) });
    });
}

void vtkVesicleSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  std::ostringstream margin;
  margin << indent;
  lamella::print_sections(os, margin.str(), *this->Scene, SceneSections);
}
