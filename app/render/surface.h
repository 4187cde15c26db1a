#pragma once
#include "dynamics/measures.h"
#include "render/phases.h"
#include "render/units.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <string_view>

namespace lamella::render {

/// What colours on a membrane tell, by its name as in scenes and on the command line: one of those
/// below, or a material field. phase: Ld red, Lo blue; one colour where there is one phase.
struct Quantity {
  std::string name;

  static const Quantity phase, K_M, K, energy_density, c, velocity;
  bool operator==(const Quantity&) const = default;
};
inline const Quantity Quantity::phase{"phase"}, Quantity::K_M{"K_M"}, Quantity::K{"K"},
    Quantity::energy_density{"energy_density"}, Quantity::c{"c"}, Quantity::velocity{"velocity"};

/// Those that are always known.
constexpr std::string_view quantity_names[]{"phase", "K_M", "K", "energy_density", "c", "velocity"};
/// Whether there can be one of this name.
bool is_quantity(std::string_view name);

/// The membrane of a frame, ready to draw or to cut.
struct Surface {
  double time = 0; ///< of the scene
  /// From vtkMembraneSurface, with more point data: "occlusion", from 0 (open) to 1 (hidden in a
  /// dimple, a neck or between two membranes). With phases the scalars are psi.
  vtkSmartPointer<vtkPolyData> mesh;
  std::vector<Patch> parts;              ///< the mesh phase by phase
  vtkSmartPointer<vtkPolyData> boundary; ///< from vtkPhaseBoundary; null with one phase
  Units units{};                         ///< of its run

  bool has_phases() const { return boundary != nullptr; }
};

/// A stored state with what its run knows of it.
struct State {
  Frame frame;
  Measures measures{};
  Scene scene{};
  int vesicles = 1; ///< that have multipliers of their own
};

/// The surface alone suits Quantity::phase. Throws RenderError when phi is nowhere negative.
Surface extract_surface(const Frame& frame);

/// With the array that a quantity needs, named after it and of one component, in the unit of
/// pictures; the velocity is that along the normal. Throws RenderError too where the state does not
/// have it.
Surface extract_surface(const State& state, const Quantity& quantity);

} // namespace lamella::render
