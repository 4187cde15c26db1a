/**
 * @class vtkVesicleFromImage
 * @brief a mask, labels or a level set as people have them, made a level set: the start of a vesicle
 *
 * The other filters take masks and level sets as they are, with what this one does by default. It
 * also takes one label of several, or the other side of a mask that is inverted, and fills masks of
 * which only the membrane is marked.
 *
 * Input: vtkImageData, point or cell data of one component and any type. Its axes are x, y and z, in
 * any order and sign; the spacings may differ, and are resampled to the smallest.
 * - A level set is negative inside and positive at all sides.
 * - A mask has two values; inside is where it is negative, or else where it is larger. It may reach the
 *   sides. Its edge is smoothed over two voxels, and each part keeps its volume; parts and cavities
 *   too small for that are left out. Warnings say what is done.
 * - Labels are whole numbers, 0 or more; Label is one of them.
 *
 * Output: vtkImageData. Point data:
 * | array | type, components | meaning |
 * |-------|------------------|---------|
 * | phi   | double, 1        | level set, negative inside; the scalars |
 * | psi, c | double, 1       | where the input has them |
 *
 * @sa vtkVesicleDynamics vtkVesicleFromSurface vtkImageThreshold
 */
#ifndef vtkVesicleFromImage_h
#define vtkVesicleFromImage_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkImageAlgorithm.h>

#include <string>

class VTKLAMELLAFILTERS_EXPORT vtkVesicleFromImage : public vtkImageAlgorithm
{
public:
  static vtkVesicleFromImage* New();
  vtkTypeMacro(vtkVesicleFromImage, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Name of the array; an image's only array is taken whatever its name. Default "phi". */
  vtkSetStdStringFromCharMacro(PhiArray);
  vtkGetCharFromStdStringMacro(PhiArray);
  ///@}

  ///@{
  /** The label of what is inside, 0 or more; all other voxels are outside. Default -1: none is chosen,
   * and the image is a mask or a level set. */
  vtkSetMacro(Label, int);
  vtkGetMacro(Label, int);
  ///@}

  ///@{
  /** Whether all that a mask or label encloses is inside too: for masks of which only the membrane is
   * marked. Default off: cavities are outside, with a membrane of their own. */
  vtkSetMacro(FillCavities, bool);
  vtkGetMacro(FillCavities, bool);
  vtkBooleanMacro(FillCavities, bool);
  ///@}

protected:
  vtkVesicleFromImage() = default;
  ~vtkVesicleFromImage() override = default;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesicleFromImage(const vtkVesicleFromImage&) = delete;
  void operator=(const vtkVesicleFromImage&) = delete;

  std::string PhiArray = "phi";
  int Label = -1;
  bool FillCavities = false;
};

#endif
