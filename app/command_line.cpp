#include "command_line.h"

#include "commands.h"
#include "exit_code.h"
#include "kernels/kernels.h"
#include "nearest.h"
#include "progress.h"
#include "scene/keys.h"
#include "usage_error.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

namespace lamella {

namespace {

constexpr const char* introduction =
    "Lipid vesicles of one or two phases: how they change their shape, and where that ends.";

constexpr const char* first_steps = R"(First steps:
  lamella scenes                       what there is to run
  lamella run fig3_oblate -o oblate    numbers and pictures of one in the folder "oblate"
  lamella run --help                   more about a command)";

constexpr const char* run_notes = R"(Examples:
  lamella run fig3_oblate -o oblate              a built-in scene
  lamella scenes fig3_oblate > vesicle.toml      a scene to start your own from
  lamella run vesicle.toml                       into the folder "vesicle"
  lamella run vesicle.toml -o fine --preset fine
  lamella run vesicle.toml --set grid.nodes=96 --set numerics.tolerance=0.002

A name without folder and ".toml" is first looked for among the built-in scenes; ./NAME is always a
file. The output folder receives figure.png, energy.png, history.csv, events.csv, frames/,
scene.toml, status.toml and summary.txt. Ctrl-C ends a run early and stores what there is; so do
SIGTERM, SIGHUP, SIGUSR2 and SIGXCPU. SIGUSR1 asks for a checkpoint.

A run that was interrupted or killed goes on as if it had not been:
  lamella run --resume oblate
  lamella run --resume oblate --branch -o longer --set run.end_time=0.01
  lamella run --resume oblate/frames/frame_0004.hdf --branch -o soft --set membrane.bending_modulus=0.5

Exit codes: 0 done, 2 bad scene or command line (nothing written), 3 the run could not go on (stored
up to there), 4 a file could not be written, 5 no pictures, 75 interrupted and can be resumed, 130
interrupted before there was anything to resume.)";

constexpr const char* render_notes = R"(Examples:
  lamella render oblate                 figure.png and energy.png again
  lamella render oblate --width 4200    larger, for a poster
  lamella render oblate --times 0,1e-4,4e-4,1.6e-3 --format pdf
  lamella render oblate --color K_M --elevation 60)";

constexpr const char* inspect_notes = R"(Examples:
  lamella inspect oblate                              the run in a folder
  lamella inspect oblate/frames/frame_0004.hdf        a stored state
  lamella inspect oblate/checkpoints/checkpoint_00000087.hdf)";

constexpr const char* figure_notes = R"(Examples:
  lamella figure                        the built-in figures, those of the paper
  lamella figure 9 -o figures           its runs and its page, as PNG, PDF and SVG
  lamella figure all -o figures         all of them; runs that are there are not made again
  lamella figure mine.toml              your own; docs/figures.md describes the format

Runs are kept in the folder "runs" beside the pages. Exit codes: 0 done, 1 an outcome is not as the
figure's file expects, 3 a run did not come to its end.)";

constexpr const char* movie_notes = R"(Examples:
  lamella movie oblate                          oblate/movie.mp4, 8 seconds
  lamella movie oblate -o oblate.webm --turntable
  lamella movie oblate -o pictures              pictures in a folder

Movies end in .mp4, .webm, .avi or .gif. Without ffmpeg there are pictures in a folder instead.)";

constexpr const char* export_notes = R"(Examples:
  lamella export oblate                         oblate/surfaces/membrane.pvd and its files
  lamella export oblate -o meshes --times 0,1.6e-3

Membranes are triangles with normals, curvatures, energy density and velocity at the points; with two
phases their boundaries are lines. ParaView opens the .pvd files, as time series, without the plugin;
other programs read the .vtp files. Those of an earlier export are replaced.)";

constexpr const char* scenes_notes = R"(Examples:
  lamella scenes                              the list
  lamella scenes fig3_oblate > vesicle.toml   a scene to start your own from)";

