"""What the tests of the plugin have in common: the plugin loaded, messages caught, pictures compared."""

import contextlib
import os

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOImage import vtkPNGReader

PLUGIN = os.environ["LAMELLA_PLUGIN"]
HERE = os.path.dirname(os.path.abspath(__file__))
BASELINES = os.path.join(HERE, "baselines")
EXAMPLES = os.path.join(HERE, "..", "..", "docs", "examples", "paraview")


def load_plugin(remote=False):
    simple.LoadPlugin(PLUGIN, remote=remote, ns=vars(simple))


@contextlib.contextmanager
def messages():
    """What is reported meanwhile: a list of one text, once it is over."""
    before, window, texts = vtkOutputWindow.GetInstance(), vtkStringOutputWindow(), []
    vtkOutputWindow.SetInstance(window)
    try:
        yield texts
    finally:
        vtkOutputWindow.SetInstance(before)
        texts.append(window.GetOutput())


def measures(source):
    """Field data of the membrane, by name."""
    data = simple.servermanager.Fetch(source).GetFieldData()
    return {data.GetArrayName(n): data.GetArray(n).GetValue(0)
            for n in range(data.GetNumberOfArrays()) if data.GetArray(n)}


def picture_of(source, file, time=0, size=(320, 320)):
    """Draws the membrane and the phase boundary, as Apply does, from aside."""
    view = simple.CreateView("RenderView")
    view.ViewSize, view.ViewTime = size, time
    view.OrientationAxesVisibility = 0
    simple.Show(source, view)
    simple.Show(simple.OutputPort(source, 1), view)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [3, -6, 3], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    simple.SaveScreenshot(file, view)
    simple.Delete(view)


def pixels(file):
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3]


def difference(file, other, block=8):
    """Of two pictures as seen from afar: root mean square over blocks of pixels, 0 to 255."""
    a, b = (pixels(name).astype(float) for name in (file, other))
    if a.shape != b.shape:
        raise AssertionError(f"{file} is {a.shape}, {other} {b.shape}")
    rows, columns = a.shape[0] // block, a.shape[1] // block
    blocks = (a - b)[:rows * block, :columns * block].reshape(rows, block, columns, block, 3)
    return float(numpy.sqrt((blocks.mean(axis=(1, 3)) ** 2).mean()))
