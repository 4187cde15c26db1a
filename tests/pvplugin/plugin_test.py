"""The plugin in pvpython, without a display: proxies, parameters, times, pictures, states, traces."""

import os
import re
import tempfile
import unittest

import session
from paraview import servermanager, simple, smtrace

SOURCES = {"Vesicle": "sources", "VesicleShape": "sources", "VesicleScene": "sources", "VesicleRun": "sources",
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

    def test_a_wrong_scene_is_told(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write("[shape]\nkind = 'spher'\n")
            file.flush()
            proxy = simple.OpenDataFile(file.name)
            with session.messages() as texts:
                proxy.UpdatePipeline()
            self.assertIn(":2: [shape] kind", texts[0])
            self.assertEqual(proxy.GetDataInformation().GetNumberOfPoints(), 0)


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

    def test_live(self):
        vesicle = simple.Vesicle(Nodes=[48, 48, 48], EndTime=2e-3, Frames=3, Live=1)
        vesicle.UpdatePipelineInformation()
        self.assertEqual(len(vesicle.TimestepValues), 0)
        times = [0]
        while times[-1] < 2e-3:
            vesicle.GetClientSideObject().Modified()
            vesicle.MarkModified(vesicle.SMProxy)
            vesicle.UpdatePipeline()
            times.append(session.measures(vesicle)["t"])
            self.assertGreater(times[-1], times[-2])
        self.assertGreater(len(times), 3)
        self.assertAlmostEqual(times[-1], 2e-3, 12)

    def test_abort(self):
        vesicle = simple.Vesicle(Nodes=[48, 48, 48], EndTime=2e-3, Frames=2)
        running, progress = vesicle.GetClientSideObject(), []

        def abort(*_):
            progress.append(running.GetProgress())
            running.AbortExecuteOn()

        observer = running.AddObserver("ProgressEvent", abort)
        vesicle.UpdatePipeline(2e-3)
        running.RemoveObserver(observer)
        time = session.measures(vesicle)["t"]
        self.assertTrue(progress and 0 <= time < 2e-3, (progress, time))
        running.AbortExecuteOff()
        running.Modified()
        vesicle.MarkModified(vesicle.SMProxy)
        vesicle.UpdatePipeline(2e-3)
        self.assertAlmostEqual(session.measures(vesicle)["t"], 2e-3, 12)


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
        script = smtrace.stop_trace()
        self.assertIn("Vesicle(", script)
        self.tearDown()
        exec(compile(script, "trace", "exec"), {})
        (again,) = simple.GetSources().values()
        self.assertEqual((again.Shape, again.SpontaneousCurvature), ("torus", -2))


if __name__ == "__main__":
    unittest.main()
