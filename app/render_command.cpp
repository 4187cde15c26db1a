#include "commands.h"

#include "exit_code.h"
#include "render/render.h"
#include "run_folder.h"

#include <fmt/format.h>

namespace lamella {

std::vector<std::filesystem::path> draw_pictures(const RenderCommandOptions& options) {
  const StoredRun run = read_run(options.folder);
  RenderOptions render_options;
  render_options.backend = options.backend;
  render_options.bending_modulus =
      run.scene.has_phases() ? run.scene.ld.bending_modulus : run.scene.membrane.bending_modulus;
  if (options.width > 0) render_options.width = options.width;
  return render_run(run.start, run.end, run.history, options.folder, render_options);
}

int render(const RenderCommandOptions& options) {
  for (const auto& file : draw_pictures(options)) fmt::print("{}\n", file.string());
  return success;
}

} // namespace lamella
