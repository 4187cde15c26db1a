#include "scene/scene.h"

#include <algorithm>

namespace lamella {

Grid Scene::grid() const { return {nodes, 2 * half_width / *std::ranges::min_element(nodes)}; }

} // namespace lamella
