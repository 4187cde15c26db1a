#include "vtkVesicleFromImage.h"

#include "fields/image.h"
#include "fields/report.h"
#include "fields/serve.h"
#include "fields/start_image.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

vtkStandardNewMacro(vtkVesicleFromImage);

/** What is wrong with the image is said with the data. */
int vtkVesicleFromImage::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  try
  {
    const auto [grid, center] = lamella::announced_place(*input[0]->GetInformationObject(0));
    lamella::offer_grid(*output->GetInformationObject(0), grid, center);
  }
  catch (const lamella::InputError&)
  {
  }
  return 1;
}

/** The whole of the input. */
int vtkVesicleFromImage::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* info = input[0]->GetInformationObject(0);
  if (info->Has(Pipeline::WHOLE_EXTENT()))
  {
    info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  return 1;
}

int vtkVesicleFromImage::RequestData(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  return lamella::reporting(this,
    [&]
    {
      const auto [frame, center, remark] = lamella::vesicle_in(
        *vtkImageData::GetData(input[0]), { this->PhiArray, this->Label, this->FillCavities });
      lamella::remark(this, remark);
      lamella::offer_grid(*output->GetInformationObject(0), frame.grid,
        center); // masks may have needed more room than was announced
      lamella::fill_image(*vtkImageData::GetData(output), frame, center);
    });
}

void vtkVesicleFromImage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PhiArray: " << this->PhiArray << "\n";
  os << indent << "Label: " << this->Label << "\n";
  os << indent << "FillCavities: " << this->FillCavities << "\n";
}
