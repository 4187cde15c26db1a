/**
 * @class vtkVesicleRunReader
 * @brief a stored run as a time-varying image, with its history
 *
 * Opens the folder that `lamella run` leaves (docs/command-line.md), also while the run goes on or
 * after it was stopped. The time steps are those of the stored frames; asked for a time between two,
 * the output is the earlier frame.
 *
 * Output 0: vtkImageData with phi, psi and c as stored, and field data as of vtkVesicleDynamics: the
 * measures of the state and the parameters of the membrane.
 * Output 1: vtkTable, the whole history as stored, a row for the start and every step.
 * Output 2: vtkTable, all events, as of vtkVesicleDynamics.
 * Output 3: vtkTable, the vesicles where there are several, as of vtkVesicleDynamics.
 *
 * A file that is missing or damaged is an error that names it.
 *
 * @sa vtkVesicleSceneReader vtkMembraneSurface
 */
#ifndef vtkVesicleRunReader_h
#define vtkVesicleRunReader_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkImageAlgorithm.h>

#include <string>

class VTKLAMELLAFILTERS_EXPORT vtkVesicleRunReader : public vtkImageAlgorithm
{
public:
  static vtkVesicleRunReader* New();
  vtkTypeMacro(vtkVesicleRunReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The folder of a run, or any file in it. */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  /** Whether a path is a run with frames: 1 or 0. */
  static int CanReadFile(const char* name);

protected:
  vtkVesicleRunReader();
  ~vtkVesicleRunReader() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesicleRunReader(const vtkVesicleRunReader&) = delete;
  void operator=(const vtkVesicleRunReader&) = delete;

  std::string FileName;
};

#endif
