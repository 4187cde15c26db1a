/**
 * @class vtkVesiclePipeline
 * @brief what there is to see of a vesicle over time, from one source
 *
 * Runs an algorithm that gives a vesicle over time, vtkVesicleSceneReader or vtkVesicleRunReader, and
 * the filters that show it.
 *
 * | output           | type         | content |
 * |------------------|--------------|---------|
 * | 0 membrane       | vtkPolyData  | triangles, as of vtkMembraneSurface |
 * | 1 phase boundary | vtkPolyData  | lines, as of vtkPhaseBoundary; empty with one phase |
 * | 2 history        | vtkTable     | a row for each step that was computed, or stored |
 * | 3 level set      | vtkImageData | phi, psi, c |
 * | 4 events         | vtkTable     | a row for each event until then |
 *
 * Field data of outputs 0 and 3 are the measures of the state. Progress is that towards the time asked
 * for; aborted, the outputs are those of the time reached, and the next update goes on from there. All
 * of it is on the first of several pieces.
 *
 * @sa vtkVesicle vtkVesicleScene vtkVesicleRun
 */
#ifndef vtkVesiclePipeline_h
#define vtkVesiclePipeline_h

#include "vtkLamellaVesicleModule.h" // for the export macro

#include <vtkNew.h> // for the filters
#include <vtkPolyDataAlgorithm.h>

#include <chrono>
#include <deque>
#include <memory>
#include <string>

namespace lamella
{
class UpdateRound;
}

class vtkImageData;
class vtkMembraneSurface;
class vtkPhaseBoundary;

class VTKLAMELLAVESICLE_EXPORT vtkVesiclePipeline : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkVesiclePipeline, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Whether the vesicle is shown while it is computed: there are no time steps then; each update
   * computes for a fraction of a second and shows the state that it has come to. Aborted, it stays there
   * until something is changed. Default off. */
  vtkSetMacro(Live, bool);
  vtkGetMacro(Live, bool);
  vtkBooleanMacro(Live, bool);
  ///@}

  /** Whether another update would show something later: for ParaView's live sources. */
  bool GetNeedsUpdate();

  /** How far a live vesicle has come, and how long it takes until its end at the pace of the last seconds. */
  const char* GetLiveState() { return this->LiveState.c_str(); }

  /** Later than the last update for as long as that was aborted. */
  vtkMTimeType GetMTime() override;

protected:
  vtkVesiclePipeline();
  ~vtkVesiclePipeline() override;

  /** The vesicle over time: an image, its history, its events on its output ports. */
  virtual vtkAlgorithm* GetRun() = 0;
  /** Passes parameters on to the run. Throws std::exception where they make none. */
  virtual void Prepare() {}

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesiclePipeline(const vtkVesiclePipeline&) = delete;
  void operator=(const vtkVesiclePipeline&) = delete;

  using Clock = std::chrono::steady_clock;
  void Compute(double time);
  void UpdateRun(double time);
  void UpdateRunForAWhile();
  void TellLiveState(double end);
  std::string TimeLeft(double end) const;
  void OnProgress();
  void Fill(vtkInformationVector& output);
  void Show(vtkImageData& image, vtkInformationVector& output);

  bool Live = false;
  bool Ended = false;         // a live run
  Clock::time_point SliceEnd; // of a live update
  std::string LiveState;
  struct Milestone
  {
    Clock::time_point When;
    double Time;
  };
  std::deque<Milestone> Lately; // where a live vesicle was
  vtkNew<vtkMembraneSurface> Membrane;
  vtkNew<vtkPhaseBoundary> Boundary;
  std::unique_ptr<lamella::UpdateRound> Round;
};

#endif
