"""Scenes and stored runs as sequences of frames."""

import builtins
import os
import shutil
import tempfile
import weakref

import numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ._data import arrays, boundary, fields, records, surface, time_of, update
from .vtkLamellaFilters import vtkVesicleRunReader, vtkVesicleSceneReader


class Frame:
    """A vesicle at one time.

    time      of the state
    phi       level set, negative inside; float64, shape (nz, ny, nx), a view without a copy
    psi, c    phases (negative in Ld) and local stretch, likewise; None where there are none
    measures  dict of floats, named as the columns of the history: energy, P, sigma, A, V, v, ...
    image     all of it as vtkImageData, for VTK filters
    """

    def __init__(self, image):
        self.image = vtkImageData()
        self.image.ShallowCopy(image)
        self.time = time_of(image)
        self.measures = fields(image)
        found = arrays(self.image)
        self.phi, self.psi, self.c = found["phi"], found.get("psi"), found.get("c")

    def surface(self, **properties):
        """The membrane as triangles: vtkPolyData, see vtkMembraneSurface."""
        return surface(self, **properties)

    def boundary(self):
        """The boundary of two phases as closed lines: vtkPolyData, see vtkPhaseBoundary."""
        return boundary(self)

    def __repr__(self):
        return f"<lamella.Frame at t = {self.time:g}>"


class Run:
    """A scene or a stored run over time: iterate over it for the frames at `times`, len() of them; index
    it by number, or ask for any time with at()."""

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
        return Frame(update(self.reader, float(time)).GetOutputDataObject(0))

    @property
    def history(self):
        """The start and every step until the frame last asked for, as dict of float64 arrays,
        shape (rows,), named as the columns of history.csv."""
        return arrays(self.reader.GetOutputDataObject(1))

    @property
    def events(self):
        """What happened until the frame last asked for: a list of dicts with the columns of
        events.csv, `kind` ("fission", "rupture", ...), `t`, `x`, `y`, `z`, `size`, ..."""
        return records(self.reader.GetOutputDataObject(2))

    def __len__(self):
        return len(self.times)

    def __getitem__(self, number):
        return self.at(self.times[number])

    def __iter__(self):
        return (self.at(time) for time in self.times)


def run(scene, overrides=()):
    """A Run of a scene, computed as it is looked at.

    scene      a scene file, the name of a built-in scene, or a dict of sections:
               {"shape": {"kind": "sphere", "radius": 0.6}, "run": {"end_time": 1e-3}}
    overrides  "section.key=value", in place of what the scene says

    Raises Error for a mistake in the scene, with the key and what is allowed.
    """
    reader = vtkVesicleSceneReader()
    for setting in overrides:
        reader.AddOverride(setting)
    if not isinstance(scene, dict):
        reader.SetFileName(os.fspath(scene))
        return Run(reader)
    folder = tempfile.mkdtemp(prefix="lamella-")
    file = os.path.join(folder, "scene.toml")
    with builtins.open(file, "w", encoding="utf-8") as stream:
        stream.write(_toml(scene))
    weakref.finalize(reader, shutil.rmtree, folder, ignore_errors=True)  # there as long as it
    reader.SetFileName(file)
    return Run(reader)


def open(folder):
    """The Run that `lamella run` stored in a folder. Raises Error where there is none."""
    reader = vtkVesicleRunReader()
    reader.SetFileName(os.fspath(folder))
    return Run(reader)


def _toml(scene):
    """Sections of keys as TOML."""
    top = {key: value for key, value in scene.items() if not isinstance(value, dict)}
    lines = [f"{key} = {_value(value)}" for key, value in top.items()]
    for section, keys in scene.items():
        if isinstance(keys, dict):
            lines.append(f"[{section}]")
            lines += [f"{key} = {_value(value)}" for key, value in keys.items()]
    return "\n".join(lines) + "\n"


def _value(value):
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (list, tuple, numpy.ndarray)):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    if isinstance(value, (float, numpy.floating)):
        return repr(float(value))
    return str(value)
