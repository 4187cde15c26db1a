#pragma once
#include "dynamics/measures.h"
#include "store/frame.h"

#include <array>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace lamella {

/// A picture could not be drawn; the message says why and what would help.
struct RenderError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RenderOptions {
  std::string backend = "auto"; ///< auto, osmesa, egl or x; see vtkLamellaOffscreen
  /// Of figure.png, in pixels; energy.png is two thirds as wide. Type and lines scale with it.
  /// Meant for print at 400 pixels per inch: 2100 pixels are 133 mm (labels of 9 pt), legible from
  /// 90 to 180 mm.
  int width = 2100;
  double bending_modulus = 1; ///< kappa, with phases that of Ld: the unit of energy in plots
};

/// Draw a run into an existing folder and return the files written:
///   figure.png  its start and end: the membrane in 3-D above its x-z cross-section, all at one
///   scale energy.png  the energy over time
/// Every file appears whole or not at all. Throws RenderError, and StoreError where a file cannot
/// be written.
std::vector<std::filesystem::path> render_run(const Frame& start, const Frame& end,
                                              const std::vector<Measures>& history,
                                              const std::filesystem::path& folder,
                                              const RenderOptions& options = {});

/// What a run cost and how wrong it was.
struct Trade {
  std::array<int, 3> nodes{};
  double seconds = 0, error = 0; ///< wall time; relative error
  bool on_front = false;         ///< no other one is both faster and more accurate
  std::string name;              ///< of a preset, or nothing
};

/// Draw trades as a picture of two thirds of the options' width: error against wall time. Throws as
/// render_run does.
void render_tradeoff(std::span<const Trade> trades, const std::filesystem::path& file,
                     const RenderOptions& options = {});

} // namespace lamella
