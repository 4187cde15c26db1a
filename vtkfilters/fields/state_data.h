#pragma once
#include "dynamics/event.h"
#include "dynamics/measures.h"
#include "grid/grid.h"
#include "scene/scene.h"
#include "store/frame.h"

#include <vtkImageData.h>
#include <vtkTable.h>

#include <span>

namespace lamella {

/// The image of a frame, and its field data: the measures, the parameters of the membrane, and how
/// many vesicles there are where several have multipliers of their own.
void fill_state(vtkImageData& image, const Frame& frame, const Measures& measures,
                const Scene& scene, int vesicles = 1, const Vec3& center = {});

/// Measures, one row each, in the columns of history.csv.
void fill_history(vtkTable& table, std::span<const Measures> history);

/// The same of events in a box around a centre, in the columns of events.csv; the kind is text.
void fill_events(vtkTable& table, std::span<const Event> events, const Vec3& center = {});

/// The same of vesicles, in the columns of components.csv.
void fill_components(vtkTable& table, std::span<const ComponentMeasures> vesicles,
                     const Vec3& center = {});

} // namespace lamella
