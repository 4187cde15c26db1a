/**
 * @class vtkVesicleScene
 * @brief a scene file, or a built-in scene, as ParaView shows it
 *
 * Outputs are those of vtkVesiclePipeline; states are computed when they are looked at, and kept.
 *
 * @sa vtkVesicleSceneReader vtkVesicle
 */
#ifndef vtkVesicleScene_h
#define vtkVesicleScene_h

#include "vtkVesiclePipeline.h"

class vtkVesicleSceneReader;

class VTKLAMELLAVESICLE_EXPORT vtkVesicleScene : public vtkVesiclePipeline
{
public:
  static vtkVesicleScene* New();
  vtkTypeMacro(vtkVesicleScene, vtkVesiclePipeline);

  ///@{
  /** A scene file, or the name of a built-in scene. */
  void SetFileName(const char* name);
  const char* GetFileName();
  ///@}

  ///@{
  /** "section.key=value", in place of what the file says; the last one wins. */
  void AddOverride(const char* setting);
  void RemoveAllOverrides();
  ///@}

protected:
  vtkVesicleScene();
  ~vtkVesicleScene() override;

  vtkAlgorithm* GetRun() override;

private:
  vtkVesicleScene(const vtkVesicleScene&) = delete;
  void operator=(const vtkVesicleScene&) = delete;

  vtkNew<vtkVesicleSceneReader> Reader;
};

#endif
