/**
 * @class vtkVesicle
 * @brief a vesicle from its parameters, as ParaView shows it
 *
 * Start shape, domains, elasticity, constraints: everything that a scene file can say
 * (docs/scene-format.md), with the same names, units and ranges. Outputs are those of
 * vtkVesiclePipeline; states are computed when they are looked at, and kept. What changes the result
 * starts the run anew, and nothing else does.
 *
 * @sa vtkVesicleScene vtkVesicleSource vtkVesicleDynamics
 */
#ifndef vtkVesicle_h
#define vtkVesicle_h

#include "vtkVesiclePipeline.h"

#include <memory>

class vtkVesicleSceneReader;

namespace lamella
{
struct PropertyScene;
}

class VTKLAMELLAVESICLE_EXPORT vtkVesicle : public vtkVesiclePipeline
{
public:
  static vtkVesicle* New();
  vtkTypeMacro(vtkVesicle, vtkVesiclePipeline);

  ///@{
  /** A parameter by its name in scene files, "section.key". One that the kind of shape, of domains or
   * of a constraint has no use for is ignored; a value that there is not is refused where the vesicle is computed. */
  void SetNumber(const char* key, double value);
  void SetVector(const char* key, double x, double y, double z);
  void SetText(const char* key, const char* value);
  ///@}

  ///@{
  /** [domains] directions. */
  void AddDomain(double x, double y, double z);
  void RemoveAllDomains();
  ///@}

  ///@{
  /** [volume] targets and start_times. */
  void AddVolumeTarget(double target, double start_time);
  void RemoveAllVolumeTargets();
  ///@}

  ///@{
  /** [area_difference] targets and start_times. */
  void AddAreaDifferenceTarget(double target, double start_time);
  void RemoveAllAreaDifferenceTargets();
  ///@}

protected:
  vtkVesicle();
  ~vtkVesicle() override;

  vtkAlgorithm* GetRun() override;
  void Prepare() override;

private:
  vtkVesicle(const vtkVesicle&) = delete;
  void operator=(const vtkVesicle&) = delete;

  std::unique_ptr<lamella::PropertyScene> Scene;
  vtkNew<vtkVesicleSceneReader> Reader;
};

#endif
