"""The VTK classes, with updates that raise Error; functions that run one of them."""

from vtkmodules.vtkCommonDataModel import vtkDataObject

from ._data import WRAPPED, Error, Raising, arrays, update, what

for _class in WRAPPED:
    globals()[_class.__name__] = type(_class.__name__, (Raising, _class),
                                      {"__doc__": _class.__doc__, "__module__": __package__})

CLASSES = [one.__name__ for one in WRAPPED]
__all__ = CLASSES + ["boundary", "measures", "surface"]


def surface(image, **properties):
    """The membrane of an image or a Frame as vtkPolyData, see vtkMembraneSurface. Properties by their
    VTK names: surface(image, Refinement=3)."""
    return _filtered("vtkMembraneSurface", image, properties)


def boundary(image, **properties):
    """The boundary of two phases as vtkPolyData, see vtkPhaseBoundary."""
    return _filtered("vtkPhaseBoundary", image, properties)


def measures(image, **properties):
    """What vtkMembraneMeasures measures, by name: floats."""
    table = _filtered("vtkMembraneMeasures", image, properties)
    return {name: float(column[0]) for name, column in arrays(table).items()}


def _filtered(name, image, properties):
    algorithm, data = globals()[name](), getattr(image, "image", image)
    if not isinstance(data, vtkDataObject):
        raise Error(f"{name} takes a Frame or a vtkImageData, not {what(image)}")
    algorithm.SetInputData(data)
    for key, value in properties.items():
        _set(algorithm, key, value)
    return update(algorithm).GetOutputDataObject(0)


def _set(algorithm, name, value):
    setter = getattr(algorithm, "Set" + name, None)
    if setter is None:
        raise Error(f"{algorithm.GetClassName()} has no property {name}")
    try:
        setter(value)
    except (TypeError, ValueError) as error:
        raise Error(f"{algorithm.GetClassName()}, {name} = {value!r}: {error}") from None
