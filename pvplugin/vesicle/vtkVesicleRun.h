/**
 * @class vtkVesicleRun
 * @brief a stored run as ParaView shows it
 *
 * Opens what `lamella run` leaves, also while the run goes on. Outputs are those of
 * vtkVesiclePipeline; time steps are those of the stored frames.
 *
 * @sa vtkVesicleRunReader
 */
#ifndef vtkVesicleRun_h
#define vtkVesicleRun_h

#include "vtkVesiclePipeline.h"

class vtkVesicleRunReader;

class VTKLAMELLAVESICLE_EXPORT vtkVesicleRun : public vtkVesiclePipeline
{
public:
  static vtkVesicleRun* New();
  vtkTypeMacro(vtkVesicleRun, vtkVesiclePipeline);

  ///@{
  /** The folder of a run, or any file in it. */
  void SetFileName(const char* name);
  const char* GetFileName();
  ///@}

  /** Whether a path is a run with frames: 1 or 0. */
  static int CanReadFile(const char* name);

protected:
  vtkVesicleRun();
  ~vtkVesicleRun() override;

  vtkAlgorithm* GetRun() override;

private:
  vtkVesicleRun(const vtkVesicleRun&) = delete;
  void operator=(const vtkVesicleRun&) = delete;

  vtkNew<vtkVesicleRunReader> Reader;
};

#endif
