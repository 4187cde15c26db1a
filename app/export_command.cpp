#include "commands.h"

#include "error.h"
#include "exit_code.h"
#include "fields/state_data.h"
#include "interrupt.h"
#include "output_folder.h"
#include "progress.h"
#include "regular_file.h"
#include "render/filter_output.h"
#include "run_contents.h"
#include "run_names.h"
#include "surface_collection.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <vtkMembraneSurface.h>
#include <vtkNew.h>
#include <vtkPhaseBoundary.h>
#include <vtkXMLPolyDataWriter.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

/// The text of a .vtp file. Throws StoreError.
std::string vtp_of(vtkPolyData& polygons, const std::string& frame) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&polygons);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0)
    throw StoreError(fmt::format("{}: not exported: VTK ran out of memory", frame));
  return writer->GetOutputString();
}

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

/// Throws StoreError where a file that is not of an earlier export is in the way.
void refuse_foreign(const Folder& folder, const std::string& collection,
                    const std::vector<std::size_t>& frames) {
  const std::vector<std::string> own = exported_files(folder);
  const auto check = [&](const std::string& file) {
    if (folder.type_of(file) != fs::file_type::not_found && std::ranges::count(own, file) == 0)
      throw StoreError(fmt::format("{}: is there already and not of an earlier export; move it "
                                   "away, or choose another folder with -o",
                                   (folder.path() / file).string()));
  };
  check(collection + ".pvd");
  for (const std::size_t frame : frames) check(surface_file(collection, frame));
}

/// Writes the frames of a run, as far as no interrupt is requested.
void write_surfaces(const render::StoredStates& run, const std::vector<std::size_t>& frames,
                    const Folder& folder) {
  const bool has_phases = run.scene().has_phases();
  SurfaceCollection membranes(folder, "membrane"), boundaries(folder, "boundary");
  for (const std::size_t n : frames) {
    if (interrupt_requested()) break;
    const SeriesEntry& frame = run.frames()[n];
    const render::State state = run.at(frame.time);
    vtkNew<vtkImageData> image;
    fill_state(*image, state.frame, state.measures, state.scene, state.vesicles);
    const auto vtp = [&](vtkPolyDataAlgorithm& filter) {
      return vtp_of(*polygons(filter, *image, frame.file), frame.file);
    };
    membranes.add(n, frame.time, vtp(*vtkNew<vtkMembraneSurface>()));
    if (has_phases) boundaries.add(n, frame.time, vtp(*vtkNew<vtkPhaseBoundary>()));
  }
  for (const SurfaceCollection* written : {&membranes, &boundaries})
    if (!is_free(written->file())) say(written->file().string() + "\n");
}

/// The folder for the surfaces, once nothing else is in the way. What an earlier export wrote goes.
OutputFolder cleared(const ExportOptions& options, const std::vector<std::size_t>& frames,
                     bool has_phases) {
  const fs::path path =
      options.output.empty() ? options.folder / run_names::surfaces : options.output;
  if (options.output.empty()) Folder(options.folder).find(run_names::surfaces); // refuses a link
  OutputFolder folder(path);
  refuse_foreign(*folder, "membrane", frames);
  if (has_phases) refuse_foreign(*folder, "boundary", frames);
  erase_surfaces(*folder);
  return folder;
}

} // namespace

int export_surfaces(const ExportOptions& options) {
  require_run(options.folder);
  std::error_code ignored;
  std::optional<Folder> held; // the output folder is held anyway
  if (!fs::equivalent(options.folder, options.output, ignored)) held = hold_run(options.folder);
  const render::StoredStates run(options.folder);
  const std::vector<std::size_t> frames = frames_at(run, options.times);
  const OutputFolder folder = cleared(options, frames, run.scene().has_phases());
  try {
    write_surfaces(run, frames, *folder);
  } catch (...) {
    erase_surfaces(*folder);
    throw;
  }
  return interrupt_requested() ? interrupted : success;
}

} // namespace lamella
