"""ParaView's window on a virtual screen: menu, scene picker, property, Apply, play, energy plot, abort, files.

gui_test.py PARAVIEW LAMELLA PLUGIN FOLDER plays the tests below, screenshots and all into FOLDER.
"""

import mmap
import os
import re
import shutil
import struct
import subprocess
import sys
import time
import unittest
import zlib
from xml.sax.saxutils import quoteattr

PARAVIEW, LAMELLA, PLUGIN, FOLDER = sys.argv[1:5]
SIZE = WIDTH, HEIGHT = (1152, 762) # of ParaView's window on a first start
ABORT_BUTTONS = [(x, HEIGHT - 15) for x in range(361, 416, 6)] # where it may be
PATIENCE = 120 # seconds, for a session

PANEL = "propertiesDock/propertiesPanel/"
PROPERTIES = PANEL + ("scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel/")
APPLY = (PANEL + "Accept", "activate", "")
FIRST, PLAY, LAST = ((f"VCRToolbar/1QToolButton{n}", "activate", "") for n in (0, 3, 5))


def menu(*path):
    """Events that choose an entry; menus and entries by their object names."""
    place = "menubar"
    for entry in path:
        yield (place, "activate", entry)
        place += "/" + entry


def choose_file(entry, dialog, file):
    return [*menu("menu_File", entry), (dialog, "filesSelected", file)]


def save_state(name):
    """Also a sign for this program that the session has come so far."""
    return [*choose_file("actionFileSaveServerState", "FileSaveServerStateDialog", os.path.join(FOLDER, name)),
            ("", "pause", "2000")]


class Screen:
    """A virtual screen."""

    def __init__(self):
        self.memory = os.path.join(FOLDER, "screen")
        os.makedirs(self.memory)
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{SIZE[0]}x{SIZE[1]}x24", "-fbdir", self.memory],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()

    def pixels(self):
        """Rows of bytes r, g, b."""
        with open(os.path.join(self.memory, "Xvfb_screen0"), "rb") as file:
            data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        header = struct.unpack(">25I", data[:100])
        start, width, height, stride = header[0] + 12 * header[19], header[4], header[5], header[12]
        rows = []
        for y in range(height):
            row = data[start + y * stride:start + y * stride + 4 * width] # b, g, r, unused
            rgb = bytearray(3 * width)
            rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
            rows.append(bytes(rgb))
        return rows

    def save(self, name):
        def chunk(kind, content):
            crc = zlib.crc32(kind + content)
            return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", crc)

        rows = self.pixels()
        with open(os.path.join(FOLDER, name), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n")
            file.write(chunk(b"IHDR", struct.pack(">2I5B", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)))
            file.write(chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9)))
            file.write(chunk(b"IEND", b""))

    def share(self, is_of_it):
        """Of the pixels, those whose (r, g, b) is what is asked for."""
        rows = self.pixels()
        hits = sum(is_of_it(*row[x:x + 3]) for row in rows[::4] for x in range(0, len(row), 12))
        return hits / (len(rows[0]) / 12 * len(rows) / 4)


class Session:
    """A run of ParaView that plays events."""

    def __init__(self, screen, name, events):
        self.script = os.path.join(FOLDER, name + ".xml")
        with open(self.script, "w", encoding="utf-8") as file:
            file.write("<?xml version=\"1.0\" ?>\n<pqevents>\n")
            for place, command, arguments in events:
                window = "/".join(part for part in ("pqClientMainWindow", place) if part)
                file.write(f"  <pqevent object={quoteattr(window)} command={quoteattr(command)} "
                           f"arguments={quoteattr(arguments)}/>\n")
            file.write("</pqevents>\n")
        home = os.path.join(FOLDER, "home")
        shutil.rmtree(home, ignore_errors=True)
        os.makedirs(home, mode=0o700)
        self.log = os.path.join(FOLDER, name + ".log")
        self.begin = time.monotonic()
        self.screen = screen
        with open(self.log, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [PARAVIEW, "--dr", "--plugins=Lamella", "--test-script=" + self.script, "--exit"],
                stdout=log, stderr=subprocess.STDOUT,
                env={**os.environ, "DISPLAY": screen.name, "HOME": home, "XDG_RUNTIME_DIR": home,
                     "PV_PLUGIN_PATH": os.path.dirname(PLUGIN)})

    def wait_for(self, done, meanwhile=lambda: None):
        while not done():
            if time.monotonic() - self.begin > PATIENCE:
                self.fail("ParaView hangs")
            if "critical:" in self.text():
                self.fail("an event could not be played")
            if self.process.poll() is not None and not done():
                self.fail("ParaView ended too early")
            meanwhile()
            time.sleep(0.1)

    def fail(self, why):
        self.screen.save("failed.png")
        self.process.kill()
        self.process.wait()
        raise AssertionError(f"{why}:\n{self.text()}")

    def wait_for_file(self, name, meanwhile=lambda: None):
        self.wait_for(lambda: os.path.exists(os.path.join(FOLDER, name)), meanwhile)

    def finish(self):
        """What it has printed."""
        self.wait_for(lambda: self.process.poll() is not None)
        if self.process.returncode != 0:
            self.fail(f"ParaView ended with {self.process.returncode}")
        return self.text()

    def text(self):
        with open(self.log, encoding="utf-8") as file:
            return file.read()


