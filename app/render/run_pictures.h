#pragma once
#include "render/paper.h"
#include "render/render.h"
#include "render/strip.h"
#include "store/history.h"

#include <filesystem>
#include <span>
#include <vector>

namespace lamella::render {

/// A stored run, whose frames are read when they are asked for.
class StoredStates {
public:
  /// The folder of a run, or a file in it. Throws StoreError, SceneError.
  explicit StoredStates(const std::filesystem::path& folder);

  const Scene& scene() const { return scene_; }
  const std::vector<Measures>& history() const { return history_; }
  const std::vector<SeriesEntry>& frames() const { return frames_; } ///< at least one
  Units units() const { return Units(scene_); }
  /// Of a column of history.csv in the unit of pictures. Throws SceneError where the run does not
  /// have it.
  double value(const Measures& measures, const std::string& column) const;
  /// The frame nearest to a time. Throws StoreError.
  State at(double time) const;

private:
  Scene scene_;
  std::vector<Measures> history_;
  std::vector<ComponentMeasures> vesicles_;
  std::vector<SeriesEntry> frames_;
};

std::vector<Surface> surfaces_at(const StoredStates& run, const std::vector<double>& times,
                                 const Quantity& quantity);

struct PictureOptions {
  std::string backend = "auto"; ///< auto, osmesa, egl or x; see vtkLamellaOffscreen
  /// Of figure.png, in pixels; energy.png is two thirds as wide. Type and lines scale with it.
  /// Meant for print at 400 pixels per inch: 2100 pixels are 133 mm (labels of 9 pt), legible from
  /// 90 to 180 mm.
  int width = 2100;
  std::string format = "png"; ///< png, pdf or svg
  Background background = Background::white;
  View view{.section = true};
  std::vector<double> times{}; ///< of the states in the figure; empty: start and end
};

/// Draw a run into an existing folder and return the files written:
///   figure.png  its start and end: the membrane in 3-D above its x-z cross-section, all at one
///               scale
///   energy.png  the energy over time
/// Every file appears whole or not at all. Throws RenderError, and StoreError where a file cannot
/// be read or written.
std::vector<std::filesystem::path> draw_run(const StoredStates& run,
                                            const std::filesystem::path& folder,
                                            const PictureOptions& options = {});

/// Error against wall time, as a picture of 1400 pixels. Throws as draw_run does.
void draw_tradeoff(std::span<const Trade> trades, const std::filesystem::path& file);

} // namespace lamella::render
