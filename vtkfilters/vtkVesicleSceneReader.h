/**
 * @class vtkVesicleSceneReader
 * @brief a scene file as a time-varying image, computed as it is looked at
 *
 * Opens a scene (.toml, docs/scene-format.md), or one of those that are built in, and gives its states
 * as vtkVesicleDynamics does: at the scene's stored times and any time between, computed when they
 * are asked for and kept. They are those that `lamella run` stores. A scene that starts from the end
 * of a built-in one runs that first; aborted on the way there, the outputs are empty.
 *
 * Output 0: vtkImageData with phi, psi and c; output 1: vtkTable, the history; output 2:
 * vtkTable, the events. Arrays, field data, progress, aborting and errors are those of
 * vtkVesicleDynamics, see there. A mistake in the scene is an error with file, line, key and what is
 * allowed; there are then no times.
 *
 * @sa vtkVesicleDynamics vtkVesicleRunReader
 */
#ifndef vtkVesicleSceneReader_h
#define vtkVesicleSceneReader_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkImageAlgorithm.h>

#include <memory>
#include <string>
#include <vector>

namespace lamella
{
struct Scene;
class UpdateRound;
}

class VTKLAMELLAFILTERS_EXPORT vtkVesicleSceneReader : public vtkImageAlgorithm
{
public:
  static vtkVesicleSceneReader* New();
  vtkTypeMacro(vtkVesicleSceneReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** A scene file, or the name of a built-in scene (`lamella scenes` lists them). */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /** A scene itself, as the text of such a file, in place of one; files that it names are looked for from
   * the current folder. Default empty. */
  vtkSetStdStringFromCharMacro(SceneText);
  vtkGetCharFromStdStringMacro(SceneText);
  ///@}

  ///@{
  /** "section.key=value", in place of what the file says, as `--set` of `lamella run`; the last one
   * wins. */
  void AddOverride(const char* setting);
  void RemoveAllOverrides();
  int GetNumberOfOverrides();
  ///@}

  /** Whether a file is a valid scene: 1 or 0. */
  static int CanReadFile(const char* name);

  /** Later than the last update for as long as that was aborted. */
  vtkMTimeType GetMTime() override;

protected:
  vtkVesicleSceneReader();
  ~vtkVesicleSceneReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesicleSceneReader(const vtkVesicleSceneReader&) = delete;
  void operator=(const vtkVesicleSceneReader&) = delete;

  class Run;
  lamella::Scene Open() const;

  std::string FileName;
  std::string SceneText;
  std::vector<std::string> Overrides;
  std::unique_ptr<Run> Current;
  std::unique_ptr<lamella::UpdateRound> Round;
};

#endif
