#include "render/render.h"

#include "render/energy_plot.h"
#include "render/figure.h"
#include "render/tradeoff_plot.h"

#include <cmath>

namespace lamella {

std::vector<std::filesystem::path> render_run(const Frame& start, const Frame& end,
                                              const std::vector<Measures>& history,
                                              const std::filesystem::path& folder,
                                              const RenderOptions& options) {
  using namespace render;
  if (options.width < 200 || options.width > 10000)
    throw RenderError("a picture's width must be 200 to 10000 pixels, not " +
                      std::to_string(options.width));
  Studio studio(options.backend);
  const std::vector<std::filesystem::path> files{folder / "figure.png", folder / "energy.png"};
  write_png(files[0],
            draw_figure(studio, extract_surface(start), extract_surface(end), options.width));
  write_png(files[1], draw_energy(studio, history, options.bending_modulus, options.width * 2 / 3));
  return files;
}

void render_tradeoff(std::span<const Trade> trades, const std::filesystem::path& file,
                     const RenderOptions& options) {
  render::Studio studio(options.backend);
  render::write_png(file, render::draw_tradeoff(studio, trades, options.width * 2 / 3));
}

} // namespace lamella