class Window(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        cls.screen = Screen()

    @classmethod
    def tearDownClass(cls):
        cls.screen.close()

    def play(self, name, events):
        return Session(self.screen, name, events)

    def state(self, name):
        with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
            return file.read()

    def test_first_sight(self):
        session = self.play("first_sight", [
            *menu("menuSources", "Lamella", "Vesicle"),
            (PROPERTIES + "StartFrom/ScenePicker", "set_string", "Sphere with one Ld domain: a bulged cap (fig9)"),
            (PROPERTIES + "EndTime/DoubleLineEdit0", "set_string", "0.003"),
            (PROPERTIES + "OutputFrames/LineEdit0", "set_string", "4"),
            APPLY, PLAY,
            ("Lamella/1QToolButton0", "activate", ""), # energy
            *save_state("played.pvsm")])
        session.wait_for_file("played.pvsm")
        time.sleep(0.5)
        self.screen.save("first_sight.png")
        self.assertGreater(self.screen.share(lambda r, g, b: r > 2 * g and r > 2 * b and r > 90), 0.01) # Ld
        self.assertGreater(self.screen.share(lambda r, g, b: b > 1.5 * r and b > 90), 0.03) # Lo
        session.finish()
        state = self.state("played.pvsm")
        for name, value in (("ShapeKind", "sphere"), ("DomainsKind", "cap"), ("EndTime", "0.003"),
                            ("LineTension", "30")):
            self.assertRegex(state, f'name="{name}"[^>]*>\\s*<Element index="0" value="{value}"')
        self.assertRegex(state, r'name="ViewTime"[^>]*>\s*<Element index="0" value="0.003"')
        self.assertIn('type="MembraneRepresentation"', state)
        self.assertIn('type="XYChartView"', state)

    def test_abort(self):
        """A run of minutes, ended by a click on the button as soon as there is progress."""
        session = self.play("abort", [
            *menu("menuSources", "Lamella", "Vesicle"),
            (PROPERTIES + "EndTime/DoubleLineEdit0", "set_string", "1"),
            APPLY, *save_state("applied.pvsm"),
            LAST, *save_state("aborted.pvsm")])
        session.wait_for_file("applied.pvsm")
        click = ["xdotool"]
        for x, y in ABORT_BUTTONS:
            click += ["mousemove", str(x), str(y), "click", "1"]
        session.wait_for_file("aborted.pvsm", lambda: subprocess.run(
            click, env={**os.environ, "DISPLAY": self.screen.name}, check=True))
        self.screen.save("aborted.png")
        session.finish()
        time_shown = re.search(r'name="ViewTime"[^>]*>\s*<Element index="0" value="([^"]*)"',
                               self.state("aborted.pvsm"))
        self.assertLess(float(time_shown.group(1)), 1) # that of the state reached

    def test_live(self):
        """The picture changes while nothing is asked for."""
        session = self.play("live", [
            *menu("menuSources", "Lamella", "Vesicle"),
            (PROPERTIES + "Live/CheckBox", "set_boolean", "true"),
            (PROPERTIES + "EndTime/DoubleLineEdit0", "set_string", "1"),
            APPLY, *save_state("live.pvsm"), ("", "pause", "4000"), *save_state("live_later.pvsm")])
        session.wait_for_file("live.pvsm")
        first = self.screen.pixels()
        session.wait_for_file("live_later.pvsm")
        later = self.screen.pixels()
        self.screen.save("live.png")
        session.finish()
        middle = slice(HEIGHT // 3, 2 * HEIGHT // 3)
        self.assertTrue(first[middle] != later[middle], "the picture stays the same")

    def test_a_wrong_scene(self):
        file = os.path.join(FOLDER, "wrong.toml")
        with open(file, "w", encoding="utf-8") as scene:
            scene.write("[shape]\nkind = 'spher'\n")
        session = self.play("wrong_scene", [
            *choose_file("actionFileOpen", "FileOpenDialog", file), APPLY, *save_state("wrong.pvsm")])
        session.wait_for_file("wrong.pvsm")
        self.screen.save("wrong_scene.png")
        self.assertIn("wrong.toml:2: [shape] kind", session.finish())

    def test_a_stored_run(self):
        run = os.path.join(FOLDER, "run")
        subprocess.run([LAMELLA, "run", "sphere", "-o", run, "--no-pictures", "--set", "grid.nodes=32",
                        "--set", "output.frames=3"], check=True, capture_output=True)
        session = self.play("run", [
            *choose_file("actionFileOpen", "FileOpenDialog", os.path.join(run, "frames/frames.hdf.series")),
            ("pqSelectReaderDialog/listWidget", "setCurrent", "0.0"), # the first that is offered
            ("pqSelectReaderDialog/okButton", "activate", ""),
            APPLY, LAST, *save_state("run.pvsm")])
        session.wait_for_file("run.pvsm")
        self.screen.save("run.png")
        session.finish()
        self.assertIn('type="FramesOfRun"', self.state("run.pvsm"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
