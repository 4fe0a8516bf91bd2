# SPDX-License-Identifier: BSD-3-Clause
"""Pages and widgets in a real JupyterLab, in Chromium: what a cell shows, pixel by pixel beside render(), and what Python and
a page tell each other. notebook_check.py CHROMIUM; needs jupyterlab, anywidget and playwright of PyPI: scripts/check/notebooks.sh.

With MENISCUS_SCREENSHOTS=FOLDER in the environment, pictures are left there to be looked at."""

import base64
import io
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

import numpy as np
from PIL import Image
from playwright.sync_api import Error, sync_playwright

CHROMIUM = sys.argv.pop(1)
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
SCREENSHOTS = os.environ.get("MENISCUS_SCREENSHOTS")

CELLS = [
    # 0: a scene, with its picture beside the page.
    f"""import meniscus, numpy as np
molecule = meniscus.read({UBIQUITIN!r})
scene = meniscus.Scene({UBIQUITIN!r}, color="chain", size="{{size}}")
scene.show(frame_height=420)""",
    # 1: a scene that shows itself.
    "scene",
    # 2: a widget.
    f"""w = meniscus.widget(meniscus.Scene({UBIQUITIN!r}, color="chain"), height=400)
picks = []
w.on_pick(picks.append)
w""",
    # 3 and on: run one after the other by the tests.
    "print(w.camera); print(w.picked); print(len(picks))",
    "c = w.camera; c.position = tuple(2 * p - t for p, t in zip(c.position, c.target)); w.camera = c",
    "w.color_by((np.arange(len(molecule)) < 300) * 1.0, ramp=[(0, 0, 1), (1, 0.5, 0)], label='first')",
    "w.reset_colors()",
    """try:
    w.color_by(np.zeros(7))
except meniscus.InputError as error:
    print(error)""",
]


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


