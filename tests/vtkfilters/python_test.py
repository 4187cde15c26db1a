"""The Python package: scenes from dicts and files, arrays, errors as exceptions, signals, threads."""

import contextlib
import copy
import os
import pathlib
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import lamella
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkContourFilter

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


LONG = {**SCENE, "run": {"end_time": 1}, "output": {"frames": 2}}  # minutes


@contextlib.contextmanager
def current_folder():
    """Another one, while this lasts."""
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield pathlib.Path(folder)
        finally:
            os.chdir(before)


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

    def test_density_as_text(self):
        parameters = {"a": numpy.float64(0.25)}
        energy, twice = (lamella.run({**SCENE, **more})[0].measures["energy"] for more in (
            {}, {"membrane": {"density": "2*a*KM^2"}, "parameters": parameters}))
        self.assertAlmostEqual(twice, 2 * energy, 9)
        self.assertRaisesRegex(lamella.Error, r"\[membrane\] density: column 1: unknown name KN", lamella.run,
                               {"membrane": {"density": "KN^2"}})

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

    def test_history_is_there_at_once(self):
        run = lamella.run(SCENE)
        self.assertEqual(list(run.history["t"]), [0])
        run[-1]
        run[0]
        self.assertEqual(run.history["t"][-1], 1e-4)

    def test_slices(self):
        run = lamella.run(SCENE)

        def times(frames):
            return [frame.time for frame in frames]

        for part in (slice(1, 3), slice(None, None, 2), slice(-2, None), slice(None, None, -1), slice(5, 9)):
            self.assertEqual(times(run[part]), list(run.times[part]))
        self.assertEqual(run[numpy.int64(1)].time, run[-2].time)
        with self.assertRaises(IndexError):
            run[3]
        with self.assertRaises(TypeError):
            run["end"]

    def test_what_scenes_are_made_of(self):
        with current_folder() as folder:
            for name in ("scene.toml", pathlib.Path("scene.toml"), folder / "scene.toml", b"scene.toml"):
                pathlib.Path("scene.toml").write_text("[shape]\nkind = 'sphere'\n[grid]\nnodes = 24\n")
                self.assertEqual(lamella.run(name)[0].phi.shape, (24, 24, 24))
        scene = {
            "title": None, "domains": None,
            "grid": {"nodes": numpy.array([16, 16, numpy.int64(24)]), "half_width": None},
            "shape": {"kind": numpy.str_("sphere"), "radius": numpy.float32(0.5), "center": numpy.zeros(3)},
            "contact": {"topology_changes": numpy.bool_(False)},
            "run": {"end_time": numpy.array(1e-5)},
            "output": {"frames": numpy.uint8(2)},
        }
        run = lamella.run(scene, "membrane.bending_modulus=2")
        self.assertEqual(run[0].phi.shape, (24, 16, 16))
        self.assertEqual(run[0].measures["membrane.bending_modulus"], 2)
        self.assertEqual(len(run), 2)

    def test_files_count_from_the_current_folder(self):
        earlier = lamella.run({**SCENE, "output": {"frames": 2}})
        with current_folder() as folder:
            (folder / "later.toml").write_text("[shape]\nkind = 'frame'\nfile = 'sphere'\n[grid]\nnodes = 32\n")
            run = lamella.run("later.toml")
            frame = {"grid": {"nodes": 32}, "shape": {"kind": "frame", "file": pathlib.Path("none.hdf")}}
            with self.assertRaisesRegex(lamella.Error, os.path.join(str(folder), "none.hdf")):
                lamella.run(frame)[0]
            for name in ("of scenes", "no run"):
                (folder / name).mkdir()
            (folder / "of scenes" / "frame.toml").write_text("[shape]\nkind = 'frame'\nfile = 'none'\n")
            with self.assertRaisesRegex(lamella.Error, os.path.join(str(folder), "no run")):
                lamella.run("of scenes/frame.toml", "shape.file=no run")[0]
        with self.assertRaises(lamella.Error): # the folder has gone with its file
            run[0]
        self.assertEqual(len(earlier), 2)

    def test_events(self):
        run = lamella.run(SHARP)
        run[-1]
        self.assertEqual(run.events[0]["kind"], "sharp")
        self.assertLess(run.events[0]["size"], 2 / 24)
        smooth = lamella.run(SCENE)
        smooth[0]
        self.assertEqual(smooth.events, [])

    def test_components(self):
        run = lamella.run(SCENE)
        run[0]
        self.assertEqual(len(run.components["V"]), 0)

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

    def test_frames_are_their_own(self):
        run = lamella.run(TWO_PHASES)
        first = run[0]
        before = {name: getattr(first, name).copy() for name in ("phi", "psi")}
        for name in before:
            getattr(first, name)[...] = 17
        first.measures["energy"] = 17
        for again in (run[0], run.at(0)):
            for name, values in before.items():
                numpy.testing.assert_array_equal(getattr(again, name), values)
            self.assertNotEqual(again.measures["energy"], 17)
        run.history["t"][0] = 17
        self.assertEqual(run.history["t"][0], 0)
        self.assertLess(run[1].measures["energy"], run[0].measures["energy"])

    def test_frames_are_pickled(self):
        frame = lamella.run(TWO_PHASES)[0]
        for again in (pickle.loads(pickle.dumps(frame)), copy.deepcopy(frame), copy.copy(frame)):
            self.assertEqual(again.time, frame.time)
            self.assertEqual(again.measures, frame.measures)
            numpy.testing.assert_array_equal(again.phi, frame.phi)
            numpy.testing.assert_array_equal(again.psi, frame.psi)
            self.assertEqual(again.image.GetOrigin(), frame.image.GetOrigin())
            self.assertEqual(again.image.GetSpacing(), frame.image.GetSpacing())
            numpy.testing.assert_equal(lamella.measures(again), lamella.measures(frame))
            self.assertEqual(again.boundary().GetNumberOfPoints(), frame.boundary().GetNumberOfPoints())

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
        for _ in range(2):  # what fails, fails again
            with self.assertRaises(lamella.Error) as caught:
                action()
            for word in words:
                self.assertIn(word, str(caught.exception))
            self.assertNotRegex(str(caught.exception), "ERROR|0x")

    def test_scenes(self):
        self.check(lambda: lamella.run({"shape": {"kind": "spher"}}), "[shape] kind", "sphere")
        self.check(lambda: lamella.run({"membrane": {"bending_modulus": -1}}), "bending_modulus")
        self.check(lambda: lamella.run({"membrane": {"bending modulus": 1}}), "bending modulus")
        self.check(lambda: lamella.run({"membrane": {"bending_modulus": {1, 2}}}), "[membrane] bending_modulus", "set")
        self.check(lambda: lamella.run({"shape": {"center": [0, None, 0]}}), "[shape] center")
        self.check(lambda: lamella.run({3: 4}), "3")
        self.check(lambda: lamella.run({"title": "a\nb\"c\\", "shape": {"radius": "\u00e9"}}), "radius")
        self.check(lambda: lamella.run("fig3_oblat"), "fig3_oblate")
        self.check(lambda: lamella.run(SCENE, ["grid.nodes=33"]), "multiple of 8")
        self.check(lambda: lamella.run(SCENE, [33]), "33")
        for nothing in (None, 3, [], object()):
            self.check(lambda: lamella.run(nothing), "a scene is")
        self.check(lambda: lamella.run({"title": "\ud800"}), "title", "Unicode")
        self.check(lambda: lamella.run(b"caf\xe9.toml"), "caf", "UTF-8")

    def test_stored_runs(self):
        self.check(lambda: lamella.open("/no/such/folder"), "no such file or folder")
        self.check(lambda: lamella.open(pathlib.Path("/no/such/folder")), "no such file or folder")
        self.check(lambda: lamella.open(None), "the folder of a run, not None")

    def test_times(self):
        run = lamella.run(SCENE)
        for moment in (None, "late", [1], float("nan")):
            self.check(lambda: run.at(moment), "a time is a number")
        self.assertEqual(run.at(float("inf")).time, 1e-4)

    def test_runs_that_stop(self):
        run = lamella.run({**SCENE, "contact": {"topology_changes": False}, "run": {"end_time": 0.05},
                           "volume": {"constraint": "ramped", "targets": [0.2], "rate": 200}})
        self.check(lambda: run[-1], "the run stopped at t = ")
        reached = run.history["t"][-1]
        self.assertGreater(reached, 0)
        self.assertLess(run.at(reached / 2).time, reached)
        self.check(lambda: run[-1], "the run stopped at t = ")

    def test_data(self):
        self.check(lambda: lamella.surface(vtkImageData()), "the image is empty")
        self.check(lambda: lamella.run(SCENE)[0].boundary(), "one phase")
        vesicle = lamella.vtkVesicleFromSurface()
        vesicle.SetInputData(vtkPolyData())
        self.check(lambda: lamella.update(vesicle), "no triangles")

    def test_what_is_no_data(self):
        for function in (lamella.surface, lamella.boundary, lamella.measures):
            for thing in (None, 3, "image", SCENE):
                self.check(lambda: function(thing), "takes a Frame or a vtkImageData")
                self.check(lambda: lamella.arrays(thing), "takes a VTK data set")
            self.check(lambda: function(vtkPolyData()), "vtkPolyData", "vtkImageData is required")
        for thing in (None, 3, vtkPolyData()):
            self.check(lambda: lamella.update(thing), "takes a VTK algorithm")
        frame = lamella.run(SCENE)[0]
        self.check(lambda: frame.surface(Refinment=2), "no property Refinment")
        self.check(lambda: frame.surface(Refinement="fine"), "Refinement")

    def test_of_classes(self):
        """By their own updates as by update(), however that is asked for."""
        for name in lamella.__all__:
            one = getattr(lamella, name)
            if not name.startswith("vtk") or name == "vtkVesicleSource":
                continue
            for update in ("Update", "UpdateWholeExtent"):
                self.check(getattr(one(), update), "0 connections" if "Reader" not in name else "no FileName")
            self.check(lambda: one().UpdateTimeStep(0))
            if one().GetNumberOfInputPorts() > 0:
                algorithm = one()
                algorithm.SetInputDataObject(vtkImageData() if name == "vtkVesicleFromSurface" else vtkPolyData())
                self.check(algorithm.Update, "is required")
                algorithm.SetInputDataObject(None)
                self.check(algorithm.Update, "0 connections")
        source = lamella.vtkVesicleSource()
        source.SetShapeKind("spher")
        self.check(source.Update, 'did you mean "sphere"')
        source.SetShapeKind("sphere")
        source.Update()
        self.assertGreater(source.GetOutput().GetNumberOfPoints(), 0)

    def test_those_of_filters_before(self):
        source = lamella.vtkVesicleSource()
        source.SetShapeSemiAxis(5)
        dynamics = lamella.vtkVesicleDynamics()
        dynamics.SetInputConnection(source.GetOutputPort())
        self.check(lambda: lamella.update(dynamics), "[shape] semi_axis")
        after = vtkContourFilter()
        after.SetInputConnection(dynamics.GetOutputPort())
        self.check(lambda: lamella.update(after), "[shape] semi_axis")