constexpr const char* tradeoff_notes = R"(Examples:
  lamella tradeoff fig3_oblate                      which grid and tolerance for which accuracy
  lamella tradeoff fig3_oblate --presets            the three presets alone
  lamella tradeoff vesicle.toml --grids 48,64,96 --tolerances 0.02,0.005 --repeats 3
  lamella tradeoff vesicle.toml --reference fine/history.csv

Runs are compared with a table (--reference), the exact solution that comes with the scene, or a run
finer than all others. The output folder receives tradeoff.csv, tradeoff.md and tradeoff.png: wall time
against error, with the Pareto front. docs/tradeoff.md says more.)";

constexpr const char* extremes_notes = R"(Examples:
  lamella extremes                     all cases, some minutes
  lamella extremes --quick             a minute's worth of them
  lamella extremes --only prolate      those with "prolate" in their names
  lamella extremes --random 100        a hundred random scenes against the laws of every run

Each case comes to its known answer or is told what it lacks. The output folder receives extremes.md
and extremes.csv; with --random, random.csv and each scene that broke a law. docs/extremes.md says more.
Exit code 1: a case came out wrong without a word, or a law was broken.)";

void add_backend(CLI::App& command, std::string& backend) {
  command.add_option("--backend", backend, "How pictures are drawn: auto, osmesa, egl or x")
      ->check(CLI::IsMember({"auto", "osmesa", "egl", "x"}).description(""))
      ->capture_default_str()
      ->type_name("NAME");
}

CLI::Option* add_scene(CLI::App& command, std::string& scene, std::vector<std::string>& set) {
  command.add_option("--set", set, "Change a value of the scene; may be repeated")
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("SECTION.KEY=VALUE");
  return command.add_option("scene", scene, "Scene file (.toml), or the name of a built-in scene")
      ->type_name("");
}

CLI::Option* add_output(CLI::App& command, std::filesystem::path& folder, const char* description) {
  return command.add_option("-o,--output", folder, description)
      ->check([](const std::string& name) { return name.empty() ? "the name is empty" : ""; })
      ->type_name("FOLDER");
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads (default: all cores)")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N");
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App& run = *app.add_subcommand("run", "Run a scene; numbers and pictures go to a folder");
  run.footer(run_notes);
  CLI::Option* scene = add_scene(run, options.scene, options.set);
  run.add_option("--preset", options.preset,
                 "draft, standard or fine: grid and tolerance relative to the scene's own")
      ->capture_default_str()
      ->type_name("NAME");
  CLI::Option* output =
      add_output(run, options.folder, "Output folder (default: the scene's name)");
  CLI::Option* resume =
      run.add_option("--resume", options.resume,
                     "Go on with the run in a folder, to the last bit; with --branch also from a "
                     "checkpoint or an exact frame")
          ->type_name("FOLDER|FILE");
  CLI::Option* branch =
      run.add_flag("--branch", options.branch,
                   "With --resume, -o and --set: go on in another folder, with a changed scene")
          ->needs(resume, output);
  run.add_option("--checkpoint-every", options.checkpoint_seconds,
                 "Seconds of wall-clock time between checkpoints; 0: none")
      ->check(CLI::Range(0., 1e9).description(""))
      ->capture_default_str()
      ->type_name("S");
  run.add_flag("--exact-frames", options.exact_frames,
               "Make every frame a checkpoint: seven times the size, and --branch starts from any");
  run.callback([=] {
    if (scene->empty() && resume->empty()) throw CLI::RequiredError("scene");
    if (!resume->empty() && !output->empty() && branch->empty())
      throw CLI::ExcludesError("--resume", "-o without --branch");
  });
  add_threads(run, options.threads);
  run.add_flag("--force", options.force, "Replace an earlier run in the output folder");
  run.add_flag("--no-pictures", options.no_pictures, "Numbers only");
  add_backend(run, options.backend);
}

