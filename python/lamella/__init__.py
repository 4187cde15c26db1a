"""Lipid vesicles and membranes over time, for VTK pipelines and numpy.

The VTK classes are here under their own names (vtkVesicleSource, vtkMembraneSurface, ...), beside
those of `vtkmodules`; help(lamella.vtkVesicleDynamics) has their arrays, shapes and units. Their updates
raise Error. Around them:

    run(scene)        a scene over time, computed as it is looked at
    open(folder)      a stored run
    surface(image)    the membrane as triangles
    boundary(image)   the boundary of two phases as lines
    measures(image)   area, volume, energies, topology
    arrays(data)      the arrays of any VTK data set, as numpy views
    update(algorithm) runs an algorithm; what it reports is raised as Error

Lengths and energies are in units of your choice; the drag coefficient is 1, so time is in length^4 / energy. K_M = -2
on the unit sphere.
"""

import vtkmodules.vtkCommonExecutionModel  # what the wrapped classes are made from
import vtkmodules.vtkFiltersCore  # noqa: F401

from ._classes import *  # noqa: F401,F403
from ._classes import CLASSES
from ._data import Error, arrays, update
from ._run import Frame, Run, open, run

__all__ = CLASSES + ["Error", "Frame", "Run", "arrays", "boundary", "measures", "open", "run", "surface", "update"]