class Stop(RuntimeError):
    """What a test's handler of a signal raises."""


class Signals(unittest.TestCase):
    """Sent by the process to itself at the third step of runs of minutes: what ends them is the signal."""

    def setUp(self):
        def stop(*_):
            raise Stop

        self.addCleanup(signal.signal, signal.SIGUSR1, signal.signal(signal.SIGUSR1, stop) or signal.SIG_DFL)
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before or signal.SIG_DFL)  # None: not from Python

    @staticmethod
    def signal_at_third_step(algorithm, number):
        steps = []

        def count(*_):
            steps.append(0)
            if len(steps) == 3:
                threading.Thread(target=os.kill, args=(os.getpid(), number)).start()

        return algorithm.AddObserver("ProgressEvent", count)

    def test_end_a_run_within_a_step(self):
        for number, exception in ((signal.SIGINT, KeyboardInterrupt), (signal.SIGUSR1, Stop)):
            run = lamella.run(LONG)
            tag = self.signal_at_third_step(run.reader, number)
            with self.assertRaises(exception):
                run[-1]
            run.reader.RemoveObserver(tag)
            steps = len(run.history["t"])
            self.assertGreater(steps, 1)
            self.assertGreater(run.at(2 * run.history["t"][-1]).time, 0) # goes on

    def test_end_the_updates_of_classes(self):
        source = lamella.vtkVesicleSource()
        source.SetNodes(32, 32, 32)
        dynamics = lamella.vtkVesicleDynamics()
        dynamics.SetInputConnection(source.GetOutputPort())
        dynamics.SetEndTime(1)
        self.signal_at_third_step(dynamics, signal.SIGINT)
        measures = lamella.vtkMembraneMeasures()
        measures.SetInputConnection(dynamics.GetOutputPort())
        with self.assertRaises(KeyboardInterrupt):
            measures.Update()

    @unittest.skipIf(shutil.which("pvpython") and not os.path.exists(sys.executable),
                     "pvpython leaves Ctrl-C to the system, which ends it")
    def test_end_a_program(self):
        program = ("import lamella, sys\n"
                   f"run = lamella.run({LONG!r})\n"
                   "run[0]\n"
                   "run.reader.AddObserver('ProgressEvent', lambda *_: print('step', flush=True))\n"
                   "try:\n    run[-1]\n"
                   "except KeyboardInterrupt:\n    print('stopped at', run.history['t'][-1])\n")
        with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as process:
            for _ in range(3):
                self.assertEqual(process.stdout.readline(), "step\n")
            process.send_signal(signal.SIGINT)
            text, _ = process.communicate()
        self.assertIn("stopped at", text)
        self.assertEqual(process.returncode, 0)


