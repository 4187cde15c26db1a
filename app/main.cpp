// lamella: dynamics of lipid vesicles on the command line.
#include "commands.h"
#include "error.h"
#include "exit_code.h"
#include "kernels/kernels.h"
#include "render/render.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <new>

namespace {

using namespace lamella;

constexpr const char* run_examples = R"(
Examples:
  lamella run fig3_oblate -o oblate            a built-in scene (see `lamella scenes`)
  lamella run my_vesicle.toml -o out           your own
  lamella run fig3_oblate -o fine --set grid.nodes=96 --set numerics.tolerance=0.002

The folder receives figure.png, energy.png, history.csv, frames/, scene.toml and summary.txt.
Exit codes: 0 done, 2 bad scene or command line (nothing written), 3 the run could not go on, 4 a file
could not be written, 5 no pictures, 130 interrupted (what there is is stored).
)";

void add_backend(CLI::App& command, std::string& backend) {
  command.add_option("--backend", backend, "How pictures are drawn: auto, osmesa, egl or x")
    ->check(CLI::IsMember({"auto", "osmesa", "egl", "x"}))
    ->capture_default_str();
}

int complain(int code, const char* message) {
  fmt::print(stderr, "lamella: {}\n", message);
  return code;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Dynamics of lipid vesicles: level sets, bending energy, exact volume and area.\n"
               "`lamella run fig3_oblate -o out` is a first run; `lamella run --help` says more.",
               "lamella"};
  app.set_version_flag("--version", fmt::format("lamella {} ({} kernels)\nBSD-3-Clause; this program links FFTW and "
                                                "is therefore distributed under the GPL.",
                                                LAMELLA_VERSION, kernels().name));
  app.require_subcommand(1);

  RunOptions run_options;
  CLI::App& run_command = *app.add_subcommand("run", "Run a scene; leaves numbers and pictures in a folder");
  run_command.footer(run_examples);
  run_command.add_option("scene", run_options.scene, "Scene file (.toml), or the name of a built-in scene")->required();
  run_command.add_option("-o,--output", run_options.folder, "Output folder (default: the scene's name)");
  run_command.add_option("--threads", run_options.threads, "Threads (default: all cores)")->check(CLI::Range(1, 1024));
  run_command
    .add_option("--set", run_options.set, "Change a value of the scene: section.key=value; may be repeated")
    ->expected(1)
    ->take_all()
    ->type_name("KEY=VALUE");
  run_command.add_flag("--force", run_options.force, "Replace an earlier run in the output folder");
  run_command.add_flag("--no-pictures", run_options.no_pictures, "Numbers only");
  add_backend(run_command, run_options.backend);

  RenderCommandOptions render_options;
  CLI::App& render_command = *app.add_subcommand("render", "Draw the pictures of a stored run again");
  render_command.add_option("folder", render_options.folder, "Output folder of a run")->required();
  render_command.add_option("--width", render_options.width, "Width of figure.png in pixels")
    ->check(CLI::Range(200, 10000));
  add_backend(render_command, render_options.backend);

  std::string scene_name;
  CLI::App& scenes_command =
    *app.add_subcommand("scenes", "List the built-in scenes, or print one to start your own from");
  scenes_command.add_option("name", scene_name, "The scene to print");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? success : bad_input;
  }
  try {
    if (run_command) return run(run_options);
    if (render_command) return render(render_options);
    return show_scenes(scene_name);
  } catch (const SceneError& e) {
    return complain(bad_input, e.what());
  } catch (const RunError& e) {
    return complain(run_stopped, e.what());
  } catch (const StoreError& e) {
    return complain(cannot_store, e.what());
  } catch (const RenderError& e) {
    return complain(no_pictures, e.what());
  } catch (const std::bad_alloc&) {
    return complain(run_stopped, "not enough memory for this grid; choose fewer grid.nodes");
  }
}
