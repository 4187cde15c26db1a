#include "fields/material_fields.h"

#include "fields/image.h"

#include <fmt/format.h>

namespace lamella {

std::vector<CarriedField> material_fields(const Scene& scene, const Frame& frame,
                                          const SurfaceGeometry& surface, Fourier& fourier) {
  constexpr int sweeps = 60; // of the spline through the values: almost exact
  std::vector<CarriedField> all;
  for (const MaterialField& field : scene.fields) {
    if (!frame.has(field.name))
      throw InputError(
          fmt::format("the image has no array \"{}\", which its energy depends on", field.name));
    CarriedField& m = all.emplace_back(field.name, field.carried, frame.grid, fourier);
    m.evolving().fit(frame.field(field.name), sweeps);
    m.sample(surface);
  }
  return all;
}

} // namespace lamella
