# SPDX-License-Identifier: BSD-3-Clause
"""The panel in Blender's window on a virtual screen: surfaces come while a slider moves, the window never waits for them, undo works.

Arguments: BLENDER PROGRAM ADDON_FOLDER PACKAGE [PICTURE]; the picture is a screenshot, to look at."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

BLENDER, PROGRAM, ADDON, PACKAGE = sys.argv[1:5]
PICTURE = sys.argv[5] if len(sys.argv) > 5 else ""
HERE = os.path.dirname(os.path.abspath(__file__))
SIZE = ("1280", "900") if PICTURE else ("640", "480")
MOLECULE = "/usr/share/freesasa/test-data/1ubq.pdb"


class VirtualScreen:
    """Xvfb on a display of its own."""

    def __enter__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "x".join((*SIZE, "24")), "-nolisten", "tcp"],
                                       pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            return ":" + pipe.readline().strip()

    def __exit__(self, *_error):
        self.server.terminate()
        self.server.wait()


class Window(unittest.TestCase):
    def test_a_slider_is_followed_and_undone(self):
        with tempfile.TemporaryDirectory() as folder, VirtualScreen() as display:
            scripts = os.path.join(folder, "scripts")
            os.makedirs(os.path.join(scripts, "addons"))
            os.symlink(os.path.join(ADDON, "meniscus_import"), os.path.join(scripts, "addons", "meniscus_import"))
            told = os.path.join(folder, "told.json")
            done = subprocess.run(
                [BLENDER, "--factory-startup", "--window-geometry", "0", "0", *SIZE, "--addons", "meniscus_import", "--python",
                 os.path.join(HERE, "in_window.py"), "--", told, MOLECULE, PROGRAM, PACKAGE, PICTURE],
                env={**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "BLENDER_USER_SCRIPTS": scripts,
                     "MESA_SHADER_CACHE_DISABLE": "true", "PYTHONDONTWRITEBYTECODE": "1"},
                timeout=200, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertGreaterEqual(done.returncode, 0, f"Blender ended by signal {-done.returncode}\n{done.stdout[-3000:]}")
            self.assertTrue(os.path.exists(told), done.stdout[-3000:])
            with open(told, encoding="utf-8") as file:
                found = json.load(file)
        self.assertEqual(found.get("error", ""), "")

        def area(probe):
            said = subprocess.run([PROGRAM, "surface", MOLECULE, "--select", "resi 1-20", "--probe", str(probe), "--json", "-q", "--device", "cpu"], check=True,
                                  capture_output=True, text=True).stdout
            return json.loads(said)["area"]

        self.assertEqual(found["first"], area(1.4))
        self.assertEqual(found["dragged"], area(2.0))
        self.assertEqual(found["undone"], area(1.4))
        self.assertGreater(found["shown_while_dragging"], 0)
        self.assertEqual(found["threads"], 1)  # of Python: Blender crashes at times while others run
        self.assertEqual(found["drawn"], ["VIEW3D_PT_meniscus", "VIEW3D_PT_meniscus_look", "VIEW3D_PT_meniscus_time"])


if __name__ == "__main__":
    unittest.main(argv=["window_test"])
