#include "vtkVesicleDynamics.h"

#include "fields/report.h"
#include "fields/scene_properties.h"
#include "fields/serve.h"
#include "fields/start_image.h"
#include "fields/trajectory.h"
#include "scene/scene_toml.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <array>
#include <sstream>

vtkStandardNewMacro(vtkVesicleDynamics);

namespace
{
constexpr std::array<std::string_view, 15> Sections = { "membrane", "domains", "ld", "lo", "line",
  "parameters", "stretch", "volume", "area", "area_difference", "contact", "run", "stop",
  "numerics", "output" };

lamella::Trajectory Begin(const lamella::Scene& scene, lamella::Frame start)
{
  lamella::validate(scene);
  start.grid = scene.grid(); // to the last bit
  return { scene, lamella::start_of(scene, std::move(start)) };
}
}

/** A run, and what it was made from. */
class vtkVesicleDynamics::Run
{
public:
  Run(const lamella::Scene& scene, const lamella::ImageVesicle& vesicle, vtkMTimeType inputTime,
    const std::string& phiArray)
    : InputTime(inputTime)
    , PhiArray(phiArray)
    , Center(vesicle.center)
    , Trajectory(Begin(
        lamella::with_start(scene, vesicle.frame.grid, vesicle.frame.has("psi")), vesicle.frame))
  {
  }

  /** Whether these would make the same run. */
  bool IsOf(lamella::Scene scene, vtkMTimeType inputTime, const std::string& phiArray) const
  {
    const lamella::Scene& own = this->Trajectory.scene();
    scene.nodes = own.nodes; // the start is that of the input
    scene.half_width = own.half_width;
    scene.shape = own.shape;
    scene.domains = own.domains;
    return this->InputTime == inputTime && this->PhiArray == phiArray &&
      lamella::to_toml(scene) == lamella::to_toml(own); // what counts
  }

  lamella::Grid Grid() const { return this->Trajectory.scene().grid(); }

  vtkMTimeType InputTime;
  std::string PhiArray;
  lamella::Vec3 Center;
  lamella::Trajectory Trajectory;
};

lamellaProperty(vtkVesicleDynamics, BendingModulus, double, membrane.bending_modulus);
lamellaProperty(vtkVesicleDynamics, SpontaneousCurvature, double, membrane.spontaneous_curvature);
lamellaProperty(vtkVesicleDynamics, GaussianModulus, double, membrane.gaussian_modulus);
lamellaProperty(vtkVesicleDynamics, LinearModulus, double, membrane.linear_modulus);
lamellaProperty(vtkVesicleDynamics, CubicModulus, double, membrane.cubic_modulus);
lamellaProperty(vtkVesicleDynamics, MixedCubicModulus, double, membrane.mixed_cubic_modulus);
lamellaProperty(vtkVesicleDynamics, QuarticModulus, double, membrane.quartic_modulus);
lamellaProperty(vtkVesicleDynamics, MixedQuarticModulus, double, membrane.mixed_quartic_modulus);
lamellaProperty(
  vtkVesicleDynamics, GaussianSquareModulus, double, membrane.gaussian_square_modulus);