class Threads(unittest.TestCase):
    def test_go_on_while_a_run_computes(self):
        """No thread gives way to another by itself here, but where the run computes, and then the other
        counts. A run of minutes ends as soon as that was seen."""
        run, counts, over = lamella.run(LONG), [0], threading.Event()
        first, steps = [], [0]

        def count():
            while not over.is_set():
                counts[0] += 1
                time.sleep(0)  # gives way

        def look(algorithm, _):
            steps[0] += 1
            if steps[0] == 2:
                first.append(counts[0])
            if steps[0] > 2 and counts[0] > first[0] or steps[0] == 1000:
                algorithm.AbortExecuteOn()

        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(1000)
        run.reader.AddObserver("ProgressEvent", look)
        thread = threading.Thread(target=count)
        thread.start()
        run[-1]
        over.set()
        thread.join()
        self.assertLess(steps[0], 1000)

    def test_take_turns_with_a_run(self):
        run, expected = lamella.run(SCENE), [frame.measures for frame in lamella.run(SCENE)]
        failures = []

        def look(numbers):
            try:
                for number in numbers:
                    frame = run[number]
                    if (frame.time, frame.measures) != (run.times[number], expected[number]):
                        failures.append((number, frame))
            except Exception as error: # pylint: disable=broad-except
                failures.append(error)

        threads = [threading.Thread(target=look, args=(numbers,))
                   for numbers in ([0, 2, 1] * 3, [2, 0, 1] * 3, [1, 2, 0] * 3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])

    def test_run_side_by_side(self):
        energies = []

        def run():
            energies.append(lamella.run(SCENE)[-1].measures["energy"])

        threads = [threading.Thread(target=run) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(energies, [lamella.run(SCENE)[-1].measures["energy"]] * 3)


if __name__ == "__main__":
    unittest.main()
