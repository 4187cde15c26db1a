"""The Python package: scenes from dicts and files, views without copies, errors as exceptions."""

import os
import tempfile
import unittest

import lamella
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

SCENE = {
    "title": 'a "quoted" title',
    "grid": {"nodes": 32},
    "shape": {"kind": "prolate", "semi_axis": 0.7, "reduced_volume": 0.8,
              "center": (0.05, 0, numpy.float64(0.1))},
    "run": {"end_time": 1e-4},
    "contact": {"topology_changes": True},
    "output": {"frames": 3},
}
TWO_PHASES = {
    "grid": {"nodes": [32, 32, 32]},
    "shape": {"kind": "prolate", "reduced_volume": 0.9},
    "domains": {"kind": "caps", "directions": [[0, 0, 1]], "half_angle": 60},
    "line": {"tension": 5},
    "run": {"end_time": 1e-5},
}

SHARP = {
    "grid": {"nodes": 24},
    "shape": {"kind": "prolate", "semi_axis": 0.7, "reduced_volume": 0.7},
    "run": {"end_time": 1e-6},
}


class Runs(unittest.TestCase):
    def test_frames_of_a_dict(self):
        run = lamella.run(SCENE)
        self.assertEqual(len(run), 3)
        numpy.testing.assert_allclose(run.times, [0, 5e-5, 1e-4])
        frames = list(run)
        self.assertEqual([frame.time for frame in frames], list(run.times))
        energies = [frame.measures["energy"] for frame in frames]
        self.assertEqual(energies, sorted(energies, reverse=True))
        self.assertIsNone(frames[0].psi)
        self.assertGreater(numpy.abs(frames[2].phi - frames[0].phi).max(), 1e-3)
        self.assertEqual(run[1].measures, frames[1].measures)

    def test_any_time(self):
        run = lamella.run(SCENE)
        frame = run.at(7e-5)
        self.assertAlmostEqual(frame.time, 7e-5, 15)
        self.assertLess(frame.measures["energy"], run[1].measures["energy"])

    def test_history(self):
        run = lamella.run(SCENE)
        run[-1]
        history = run.history
        self.assertEqual(history["t"][-1], 1e-4)
        self.assertGreater(len(history["t"]), 3)
        self.assertEqual(history["energy"].shape, history["t"].shape)
        self.assertTrue((numpy.diff(history["t"]) > 0).all())

    def test_events(self):
        run = lamella.run(SHARP)
        run[-1]
        self.assertEqual(run.events[0]["kind"], "sharp")
        self.assertLess(run.events[0]["size"], 2 / 24)
        smooth = lamella.run(SCENE)
        smooth[0]
        self.assertEqual(smooth.events, [])

    def test_scene_file_with_overrides(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "mine.toml")
            with open(file, "w", encoding="utf-8") as stream:
                stream.write("[shape]\nkind = 'sphere'\n")
            run = lamella.run(file, overrides=["grid.nodes=24", "output.frames=2"])
            self.assertEqual(run[0].phi.shape, (24, 24, 24))

    def test_two_phases(self):
        frame = lamella.run(TWO_PHASES)[-1]
        self.assertEqual(frame.psi.shape, (32, 32, 32))
        line = lamella.arrays(frame.boundary())
        self.assertGreater(len(line["kg"]), 20)
        self.assertEqual(line["tangent"].shape[1], 3)
        self.assertEqual(set(numpy.unique(lamella.arrays(frame.surface())["phase"])), {0, 1})


