/**
 * @class vtkVesicleFromSurface
 * @brief a closed surface of triangles as a level set, the start of a vesicle
 *
 * Takes any closed surface: a segmented cell, a drawing (STL, PLY, OBJ, VTP). It must be watertight
 * and must not cross itself; how its triangles are wound does not matter, and it may have several
 * parts, also within each other. Points within 1e-6 of the diagonal of its bounds are one point; edges
 * are divided where corners of other triangles lie on them. Triangles that are there more than once
 * count once, and parts that are too small for the grid are left out, with a warning. Holes, branches
 * and crossings are errors that tell how many there are and where, and what helps.
 *
 * The level set is the signed distance, blurred over Smoothing spacings, so that facets and sharp
 * edges become what a grid can carry. Each part keeps its volume. Away from the membrane the level set
 * levels off.
 *
 * Input: vtkPolyData, polygons or triangle strips.
 *
 * Output: vtkImageData around the origin. Point data:
 * | array | type, components | meaning |
 * |-------|------------------|---------|
 * | phi   | double, 1        | level set, negative inside, \|grad phi\| about 1 on the membrane; the scalars |
 *
 * @sa vtkVesicleDynamics vtkVesicleSource vtkFillHolesFilter
 */
#ifndef vtkVesicleFromSurface_h
#define vtkVesicleFromSurface_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkImageAlgorithm.h>

class VTKLAMELLAFILTERS_EXPORT vtkVesicleFromSurface : public vtkImageAlgorithm
{
public:
  static vtkVesicleFromSurface* New();
  vtkTypeMacro(vtkVesicleFromSurface, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** [grid] nodes: along x, y, z; multiples of 8 from 16 to 512. Default 64. */
  vtkSetVector3Macro(Nodes, int);
  vtkGetVector3Macro(Nodes, int);
  ///@}

  ///@{
  /** [grid] half_width: half the width of the box along its shortest axis; length. Default 1. */
  vtkSetMacro(HalfWidth, double);
  vtkGetMacro(HalfWidth, double);
  ///@}

  ///@{
  /** Whether to move the surface to the middle of the box and to scale it, its longest side to 0.7 of
   * the shortest of the box. Default off: it is taken where and as large as it is. */
  vtkSetMacro(ScaleToBox, bool);
  vtkGetMacro(ScaleToBox, bool);
  vtkBooleanMacro(ScaleToBox, bool);
  ///@}

  ///@{
  /** Standard deviation of the blur in grid spacings, 0 to 4. Default 1. */
  vtkSetClampMacro(Smoothing, double, 0, 4);
  vtkGetMacro(Smoothing, double);
  ///@}

protected:
  vtkVesicleFromSurface() = default;
  ~vtkVesicleFromSurface() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesicleFromSurface(const vtkVesicleFromSurface&) = delete;
  void operator=(const vtkVesicleFromSurface&) = delete;

  int Nodes[3] = { 64, 64, 64 };
  double HalfWidth = 1;
  bool ScaleToBox = false;
  double Smoothing = 1;
};

#endif
