#include "commands.h"

#include "exit_code.h"
#include "interrupt.h"
#include "output_folder.h"
#include "progress.h"
#include "run_contents.h"

#include <fmt/format.h>

namespace lamella {

std::vector<std::filesystem::path> draw_pictures(const RenderCommandOptions& options) {
  const render::StoredStates run(options.folder);
  return render::draw_run(run, options.folder, options.pictures);
}

int redraw(const RenderCommandOptions& options) {
  end_at_interrupt();
  require_run(options.folder);
  const Folder held = hold_run(options.folder);
  for (const auto& file : draw_pictures(options)) say(fmt::format("{}\n", file.string()));
  return success;
}

} // namespace lamella
