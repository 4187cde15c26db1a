/**
 * @class vtkVesicleSource
 * @brief a start shape, with domains of a second phase where wanted, as a level set
 *
 * The shapes and domains of scenes, with the names, units and ranges of the scene format
 * (docs/scene-format.md): what `lamella run` starts from. Properties that the kind of shape or of
 * domains has no use for are ignored. What cannot be resolved on the grid, or does not fit the box, is
 * refused with the reason.
 *
 * Output: vtkImageData around the origin, its nodes at the centres of cells. Point data:
 * | array | type, components | meaning |
 * |-------|------------------|---------|
 * | phi   | double, 1        | level set, negative inside, \|grad phi\| about 1 on the membrane; the scalars |
 * | psi   | double, 1        | with domains: about the signed distance from the phase boundary, negative in Ld |
 *
 * @sa vtkVesicleDynamics vtkMembraneSurface
 */
#ifndef vtkVesicleSource_h
#define vtkVesicleSource_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkImageAlgorithm.h>

#include <memory>

namespace lamella
{
struct PropertyScene;
}

class VTKLAMELLAFILTERS_EXPORT vtkVesicleSource : public vtkImageAlgorithm
{
public:
  static vtkVesicleSource* New();
  vtkTypeMacro(vtkVesicleSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** [grid] nodes: nodes along x, y, z, equally spaced; one number for a cube. An integer multiple
   * of 8 from 16 to 512. Default 64. */
  void SetNodes(int x, int y, int z);
  int* GetNodes() VTK_SIZEHINT(3);
  ///@}

  ///@{
  /** [grid] half_width: half the width, along its shortest axis, of the periodic box around the
   * origin. A number from 1e-12 to 1e+12; length. Default 1. */
  void SetHalfWidth(double value);
  double GetHalfWidth();
  ///@}

  ///@{
  /** [shape] kind: start shape; before rotation its axis of symmetry is z. "sphere", "oblate",
   * "prolate", "ellipsoid", "torus". Default "oblate". */
  void SetShapeKind(const char* value);
  const char* GetShapeKind();
  ///@}

  ///@{
  /** [shape] radius: sphere: radius. A number above 0 and up to 1e+30; length. Default 0.5. */
  void SetShapeRadius(double value);
  double GetShapeRadius();
  ///@}

  ///@{
  /** [shape] semi_axis: oblate, prolate: largest semi-axis. A number above 0 and up to 1e+30;
   * length. Default 0.7. */
  void SetShapeSemiAxis(double value);
  double GetShapeSemiAxis();
  ///@}

  ///@{
  /** [shape] reduced_volume: oblate, prolate: volume over that of the sphere with the same area;
   * sets the other semi-axis. A number from 0.01 and below 1. Default 0.6. */
  void SetShapeReducedVolume(double value);
  double GetShapeReducedVolume();
  ///@}

  ///@{
  /** [shape] semi_axes: ellipsoid: semi-axes along x, y, z. Three numbers [x, y, z] above 0 and up
   * to 1e+30; length. Default [0.7, 0.6, 0.5]. */
  void SetShapeSemiAxes(double x, double y, double z);
  double* GetShapeSemiAxes() VTK_SIZEHINT(3);
  ///@}

  ///@{
  /** [shape] ring_radius: torus: from the centre of the torus to the centre of its tube. A number
   * above 0 and up to 1e+30; length. Default 0.5. */
  void SetShapeRingRadius(double value);
  double GetShapeRingRadius();
  ///@}

  ///@{
  /** [shape] tube_radius: torus: radius of the tube. A number above 0 and up to 1e+30; length.
   * Default 0.2. */
  void SetShapeTubeRadius(double value);
  double GetShapeTubeRadius();
  ///@}

  ///@{
  /** [shape] center: sphere, oblate, prolate, ellipsoid, torus: centre of the shape. Three numbers
   * [x, y, z] from -1e+30 to 1e+30; length. Default [0, 0, 0]. */
  void SetShapeCenter(double x, double y, double z);
  double* GetShapeCenter() VTK_SIZEHINT(3);
  ///@}

  ///@{
  /** [shape] rotation_axis: sphere, oblate, prolate, ellipsoid, torus: axis through the centre
   * about which the shape is turned; any length but zero. Three numbers [x, y, z] from -1e+30 to
   * 1e+30. Default [0, 0, 1]. */
  void SetShapeRotationAxis(double x, double y, double z);
  double* GetShapeRotationAxis() VTK_SIZEHINT(3);
  ///@}

  ///@{
  /** [shape] rotation_angle: sphere, oblate, prolate, ellipsoid, torus: right-handed about
   * rotation_axis. A number from -360 to 360; degrees. Default 0. */
  void SetShapeRotationAngle(double value);
  double GetShapeRotationAngle();
  ///@}

  ///@{
  /** [perturbation] amplitude: bound of a smooth displacement of the start shape; 0: none. A number
   * from 0 to 1e+30; length. Default 0. */
  void SetPerturbationAmplitude(double value);
  double GetPerturbationAmplitude();
  ///@}

  ///@{
  /** [perturbation] wavelength: shortest of its waves, the longest is three times it; 0 stands for
   * a third of the shape's largest extent. A number from 0 to 1e+30; length. Default 0. */
  void SetPerturbationWavelength(double value);
  double GetPerturbationWavelength();
  ///@}

  ///@{
  /** [perturbation] seed: each number gives a displacement of its own, always the same. An integer
   * from 0 to 1000000000. Default 1. */
  void SetPerturbationSeed(int value);
  int GetPerturbationSeed();
  ///@}

  ///@{
  /** [perturbation] fold: number of arms about the shape's axis that it seeds; 0: none, random in
   * all directions. An integer from 0 to 12. Default 0. */
  void SetPerturbationFold(int value);
  int GetPerturbationFold();
  ///@}

  ///@{
  /** [domains] kind: where the membrane is Ld at the start, the rest of it being Lo; none: one
   * phase. "none", "cap", "caps". Default "none". */
  void SetDomainsKind(const char* value);
  const char* GetDomainsKind();
  ///@}

  ///@{
  /** [domains] area_fraction: cap: area of the cap over that of the whole membrane. A number above
   * 0 and below 1. Default 0.5. */
  void SetDomainsAreaFraction(double value);
  double GetDomainsAreaFraction();
  ///@}

  ///@{
  /** [domains] direction: cap: from the shape's centre to the middle of the cap; any length but
   * zero. Three numbers [x, y, z] from -1e+30 to 1e+30. Default [0, 0, 1]. */
  void SetDomainsDirection(double x, double y, double z);
  double* GetDomainsDirection() VTK_SIZEHINT(3);
  ///@}

  ///@{
  /** [domains] directions: caps: from the shape's centre to the middle of each cap. Three numbers
   * each, from -1e+30 to 1e+30. Default none. */
  void AddDomain(double x, double y, double z);
  void RemoveAllDomains();
  int GetNumberOfDomains();
  ///@}

  ///@{
  /** [domains] half_angle: caps: from the middle of a cap to its rim, seen from the shape's centre.
   * A number above 0 and below 180; degrees. Default 20. */
  void SetDomainsHalfAngle(double value);
  double GetDomainsHalfAngle();
  ///@}

  ///@{
  /** [domains] bulge: caps: on a sphere, from the plane of a cap's rim to its membrane: above
   * half_angle it bulges outward, below 0 inward; 0: flush with the sphere. A number from -90 to
   * 90; degrees. Default 0. */
  void SetDomainsBulge(double value);
  double GetDomainsBulge();
  ///@}

protected:
  vtkVesicleSource();
  ~vtkVesicleSource() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesicleSource(const vtkVesicleSource&) = delete;
  void operator=(const vtkVesicleSource&) = delete;

  std::unique_ptr<lamella::PropertyScene> Scene;
};

#endif
