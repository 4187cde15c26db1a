#pragma once
#include "dynamics/measures.h"
#include "render/phases.h"
#include "render/units.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string_view>

namespace lamella::render {

/// What colours on a membrane tell. phase: Ld red, Lo blue; one colour where there is one phase.
enum class Quantity { phase, K_M, K, energy_density, c, velocity };

/// As in scenes and on the command line: "phase", "K_M", "K", "energy_density", "c", "velocity".
std::string_view to_string(Quantity quantity);
constexpr Quantity quantities[]{Quantity::phase,          Quantity::K_M, Quantity::K,
                                Quantity::energy_density, Quantity::c,   Quantity::velocity};

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
Surface extract_surface(const State& state, Quantity quantity);

} // namespace lamella::render