/// Numbers separated by commas.
template <class Values>
CLI::Option* add_list(CLI::App& command, const char* name, Values& values, const char* help) {
  return command.add_option(name, values, help)->delimiter(',')->allow_extra_args(false);
}

/// How membranes are looked at.
void add_view(CLI::App& command, render::View& view) {
  command.add_option("--elevation", view.elevation, "Of the eye above the x-y plane, in degrees")
      ->check(CLI::Range(-90., 90.).description(""))
      ->type_name("DEGREES");
  command.add_option("--azimuth", view.azimuth, "Of the eye around z, in degrees")
      ->type_name("DEGREES");
  const auto check = [](const std::string& name) {
    if (render::is_quantity(name)) return std::string();
    return fmt::format("\"{}\" is not available; allowed: {}, or a field of the scene", name,
                       fmt::join(render::quantity_names, ", "));
  };
  command
      .add_option_function<std::string>(
          "--color", [&view](const std::string& name) { view.color = {name}; },
          "What colours tell: phase, K_M, K, energy_density, c, velocity, or one of [[fields]]")
      ->check(CLI::Validator(check, ""))
      ->type_name("NAME");
}

void add_render(CLI::App& app, RenderCommandOptions& options) {
  CLI::App& command = *app.add_subcommand("render", "Draw the pictures of a stored run again");
  command.footer(render_notes);
  command.add_option("folder", options.folder, "Output folder of a run")->required()->type_name("");
  command
      .add_option("--width", options.pictures.width,
                  "Width of figure.png in pixels (default: 2100)")
      ->check(CLI::Range(200, 10000).description(""))
      ->type_name("N");
  add_list(command, "--times", options.pictures.times,
           "States to show, those nearest to these times (default: start and end)")
      ->type_name("T[,T]");
  add_view(command, options.pictures.view);
  command.add_flag("--no-sections{false}", options.pictures.view.section, "Without cross-sections");
  command.add_option("--format", options.pictures.format, "png, pdf or svg")
      ->check(CLI::IsMember({"png", "pdf", "svg"}).description(""))
      ->capture_default_str()
      ->type_name("NAME");
  command.add_flag(
      "--transparent",
      [&](std::int64_t) { options.pictures.background = render::Background::transparent; },
      "PNG without background");
  add_backend(command, options.pictures.backend);
}

void add_inspect(CLI::App& app, std::filesystem::path& what) {
  CLI::App& inspect =
      *app.add_subcommand("inspect", "Tell what is in a run's folder, a frame or a checkpoint");
  inspect.footer(inspect_notes);
  inspect.add_option("what", what, "A run's folder, or a file of it (.hdf)")
      ->required()
      ->type_name("");
}

void add_figure(CLI::App& app, FigureOptions& options) {
  CLI::App& command =
      *app.add_subcommand("figure", "Draw a figure or table of the paper, or your own");
  command.footer(figure_notes);
  command.add_option("name", options.name, "A figure (3 to 15, table1, ... or a file), or all")
      ->type_name("");
  add_output(command, options.folder, "Output folder (default: figures)");
  command.add_option("--set", options.set, "Change a value of all scenes; may be repeated")
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("SECTION.KEY=VALUE");
  add_list(command, "--format", options.formats, "png, pdf, svg (default: all three)")
      ->check(CLI::IsMember({"png", "pdf", "svg"}).description(""))
      ->type_name("NAME[,NAME]");
  command.add_flag(
      "--transparent", [&](std::int64_t) { options.background = render::Background::transparent; },
      "PNG without background");
  command
      .add_option(
          "--gallery", options.gallery,
          "Also a page of small pictures, in Markdown; these go to images/gallery beside it")
      ->type_name("FILE");
  add_threads(command, options.threads);
  add_backend(command, options.backend);
}

