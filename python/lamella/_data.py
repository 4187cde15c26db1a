"""VTK data as numpy arrays, errors as exceptions."""

import contextlib
import math
import re
import signal
import sys
import threading
import warnings

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkFieldData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from . import _update, vtkLamellaFilters

WRAPPED = tuple(one for one in vars(vtkLamellaFilters).values()
                if isinstance(one, type) and issubclass(one, vtkAlgorithm))


class Error(RuntimeError):
    """What cannot be computed, and what would be right, in the words of the solver."""


class Raising:
    """An algorithm whose updates raise Error, as those of update() do."""


def _raising(name):
    def method(self, *arguments):
        return _updated(self, lambda: getattr(super(Raising, self), name)(*arguments))

    method.__name__ = name
    method.__doc__ = getattr(vtkAlgorithm, name).__doc__
    return method


for _name in ("Update", "UpdateDataObject", "UpdateExtent", "UpdateInformation", "UpdatePiece", "UpdateTimeStep",
              "UpdateWholeExtent"):
    setattr(Raising, _name, _raising(_name))


def update(algorithm, time=None):
    """Update an algorithm, at a time if one is given, and return it. Raises Error for what it, or
    an algorithm before it, reports; its warnings become Python's. Other threads go on meanwhile; a
    signal (Ctrl-C) ends it within a step, and the next update goes on from there."""
    if not isinstance(algorithm, vtkAlgorithm):
        raise Error(f"update() takes a VTK algorithm, not {what(algorithm)}")
    plain = super(Raising, algorithm) if isinstance(algorithm, Raising) else algorithm
    if time is None:
        _updated(algorithm, plain.Update)
    else:
        time = number(time)
        _updated(algorithm, lambda: plain.UpdateTimeStep(time))
    return algorithm


def _updated(algorithm, function):
    """Calls a function that updates an algorithm; its result."""
    pipeline, results = _pipeline(algorithm), []
    with alone(pipeline), _Signals() as signals:
        errors, remarks = _update.run(lambda: results.append(function()), pipeline,
                                      [one for one in pipeline if isinstance(one, WRAPPED)], signals.hear)
    signals.hear()
    for remark in remarks:
        warnings.warn(_plain(remark), stacklevel=_users_level())
    if errors:
        raise Error("\n".join(_plain(error) for error in errors))
    return results[0]


def _plain(report):
    """A report of VTK without the place in its source and addresses."""
    text = re.sub(r"^(ERROR|Warning): .*\n[^:]*: ", "", report).strip()
    return re.sub(r" ?\(0x[0-9a-f]+\)", "", text)


def _users_level():
    """How many calls up is what is not of this package, for warnings.warn."""
    frame, level = sys._getframe(1), 1
    while frame.f_back and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    return level


class _Signals:
    """Keeps signals until they are heard: VTK ends the program where a handler raises in an observer."""

    def __enter__(self):
        self.handlers, self.waiting = {}, []
        if threading.current_thread() is threading.main_thread():  # where handlers run
            for number in signal.valid_signals():
                handler = signal.getsignal(number)
                if callable(handler):
                    self.handlers[number] = handler
                    signal.signal(number, lambda *received: self.waiting.append(received))
        return self

    def __exit__(self, *_):
        for number, handler in self.handlers.items():
            signal.signal(number, handler)

    def hear(self):
        while self.waiting:
            number, frame = self.waiting.pop(0)
            self.handlers[number](number, frame)


_computing = threading.Condition()
_owners = {}  # thread and depth by algorithm


@contextlib.contextmanager
def alone(algorithms):
    """The algorithms for this thread alone; waits for others that compute with one of them."""
    me, held = threading.get_ident(), []
    try:
        with _computing:
            _computing.wait_for(lambda: all(_owners.get(one, (me, 0))[0] == me for one in algorithms))
            for one in algorithms:
                _owners[one] = (me, _owners.get(one, (me, 0))[1] + 1)
                held.append(one)
        yield
    finally:
        with _computing:
            for one in held:
                depth = _owners.pop(one)[1] - 1
                if depth:
                    _owners[one] = (me, depth)
            _computing.notify_all()


def what(thing):
    """A wrong argument, in words."""
    return repr(thing) if thing is None or isinstance(thing, (str, int, float)) else f"a {type(thing).__name__}"


def number(time):
    try:
        value = float(time)
    except (TypeError, ValueError):
        raise Error(f"a time is a number, not {what(time)}") from None
    if math.isnan(value):
        raise Error("a time is a number, not nan")
    return value


def arrays(data):
    """The arrays of a data set (of its points, else its cells), of a table, or of field data, by
    name. Views without copies: shape (tuples,), or (tuples, components), for images
    (nz, ny, nx[, components])."""
    if not isinstance(data, (vtkDataObject, vtkFieldData)):
        raise Error(f"arrays() takes a VTK data set, a table or field data, not {what(data)}")
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


def records(table):
    """The rows of a table as dicts: floats, and text where a column has text."""
    columns = [table.GetColumn(index) for index in range(table.GetNumberOfColumns())]

    def value(column, row):
        return column.GetValue(row) if column.IsA("vtkStringArray") else column.GetTuple1(row)

    return [{column.GetName(): value(column, row) for column in columns}
            for row in range(table.GetNumberOfRows())]


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
