#pragma once
#include "scene/scene.h"

class vtkSMProxy;

namespace lamella
{

/// Gives the properties of a Vesicle proxy the values of a scene.
void set_properties(vtkSMProxy& vesicle, Scene scene);

} // namespace lamella