void add_movie(CLI::App& app, MovieOptions& options) {
  CLI::App& command = *app.add_subcommand("movie", "Make a movie of a stored run");
  command.footer(movie_notes);
  command.add_option("folder", options.folder, "Output folder of a run")->required()->type_name("");
  command
      .add_option(
          "-o,--output", options.output,
          "File (.mp4, .webm, .avi, .gif) or folder for pictures (default: movie.mp4 in the run's)")
      ->type_name("NAME");
  command.add_option("--width", options.width, "In pixels")
      ->check(CLI::Range(200, 4000).description(""))
      ->capture_default_str()
      ->type_name("N");
  command.add_option("--height", options.height, "In pixels")
      ->check(CLI::Range(200, 4000).description(""))
      ->capture_default_str()
      ->type_name("N");
  command.add_option("--seconds", options.seconds, "Length")
      ->check(CLI::Range(0.1, 3600.).description(""))
      ->capture_default_str()
      ->type_name("S");
  command.add_option("--rate", options.rate, "Pictures a second")
      ->check(CLI::Range(1., 100.).description(""))
      ->capture_default_str()
      ->type_name("N");
  command.add_flag("--turntable{360}", options.turn, "The eye goes around the vesicle once");
  add_view(command, options.view);
  add_backend(command, options.backend);
}

void add_export(CLI::App& app, ExportOptions& options) {
  CLI::App& command =
      *app.add_subcommand("export", "Write the membranes of a stored run as triangles (.vtp)");
  command.footer(export_notes);
  command.add_option("folder", options.folder, "Output folder of a run")->required()->type_name("");
  add_output(command, options.output, "Output folder (default: surfaces in the run's)");
  add_list(command, "--times", options.times,
           "States to write, those nearest to these times (default: all)")
      ->type_name("T[,T]");
}

void add_scenes(CLI::App& app, std::string& name) {
  CLI::App& scenes = *app.add_subcommand("scenes", "List the built-in scenes, or print one");
  scenes.footer(scenes_notes);
  scenes.add_option("name", name, "The scene to print")->type_name("");
}

/// A value of a list for a key of the scene.
CLI::Validator allowed(std::string_view section, std::string_view name) {
  const Key* key = find_key(section, name);
  return {[key](const std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && key->range.contains(value);
            return good ? "" : fmt::format("{}; allowed: {}", text, allowed_text(*key));
          },
          ""};
}

void add_tradeoff(CLI::App& app, TradeoffOptions& options) {
  CLI::App& tradeoff =
      *app.add_subcommand("tradeoff", "Measure accuracy against time over grids and tolerances");
  tradeoff.footer(tradeoff_notes);
  add_scene(tradeoff, options.scene, options.set)->required();
  add_output(tradeoff, options.folder,
             "Output folder (default: the scene's name and \"-tradeoff\")");
  CLI::Option* grids =
      tradeoff
          .add_option("--grids", options.range.grids,
                      "Nodes along the shortest axis (default: 1/2, 3/4, 1, 3/2 of the scene's)")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->check(allowed("grid", "nodes"))
          ->type_name("N[,N]");
  CLI::Option* tolerances =
      tradeoff
          .add_option("--tolerances", options.range.tolerances,
                      "Of the time steps (default: 4, 1, 1/4 times the scene's)")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->check(allowed("numerics", "tolerance"))
          ->type_name("X[,X]");
  tradeoff.add_flag("--presets", options.range.presets_only, "Draft, standard and fine alone")
      ->excludes(grids)
      ->excludes(tolerances);
  tradeoff
      .add_option("--reference", options.reference,
                  "Table to compare with, such as the history.csv of a finer run")
      ->type_name("FILE");
  tradeoff.add_option("--repeats", options.repeats, "Runs of each kind; the fastest counts")
      ->check(CLI::Range(1, 100).description(""))
      ->capture_default_str()
      ->type_name("N");
  add_threads(tradeoff, options.threads);
  tradeoff.add_flag("--force", options.force, "Replace an earlier sweep in the output folder");
}

