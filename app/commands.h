#pragma once
#include "render/run_pictures.h"
#include "tradeoff/sweep.h"

#include <filesystem>
#include <string>
#include <vector>

namespace lamella {

struct RunOptions {
  std::string scene; ///< a file, or the name of a built-in scene; empty: that of `resume`
  std::filesystem::path folder; ///< empty: the scene's name in the current folder
  std::filesystem::path resume; ///< a run to go on with, or a state in it; empty: a new run
  bool branch = false;          ///< go on in `folder`, with what the scene changes
  std::vector<std::string> set; ///< section.key=value
  std::string preset = "standard";
  double checkpoint_seconds = 60; ///< wall-clock time between checkpoints; 0: none
  bool exact_frames = false;      ///< frames are checkpoints too
  std::string backend = "auto";   ///< of the pictures
  int threads = 0;                ///< 0: all
  bool force = false;             ///< replace an earlier run in the folder
  bool no_pictures = false;
};

/// Runs a scene and fills the folder. Returns an ExitCode; throws UsageError, SceneError,
/// StoreError.
int run(const RunOptions& options);

struct RenderCommandOptions {
  std::filesystem::path folder;
  render::PictureOptions pictures;
};

/// Draws the pictures of a stored run and returns their files. Throws StoreError, RenderError.
std::vector<std::filesystem::path> draw_pictures(const RenderCommandOptions& options);

/// The same as a command: lists the files. Returns an ExitCode; throws UsageError too for a folder
/// that holds no run.
int redraw(const RenderCommandOptions& options);

/// Tells a person what is in a run's folder, a frame or a checkpoint. Returns an ExitCode; throws
/// UsageError, StoreError.
int inspect(const std::filesystem::path& what);

struct FigureOptions {
  std::string name; ///< a file, a built-in figure, its number, or "all"; empty: list them
  std::filesystem::path folder = "figures";
  std::vector<std::string> set; ///< section.key=value, for all scenes
  std::vector<std::string> formats{"png", "pdf", "svg"};
  std::string backend = "auto";
  int threads = 0; ///< 0: all
  render::Background background = render::Background::white;
  std::filesystem::path gallery; ///< a Markdown file that shows all, small; empty: none
};

/// Runs the scenes that figures need, as far as the folder does not have them, and draws the
/// figures. Returns an ExitCode, `unexpected` where an outcome is not as a figure expects; throws
/// UsageError, SceneError, StoreError, RenderError.
int figure(const FigureOptions& options);

struct MovieOptions {
  std::filesystem::path folder;   ///< of a run
  std::filesystem::path output;   ///< .mp4, .webm, or a folder for pictures; empty: movie.mp4 there
  int width = 1200, height = 900; ///< pixels
  double seconds = 8, rate = 25;  ///< length; pictures a second
  double turn = 0;                ///< degrees by which the eye goes around in that time
  render::View view;
  std::string backend = "auto";
};

/// Makes a movie of a stored run. Returns an ExitCode; throws UsageError, StoreError, RenderError.
int movie(const MovieOptions& options);

struct ExportOptions {
  std::filesystem::path folder; ///< of a run
  std::filesystem::path output; ///< a folder; empty: "surfaces" in that of the run
  std::vector<double> times;    ///< of the states, those nearest; empty: all
};

/// Writes the membranes of a stored run, and with two phases their boundaries, as polygons. Returns
/// an ExitCode; throws UsageError, StoreError.
int export_surfaces(const ExportOptions& options);

/// Lists the built-in scenes, or prints one. Returns an ExitCode; throws SceneError.
int show_scenes(const std::string& name);

struct TradeoffOptions {
  std::string scene;            ///< a file, or the name of a built-in scene
  std::filesystem::path folder; ///< empty: the scene's name and "-tradeoff" in the current folder
  std::filesystem::path reference; ///< empty: the built-in one, or else a finer run
  std::vector<std::string> set;    ///< section.key=value
  SweepRange range;
  int repeats = 1;    ///< runs of each kind; the fastest counts
  int threads = 0;    ///< 0: all
  bool force = false; ///< replace an earlier sweep in the folder
};

/// Runs a scene on several grids and with several tolerances, and fills the folder with a table and
/// a picture of wall time against error. Returns an ExitCode; throws UsageError, SceneError,
/// StoreError.
int tradeoff(const TradeoffOptions& options);

struct ExtremesOptions {
  std::filesystem::path folder = "extremes";
  std::string only; ///< a part of the names of those cases to run; empty: all
  bool quick = false;
  int random = 0; ///< so many random scenes in place of the cases
  int seed = 1;
  int threads = 0; ///< 0: all
};

/// Runs the cases at the limits of the method, or random scenes, and writes a table of them into
/// the folder. Returns an ExitCode, `unexpected` where a case came out wrong or a scene broke a
/// law; throws UsageError, StoreError.
int extremes(const ExtremesOptions& options);

} // namespace lamella
