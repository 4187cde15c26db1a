#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "fields/state_data.h"
#include "interrupt.h"
#include "progress.h"
#include "render/filter_output.h"
#include "run_folder.h"
#include "store/atomic_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPhaseBoundary.h>
#include <vtkXMLPolyDataWriter.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// Polygons over time: membrane.pvd lists membrane_0000.vtp and so on.
class Collection {
public:
  Collection(fs::path folder, std::string name)
      : folder_(std::move(folder)), name_(std::move(name)) {}

  /// The one of a frame, by its number in the run. Throws StoreError.
  void add(std::size_t frame, double time, vtkPolyData& polygons) {
    const std::string file = fmt::format("{}_{:04}.vtp", name_, frame);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(&polygons);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0)
      throw StoreError(fmt::format("{}: not written: VTK ran out of memory", file));
    write_text_atomically(folder_ / file, writer->GetOutputString());
    entries_ += fmt::format("    <DataSet timestep=\"{}\" file=\"{}\"/>\n", time, file);
  }

  /// Throws StoreError.
  fs::path end() const {
    const fs::path file = folder_ / (name_ + ".pvd");
    write_text_atomically(file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                                "version=\"0.1\">\n  <Collection>\n" +
                                    entries_ + "  </Collection>\n</VTKFile>\n");
    return file;
  }

private:
  fs::path folder_;
  std::string name_, entries_;
};

/// What a filter makes of a frame. Throws StoreError where that is nothing.
vtkSmartPointer<vtkPolyData> polygons(vtkPolyDataAlgorithm& filter, vtkImageData& image,
                                      const std::string& frame) {
  const render::FilterOutput output = render::output_of(filter, image);
  if (!output.error.empty()) throw StoreError(fmt::format("{}: {}", frame, output.error));
  if (!output.warning.empty())
    fmt::print(stderr, "lamella: warning: {}: {}\n", frame, output.warning);
  return output.data;
}

/// The frames nearest to times, each once; all without any.
std::vector<std::size_t> frames_at(const render::StoredStates& run,
                                   const std::vector<double>& times) {
  const std::vector<SeriesEntry>& frames = run.frames();
  std::vector<std::size_t> chosen;
  for (const double time : times)
    chosen.push_back(
        std::size_t(std::ranges::min_element(
                        frames, {}, [&](const SeriesEntry& f) { return std::abs(f.time - time); }) -
                    frames.begin()));
  if (times.empty())
    for (std::size_t n = 0; n < frames.size(); n++) chosen.push_back(n);
  std::ranges::sort(chosen);
  chosen.erase(std::ranges::unique(chosen).begin(), chosen.end());
  return chosen;
}

} // namespace

int export_surfaces(const ExportOptions& options) {
  require_run(options.folder);
  watch_for_interrupt();
  const render::StoredStates run(options.folder);
  const fs::path folder = options.output.empty() ? surfaces_folder(options.folder) : options.output;
  clear_surfaces(folder);
  Collection membranes(folder, "membrane"), boundaries(folder, "boundary");
  int code = success;
  for (const std::size_t n : frames_at(run, options.times)) {
    if (interrupt_requested()) {
      code = interrupted;
      break;
    }
    const SeriesEntry& frame = run.frames()[n];
    const render::State state = run.at(frame.time);
    vtkNew<vtkImageData> image;
    fill_state(*image, state.frame, state.measures, state.scene);
    membranes.add(n, frame.time, *polygons(*vtkNew<vtkMembraneSurface>(), *image, frame.file));
    if (run.scene().has_phases())
      boundaries.add(n, frame.time, *polygons(*vtkNew<vtkPhaseBoundary>(), *image, frame.file));
  }
  say(membranes.end().string() + "\n");
  if (run.scene().has_phases()) say(boundaries.end().string() + "\n");
  return code;
}

} // namespace lamella
