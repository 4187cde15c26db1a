"""The plugin in pvpython, without a display: proxies, parameters, times, pictures, states, traces."""

import os
import re
import subprocess
import tempfile
import unittest

import session
from paraview import servermanager, simple, smtrace
from vtkmodules.vtkCommonDataModel import vtkDataObject

SOURCES = {"Vesicle": "sources", "VesicleShape": "sources", "VesicleScene": "sources", "FramesOfRun": "sources",
           "VesicleDynamics": "filters", "VesicleFromSurface": "filters", "VesicleFromImage": "filters",
           "MembraneSurface": "filters", "PhaseBoundary": "filters", "MembraneMeasures": "filters"}
BUDDING = ["grid.nodes=32", "run.end_time=2e-3", "output.frames=3"]


def two_phases():
    return simple.VesicleScene(FileName="fig9", Overrides=BUDDING)


class Session(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        session.load_plugin()

    def tearDown(self):
        simple.ResetSession()
        session.load_plugin()


class Proxies(Session):
    def update(self, proxy):
        with session.messages() as texts:
            proxy.UpdatePipeline()
        self.assertEqual(texts[0], "")

    def test_with_defaults(self):
        vesicle = simple.Vesicle()
        self.update(vesicle)
        for port, kind in enumerate(["vtkPolyData", "vtkPolyData", "vtkTable", "vtkImageData", "vtkTable"]):
            self.assertEqual(vesicle.GetDataInformation(port).GetDataSetTypeAsString(), kind)
        self.update(simple.VesicleScene(FileName="sphere"))
        shape = simple.VesicleShape()
        self.update(shape)
        dynamics = simple.VesicleDynamics(Input=shape)
        self.update(dynamics)
        surface = simple.MembraneSurface(Input=dynamics)
        self.update(surface)
        self.update(simple.MembraneMeasures(Input=dynamics))
        self.update(simple.VesicleFromSurface(Input=surface))
        self.update(simple.VesicleFromImage(Input=shape))
        level_set = simple.OutputPort(two_phases(), 3)
        self.update(simple.PhaseBoundary(Input=level_set))

    def test_labels_of_cells(self):
        """Two boxes of labels in cell data; each is chosen by its number."""
        labels = simple.ProgrammableSource(OutputDataSetType="vtkImageData", Script="""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
k, j, i = numpy.meshgrid(*[numpy.arange(40)] * 3, indexing="ij")
inside = (abs(j - 19.5) < 9) & (abs(k - 19.5) < 9)
values = numpy.where(inside & (i < 16) & (i > 4), 1, 0) + numpy.where(inside & (i > 20) & (i < 36), 2, 0)
array = numpy_to_vtk(values.astype(numpy.uint8).ravel(), deep=True)
array.SetName("labels")
output.VTKObject.SetDimensions(41, 41, 41)
output.VTKObject.GetCellData().AddArray(array)
""", ScriptRequestInformation="""
self.GetOutputInformation(0).Set(self.GetExecutive().WHOLE_EXTENT(), [0, 40] * 3, 6)
""")
        for label, voxels in ((1, 11 * 18 * 18), (2, 15 * 18 * 18)):
            vesicle = simple.VesicleFromImage(Input=labels, Label=label)
            measures = simple.MembraneMeasures(Input=vesicle)
            measures.UpdatePipeline()
            volume = servermanager.Fetch(measures).GetColumnByName("V").GetValue(0)
            self.assertAlmostEqual(volume / voxels, 1, delta=1e-4)

    def test_say_what_they_are(self):
        manager = servermanager.ProxyManager().SMProxyManager
        for name, group in SOURCES.items():
            proxy = manager.GetPrototypeProxy(group, name)
            self.assertTrue(proxy.GetDocumentation().GetDescription().strip(), name)
            self.assertTrue(proxy.GetHints().FindNestedElementByName("ShowInMenu"), name)
            iterator = proxy.NewPropertyIterator()
            iterator.Begin()
            while not iterator.IsAtEnd():
                text = iterator.GetProperty().GetDocumentation()
                self.assertTrue(text and text.GetDescription().strip(), f"{name} {iterator.GetKey()}")
                iterator.Next()

    def test_names_in_python(self):
        for name in simple.Vesicle().ListProperties():
            self.assertRegex(name, "^[A-Z][A-Za-z]+$")


class Parameters(Session):
    """Every number of a scene is a property, and arrives."""

    CASES = [dict(Shape=shape, Domains=domains, Volume=volume, AreaDifference=difference,
                  Directions=[0, 0, 1], VolumeTargets=[0.5, 0], AreaDifferenceTargets=[1.1, 0])
             for shape, domains, volume, difference in (
                 ("sphere", "none", "free", "free"), ("oblate", "cap", "ramped", "free"),
                 ("ellipsoid", "caps", "free", "free"), ("torus", "none", "fixed", "ramped"))]

    @staticmethod
    def key_of(proxy, name):
        text = proxy.GetProperty(name).SMProperty.GetDocumentation()
        found = re.search(r"In scene files: (\[\w+\] \w+)\.", text.GetDescription() if text else "")
        return found and found.group(1)

    def test_numbers_out_of_range_are_refused_by_name(self):
        missing = set()
        for case in self.CASES:
            proxy = simple.Vesicle(**case)
            for name in proxy.ListProperties():
                key, value = self.key_of(proxy, name), proxy.GetPropertyValue(name)
                kind = proxy.GetProperty(name).SMProperty
                if not key or kind.IsA("vtkSMStringVectorProperty") or kind.GetRepeatCommand():
                    continue
                if name == "TopologyChanges": # true or false, never out of range
                    continue
                if case is self.CASES[0]:
                    missing.add(key)
                one = not hasattr(value, "__len__")
                value = value if one else list(value) # not a view of what is about to change
                wrong = -2**30 if kind.IsA("vtkSMIntVectorProperty") else 1e31
                setattr(proxy, name, wrong if one else [wrong] * len(value))
                with session.messages() as texts:
                    proxy.UpdatePipeline()
                if key in texts[0]:
                    missing.discard(key)
                setattr(proxy, name, value)
            simple.Delete(proxy)
        self.assertEqual(missing, set())

    def test_lists_arrive(self):
        proxy = simple.Vesicle(Shape="sphere", Volume="free", Domains="caps", HalfAngle=25,
                               Directions=[0, 0, 1, 0, 0, -1, 1, 0, 0], LineTension=5)
        proxy.UpdatePipeline()
        self.assertEqual(proxy.GetDataInformation(1).GetNumberOfCells(), 3)
        proxy.Directions = [0, 0, 1]
        proxy.UpdatePipeline()
        self.assertEqual(proxy.GetDataInformation(1).GetNumberOfCells(), 1)

    def test_filters_take_them_too(self):
        run = dict(SpontaneousCurvature=-3, EndTime=1e-4, Frames=2)
        shape = simple.VesicleShape(Shape="torus", Nodes=[48, 48, 48])
        dynamics = simple.VesicleDynamics(Input=shape, **run)
        vesicle = simple.Vesicle(Shape="torus", Nodes=[48, 48, 48], **run)
        energies = []
        for proxy in (dynamics, vesicle):
            proxy.UpdatePipeline(1e-4)
            energies.append(session.measures(proxy)["energy"])
        self.assertAlmostEqual(energies[0] / energies[1], 1, 4) # the filter scales phi

    def told(self, proxy, *ports):
        """What is reported while the outputs are asked for, as by a view: once, by one of them."""
        with session.messages() as texts:
            proxy.UpdatePipeline(0)
            for port in ports:
                simple.servermanager.Fetch(proxy, idx=port)
        self.assertEqual(texts[0].count("ERROR"), 1, texts[0])
        self.assertEqual(proxy.GetDataInformation().GetNumberOfPoints(), 0)
        return texts[0]

    def test_what_is_wrong_is_told_once(self):
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], SemiAxis=5)
        self.assertIn("[shape] semi_axis", self.told(vesicle, 0, 1, 2, 3, 4))
        vesicle.SemiAxis = 0.7
        for name, right, key in (("Shape", "oblate", "[shape] kind"), ("Domains", "none", "[domains] kind"),
                                 ("Volume", "fixed", "[volume] constraint"),
                                 ("AreaDifference", "free", "[area_difference] constraint")):
            setattr(vesicle, name, "nonsense")
            self.assertIn(f'{key}: "nonsense" is not available; allowed: "', self.told(vesicle, 0, 1, 2, 3, 4))
            setattr(vesicle, name, right)
            with session.messages() as texts:
                vesicle.UpdatePipeline(0)
            self.assertEqual(texts[0], "")
            self.assertGreater(vesicle.GetDataInformation().GetNumberOfPoints(), 0)
        self.assertIn("[shape] kind", self.told(simple.VesicleShape(Shape="nonsense")))
        self.assertIn("fig3_oblate", self.told(simple.VesicleScene(FileName="fig3_oblat"), 0, 1, 2, 3, 4))
        self.assertIn("no such file", self.told(simple.VesicleRun(FileName="/nowhere"), 0, 1, 2, 3, 4))

    def test_a_run_that_stops_tells_it_once(self):
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], EndTime=0.05, Volume="ramped", VolumeTargets=[0.2, 0],
                                 VolumeRate=200, TopologyChanges=0, ReducedVolume=0.8)
        with session.messages() as texts:
            vesicle.UpdatePipeline(0.05)
            for port in range(5):
                simple.servermanager.Fetch(vesicle, idx=port)
        self.assertEqual(texts[0].count("the run stopped at t = "), 1, texts[0])

    def test_a_wrong_scene_is_told(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write("[shape]\nkind = 'spher'\n")
            file.flush()
            proxy = simple.OpenDataFile(file.name)
            with session.messages() as texts:
                proxy.UpdatePipeline()
            self.assertIn(":2: [shape] kind", texts[0])
            self.assertEqual(proxy.GetDataInformation().GetNumberOfPoints(), 0)


class Readers(Session):
    def test_a_stored_run_is_a_vesicle_run(self):
        """Of all readers that can open its frames the first that is offered."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["LAMELLA"], "run", "sphere", "-o", folder, "--no-pictures", "--set",
                            "grid.nodes=32", "--set", "output.frames=3"], check=True, capture_output=True)
            for file in ("frames/frames.hdf.series", "frames/frame_0001.hdf"):
                proxy = simple.OpenDataFile(os.path.join(folder, file))
                self.assertEqual(proxy.GetXMLName(), "FramesOfRun")
            old = servermanager.ProxyManager().NewProxy("sources", "VesicleRun") # in states of version 0.1
            self.assertEqual(old.GetClientSideObject().GetClassName(), "vtkVesicleRun")
            proxy.UpdatePipeline(0)
            history = simple.servermanager.Fetch(proxy, idx=2)
            self.assertEqual(history.GetColumnByName("t").GetValue(history.GetNumberOfRows() - 1),
                             proxy.TimestepValues[-1])


class Times(Session):
    def test_play(self):
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], SemiAxis=0.8, ReducedVolume=0.8, EndTime=2e-4, Frames=5)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual(list(scene.TimeKeeper.TimestepValues), list(vesicle.TimestepValues))
        energies = []
        for time in vesicle.TimestepValues:
            vesicle.UpdatePipeline(time)
            energies.append(session.measures(vesicle)["energy"])
        self.assertEqual(energies, sorted(energies, reverse=True))
        vesicle.UpdatePipeline(vesicle.TimestepValues[1]) # back
        self.assertEqual(session.measures(vesicle)["energy"], energies[1])
        rows = vesicle.GetDataInformation(2).GetNumberOfRows()
        self.assertGreater(rows, 1)

    def test_history_is_whole(self):
        """Also where it is asked for no time, or for the time of another output."""
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], SemiAxis=0.8, ReducedVolume=0.8, EndTime=2e-4, Frames=3)
        view = simple.CreateView("RenderView")
        simple.Show(vesicle, view)
        view.ViewTime = 2e-4
        view.Update()
        for time in (None, 0, 1e-4):
            if time is not None:
                vesicle.UpdatePipeline(time)
            history = simple.servermanager.Fetch(vesicle, idx=2)
            self.assertEqual(history.GetColumnByName("t").GetValue(history.GetNumberOfRows() - 1), 2e-4)

    def test_live(self):
        vesicle = simple.Vesicle(Nodes=[48, 48, 48], EndTime=2e-3, Frames=3, Live=1)
        vesicle.UpdatePipelineInformation()
        self.assertEqual(len(vesicle.TimestepValues), 0)
        times, states = [0], []
        while times[-1] < 2e-3:
            self.go_on(vesicle)
            times.append(session.measures(vesicle)["t"])
            self.assertGreater(times[-1], times[-2])
            states.append(self.live_state(vesicle))
        self.assertGreater(len(times), 3)
        self.assertAlmostEqual(times[-1], 2e-3, 12)
        self.assertRegex(states[0], r"^t = [0-9.e-]+ of 0.002$")
        self.assertEqual(states[-1], "ended at t = 0.002 of 0.002")

    def test_live_after_changes_and_errors(self):
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], EndTime=1, Live=1)
        vesicle.UpdatePipeline()
        while "left" not in self.live_state(vesicle):
            self.go_on(vesicle)
        self.assertRegex(self.live_state(vesicle), r"^t = [0-9.e-]+ of 1, \d+ (s|min|h) left at this pace$")
        vesicle.SemiAxis = 5
        with session.messages():
            vesicle.UpdatePipeline()
        self.assertEqual(self.live_state(vesicle), "")
        vesicle.SemiAxis = 0.7
        vesicle.EndTime = 1e-5
        vesicle.UpdatePipeline()
        while not self.live_state(vesicle).startswith("ended"):
            self.go_on(vesicle)
        self.assertEqual(session.measures(vesicle)["t"], 1e-5)
        vesicle.EndTime = 1
        vesicle.UpdatePipeline()
        self.assertRegex(self.live_state(vesicle), "^t = .* of 1")

    @staticmethod
    def go_on(vesicle):
        """As ParaView does a few times a second."""
        vesicle.GetClientSideObject().Modified()
        vesicle.MarkModified(vesicle.SMProxy)
        vesicle.UpdatePipeline()

    @staticmethod
    def live_state(vesicle):
        vesicle.UpdatePropertyInformation()
        return vesicle.SMProxy.GetProperty("LiveState").GetElement(0)

    def abort_on_the_way_to(self, proxy, time, count=6):
        """Asks for a time, and aborts at the count-th progress; the time reached."""
        running, progress = proxy.GetClientSideObject(), []

        def abort(*_):
            progress.append(running.GetProgress())
            if len(progress) == count:
                running.AbortExecuteOn()

        observer = running.AddObserver("ProgressEvent", abort)
        proxy.UpdatePipeline(time)
        running.RemoveObserver(observer)
        return self.time_of(proxy)

    def time_of(self, proxy):
        """As every output says it."""
        running = proxy.GetClientSideObject()
        times = {running.GetOutputDataObject(port).GetInformation().Get(vtkDataObject.DATA_TIME_STEP())
                 for port in range(running.GetNumberOfOutputPorts())}
        times.add(running.GetOutputDataObject(0).GetFieldData().GetArray("t").GetValue(0))
        self.assertEqual(len(times), 1, times)
        return times.pop()

    def test_abort(self):
        shape = simple.VesicleShape(Nodes=[32, 32, 32])
        for proxy in (simple.Vesicle(Nodes=[32, 32, 32], EndTime=2e-3, Frames=3),
                      simple.VesicleScene(FileName="fig3_oblate", Overrides=["grid.nodes=32", "run.end_time=2e-3"]),
                      simple.VesicleDynamics(Input=shape, EndTime=2e-3, Frames=3)):
            self.assertEqual(self.abort_on_the_way_to(proxy, 2e-3, 1), 0)
            reached = self.abort_on_the_way_to(proxy, 2e-3)
            self.assertLess(0, reached)
            self.assertLess(reached, 2e-3)
            self.assertEqual(self.abort_on_the_way_to(proxy, reached), reached) # is there
            for time in (1e-3, 2e-3, 0, 2e-3):
                proxy.UpdatePipeline(time)
                self.assertEqual(self.time_of(proxy), time)
            if proxy.GetXMLName() == "VesicleScene":
                proxy.Overrides = ["grid.nodes=32", "run.end_time=2e-3", "membrane.spontaneous_curvature=1"]
            else:
                proxy.SpontaneousCurvature = 1
            self.assertLess(self.abort_on_the_way_to(proxy, 2e-3), 2e-3)
            proxy.UpdatePipeline(2e-3) # the same time again
            self.assertEqual(self.time_of(proxy), 2e-3)

    def test_abort_live(self):
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], EndTime=1, Live=1)
        running = vesicle.GetClientSideObject()
        observer = running.AddObserver("ProgressEvent", lambda *_: running.AbortExecuteOn())
        vesicle.UpdatePipeline()
        running.RemoveObserver(observer)
        self.assertTrue(self.live_state(vesicle).startswith("ended")) # stays where it is
        vesicle.Live = 0
        vesicle.EndTime = 1e-4
        vesicle.UpdatePipeline(1e-4)
        self.assertEqual(session.measures(vesicle)["t"], 1e-4)
        vesicle.Live = 1
        vesicle.EndTime = 1
        vesicle.UpdatePipeline()
        self.assertRegex(self.live_state(vesicle), "^t = .* of 1")
        self.assertGreater(session.measures(vesicle)["t"], 0)


class Pictures(Session):
    TOLERANCE = 3 # of 255; another time step differs by more than twice as much

    def test_first_sight(self):
        with tempfile.TemporaryDirectory() as folder:
            bud, other = os.path.join(folder, "bud.png"), os.path.join(folder, "other.png")
            source = two_phases()
            session.picture_of(source, bud, 2e-3)
            session.picture_of(source, other, 0)
            baseline = os.path.join(session.BASELINES, "bud.png")
            self.assertLess(session.difference(bud, baseline), self.TOLERANCE)
            self.assertGreater(session.difference(other, baseline), 2 * self.TOLERANCE)


class States(Session):
    def test_come_back(self):
        vesicle = simple.Vesicle(Shape="prolate", ReducedVolume=0.9, SemiAxis=0.8, Domains="caps", HalfAngle=45,
                                 Directions=[0, 0, 1, 0, 0, -1], LineTension=7, Volume="ramped",
                                 VolumeTargets=[0.8, 0, 0.7, 1e-3], Nodes=[48, 48, 48], Frames=4)
        simple.Show(vesicle, simple.CreateView("RenderView"))
        names = [name for name in vesicle.ListProperties() if name != "StartFrom"]
        before = {name: str(vesicle.GetPropertyValue(name)) for name in names}
        with tempfile.TemporaryDirectory() as folder:
            for name in ("state.pvsm", "state.py"):
                simple.SaveState(os.path.join(folder, name))
            for name in ("state.pvsm", "state.py"):
                self.tearDown()
                simple.LoadState(os.path.join(folder, name))
                (again,) = simple.GetSources().values()
                self.assertEqual({name: str(again.GetPropertyValue(name)) for name in names}, before)
                again.UpdatePipeline()
                self.assertEqual(again.GetDataInformation(1).GetNumberOfCells(), 2)

    def test_examples_open(self):
        for name in ("fig3_oblate", "fig9", "fig15a"):
            simple.LoadState(os.path.join(session.EXAMPLES, name + ".pvsm"))
            (source,) = simple.GetSources().values()
            self.assertEqual(source.FileName, name)
            source.UpdatePipeline()
            self.assertGreater(source.GetDataInformation().GetNumberOfPoints(), 1000)
            self.assertEqual(len(simple.GetActiveView().Representations), 2)
            self.tearDown()

    def test_traces_run_again(self):
        smtrace.start_trace()
        vesicle = simple.Vesicle(Nodes=[32, 32, 32], Shape="torus", SpontaneousCurvature=-2)
        view = simple.CreateView("RenderView")
        simple.Show(vesicle, view)
        simple.Show(simple.MembraneSurface(Input=simple.VesicleShape(Nodes=[32, 32, 32])), view)
        script = smtrace.stop_trace()
        self.assertIn("Vesicle(", script)
        self.assertEqual(script.count("LoadPlugin("), 1)
        self.tearDown()
        exec(compile(script, "trace", "exec"), {})
        again = simple.FindSource("Vesicle1")
        self.assertEqual((again.Shape, again.SpontaneousCurvature), ("torus", -2))
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "trace.py")
            with open(file, "w", encoding="utf-8") as stream:
                stream.write(script)
            plain = subprocess.run([os.environ["PVPYTHON"], file], capture_output=True, text=True, check=False)
        self.assertEqual((plain.returncode, plain.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
