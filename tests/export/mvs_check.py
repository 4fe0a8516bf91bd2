# SPDX-License-Identifier: BSD-3-Clause
"""Views of `export mvs` as others read them: by molviewspec of PyPI, and drawn by Mol* of npm in Chromium, beside render().
mvs_check.py CHROMIUM MOLSTAR/build/viewer; MENISCUS_PROGRAM is the program: scripts/check/notebooks.sh.

With MENISCUS_SCREENSHOTS=FOLDER in the environment, pictures are left there to be looked at."""

import base64
import http.server
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import zipfile

import molviewspec
from molviewspec import nodes
import numpy as np
import pydantic
from PIL import Image
from playwright.sync_api import sync_playwright

CHROMIUM, MOLSTAR = sys.argv.pop(1), sys.argv.pop(1)
PROGRAM = os.environ["MENISCUS_PROGRAM"]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
SCREENSHOTS = os.environ.get("MENISCUS_SCREENSHOTS")
SIZE = (640, 480)

PAGE = """<!DOCTYPE html><meta charset="utf-8"><link rel="stylesheet" href="molstar.css"><script src="molstar.js"></script>
<style>#app { position: absolute; width: %dpx; height: %dpx; }</style><div id="app"></div>""" % (SIZE[0] + 2, SIZE[1] + 2)

DRAW = """async (text) => {
  const viewer = await molstar.Viewer.create("app", { layoutIsExpanded: false, layoutShowControls: false,
    viewportShowExpand: false, viewportShowControls: false, viewportShowSettings: false, viewportShowSelectionMode: false,
    viewportShowAnimation: false, layoutShowSequence: false, viewportShowTrajectoryControls: false });
  await viewer.loadMvsData(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), "mvsx");
  window.viewer = viewer;
  await new Promise((go) => setTimeout(go, 3000));
  const helper = viewer.plugin.helpers.viewportScreenshot;
  helper.behaviors.values.next({ ...helper.values, transparent: false, axes: { name: "off", params: {} },
    resolution: { name: "viewport", params: {} } });
  return await helper.getImageDataUri();
}"""


class ViewTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

        class Files(http.server.SimpleHTTPRequestHandler):
            def __init__(self, *arguments):
                super().__init__(*arguments, directory=MOLSTAR)

            def do_GET(self):
                if self.path != "/page.html":
                    return super().do_GET()
                self.send_response(200)
                self.send_header("Content-Type", "text/html")
                self.end_headers()
                self.wfile.write(PAGE.encode())

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Files)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        cls.addClassCleanup(server.shutdown)
        cls.address = f"http://127.0.0.1:{server.server_port}/page.html"
        playwright = sync_playwright().start()
        cls.addClassCleanup(playwright.stop)
        cls.browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[
            "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        cls.addClassCleanup(cls.browser.close)

    def export(self, name, *arguments):
        path = self.folder / f"{name}.mvsx"
        subprocess.run([PROGRAM, "export", "mvs", *arguments, "-o", str(path), "-q", "--size", "%dx%d" % SIZE], check=True,
                       capture_output=True)
        return path

    def state_of(self, path):
        with zipfile.ZipFile(path) as archive:
            self.assertEqual(archive.namelist(), ["index.mvsj"])
            return json.loads(archive.read("index.mvsj"))

    def drawn_by_molstar(self, path, name):
        page = self.browser.new_page(viewport={"width": SIZE[0] + 20, "height": SIZE[1] + 20})
        page.set_default_timeout(300_000)
        complaints = []
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.goto(self.address)
        uri = page.evaluate(DRAW, base64.b64encode(path.read_bytes()).decode())
        page.close()
        self.assertEqual(complaints, [])
        picture = Image.open(io.BytesIO(base64.b64decode(uri.split(",")[1]))).convert("RGB")
        self.keep(picture, f"{name}_molstar")
        return np.asarray(picture).astype(int)

    def drawn_by_render(self, name, *arguments):
        path = self.folder / f"{name}.png"
        subprocess.run([PROGRAM, "render", *arguments, "-o", str(path), "-q", "--background", "white", "--size",
                        "%dx%d" % SIZE, "--device", "cpu"], check=True, capture_output=True)
        picture = Image.open(path).convert("RGB")
        self.keep(picture, f"{name}_render")
        return np.asarray(picture).astype(int)

    def keep(self, picture, name):
        if SCREENSHOTS:
            pathlib.Path(SCREENSHOTS).mkdir(parents=True, exist_ok=True)
            picture.save(f"{SCREENSHOTS}/{name}.png")

    def compare(self, name, *arguments, least=0.85):
        """Compares pictures by outlines and hues: Mol* has a wider angle, which shows a little more, and other
        lights."""
        path = self.export(name, *arguments, *(["--tolerance", "0.1"] if "--hide-surface" not in arguments else []))
        theirs, ours = self.drawn_by_molstar(path, name), self.drawn_by_render(name, *arguments)
        self.assertEqual(theirs.shape, ours.shape)
        there, here = (theirs.min(axis=2) < 245), (ours.min(axis=2) < 245)
        overlap = (there & here).sum() / (there | here).sum()
        both = there & here & (ours.max(axis=2) > 60) & (theirs.max(axis=2) > 60)

        def hues(picture):
            rest = picture[both] - picture[both].mean(axis=1, keepdims=True)
            return rest / np.maximum(np.linalg.norm(rest, axis=1, keepdims=True), 1)

        colored = (np.ptp(ours[both], axis=1) > 40) & (np.ptp(theirs[both], axis=1) > 40)
        alike = (hues(ours)[colored] * hues(theirs)[colored]).sum(axis=1)
        print(f"{name}: outlines overlap by {100 * overlap:.1f} %, {100 * (alike > 0.9).mean():.1f} % of "
              f"{colored.sum()} coloured pixels have the hue, {path.stat().st_size:,} bytes")
        # Thin things overlap little, but lie in the same box.
        box = [[(axis.min(), axis.max()) for axis in np.nonzero(mask)] for mask in (there, here)]
        self.assertLess(np.abs(np.subtract(*box)).max(), 0.06 * max(SIZE))
        self.assertGreater(overlap, least)
        self.assertGreater((alike > 0.9).mean(), 0.85)

    def test_surface(self):
        self.compare("ubiquitin", UBIQUITIN, "--color", "residue")

    def test_turned_and_cut(self):
        self.compare("cut", UBIQUITIN, "--color", "residue", "--turn", "y70", "--clip", "depth>0.5", "--cap-color",
                     "orange")

    def test_sticks_and_orthographic(self):
        self.compare("sticks", UBIQUITIN, "--color", "residue", "--hide-surface", "--sticks", "all", "--projection",
                     "orthographic", least=0.3)

    def check(self, state):
        """Checks a state as a whole, and the parameters of each node, which validate_state_tree() does not look at."""
        molviewspec.validate_state_tree(json.dumps(state))
        params = {"canvas": nodes.CanvasParams, "camera": nodes.CameraParams, "primitives": nodes.PrimitivesParams,
                  "mesh": nodes.MeshParams, "ellipsoid": nodes.EllipsoidParams, "tube": nodes.TubeParams}
        seen = set()

        def walk(node):
            if node["kind"] != "root":
                kind = node["params"]["kind"] if node["kind"] == "primitive" else node["kind"]
                self.assertEqual(set(node["params"]) - set(params[kind].model_fields), set())
                params[kind].model_validate(node["params"])
                seen.add(kind)
            for child in node.get("children", []):
                walk(child)

        walk(state["root"])
        return seen

    def test_molviewspec_accepts_it(self):
        found = set()
        for name, arguments in (("plain", []), ("cut", ["--clip", "depth>0.5"]), ("glass", ["--opacity", "0.4", "--sticks", "resid 48"]),
                                ("beside", ["--spheres", "resid 1-9", "--tube", "all"])):
            with self.subTest(name):
                state = self.state_of(self.export(f"valid_{name}", UBIQUITIN, *arguments, "--tolerance", "0.5"))
                found |= self.check(state)
                state["root"]["children"][1]["params"].pop("target")
                with self.assertRaises(pydantic.ValidationError):
                    self.check(state)
        self.assertEqual(found, {"canvas", "camera", "primitives", "mesh", "ellipsoid", "tube"})

    def test_frames_are_states(self):
        models = self.folder / "models.pdb"
        atoms = [line for line in pathlib.Path(UBIQUITIN).read_text().splitlines() if line.startswith("ATOM")][:80]
        models.write_text("".join(f"MODEL     {n}\n" + "\n".join(atoms) + "\nENDMDL\n" for n in (1, 2, 3)) + "END\n")
        path = self.export("frames", str(models), "--frames", "all", "--tolerance", "0.5")
        state = self.state_of(path)
        self.assertEqual((state["kind"], len(state["snapshots"])), ("multiple", 3))
        nodes.States.model_validate(state)
        for snapshot in state["snapshots"]:
            self.check({"root": snapshot["root"], "metadata": state["metadata"]})
        self.drawn_by_molstar(path, "frames")


if __name__ == "__main__":
    result = unittest.main(exit=False, verbosity=2).result
    print(f"cases {result.testsRun} failures {len(result.failures) + len(result.errors)}")
    sys.exit(not result.wasSuccessful())
