"""A pvserver of its own process: vesicles computed and drawn there."""

import os
import socket
import subprocess
import tempfile
import unittest

import session
from paraview import simple


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server(unittest.TestCase):
    def setUp(self):
        port = free_port()
        self.server = subprocess.Popen([os.environ["PVSERVER"], f"--server-port={port}"],
                                       stdout=subprocess.PIPE, text=True)
        for line in self.server.stdout:
            if "Accepting connection" in line:
                break
        simple.Connect("127.0.0.1", port)
        session.load_plugin(remote=True)
        session.load_plugin()

    def tearDown(self):
        simple.Disconnect()
        self.server.terminate()
        self.server.wait()
        self.server.stdout.close()

    def test_vesicles_are_there(self):
        source = simple.VesicleScene(FileName="fig9", Overrides=["grid.nodes=32", "run.end_time=2e-3", "output.frames=3"])
        self.assertIsNone(source.GetClientSideObject()) # computed by the server
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "bud.png")
            session.picture_of(source, picture, 2e-3)
            self.assertLess(session.difference(picture, os.path.join(session.BASELINES, "bud.png")), 3)
        self.assertAlmostEqual(session.measures(source)["t"], 2e-3)
        vesicle = simple.Vesicle(Shape="torus", SpontaneousCurvature=-2, Nodes=[48, 48, 48])
        vesicle.UpdatePipeline()
        self.assertGreater(vesicle.GetDataInformation().GetNumberOfPoints(), 1000)


if __name__ == "__main__":
    unittest.main()
