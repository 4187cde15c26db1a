#include "render/run_pictures.h"

#include "render/energy_plot.h"
#include "render/paper.h"
#include "render/tradeoff_plot.h"

#include "error.h"
#include "fields/run_files.h"
#include "scene/scene_toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella::render {
namespace {

constexpr double figure_width = 2100; ///< of figure.png, in units of a sheet

} // namespace

StoredStates::StoredStates(const std::filesystem::path& folder) {
  const RunFiles files = find_run_files(folder);
  scene_ = read_scene(files.scene);
  history_ = read_history(files.history);
  vesicles_ = read_components(files.components);
  frames_ = files.frames;
  if (folder.is_relative()) // as the user calls them, in messages
    for (SeriesEntry& frame : frames_) frame.file = std::filesystem::proximate(frame.file);
}

double StoredStates::value(const Measures& measures, const std::string& column) const {
  const std::optional<double> value = value_of(measures, column);
  if (!value)
    throw SceneError(
        fmt::format("{}: \"{}\" is not a column of its history.csv", scene_.name, column));
  return notation_of(column).value(*value, units());
}

State StoredStates::at(double time) const {
  const auto frame = std::ranges::min_element(
      frames_, {}, [&](const SeriesEntry& entry) { return std::abs(entry.time - time); });
  const auto row = std::ranges::min_element(
      history_, {}, [&](const Measures& m) { return std::abs(m.time - frame->time); });
  const Measures measures = row == history_.end() ? Measures{} : *row;
  const auto vesicles = std::ranges::count(vesicles_, measures.time, &ComponentMeasures::time);
  return {read_frame(frame->file), measures, scene_, std::max(1, int(vesicles))};
}

std::vector<Surface> surfaces_at(const StoredStates& run, const std::vector<double>& times,
                                 const Quantity& quantity) {
  std::vector<Surface> surfaces;
  for (const double time : times) surfaces.push_back(extract_surface(run.at(time), quantity));
  return surfaces;
}

std::vector<std::filesystem::path> draw_run(const StoredStates& run,
                                            const std::filesystem::path& folder,
                                            const PictureOptions& options) {
  if (options.width < 200 || options.width > 10000)
    throw RenderError("a picture's width must be 200 to 10000 pixels, not " +
                      std::to_string(options.width));
  Studio studio(options.backend);
  const std::vector<double> times =
      options.times.empty() ? std::vector{run.frames().front().time, run.frames().back().time}
                            : options.times;
  Page page(figure_width);
  page.add(std::make_unique<Strip>(Heading{}, surfaces_at(run, times, options.view.color),
                                   options.view));
  const std::string kind = "." + options.format;
  const std::vector<std::filesystem::path> files{folder / ("figure" + kind),
                                                 folder / ("energy" + kind)};
  const double pixels = options.width / figure_width, dpi = pixels * units_per_inch;
  write_sheet(files[0], page.draw({studio, pixels}), dpi, options.background);
  write_sheet(files[1], sheet_of(energy_plot(run.history(), run.units())), dpi, options.background);
  return files;
}

void draw_tradeoff(std::span<const Trade> trades, const std::filesystem::path& file) {
  write_sheet(file, sheet_of(tradeoff_plot(trades)), units_per_inch);
}

} // namespace lamella::render
