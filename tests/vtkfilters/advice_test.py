"""What messages about surfaces and images advise, done with VTK's filters: it then works."""

import math
import re
import unittest
import warnings

import lamella
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData, vtkPolyDataConnectivityFilter
from vtkmodules.vtkFiltersGeneral import vtkBooleanOperationPolyDataFilter
from vtkmodules.vtkFiltersModeling import vtkFillHolesFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import (vtkImageChangeInformation, vtkImageExtractComponents, vtkImageResample, vtkImageReslice,
                                       vtkImageThreshold)
from vtkmodules.vtkImagingMath import vtkImageMathematics


def ball(radius):
    return 4 / 3 * math.pi * radius**3


def sphere(radius, center=(0, 0, 0)):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetCenter(center)
    source.SetThetaResolution(40)
    source.SetPhiResolution(40)
    source.Update()
    return source.GetOutput()


def with_triangles(mesh, wanted):
    """The triangles whose numbers are wanted, with points of their own as an STL file has them."""
    points, cells = vtkPoints(), vtkCellArray()
    for number in range(mesh.GetNumberOfCells()):
        if wanted(number):
            cell = mesh.GetCell(number)
            cells.InsertNextCell(3)
            for corner in range(3):
                cells.InsertCellPoint(points.InsertNextPoint(mesh.GetPoint(cell.GetPointId(corner))))
    out = vtkPolyData()
    out.SetPoints(points)
    out.SetPolys(cells)
    return out


def both(first, second):
    append = vtkAppendPolyData()
    append.AddInputData(first)
    append.AddInputData(second)
    append.Update()
    return append.GetOutput()


def image_of(values, direction=None, origin=(0, 0, 0)):
    """An image of voxels of size 1, from an array [k, j, i]."""
    image = vtkImageData()
    image.SetDimensions(values.shape[::-1])
    image.SetOrigin(origin)
    if direction is not None:
        image.SetDirectionMatrix(numpy.asarray(direction).ravel())
    array = numpy_to_vtk(numpy.ascontiguousarray(values).ravel(), deep=True)
    array.SetName("phi")
    image.GetPointData().SetScalars(array)
    return image


def radii(nodes, center=None):
    """The distance of each voxel from a place, of the middle unless told."""
    center = [(nodes - 1) / 2] * 3 if center is None else center
    k, j, i = numpy.meshgrid(*[numpy.arange(nodes)] * 3, indexing="ij")
    return numpy.sqrt((i - center[0])**2 + (j - center[1])**2 + (k - center[2])**2)


def from_surface():
    vesicle = lamella.vtkVesicleFromSurface()
    vesicle.SetNodes(32, 32, 32)
    return vesicle


def filtered(vtk_filter, data):
    vtk_filter.SetInputData(data)
    vtk_filter.Update()
    return vtk_filter.GetOutput()