class Arrays(unittest.TestCase):
    def test_views_are_no_copies(self):
        frame = lamella.run(SCENE)[0]
        view = lamella.arrays(frame.image)["phi"]
        view[3, 4, 5] = 17
        self.assertEqual(frame.image.GetScalarComponentAsDouble(5, 4, 3, 0), 17)
        self.assertEqual(frame.phi[3, 4, 5], 17)

    def test_frames_keep_their_values(self):
        run = lamella.run(SCENE)
        first = run[0]
        before = first.phi.copy()
        run[-1]
        numpy.testing.assert_array_equal(first.phi, before)

    def test_surface(self):
        mesh = lamella.run(SCENE)[0].surface(Refinement=1)
        arrays = lamella.arrays(mesh)
        points = mesh.GetNumberOfPoints()
        self.assertEqual(arrays["Normals"].shape, (points, 3))
        self.assertEqual(arrays["K_M"].shape, (points,))
        self.assertLess(arrays["K_M"].max(), 0)

    def test_masks(self):
        nodes = numpy.indices((24, 24, 24)) - 11.5
        mask = (numpy.sqrt((nodes**2).sum(axis=0)) < 8).astype(numpy.uint8)
        image = vtkImageData()
        image.SetDimensions(24, 24, 24)
        image.GetPointData().AddArray(numpy_to_vtk(mask.ravel(), deep=True))
        with self.assertWarnsRegex(UserWarning, "^phi is 0 or 1: taken for a mask"):
            found = lamella.measures(image)
        self.assertAlmostEqual(found["V"] / mask.sum(), 1, 2)

    def test_measures(self):
        frame = lamella.run(SCENE)[0]
        found = lamella.measures(frame)
        self.assertAlmostEqual(found["A"], frame.measures["A"], 3)
        self.assertEqual(found["genus"], 0)


class Classes(unittest.TestCase):
    def test_pipeline(self):
        source = lamella.vtkVesicleSource()
        source.SetNodes(32, 32, 32)
        source.SetShapeReducedVolume(0.8)
        self.assertEqual(source.GetNodes(), (32, 32, 32))
        dynamics = lamella.vtkVesicleDynamics()
        dynamics.SetInputConnection(source.GetOutputPort())
        dynamics.SetEndTime(1e-5)
        surface = lamella.vtkMembraneSurface()
        surface.SetInputConnection(dynamics.GetOutputPort())
        lamella.update(surface, 1e-5)
        self.assertIn("velocity", lamella.arrays(surface.GetOutput()))

    def test_properties_say_what_they_are(self):
        help_text = lamella.vtkVesicleDynamics.SetBendingModulus.__doc__
        self.assertIn("[membrane] bending_modulus", help_text)
        for name in lamella.__all__:
            self.assertTrue(getattr(lamella, name).__doc__, name)


class Errors(unittest.TestCase):
    def check(self, action, *words):
        with self.assertRaises(lamella.Error) as caught:
            action()
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("ERROR", str(caught.exception))

    def test_scenes(self):
        self.check(lambda: lamella.run({"shape": {"kind": "spher"}}), "[shape] kind", "sphere")
        self.check(lambda: lamella.run({"membrane": {"bending_modulus": -1}}), "bending_modulus")
        self.check(lambda: lamella.run("fig3_oblat"), "fig3_oblate")
        self.check(lambda: lamella.run(SCENE, ["grid.nodes=33"]), "multiple of 8")

    def test_stored_runs(self):
        self.check(lambda: lamella.open("/no/such/folder"), "no such file or folder")

    def test_data(self):
        self.check(lambda: lamella.surface(vtkImageData()), "the image is empty")
        self.check(lambda: lamella.run(SCENE)[0].boundary(), "one phase")
        vesicle = lamella.vtkVesicleFromSurface()
        vesicle.SetInputData(vtkPolyData())
        self.check(lambda: lamella.update(vesicle), "no triangles")

    def test_those_of_filters_before(self):
        source = lamella.vtkVesicleSource()
        source.SetShapeSemiAxis(5)
        dynamics = lamella.vtkVesicleDynamics()
        dynamics.SetInputConnection(source.GetOutputPort())
        self.check(lambda: lamella.update(dynamics), "[shape] semi_axis")


if __name__ == "__main__":
    unittest.main()
