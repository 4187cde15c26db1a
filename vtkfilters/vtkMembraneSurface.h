/**
 * @class vtkMembraneSurface
 * @brief the membrane of a vesicle as triangles, with its curvatures
 *
 * Extracts {phi = 0} from a level set that is negative inside; phi need not be a distance. The
 * lattice around the membrane is first refined with polynomials of degree five, so that facets are
 * small; triangles are then those of vtkFlyingEdges3D. Their vertices are moved onto the membrane
 * that the solver works with, that of a spline of degree seven through phi, and curvatures are those
 * of the spline.
 *
 * The mesh is closed: every edge is shared by two triangles, wound around the outward normal. Its
 * area is less than the solver's, by less than 1e-3 of it with the automatic refinement.
 *
 * Input: vtkImageData, positive phi at all its sides; with a warning, also of different spacings along
 * x, y, z, which is resampled to the smallest, or a mask of two values, which is smoothed (docs/vtk.md).
 * Point data of one component each:
 * - phi (another name: SetPhiArray; an image's only array is taken whatever its name)
 * - psi, optional: phases, negative in Ld, positive in Lo
 * - c, optional: local stretch, the lipid per area over its rest value
 *
 * Field data, optional, as vtkVesicleDynamics and the readers attach it: `membrane.bending_modulus`
 * (energy) and `membrane.spontaneous_curvature` (1 / length), with phases those of `ld.` and `lo.`,
 * which take precedence over the properties of these names; `P`, `sigma` (with phases `sigma_Ld` and
 * `sigma_Lo`), `K_multiplier`: the multipliers of the state; with phases, local stretch or films what
 * else they depend on: `ld.gaussian_modulus`, `line.tension`, `contact.disjoining_pressure`, ...
 *
 * Output: vtkPolyData, triangles. Point data:
 * | array          | type, components | meaning, unit |
 * |----------------|------------------|---------------|
 * | Normals        | float, 3         | unit, outward |
 * | K_M            | double, 1        | sum of the principal curvatures, -2 on the unit sphere; 1 / length |
 * | K              | double, 1        | Gaussian curvature; 1 / length^2 |
 * | energy_density | double, 1        | bending_modulus / 2 (K_M - spontaneous_curvature)^2; energy / length^2 |
 * | velocity       | double, 3        | normal velocity; length / time; with the multipliers |
 * | psi            | double, 1        | where the input has it; then the scalars |
 * | phase          | unsigned char, 1 | 0 in Ld, 1 in Lo, where the input has psi |
 * | c              | double, 1        | where the input has it |
 *
 * `velocity` is that of all forces of the state: bending, the phase boundary, local stretch, films and
 * the constraints; of several domains that local stretch holds, each with a tension of its own, it has
 * their mean tension. Where several vesicles have pressures and tensions of their own (field data
 * `vesicles`, their number), there is none. Where there is more than bending it takes several times as long as the rest.
 *
 * T. Zhang, C. W. Wolgemuth, J. Comput. Phys. 450 (2022) 110815.
 *
 * @sa vtkPhaseBoundary vtkFlyingEdges3D
 */
#ifndef vtkMembraneSurface_h
#define vtkMembraneSurface_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkPolyDataAlgorithm.h>

#include <string>

class VTKLAMELLAFILTERS_EXPORT vtkMembraneSurface : public vtkPolyDataAlgorithm
{
public:
  static vtkMembraneSurface* New();
  vtkTypeMacro(vtkMembraneSurface, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Name of the level set's array. Default "phi". */
  vtkSetStdStringFromCharMacro(PhiArray);
  vtkGetCharFromStdStringMacro(PhiArray);
  ///@}

  ///@{
  /** Cells of the refined lattice along a cell of the input, 1 to 8. 0, the default: 2 to 4, as many as
   * keep the area of the triangles; without curvatures 2. */
  vtkSetClampMacro(Refinement, int, 0, 8);
  vtkGetMacro(Refinement, int);
  ///@}

  ///@{
  /** Whether to compute K_M, K, energy_density and velocity. Default on. Off, there is no spline
   * either: vertices lie on the edges of the lattice, where phi vanishes linearly between its nodes. */
  vtkSetMacro(ComputeCurvatures, bool);
  vtkGetMacro(ComputeCurvatures, bool);
  vtkBooleanMacro(ComputeCurvatures, bool);
  ///@}

  ///@{
  /** Bending modulus of the energy density, where the input does not tell it; energy. Default 1. */
  vtkSetMacro(BendingModulus, double);
  vtkGetMacro(BendingModulus, double);
  ///@}

  ///@{
  /** The same for the spontaneous curvature, in the sign of K_M; 1 / length. Default 0. */
  vtkSetMacro(SpontaneousCurvature, double);
  vtkGetMacro(SpontaneousCurvature, double);
  ///@}

protected:
  vtkMembraneSurface() = default;
  ~vtkMembraneSurface() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkMembraneSurface(const vtkMembraneSurface&) = delete;
  void operator=(const vtkMembraneSurface&) = delete;

  std::string PhiArray = "phi";
  int Refinement = 0;
  bool ComputeCurvatures = true;
  double BendingModulus = 1;
  double SpontaneousCurvature = 0;
};

#endif