void add_extremes(CLI::App& app, ExtremesOptions& options) {
  CLI::App& extremes =
      *app.add_subcommand("extremes", "Run the cases at the limits of the method, with a verdict");
  extremes.footer(extremes_notes);
  add_output(extremes, options.folder, "Output folder (default: extremes)");
  extremes.add_option("--only", options.only, "Cases with this in their names alone")
      ->type_name("PATTERN");
  extremes.add_flag("--quick", options.quick, "A minute's worth of cases");
  extremes
      .add_option("--random", options.random,
                  "In place of the cases, N random scenes that must obey the laws of every run")
      ->check(CLI::Range(1, 1000000).description(""))
      ->excludes("--only", "--quick")
      ->type_name("N");
  extremes.add_option("--seed", options.seed, "Which random scenes (default: 1)")
      ->check(CLI::Range(0, 1000000000).description(""))
      ->type_name("S");
  add_threads(extremes, options.threads);
}

/// What to say about an argument that no command takes.
std::string unknown_argument(const CLI::App& command, const std::string& argument) {
  if (!argument.starts_with('-'))
    return fmt::format("\"{}\" is one argument too many (names with spaces need quotes)", argument);
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::vector<std::string_view> views(names.begin(), names.end());
  return fmt::format("{}: no such option{}", argument, suggestion(argument, views));
}

[[noreturn]] void refuse(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::vector<std::string> extras = app.remaining(true);
  std::string message = extras.empty() ? error.what() : unknown_argument(command, extras.front());
  if (!message.ends_with('?'))
    message +=
        fmt::format("; see `lamella{} --help`", chosen.empty() ? "" : " " + command.get_name());
  throw UsageError(message);
}

void refuse_unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string_view> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::count(names, word) > 0) return;
  throw UsageError(fmt::format("\"{}\" is not a command; allowed: {}{}", word,
                               fmt::join(names, ", "), suggestion(word, names)));
}

} // namespace

std::function<int()> parse_command_line(int argc, const char* const* argv) {
  CLI::App app{introduction, "lamella"};
  app.footer(first_steps);
  app.set_version_flag("--version",
                       fmt::format("lamella {} ({} kernels)\nBSD-3-Clause; this program links FFTW "
                                   "and is therefore distributed under the GPL.",
                                   version(), kernels().name));
  app.require_subcommand(1);
  RunOptions run_options;
  RenderCommandOptions render_options;
  FigureOptions figure_options;
  MovieOptions movie_options;
  ExportOptions export_options;
  std::string scene;
  TradeoffOptions tradeoff_options;
  ExtremesOptions extremes_options;
  add_run(app, run_options);
  add_render(app, render_options);
  std::filesystem::path inspected;
  add_figure(app, figure_options);
  add_movie(app, movie_options);
  add_export(app, export_options);
  add_scenes(app, scene);
  add_inspect(app, inspected);
  add_tradeoff(app, tradeoff_options);
  add_extremes(app, extremes_options);

  if (argc > 1) refuse_unknown_command(app, argv[1]);
  try {
    if (argc < 2) throw CLI::CallForHelp();
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    std::ostringstream text;
    app.exit(e, text, text);
    say(text.str());
    return [] { return success; };
  } catch (const CLI::ParseError& e) {
    refuse(app, e);
  }
  if (app.got_subcommand("run")) return [=] { return run(run_options); };
  if (app.got_subcommand("render")) return [=] { return redraw(render_options); };
  if (app.got_subcommand("inspect")) return [=] { return inspect(inspected); };
  if (app.got_subcommand("figure")) return [=] { return figure(figure_options); };
  if (app.got_subcommand("movie")) return [=] { return movie(movie_options); };
  if (app.got_subcommand("export")) return [=] { return export_surfaces(export_options); };
  if (app.got_subcommand("tradeoff")) return [=] { return tradeoff(tradeoff_options); };
  if (app.got_subcommand("extremes")) return [=] { return extremes(extremes_options); };
  return [=] { return show_scenes(scene); };
}

} // namespace lamella