lamellaProperty(vtkVesicleDynamics, GradientModulus, double, membrane.gradient_modulus);
lamellaTextProperty(vtkVesicleDynamics, Density, membrane.density);
lamellaProperty(vtkVesicleDynamics, LdBendingModulus, double, ld.bending_modulus);
lamellaProperty(vtkVesicleDynamics, LdSpontaneousCurvature, double, ld.spontaneous_curvature);
lamellaProperty(vtkVesicleDynamics, LdGaussianModulus, double, ld.gaussian_modulus);
lamellaProperty(vtkVesicleDynamics, LdLinearModulus, double, ld.linear_modulus);
lamellaProperty(vtkVesicleDynamics, LdCubicModulus, double, ld.cubic_modulus);
lamellaProperty(vtkVesicleDynamics, LdMixedCubicModulus, double, ld.mixed_cubic_modulus);
lamellaProperty(vtkVesicleDynamics, LdQuarticModulus, double, ld.quartic_modulus);
lamellaProperty(vtkVesicleDynamics, LdMixedQuarticModulus, double, ld.mixed_quartic_modulus);
lamellaProperty(vtkVesicleDynamics, LdGaussianSquareModulus, double, ld.gaussian_square_modulus);
lamellaProperty(vtkVesicleDynamics, LdGradientModulus, double, ld.gradient_modulus);
lamellaTextProperty(vtkVesicleDynamics, LdDensity, ld.density);
lamellaProperty(vtkVesicleDynamics, LoBendingModulus, double, lo.bending_modulus);
lamellaProperty(vtkVesicleDynamics, LoSpontaneousCurvature, double, lo.spontaneous_curvature);
lamellaProperty(vtkVesicleDynamics, LoGaussianModulus, double, lo.gaussian_modulus);
lamellaProperty(vtkVesicleDynamics, LoLinearModulus, double, lo.linear_modulus);
lamellaProperty(vtkVesicleDynamics, LoCubicModulus, double, lo.cubic_modulus);
lamellaProperty(vtkVesicleDynamics, LoMixedCubicModulus, double, lo.mixed_cubic_modulus);
lamellaProperty(vtkVesicleDynamics, LoQuarticModulus, double, lo.quartic_modulus);
lamellaProperty(vtkVesicleDynamics, LoMixedQuarticModulus, double, lo.mixed_quartic_modulus);
lamellaProperty(vtkVesicleDynamics, LoGaussianSquareModulus, double, lo.gaussian_square_modulus);
lamellaProperty(vtkVesicleDynamics, LoGradientModulus, double, lo.gradient_modulus);
lamellaTextProperty(vtkVesicleDynamics, LoDensity, lo.density);
lamellaProperty(vtkVesicleDynamics, DomainsCurvatureStartTime, double, curvature_start_time);
lamellaProperty(vtkVesicleDynamics, LineTension, double, line.tension);
lamellaProperty(vtkVesicleDynamics, LineGeodesicModulus, double, line.geodesic_modulus);
lamellaProperty(vtkVesicleDynamics, LineTorsionModulus, double, line.torsion_modulus);
lamellaProperty(vtkVesicleDynamics, LineNormalModulus, double, line.normal_modulus);
lamellaProperty(
  vtkVesicleDynamics, LineGeodesicSquareModulus, double, line.geodesic_square_modulus);
lamellaProperty(vtkVesicleDynamics, LineTorsionSquareModulus, double, line.torsion_square_modulus);
lamellaProperty(vtkVesicleDynamics, LineNormalSquareModulus, double, line.normal_square_modulus);
lamellaProperty(vtkVesicleDynamics, LinePerpendicularModulus, double, line.perpendicular_modulus);
lamellaProperty(vtkVesicleDynamics, LineDrag, double, line.drag);
lamellaTextProperty(vtkVesicleDynamics, LineDensity, line.density);
lamellaProperty(vtkVesicleDynamics, StretchModulus, double, stretch.modulus);
lamellaChoiceProperty(vtkVesicleDynamics, VolumeConstraint, "volume", "constraint");
lamellaRampProperty(vtkVesicleDynamics, Volume, volume.ramp);
lamellaProperty(vtkVesicleDynamics, VolumeRate, double, volume.ramp.rate);
lamellaProperty(vtkVesicleDynamics, VolumePressure, double, volume.pressure);
lamellaChoiceProperty(vtkVesicleDynamics, VolumeOf, "volume", "of");
lamellaChoiceProperty(vtkVesicleDynamics, AreaOf, "area", "of");
lamellaChoiceProperty(
  vtkVesicleDynamics, AreaDifferenceConstraint, "area_difference", "constraint");
