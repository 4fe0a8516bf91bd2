# SPDX-License-Identifier: BSD-3-Clause
"""Messages between a page in a frame and the page around it, in Chromium: arguments PROGRAM CHROMIUM MOLECULE."""

import asyncio
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "preview"))

from browser import Browser

PROGRAM, CHROMIUM, MOLECULE = sys.argv[1:4]
SOFTWARE_GL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--allow-file-access-from-files")

AROUND = """<!DOCTYPE html><meta charset="utf-8"><p id="message"></p>
<iframe src="page.html" width="300" height="220" sandbox="allow-scripts"></iframe>
<script>
const heard = [], frame = document.querySelector("iframe");
addEventListener("message", ({ source, data }) => { if (source === frame.contentWindow) heard.push(data.meniscus); });
const say = (what) => frame.contentWindow.postMessage({ meniscus: what }, "*");
const last = (name) => heard.findLast((what) => what[name] !== undefined)?.[name];
</script>"""


class MessagesTest(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        place = pathlib.Path(folder.name)
        subprocess.run([PROGRAM, "export", "page", MOLECULE, "-o", str(place / "page.html"), "-q", "--select", "resid 1-9",
                        "--size", "64x48"], check=True, capture_output=True)
        (place / "around.html").write_text(AROUND)
        self.page = await self.enterAsyncContext(Browser(CHROMIUM, (400, 400), SOFTWARE_GL))
        await self.page.send("Page.navigate", url=(place / "around.html").as_uri())
        await self.page.until("typeof frame !== 'undefined'")

    async def asked(self):
        """Requests the page's camera until it answers, and returns the camera."""
        for _ in range(600):
            await self.page.evaluate("say({ hello: true })")
            await asyncio.sleep(0.2)
            if camera := await self.page.evaluate("last('camera')"):
                return camera
        self.fail("the page does not answer")

    async def told(self, camera):
        await self.page.evaluate(f"heard.length = 0; say({{ camera: {json.dumps(camera)} }}); say({{ hello: true }})")
        return await self.page.until("last('camera')")

    async def test_it_says_what_it_is_asked_for(self):
        await asyncio.sleep(4)
        self.assertEqual(await self.page.evaluate("heard.length"), 0)  # The page sends nothing without a request.
        camera = await self.asked()
        self.assertGreater(await self.page.evaluate("last('atoms')"), 40)
        self.assertEqual(sorted(camera), ["height", "position", "projection", "target", "up", "vertical_fov"])
        # The page takes a camera that it gets, in the molecule's coordinates.
        wanted = {**camera, "position": [5 + x for x in camera["position"]], "target": [5 + x for x in camera["target"]]}
        now = await self.told(wanted)
        for name in ("position", "target", "up"):
            for a, b in zip(now[name], wanted[name]):
                self.assertAlmostEqual(a, b, 9)
        self.assertEqual((await self.told({**camera, "projection": "orthographic"}))["projection"], "orthographic")

    async def test_a_click_is_told(self):
        await self.asked()
        await asyncio.sleep(1)
        box = await self.page.evaluate("(() => { const { left, top } = frame.getBoundingClientRect(); return [left, top]; })()")
        for y in (60, 80, 100, 120, 140):
            for x in (60, 90, 120, 150):
                place = {"x": box[0] + x, "y": box[1] + y}
                for kind in ("mousePressed", "mouseReleased"):
                    await self.page.mouse(kind, **place, button="left", buttons=1 if kind == "mousePressed" else 0, clickCount=1)
                await asyncio.sleep(0.1)
        picked = await self.page.until("heard.findLast((what) => what.picked)?.picked")
        self.assertRegex(picked["name"], r"^A [A-Z]{3} [0-9]+ [A-Z0-9]+$")
        self.assertEqual(len(picked["point"]), 3)
        self.assertLess(picked["atom"], await self.page.evaluate("last('atoms')"))

    async def test_what_cannot_be_is_left_alone(self):
        camera = await self.asked()
        nonsense = [{**camera, "position": [1, 2]}, {**camera, "position": ["1", 2, 3]}, {**camera, "vertical_fov": 0},
                    {**camera, "up": [t - p for t, p in zip(camera["target"], camera["position"])]},
                    {**camera, "target": camera["position"]}, {**camera, "height": -1}, {}, 7]
        for wrong in nonsense:
            with self.subTest(wrong):
                self.assertEqual(await self.told(wrong), camera)
        await self.page.evaluate("frame.contentWindow.postMessage({ meniscus: { camera: null, colors: [1], scheme: 99 } }, '*'); "
                                 "frame.contentWindow.postMessage('meniscus', '*'); frame.contentWindow.postMessage(null, '*')")
        await self.page.evaluate("say({ colors: new Uint8Array(5) })")
        self.assertEqual(await self.told({}), camera)
        self.assertEqual(self.page.complaints, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