class NotebookTest(unittest.TestCase):
    """Tests run in the order of their names, in one notebook."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(folder.cleanup)
        cls.size = (640, 480)
        cells = [{"cell_type": "code", "id": f"cell{n}", "execution_count": None, "metadata": {}, "outputs": [],
                  "source": text.replace("{size}", "x".join(map(str, cls.size)))} for n, text in enumerate(CELLS)]
        kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
        pathlib.Path(folder.name, "a.ipynb").write_text(json.dumps(
            {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}))
        own = {f"{name}": f"{folder.name}/{name}" for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "IPYTHONDIR")}
        port = free_port()
        cls.lab = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}", "--IdentityProvider.token=",
             f"--ServerApp.root_dir={folder.name}", "--LabApp.news_url=None"],
            env={**os.environ, **own}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.addClassCleanup(lambda: (cls.lab.terminate(), cls.lab.wait(30)))
        address = f"http://127.0.0.1:{port}"
        for _ in range(240):
            try:
                urllib.request.urlopen(f"{address}/api")
                break
            except OSError:
                time.sleep(0.5)
        playwright = sync_playwright().start()
        cls.addClassCleanup(playwright.stop)
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--use-angle=swiftshader",
                                                                             "--enable-unsafe-swiftshader"])
        cls.addClassCleanup(browser.close)
        cls.page = browser.new_page(viewport={"width": 1400, "height": 1000})
        cls.page.set_default_timeout(300_000)
        cls.complaints = []
        cls.page.on("pageerror", lambda error: cls.complaints.append(str(error)))
        cls.page.goto(f"{address}/lab/tree/a.ipynb?reset")
        cls.page.wait_for_selector(".jp-Notebook .jp-Cell")
        cls.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]", state="attached")

    def run_cell(self, n):
        """Runs cell n, waits until it has ended, and returns its text."""
        cell = self.page.locator(".jp-Notebook .jp-Cell").nth(n)
        for attempt in range(5):  # JupyterLab makes cells anew while it loads
            try:
                cell.scroll_into_view_if_needed()
                cell.locator(".jp-InputArea-editor").click()
                break
            except Error:
                if attempt == 4:
                    raise
                time.sleep(1)
        before = cell.locator(".jp-InputPrompt").first.inner_text()
        self.page.keyboard.press("Control+Enter")
        for _ in range(600):
            prompt = cell.locator(".jp-InputPrompt").first.inner_text()
            if prompt != before and "*" not in prompt:
                break
            time.sleep(0.1)
        else:
            self.fail(f"cell {n} does not end")
        return cell.locator(".jp-OutputArea-output").all_inner_texts()

    def frame_of(self, n):
        """Returns the page in the output of cell n, at rest."""
        cell = self.page.locator(".jp-Notebook .jp-Cell").nth(n)
        frame = cell.locator(".jp-OutputArea iframe")
        frame.wait_for()
        content = frame.element_handle().content_frame()
        content.wait_for_selector("#picture[data-rest=true]", state="attached")
        return content

    def rest(self, frame):
        frame.wait_for_selector("#picture[data-rest=true]", state="attached")

    def picture(self, frame):
        """Returns the page's picture of the molecule."""
        self.rest(frame)
        uri = frame.evaluate("""(() => { const v = window.meniscus; v.caster.present(linear_from_srgb(v.background));
            return v.canvas.toDataURL(); })()""")
        return np.asarray(Image.open(io.BytesIO(base64.b64decode(uri.split(",")[1]))).convert("RGB")).astype(int)

    def keep(self, name):
        if SCREENSHOTS:
            pathlib.Path(SCREENSHOTS).mkdir(parents=True, exist_ok=True)
            self.page.screenshot(path=f"{SCREENSHOTS}/{name}.png")

    def until(self, text_of, wanted, what):
        for _ in range(100):
            if wanted(text_of()):
                return
            time.sleep(0.1)
        self.fail(what)

    def test_1_a_page_is_the_picture_of_render(self):
        import meniscus
        self.run_cell(0)
        frame = self.frame_of(0)
        self.assertEqual(frame.evaluate("document.getElementById('message').textContent"), "")
        width, height = frame.evaluate("[window.meniscus.canvas.width, window.meniscus.canvas.height]")
        self.keep("page")
        shown = self.picture(frame)
        self.assertEqual(shown.shape, (height, width, 3))
        # The page is as high as the picture that it was made for, and wider or narrower.
        camera = frame.evaluate("""(() => { const v = window.meniscus; v.begin(v.canvas.width, v.canvas.height);
            return told_camera(widened(v.camera, v.growth()), v.figure.origin); })()""")
        text = json.dumps({"position": camera["position"], "target": camera["target"], "up": camera["up"],
                           "projection": camera["projection"], "vertical_fov": camera["vertical_fov"]})
        scene = meniscus.Scene(UBIQUITIN, color="chain", size=f"{width}x{height}", camera=text, background="white", samples=16)
        drawn = scene.render(device="cpu").pixels[:, :, :3].astype(int)
        different = (np.abs(shown - drawn).max(axis=2) > 12).mean()
        covered = (drawn.min(axis=2) < 250).mean()
        print(f"page and render(), {width}x{height}: {100 * different:.3f} % of the pixels differ by more than 12 of 255, "
              f"mean difference {np.abs(shown - drawn).mean():.3f}; {100 * covered:.0f} % are covered")
        self.assertGreater(covered, 0.2)
        self.assertLess(different, 0.01)
        # Another camera is another picture, which shows that the comparison can fail.
        other = meniscus.Scene(UBIQUITIN, color="chain", size=f"{width}x{height}", view="back", background="white")
        self.assertGreater((np.abs(shown - other.render(device="cpu").pixels[:, :, :3]).max(axis=2) > 12).mean(), 0.1)

    def test_2_a_scene_shows_itself(self):
        self.run_cell(1)
        frame = self.frame_of(1)
        self.assertEqual(frame.evaluate("window.meniscus.figure.title"), "1ubq.pdb")

    def test_3_a_widget_tells_python(self):
        self.run_cell(2)
        frame = self.frame_of(2)
        self.keep("widget")
        first = self.run_cell(3)[0]
        self.assertIn("Camera(position=", first)
        # A drag turns it, and Python has the camera that the page has.
        box = frame.locator("#picture").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + 90, y + 20, steps=4)
        self.page.mouse.up()
        self.rest(frame)
        time.sleep(0.5)
        turned = self.run_cell(3)[0]
        self.assertNotEqual(turned.splitlines()[0], first.splitlines()[0])
        here = frame.evaluate("told_camera(window.meniscus.camera, window.meniscus.figure.origin)")
        self.assertIn(f"position=({here['position'][0]!r}"[:20], turned)
        # A click names the atom.
        box = frame.locator("#picture").bounding_box()
        self.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        self.until(lambda: frame.evaluate("document.getElementById('picked').textContent"), bool, "nothing is picked")
        time.sleep(0.5)
        said = frame.evaluate("document.getElementById('picked').textContent")
        told = self.run_cell(3)[0]
        name = said.split(" – ")[0].split(";")[0]
        self.assertIn(f"name='{name}'", told)
        self.assertEqual(told.splitlines()[2], "1")

    def test_4_python_tells_a_widget(self):
        frame = self.frame_of(2)
        reach = "length(minus(window.meniscus.camera.position, window.meniscus.camera.target))"
        before = frame.evaluate(reach)
        self.run_cell(4)
        self.until(lambda: frame.evaluate(reach), lambda now: abs(now / before - 2) < 1e-6, "the camera does not move")
        plain = self.picture(frame)
        self.run_cell(5)
        self.until(lambda: frame.evaluate("document.getElementById('legend').textContent"),
                   lambda text: text == "first: 0 to 1", "no colours are shown")
        colored = self.picture(frame)
        self.keep("colored")
        red, blue = colored[:, :, 0] > colored[:, :, 2] + 60, colored[:, :, 2] > colored[:, :, 0] + 60
        self.assertGreater(red.mean(), 0.005)
        self.assertGreater(blue.mean(), 0.005)
        self.run_cell(6)
        self.until(lambda: frame.evaluate("window.meniscus.scheme"), lambda scheme: scheme == 0, "colours do not go back")
        np.testing.assert_array_equal(self.picture(frame), plain)
        self.assertIn("values has 7 rows; the page has 602 atoms", self.run_cell(7)[0])

    def test_5_nothing_complained(self):
        self.assertEqual(self.complaints, [])


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=2).result
    print(f"cases {result.testsRun} failures {len(result.failures) + len(result.errors)}")
    sys.exit(not result.wasSuccessful())
