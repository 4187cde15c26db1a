/**
 * @class vtkPhaseBoundary
 * @brief the boundary of two phases on a membrane as closed lines, with its curvatures
 *
 * Traces {phi = psi = 0} on splines of degree seven through phi and psi: neither need be a
 * distance. Lengths of smooth boundaries are right to 1e-6 or better at 64^3. The splines are
 * periodic: where psi jumps from one side of the image to the other, keep ten nodes between that
 * and the membrane. Boundaries of less than half a spacing across may escape; one that cannot be
 * followed all the way around, as domains are about to merge, to part or to vanish, is left out with
 * a warning that says where.
 *
 * N points out of the vesicle, n along the membrane into Lo (psi > 0), t along the line; {n, t, N}
 * is right-handed, so that Ld lies to the left of t as seen from outside. On the unit sphere kn =
 * B_perp = -1; the circle of radius r around a cap of Ld has kg = -sqrt(1 - r^2) / r.
 *
 * Input: vtkImageData, positive phi at all its sides; with a warning, also of different spacings along
 * x, y, z, which is resampled to the smallest, or a mask of two values, which is smoothed (docs/vtk.md).
 * Point data of one component each:
 * - phi (another name: SetPhiArray), negative inside
 * - psi, negative in Ld, positive in Lo
 *
 * Output: vtkPolyData, a closed polyline a boundary: its points in the order of t, equally spaced,
 * half a spacing apart or less, and the first one again as the last. Empty where one phase has all
 * of the membrane. Point data:
 * | array      | type, components | meaning, unit |
 * |------------|------------------|---------------|
 * | Normals    | float, 3         | N |
 * | tangent    | double, 3        | t |
 * | kg         | double, 1        | geodesic curvature n.d_s t; 1 / length |
 * | kn         | double, 1        | normal curvature N.d_s t; 1 / length |
 * | tau_g      | double, 1        | geodesic torsion -n.d_s N; 1 / length |
 * | B_perp     | double, 1        | curvature of the membrane across the line, -n.d_n N; 1 / length |
 * | arc_length | double, 1        | from the first point of the line, where it is 0 although the line ends there too |
 *
 * Cell data:
 * | array      | type, components | meaning, unit |
 * |------------|------------------|---------------|
 * | length     | double, 1        | of each line; length |
 *
 * T. Zhang, C. W. Wolgemuth, J. Comput. Phys. 450 (2022) 110815, Section 4.
 *
 * @sa vtkMembraneSurface
 */
#ifndef vtkPhaseBoundary_h
#define vtkPhaseBoundary_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkPolyDataAlgorithm.h>

#include <string>

class VTKLAMELLAFILTERS_EXPORT vtkPhaseBoundary : public vtkPolyDataAlgorithm
{
public:
  static vtkPhaseBoundary* New();
  vtkTypeMacro(vtkPhaseBoundary, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Name of the level set's array. Default "phi". */
  vtkSetStdStringFromCharMacro(PhiArray);
  vtkGetCharFromStdStringMacro(PhiArray);
  ///@}

protected:
  vtkPhaseBoundary() = default;
  ~vtkPhaseBoundary() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkPhaseBoundary(const vtkPhaseBoundary&) = delete;
  void operator=(const vtkPhaseBoundary&) = delete;

  std::string PhiArray = "phi";
};

#endif
