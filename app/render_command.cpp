#include "commands.h"

#include "exit_code.h"
#include "run_folder.h"

#include <fmt/format.h>

namespace lamella {

std::vector<std::filesystem::path> draw_pictures(const RenderCommandOptions& options) {
  const render::StoredStates run(options.folder);
  return render::draw_run(run, options.folder, options.pictures);
}

int redraw(const RenderCommandOptions& options) {
  require_run(options.folder);
  for (const auto& file : draw_pictures(options)) fmt::print("{}\n", file.string());
  return success;
}

} // namespace lamella