class Advice(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")
        self.addCleanup(warnings.resetwarnings)

    def complaint(self, algorithm, data):
        """What an algorithm says is wrong."""
        algorithm.SetInputData(data)
        with self.assertRaises(lamella.Error) as caught:
            lamella.update(algorithm)
        return str(caught.exception)

    def volume(self, algorithm, data):
        algorithm.SetInputData(data)
        return lamella.measures(lamella.update(algorithm).GetOutput())["V"]

    def number(self, pattern, text):
        """The numbers in a message."""
        found = re.search(pattern, text)
        self.assertIsNotNone(found, text)
        return [float(number) for number in found[1].split(", ")]

    def test_holes_are_filled(self):
        mesh = sphere(0.5)
        torn = with_triangles(mesh, lambda number: number not in (100, 101, 102, 700))
        said = self.complaint(from_surface(), torn)
        self.assertIn("vtkCleanPolyData and then vtkFillHolesFilter", said)
        fill = vtkFillHolesFilter()
        fill.SetHoleSize(*self.number(r"SetHoleSize\(([^)]*)\)", said))
        closed = filtered(fill, filtered(vtkCleanPolyData(), torn))
        self.assertAlmostEqual(self.volume(from_surface(), closed) / ball(0.5), 1, delta=0.02)

    def test_open_parts_beside_the_largest_go(self):
        scraps = with_triangles(sphere(0.1, (0.8, 0.3, 0)), lambda number: number < 40)
        mesh = both(sphere(0.5), scraps)
        said = self.complaint(from_surface(), mesh)
        self.assertIn("SetExtractionModeToLargestRegion()", said)
        largest = vtkPolyDataConnectivityFilter()
        largest.SetExtractionModeToLargestRegion()
        part = filtered(largest, filtered(vtkCleanPolyData(), mesh))
        self.assertAlmostEqual(self.volume(from_surface(), part) / ball(0.5), 1, delta=0.02)

    def test_small_parts_far_away_go(self):
        mesh = both(sphere(0.5), sphere(0.1, (100, 0, 0)))
        vesicle = from_surface()
        vesicle.ScaleToBoxOn()
        self.assertIn("vtkPolyDataConnectivityFilter with SetExtractionModeToLargestRegion()",
                      self.complaint(vesicle, mesh))
        largest = vtkPolyDataConnectivityFilter()
        largest.SetExtractionModeToLargestRegion()
        self.assertAlmostEqual(self.volume(vesicle, filtered(largest, mesh)) / ball(0.7), 1, delta=0.02)

    def test_parts_that_overlap_are_joined(self):
        one, other = sphere(0.4, (-0.2, 0.013, 0.007)), sphere(0.4, (0.2, 0, 0))
        said = self.complaint(from_surface(), both(one, other))
        self.assertIn("vtkBooleanOperationPolyDataFilter", said)
        union = vtkBooleanOperationPolyDataFilter()
        union.SetOperationToUnion()
        union.SetInputData(0, one)
        union.SetInputData(1, other)
        union.Update()
        d = math.dist((-0.2, 0.013, 0.007), (0.2, 0, 0))
        exact = 2 * ball(0.4) - math.pi * (4 * 0.4 + d) * (2 * 0.4 - d)**2 / 12
        self.assertAlmostEqual(self.volume(from_surface(), union.GetOutput()) / exact, 1, delta=0.02)

    def test_turned_images_are_resliced(self):
        turn = numpy.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])
        origin, at = numpy.array([5., 6, 7]), (18, 20, 22)
        mask = image_of((radii(40, at) <= 10).astype(numpy.uint8), turn, origin)
        level = image_of(radii(40, at) - 10, turn, origin)
        place = origin + turn @ at
        for image, cubic in ((mask, False), (level, True)):
            said = self.complaint(lamella.vtkVesicleFromImage(), image)
            self.assertIn("AutoCropOutputOn()", said)
            reslice = vtkImageReslice()
            reslice.SetResliceAxesDirectionCosines(
                *self.number(r"SetResliceAxesDirectionCosines\(([^)]*)\)", said))
            reslice.SetResliceAxesOrigin(*self.number(r"SetResliceAxesOrigin\(([^)]*)\)", said))
            reslice.AutoCropOutputOn()
            if cubic:
                reslice.SetInterpolationModeToCubic()
                reslice.SetBackgroundLevel(image.GetScalarRange()[1])
            vesicle = lamella.vtkVesicleFromImage()
            self.assertAlmostEqual(self.volume(vesicle, filtered(reslice, image)) / ball(10), 1, delta=0.02)
            bounds = lamella.surface(vesicle.GetOutput()).GetBounds()
            for axis in range(3):
                self.assertAlmostEqual(sum(bounds[2 * axis:2 * axis + 2]) / 2, place[axis], delta=0.3)

    def test_level_sets_are_turned_round(self):
        image = image_of(12 - radii(40))
        said = self.complaint(lamella.vtkVesicleFromImage(), image)
        self.assertIn("SetOperationToMultiplyByK() and SetConstantK(-1)", said)
        times = vtkImageMathematics()
        times.SetOperationToMultiplyByK()
        times.SetConstantK(-1)
        self.assertAlmostEqual(self.volume(lamella.vtkVesicleFromImage(), filtered(times, image)) / ball(12), 1,
                               delta=1e-3)

    def test_gray_values_become_masks(self):
        for image in (image_of(numpy.round(200 / (1 + numpy.exp(radii(40) - 12))).astype(numpy.uint8)),
                      image_of(1 / (1.1 + numpy.exp(radii(40) - 12)))):
            self.assertIn("vtkImageThreshold makes", self.complaint(lamella.vtkVesicleFromImage(), image))
            threshold = vtkImageThreshold()
            threshold.ThresholdByUpper(image.GetScalarRange()[1] / 2)
            threshold.SetInValue(1)
            threshold.SetOutValue(0)
            self.assertAlmostEqual(self.volume(lamella.vtkVesicleFromImage(), filtered(threshold, image)) / ball(12),
                                   1, delta=0.03)

    def test_colours_lose_two(self):
        mask = numpy.repeat((radii(40) <= 12)[..., None], 3, axis=3).astype(numpy.uint8)
        image = image_of(mask[..., 0])
        array = numpy_to_vtk(mask.reshape(-1, 3), deep=True)
        array.SetName("phi")
        image.GetPointData().SetScalars(array)
        self.assertIn("vtkImageExtractComponents with SetComponents(0)",
                      self.complaint(lamella.vtkVesicleFromImage(), image))
        first = vtkImageExtractComponents()
        first.SetComponents(0)
        self.assertAlmostEqual(self.volume(lamella.vtkVesicleFromImage(), filtered(first, image)) / ball(12), 1,
                               delta=0.01)

    def test_small_masks_get_smaller_voxels(self):
        image = image_of((radii(25) <= 2.3).astype(numpy.uint8))
        said = self.complaint(lamella.vtkVesicleFromImage(), image)
        finer = vtkImageResample()
        finer.SetInterpolationModeToNearestNeighbor()
        finer.SetMagnificationFactors(*self.number(r"SetMagnificationFactors\(([^)]*)\)", said))
        voxels = numpy.count_nonzero(radii(25) <= 2.3)
        self.assertAlmostEqual(self.volume(lamella.vtkVesicleFromImage(), filtered(finer, image)) / voxels, 1,
                               delta=0.1)

    def test_parts_near_each_other_get_smaller_voxels(self):
        k, j, i = numpy.meshgrid(*[numpy.arange(36)] * 3, indexing="ij")
        near = (abs(j - 17.5) < 7) & (abs(k - 17.5) < 7) & (((i > 3) & (i < 17)) | ((i > 19) & (i < 33)))
        image = image_of(near.astype(numpy.uint8))
        said = self.complaint(lamella.vtkVesicleFromImage(), image)
        self.assertIn("too near", said)
        finer = vtkImageResample()
        finer.SetInterpolationModeToNearestNeighbor()
        finer.SetMagnificationFactors(*self.number(r"SetMagnificationFactors\(([^)]*)\)", said))
        vesicle = lamella.vtkVesicleFromImage()
        self.assertAlmostEqual(self.volume(vesicle, filtered(finer, image)) / numpy.count_nonzero(near), 1, delta=0.03)
        self.assertEqual(lamella.measures(vesicle.GetOutput())["components"], 2)

    def test_units_are_changed(self):
        for spacing in (1e-15, 1e15):
            image = image_of((radii(30) <= 9).astype(numpy.uint8), origin=(5 * spacing, 0, 0))
            image.SetSpacing([spacing] * 3)
            dynamics = lamella.vtkVesicleDynamics()
            dynamics.SetEndTime(1e-9)
            said = self.complaint(dynamics, image)
            change = vtkImageChangeInformation()
            change.SetSpacingScale(*self.number(r"SetSpacingScale\(([^)]*)\)", said))
            change.SetOriginScale(*self.number(r"SetOriginScale\(([^)]*)\)", said))
            dynamics = lamella.vtkVesicleDynamics()
            dynamics.SetEndTime(1e-9)
            dynamics.SetInputData(filtered(change, image))
            frame = lamella.Frame(lamella.update(dynamics).GetOutput())
            volume = numpy.count_nonzero(radii(30) <= 9) * (spacing * change.GetSpacingScale()[0])**3
            self.assertAlmostEqual(frame.measures["V"] / volume, 1, delta=1e-3)

    def test_few_thick_slices_get_smaller_voxels(self):
        k, j, i = numpy.meshgrid(numpy.arange(7), numpy.arange(32), numpy.arange(32), indexing="ij")
        inside = numpy.sqrt((i - 15.5)**2 + (j - 15.5)**2 + (4 * (k - 3))**2) <= 11
        image = image_of(inside.astype(numpy.uint8))
        image.SetSpacing(1, 1, 4)
        said = self.complaint(lamella.vtkVesicleFromImage(), image)
        finer = vtkImageResample()
        finer.SetInterpolationModeToNearestNeighbor()
        finer.SetMagnificationFactors(*self.number(r"SetMagnificationFactors\(([^)]*)\)", said))
        self.assertAlmostEqual(self.volume(lamella.vtkVesicleFromImage(), filtered(finer, image)) / ball(11), 1,
                               delta=0.15)

    def test_gaps_of_membranes_are_closed_and_filled(self):
        r = radii(48)
        j, i = numpy.meshgrid(numpy.arange(48), numpy.arange(48), indexing="ij")
        wall = (r <= 18) & (r > 14) & (numpy.hypot(i - 23.5, j - 23.5) > 3)
        image = image_of(wall.astype(numpy.uint8))
        vesicle = lamella.vtkVesicleFromImage()
        vesicle.SetInputData(image)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            lamella.update(vesicle)
        self.assertIn("close its gaps (by a morphological closing), and vtkVesicleFromImage with FillCavitiesOn()",
                      str(said[0].message))

        def grown(inside):
            """Voxels within 3.6 of the inside."""
            steps = [step for step in numpy.ndindex(7, 7, 7) if math.dist(step, (3, 3, 3)) <= 3.6]
            return numpy.any([numpy.roll(inside, numpy.subtract(step, 3), (0, 1, 2)) for step in steps], axis=0)

        closed = ~grown(~grown(wall))
        vesicle = lamella.vtkVesicleFromImage()
        vesicle.FillCavitiesOn()
        self.assertAlmostEqual(self.volume(vesicle, image_of(closed.astype(numpy.uint8))) / ball(18), 1, delta=0.03)


if __name__ == "__main__":
    unittest.main()
