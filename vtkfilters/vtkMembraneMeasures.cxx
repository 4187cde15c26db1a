#include "vtkMembraneMeasures.h"

#include "energy/energy_terms.h"

#include "fields/image.h"
#include "fields/measure.h"
#include "fields/report.h"
#include "fields/update_round.h"

#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <utility>

vtkStandardNewMacro(vtkMembraneMeasures);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
using Row = std::vector<std::pair<const char*, double>>;

Row RowOf(const lamella::ShapeMeasures& m, double time, vtkDataObject& about)
{
  const auto known = [&](const char* name, double otherwise)
  { return lamella::field_value(about, name).value_or(otherwise); };
  Row row = { { "t", time }, { "energy", known("energy", m.bending_energy) },
    { "bending_energy", m.bending_energy }, { "int_KM2", m.int_KM2 }, { "P", known("P", m.P) },
    { "sigma", known("sigma", m.sigma) }, { "A", m.area }, { "V", m.volume },
    { "v", m.reduced_volume }, { "Da", m.area_difference },
    { "components", static_cast<double>(m.components) }, { "genus", static_cast<double>(m.genus) },
    { "neck_radius", m.neck_radius } };
  if (m.phases)
  {
    row.insert(row.end(),
      { { "A_Ld", m.phases->area_Ld }, { "A_Lo", m.phases->area_Lo },
        { "bending_Ld", m.phases->bending_energy_Ld },
        { "bending_Lo", m.phases->bending_energy_Lo }, { "line_length", m.phases->line_length } });
  }
  // What only the solver knows stands in the field data, where the scene has it.
  const auto add = [&](const char* name)
  {
    if (const auto energy = lamella::field_value(about, name))
    {
      row.emplace_back(name, *energy);
    }
  };
  for (const lamella::TermInfo& term : lamella::energy_term_table)
  {
    if (term.term != lamella::Term::bending)
    {
      add(term.column);
    }
  }
  add("line_energy");
  return row;
}

void Append(vtkTable& table, const Row& row)
{
  if (table.GetNumberOfColumns() == 0)
  {
    for (const auto& [name, value] : row)
    {
      vtkNew<vtkDoubleArray> column;
      column->SetName(name);
      table.AddColumn(column);
    }
  }
  else if (static_cast<std::size_t>(table.GetNumberOfColumns()) != row.size())
  {
    throw lamella::InputError(
      "phases, and terms of the energy, must be there at all times or at none");
  }
  vtkIdType index = 0;
  for (const auto& [name, value] : row)
  {
    vtkDoubleArray::SafeDownCast(table.GetColumn(index++))->InsertNextValue(value);
  }
}
}

vtkMembraneMeasures::vtkMembraneMeasures()
  : Unfinished(std::make_unique<lamella::Unfinished>())
{
}

vtkMembraneMeasures::~vtkMembraneMeasures() = default;

int vtkMembraneMeasures::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkMembraneMeasures::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkInformation* info = input[0]->GetInformationObject(0);
  this->Times.clear();
  if (info->Has(Pipeline::TIME_STEPS()))
  {
    const double* times = info->Get(Pipeline::TIME_STEPS());
    this->Times.assign(times, times + info->Length(Pipeline::TIME_STEPS()));
  }
  output->GetInformationObject(0)->Remove(Pipeline::TIME_STEPS());
  output->GetInformationObject(0)->Remove(Pipeline::TIME_RANGE());
  return 1;
}

int vtkMembraneMeasures::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector*)
{
  vtkInformation* info = input[0]->GetInformationObject(0);
  if (info->Has(Pipeline::WHOLE_EXTENT()))
  {
    info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  if (this->Next == 0)
  {
    this->AbortExecute = 0; // an abort was of the update that it stopped
  }
  if (this->Next < this->Times.size())
  {
    info->Set(Pipeline::UPDATE_TIME_STEP(), this->Times[this->Next]);
  }
  return 1;
}

/** One time of the input; the pipeline comes back for the next one. */
int vtkMembraneMeasures::RequestData(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (this->Next == 0)
  {
    this->Collected = vtkSmartPointer<vtkTable>::New();
  }
  bool goesOn = false, aborted = false;
  lamella::reporting(this,
    [&]
    {
      vtkImageData* image = vtkImageData::GetData(input[0]);
      const auto vesicle = lamella::vesicle_in(*image, { this->PhiArray });
      if (this->Next == 0)
      {
        lamella::remark(this, vesicle.remark);
      }
      const auto forces = lamella::forces_of(
        *image, vesicle.frame, { this->BendingModulus, this->SpontaneousCurvature });
      const auto measures = lamella::measure(vesicle.frame, forces);
      Append(*this->Collected, RowOf(measures, vesicle.frame.time, *image));
      this->UpdateProgress(
        static_cast<double>(this->Next + 1) / static_cast<double>(this->Times.size() + 1));
      const bool more = this->Next + 1 < this->Times.size();
      aborted = more && this->AbortExecute;
      goesOn = more && !aborted;
      vtkTable::GetData(output)->ShallowCopy(this->Collected);
    });
  this->Unfinished->set(aborted);
  if (goesOn)
  {
    ++this->Next;
    request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
  }
  else
  {
    this->Next = 0;
    this->Collected = nullptr;
    request->Remove(Pipeline::CONTINUE_EXECUTING());
  }
  return 1;
}

vtkMTimeType vtkMembraneMeasures::GetMTime()
{
  return this->Unfinished->modification_time(this->Superclass::GetMTime());
}

void vtkMembraneMeasures::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PhiArray: " << this->PhiArray << "\n";
  os << indent << "BendingModulus: " << this->BendingModulus << "\n";
  os << indent << "SpontaneousCurvature: " << this->SpontaneousCurvature << "\n";
}
