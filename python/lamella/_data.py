"""VTK data as numpy arrays, errors as exceptions."""

import re
import warnings

from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkDataObject

from .vtkLamellaFilters import vtkMembraneMeasures, vtkMembraneSurface, vtkPhaseBoundary


class Error(RuntimeError):
    """What cannot be computed, and what would be right, in the words of the solver."""


def update(algorithm, time=None):
    """Update an algorithm, at a time if one is given, and return it. Raises Error for what it, or
    an algorithm before it, reports; its warnings become Python's."""
    errors, remarks = [], []

    def noting(texts):
        @calldata_type(VTK_STRING)
        def note(_caller, _event, text):
            texts.append(re.sub(r"^(ERROR|Warning): .*\n[^:]*: ", "", text).strip())

        return note

    watched = [(a, a.AddObserver(event, noting(texts))) for a in _pipeline(algorithm)
               for event, texts in (("ErrorEvent", errors), ("WarningEvent", remarks))]
    try:
        if time is None:
            algorithm.Update()
        else:
            algorithm.UpdateTimeStep(time)
    finally:
        for one, tag in watched:
            one.RemoveObserver(tag)
    for remark in remarks:
        warnings.warn(remark, stacklevel=2)
    if errors:
        raise Error("\n".join(errors))
    return algorithm


def arrays(data):
    """The arrays of a data set (of its points, else its cells), of a table, or of field data, by
    name. Views without copies: shape (tuples,), or (tuples, components), for images
    (nz, ny, nx[, components])."""
    points = data.GetPointData() if hasattr(data, "GetPointData") else data.GetRowData() if hasattr(
        data, "GetRowData") else data
    shape = tuple(reversed(data.GetDimensions())) if data.IsA("vtkImageData") else (-1,)
    views = {}
    for index in range(points.GetNumberOfArrays()):
        array = points.GetArray(index)
        if array is not None:
            view = vtk_to_numpy(array)
            views[array.GetName()] = view.reshape(shape + view.shape[1:])
    return views


def surface(image, **properties):
    """The membrane of an image or a Frame as vtkPolyData, see vtkMembraneSurface. Properties by their
    VTK names: surface(image, Refinement=3)."""
    return _filtered(vtkMembraneSurface(), image, properties)


def boundary(image, **properties):
    """The boundary of two phases as vtkPolyData, see vtkPhaseBoundary."""
    return _filtered(vtkPhaseBoundary(), image, properties)


def measures(image, **properties):
    """What vtkMembraneMeasures measures, by name: floats."""
    table = _filtered(vtkMembraneMeasures(), image, properties)
    return {name: float(column[0]) for name, column in arrays(table).items()}


def _pipeline(algorithm):
    """An algorithm and all those before it."""
    found, left = [], [algorithm]
    while left:
        one = left.pop()
        if one is None or one in found:
            continue
        found.append(one)
        for port in range(one.GetNumberOfInputPorts()):
            for connection in range(one.GetNumberOfInputConnections(port)):
                left.append(one.GetInputAlgorithm(port, connection))
    return found


def _filtered(algorithm, image, properties):
    algorithm.SetInputData(getattr(image, "image", image))
    for name, value in properties.items():
        getattr(algorithm, "Set" + name)(value)
    return update(algorithm).GetOutputDataObject(0)


def records(table):
    """The rows of a table as dicts: floats, and text where a column has text."""
    columns = [table.GetColumn(index) for index in range(table.GetNumberOfColumns())]

    def value(column, row):
        return column.GetValue(row) if column.IsA("vtkStringArray") else column.GetTuple1(row)

    return [{column.GetName(): value(column, row) for column in columns} for row in range(table.GetNumberOfRows())]


def fields(data):
    """The field data that are single numbers, by name."""
    field_data = data.GetFieldData()
    found = {}
    for index in range(field_data.GetNumberOfArrays()):
        array = field_data.GetArray(index)
        if array is not None and array.GetNumberOfValues() == 1:
            found[array.GetName()] = array.GetTuple1(0)
    return found


def time_of(data):
    return data.GetInformation().Get(vtkDataObject.DATA_TIME_STEP())
