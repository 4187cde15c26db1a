"""Scenes and stored runs as sequences of frames."""

import operator
import os
from collections.abc import Mapping

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from . import _scene
from ._classes import boundary, surface, vtkVesicleRunReader, vtkVesicleSceneReader
from ._data import Error, alone, arrays, fields, number, records, time_of, update, what


class Frame:
    """A vesicle at one time. All of it is its own: what is written into it changes nothing else.

    time      of the state
    phi       level set, negative inside; float64, shape (nz, ny, nx)
    psi, c    phases (negative in Ld) and local stretch, likewise; None where there are none
    fields    these and material fields by their names: dict of arrays, likewise
    measures  dict of floats, named as the columns of the history: energy, P, sigma, A, V, v, ...
    image     all of it as vtkImageData, for VTK filters; phi and fields are views of its arrays
    """

    def __init__(self, image):
        self.image = vtkImageData()
        self.image.DeepCopy(image)
        self.time = time_of(image)
        self.measures = fields(image)
        found = arrays(self.image)
        self.phi, self.psi, self.c = found["phi"], found.get("psi"), found.get("c")
        self.fields = {name: view for name, view in found.items() if name != "phi"}

    def surface(self, **properties):
        """The membrane as triangles: vtkPolyData, see vtkMembraneSurface."""
        return surface(self, **properties)

    def boundary(self):
        """The boundary of two phases as closed lines: vtkPolyData, see vtkPhaseBoundary."""
        return boundary(self)

    def __repr__(self):
        return f"<lamella.Frame at t = {self.time:g}>"

    def __reduce__(self):
        own = {name: numpy.array(view) for name, view in arrays(self.image).items()}
        return _frame, (self.time, self.image.GetOrigin(), self.image.GetSpacing(), own, self.measures)


def _frame(time, origin, spacing, own, measures):
    """What Frame.__reduce__() has taken apart."""
    image = vtkImageData()
    image.SetDimensions(*reversed(own["phi"].shape))
    image.SetOrigin(origin)
    image.SetSpacing(spacing)
    for name, values in own.items():
        _add(image.GetPointData(), name, values.ravel())
    image.GetPointData().SetActiveScalars("phi")
    for name, value in measures.items():
        _add(image.GetFieldData(), name, numpy.array([value]))
    image.GetInformation().Set(vtkImageData.DATA_TIME_STEP(), time)
    return Frame(image)


def _add(attributes, name, values):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    attributes.AddArray(array)


class Run:
    """A scene or a stored run over time: iterate over it for the frames at `times`, len() of them; index
    it by number or slice, or ask for any time with at(). Threads that share one take turns."""

    def __init__(self, reader):
        self.reader = reader
        reader.UpdateInformation()
        info = reader.GetOutputInformation(0)
        steps = info.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
        if steps is None:
            update(reader)  # raises what is wrong
        self.times = numpy.array(steps)

    def at(self, time):
        """The Frame at a time, computed where it is not there yet. Raises Error where the run
        stopped before."""
        time = number(time)
        with alone([self.reader]):
            image = update(self.reader, time).GetOutputDataObject(0)
            if image.GetNumberOfPoints() == 0:
                raise Error("the run was aborted before it had started")
            return Frame(image)

    @property
    def history(self):
        """The start and every step, as far as they are stored, or computed until now: dict of float64
        arrays, shape (rows,), named as the columns of history.csv."""
        return arrays(self._table(1))

    @property
    def events(self):
        """What happened in these steps: a list of dicts with the columns of events.csv, `kind`
        ("fission", "rupture", ...), `t`, `x`, `y`, `z`, `size`, ..."""
        return records(self._table(2))

    @property
    def components(self):
        """Each of several vesicles in these steps: dict of float64 arrays, shape (rows,), named as the
        columns of components.csv, `t`, `component`, `x`, `y`, `z`, `V`, `A`, `P`, `sigma`, ...; a row a
        step and vesicle, none while there is one, or where [volume] and [area] are of all together."""
        return arrays(self._table(3))

    def _table(self, port):
        """A copy."""
        with alone([self.reader]):
            table = self.reader.GetOutputDataObject(port)
            if table.GetNumberOfColumns() == 0:  # nothing was asked for yet
                self.at(self.times[0])
            copy = table.NewInstance()
            copy.DeepCopy(table)
            return copy

    def __len__(self):
        return len(self.times)

    def __getitem__(self, number_or_slice):
        """The frame of a number; of a slice, a list of frames."""
        if isinstance(number_or_slice, slice):
            return [self.at(time) for time in self.times[number_or_slice]]
        return self.at(self.times[operator.index(number_or_slice)])

    def __iter__(self):
        return (self.at(time) for time in self.times)

    def __repr__(self):
        return f"<lamella.Run of {len(self)} frames until t = {self.times[-1]:g}>"


def run(scene, overrides=()):
    """A Run of a scene, computed as it is looked at.

    scene      a scene file, the name of a built-in scene, or a dict of sections:
               {"shape": {"kind": "sphere", "radius": 0.6}, "run": {"end_time": 1e-3}}; what is None
               in it has its default, and files count from the current folder
    overrides  "section.key=value", one or several, in place of what the scene says

    Raises Error for a mistake in the scene, with the key and what is allowed.
    """
    reader = vtkVesicleSceneReader()
    for setting in [overrides] if isinstance(overrides, str) else overrides or ():
        reader.AddOverride(_scene.override_of(setting))
    if isinstance(scene, Mapping):
        reader.SetSceneText(_scene.text_of(scene))
    elif isinstance(scene, (str, bytes, os.PathLike)):
        reader.SetFileName(_scene.whole_path(scene))
    else:
        raise Error(f"a scene is a file, the name of a built-in scene, or a dict of sections, not {what(scene)}")
    return Run(reader)


def open(folder):
    """The Run that `lamella run` stored in a folder. Raises Error where there is none."""
    if not isinstance(folder, (str, bytes, os.PathLike)):
        raise Error(f"open() takes the folder of a run, not {what(folder)}")
    reader = vtkVesicleRunReader()
    reader.SetFileName(_scene.whole_path(folder))
    return Run(reader)