lamellaRampProperty(vtkVesicleDynamics, AreaDifference, area_difference.ramp);
lamellaProperty(vtkVesicleDynamics, AreaDifferenceRate, double, area_difference.ramp.rate);
lamellaProperty(vtkVesicleDynamics, AreaDifferenceMultiplier, double, area_difference.multiplier);
lamellaProperty(vtkVesicleDynamics, ContactTopologyChanges, bool, contact.topology_changes);
lamellaProperty(vtkVesicleDynamics, ContactDisjoiningPressure, double, contact.disjoining_pressure);
lamellaProperty(vtkVesicleDynamics, ContactDisjoiningRange, double, contact.disjoining_range);
lamellaProperty(vtkVesicleDynamics, ContactRuptureThickness, double, contact.rupture_thickness);
lamellaProperty(vtkVesicleDynamics, EndTime, double, end_time);
lamellaProperty(vtkVesicleDynamics, StopEnergyRate, double, stop.energy_rate);
lamellaProperty(vtkVesicleDynamics, StopResidualForce, double, stop.residual_force);
lamellaProperty(vtkVesicleDynamics, StopTopologyChanges, int, stop.topology_changes);
lamellaProperty(vtkVesicleDynamics, StopWallTime, double, stop.wall_time);
lamellaProperty(vtkVesicleDynamics, Tolerance, double, numerics.tolerance);
lamellaProperty(vtkVesicleDynamics, MaxTimeStep, double, numerics.max_time_step);
lamellaProperty(vtkVesicleDynamics, OutputFrames, int, output.frames);

void vtkVesicleDynamics::SetParameters(const char* value)
{
  if (lamella::set_parameters(*this->Scene, value ? value : ""))
    this->Modified();
}

const char* vtkVesicleDynamics::GetParameters()
{
  return this->Scene->parameters_text.c_str();
}

void vtkVesicleDynamics::SetFields(const char* value)
{
  if (lamella::set_fields(*this->Scene, value ? value : ""))
    this->Modified();
}

const char* vtkVesicleDynamics::GetFields()
{
  return this->Scene->fields_text.c_str();
}

vtkVesicleDynamics::vtkVesicleDynamics()
  : Scene(std::make_unique<lamella::PropertyScene>())
  , Round(std::make_unique<lamella::UpdateRound>())
{
  this->SetNumberOfOutputPorts(4);
}

vtkVesicleDynamics::~vtkVesicleDynamics() = default;

int vtkVesicleDynamics::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkTable");
  return 1;
}

/** What is wrong with the image, or the parameters, is said with the data. */
int vtkVesicleDynamics::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  lamella::offer_times(*output, lamella::stored_times(*this->Scene));
  try
  {
    const auto [grid, center] =
      lamella::solver_place(lamella::announced_place(*input[0]->GetInformationObject(0)));
    lamella::offer_grid(*output->GetInformationObject(0), grid, center);
  }
  catch (const lamella::InputError&)
  {
  }
  return 1;
}

/** The whole of the input, at its first time. */
int vtkVesicleDynamics::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  this->AbortExecute = 0; // an abort was of the update that it stopped
  vtkInformation* info = input[0]->GetInformationObject(0);
  if (info->Has(Pipeline::WHOLE_EXTENT()))
  {
    info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  if (info->Has(Pipeline::TIME_STEPS()))
  {
    info->Set(Pipeline::UPDATE_TIME_STEP(), info->Get(Pipeline::TIME_STEPS())[0]);
  }
  else
  {
    info->Remove(Pipeline::UPDATE_TIME_STEP());
  }
  return 1;
}

void vtkVesicleDynamics::BeginRunIfNeeded(vtkImageData& image)
{
  const vtkMTimeType time = image.GetMTime();
  if (this->Current && this->Current->IsOf(*this->Scene, time, this->PhiArray))
  {
    return;
  }
  this->Current.reset();
  const auto vesicle = lamella::start_of(lamella::vesicle_in(image, { this->PhiArray }));
  lamella::remark(this, vesicle.remark);
  this->Current = std::make_unique<Run>(*this->Scene, vesicle, time, this->PhiArray);
}

int vtkVesicleDynamics::RequestData(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  return lamella::answer(this, *this->Round, *request, *output,
    [&](const lamella::TimeRequest& wanted)
    {
      lamella::check_choices(*this->Scene);
      this->BeginRunIfNeeded(*vtkImageData::GetData(input[0]));
      lamella::offer_grid(*output->GetInformationObject(0), this->Current->Grid(),
        this->Current->Center); // masks may have needed more room than was announced
      lamella::serve(this, this->Current->Trajectory, this->Current->Center, wanted, *output);
    });
}

vtkMTimeType vtkVesicleDynamics::GetMTime()
{
  return this->Round->modification_time(this->Superclass::GetMTime());
}

void vtkVesicleDynamics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PhiArray: " << this->PhiArray << "\n";
  std::ostringstream margin;
  margin << indent;
  lamella::print_sections(os, margin.str(), *this->Scene, Sections);
}
