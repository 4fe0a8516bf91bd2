# SPDX-License-Identifier: BSD-3-Clause
"""Uses the preview's page in headless Chromium like a person: arguments PROGRAM CHROMIUM SESSION."""

import asyncio
import json
import math
import os
import pathlib
import shutil
import statistics
import struct
import subprocess
import sys
import unittest

from browser import Browser
from page_case import CHROMIUM, MOLECULE, PROGRAM, SESSION, SIZE, PageCase

# Text of a file must never become markup, although the names of this chain and residue are markup.
HOSTILE = """data_x
loop_
_atom_site.group_PDB
_atom_site.id
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_alt_id
_atom_site.label_comp_id
_atom_site.label_asym_id
_atom_site.label_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.pdbx_PDB_model_num
ATOM 1 C C1 . '<img/src=x/onerror=alert(1)>' '<b>' 1 0.0 0.0 0.0 1
ATOM 2 C C1 . '<img/src=x/onerror=alert(1)>' '<b>' 1 0.0 0.0 0.0 2
ATOM 3 C C2 . '<img/src=x/onerror=alert(1)>' '<b>' 1 2.0 0.0 0.0 2
"""


def same_pixels(a, b):
    """Compares 199 of 200 pixels, which may differ by one step of 255: the page converts to sRGB on the GPU."""
    limits = ["-warn", "1", "-fail", "1e-6", "-failpercent", "0.5", "-hardfail", "0.004"]
    return subprocess.run(["idiff", "-q", *limits, a, b], capture_output=True).returncode == 0


class Page(PageCase):
    async def latencies(self, page, count):
        """Drags until the page has shown so many pictures, and returns the milliseconds between them."""
        await page.evaluate("""window.shown = [];
            window.watcher = new MutationObserver(() => shown.push(performance.now()));
            watcher.observe(document.getElementById('picture'), {attributeFilter: ['data-state']}); 0""")
        path = [(150 + n % 200, 200 + n % 50) for n in range(2000)]
        await page.mouse("mouseMoved", *path[0])
        await page.mouse("mousePressed", *path[0], button="left", buttons=1, clickCount=1)
        for point in path[1:]:
            await page.mouse("mouseMoved", *point, button="left", buttons=1)
            if await page.evaluate("window.shown.length") > count:
                break
        await page.mouse("mouseReleased", *point, button="left", buttons=0, clickCount=1)
        shown = await page.evaluate("watcher.disconnect(), window.shown")
        return sorted(after - before for before, after in zip(shown, shown[1:]))

    async def test_a_person_at_work(self):
        preview = self.serve(MOLECULE, "--record", self.path("recorded.jsonl"))
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            await self.turn(page)
            await self.change_the_probe(page)
            await self.pick(page)
            await self.colour(page)
            await self.save(page)
            await self.shoot(page, "page.png")
            self.assertEqual(page.complaints, [])
            code, _ = preview.end()
            self.assertEqual(code, 143)
            await page.until("document.getElementById('message').textContent.includes('lost')")
            self.assertTrue(await page.evaluate("document.getElementById('controls').disabled"))
        with open(self.path("recorded.jsonl")) as file:
            words = {json.loads(line)["command"] for line in file}
        self.assertLessEqual({"resize", "camera", "set", "export"}, words)

    async def turn(self, page):
        before = (await self.state(page))["camera"]
        await self.shoot(page, "page_at_first.png")
        ranked = await self.latencies(page, 20)
        self.assertGreaterEqual(len(ranked), 20, "pictures while dragging")
        print(f"\npage, {MOLECULE.split('/')[-1]}: {len(ranked)} pictures while dragging, "
              f"median {statistics.median(ranked):.0f} ms apart, p95 {ranked[int(0.95 * (len(ranked) - 1))]:.0f} ms")
        turned = (await self.state(page))["camera"]
        self.assertEqual(turned["target"], before["target"])
        self.assertNotEqual(turned["position"], before["position"])
        await page.drag([(200, 200), (230, 210), (260, 220)], button="right")
        shifted = (await self.state(page))["camera"]
        self.assertNotEqual(shifted["target"], turned["target"])
        distance = lambda c: sum((p - t) ** 2 for p, t in zip(c["position"], c["target"])) ** 0.5
        self.assertAlmostEqual(distance(shifted), distance(before), places=6)
        await page.drag([(260, 220), (230, 210), (200, 200)], modifiers=8)
        await page.mouse("mouseWheel", 200, 200, deltaX=0, deltaY=-200)
        self.assertAlmostEqual(distance((await self.state(page))["camera"]), distance(before) / 2.718281828459 ** 0.3,
                               places=6)

    async def change_the_probe(self, page):
        await page.evaluate("""const slider = document.getElementById('probe'); slider.value = '2.5';
            slider.dispatchEvent(new Event('input', {bubbles: true})); 0""")
        await page.until("document.getElementById('probe-number').value === '2.5'")
        self.assertEqual((await self.state(page))["values"]["surface.probe"], 2.5)

    async def pick(self, page):
        await page.mouse("mouseMoved", 210, 210)
        await page.until("document.querySelector('#tip span').textContent.includes('Å² exposed')")
        self.assertFalse(await page.evaluate("document.getElementById('tip').hidden"))
        hovered = await page.evaluate("document.querySelector('#tip strong').textContent")
        await page.drag([(210, 210), (210, 210)])
        rows = await page.until("(rows => rows.length > 3 && rows)([...document.querySelectorAll('#card dd')].map((row) => row.textContent))")
        self.assertEqual(await page.evaluate("document.querySelector('#card h2').textContent"), hovered)
        self.assertRegex(rows[2], r"^\d+\.\d{3} Å²$")

    async def colour(self, page):
        await page.evaluate("""const scheme = document.getElementById('scheme'); scheme.value = 'chain';
            scheme.dispatchEvent(new Event('change')); 0""")
        await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.color'][0] === 'chain'")
        await page.evaluate("""document.getElementById('scheme').value = 'kind';
            document.getElementById('scheme').dispatchEvent(new Event('change')); 0""")
        await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.color'][0] === 'kind'")
        for key, value in (("ambient_occlusion", 0.8), ("silhouettes", 2), ("depth_cue", 0.25)):
            await page.evaluate(f"""document.getElementById('look-{key}').value = '{value}';
                document.getElementById('look-{key}').dispatchEvent(new Event('input')); 0""")
        x, y, size = await page.evaluate("""document.getElementById('look').open = true, document.getElementById('lamp').scrollIntoView(),
            (({x, y, width}) => [x, y, width])(document.getElementById('lamp').getBoundingClientRect())""")
        await page.drag([(x + size / 2, y + size / 2), (x + 0.7 * size, y + 0.3 * size)])
        values = (await self.state(page))["values"]
        self.assertEqual([values[f"look.{key}"] for key in ("ambient_occlusion", "silhouettes", "depth_cue")], [0.8, 2, 0.25])
        self.assertGreater(min(map(float, values["look.light"].split(","))), 0.4)

    async def save(self, page):
        """The picture saved here, the server's, and that of `meniscus render` are equal."""
        await page.evaluate("document.getElementById('export-name').value = 'written'; 0")
        state = await self.state(page)
        camera = self.path("camera.json")
        with open(camera, "w") as file:
            json.dump(state["camera"], file)
        await page.click("#save")
        await page.until("document.getElementById('message').textContent.includes('Written')")
        rendered = self.path("rendered.png")
        size = f"{state['width']}x{state['height']}"
        subprocess.run([PROGRAM, "render", MOLECULE, "--camera", camera, "--size", size, "--probe", "2.5", "--color", "kind", "--samples", "4", "--background", state["values"]["image.background"],
                        "--ambient-occlusion", "0.8", "--silhouettes", "2", "--depth-cue", "0.25", "--light",
                        state["values"]["look.light"], "-o", rendered],
                       check=True, capture_output=True)
        saved = await self.downloaded(page, "written.png")
        self.assertTrue(same_pixels(rendered, saved))
        self.assertTrue(same_pixels(rendered, self.path("written.png")))
        # Both contain their scene.
        for picture in (saved, self.path("written.png")):
            subprocess.run([PROGRAM, "render", "--scene", picture, MOLECULE, "-o", self.path("again.png"), "--force"],
                           check=True, capture_output=True)
            self.assertTrue(same_pixels(picture, self.path("again.png")))
        await page.click("#save")
        await page.until("document.getElementById('message').textContent.includes('exists')")

    async def test_the_recorded_session_ends_in_the_same_picture(self):
        """The page shows the picture that the session writes at its end."""
        preview = self.serve(MOLECULE, "--commands", SESSION, "--quiet")
        replies = [json.loads(line) for line in preview.lines[:-1]]
        with open(SESSION) as file:
            commands = [json.loads(line) for line in file]
        self.assertEqual(len(replies), len(commands))
        exported = next(r["path"] for r in replies if r.get("path", "").endswith(".png"))
        async with preview.socket() as client:
            await client.send('{"request":"picture"}')
            message = {"full": False}
            while not message["full"]:
                await client.send('{"request":"picture"}')
                data = "{}"
                while isinstance(data, str):
                    said, data = json.loads(data), await asyncio.wait_for(client.recv(), 60)
                    message = said if said.get("event") == "picture" else message
            with open(self.path("shown.png"), "wb") as file:
                file.write(data)
        self.assertTrue(same_pixels(exported, self.path("shown.png")))

    def test_the_picture_of_the_manual_can_be_made(self):
        shutil.copy("/usr/share/pymol/data/tut/1hpv.pdb", self.folder.name)
        script = pathlib.Path(__file__).resolve().parents[2] / "scripts/check/preview_pictures.py"
        subprocess.run([sys.executable, "-B", script, PROGRAM, self.folder.name, "640x400"], check=True, timeout=200)
        with open(self.path("preview_page.png"), "rb") as file:
            data = file.read()
        self.assertEqual(struct.unpack(">II", data[16:24]), (640, 400))
        self.assertGreater(len(data), 30_000, "the molecule is in it")

    async def test_text_of_a_file_stays_text(self):
        name = self.path("<img src=x onerror=alert(1)>.cif")
        with open(name, "w") as file:
            file.write(HOSTILE)
        preview = self.serve(name)
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            self.assertFalse(await page.evaluate("document.getElementById('frames').hidden"))
            await page.drag([(200, 200), (200, 200)])
            await page.until("Boolean(document.querySelector('#card dd'))")
            self.assertIn("onerror", await page.evaluate("document.getElementById('card').textContent"))
            self.assertEqual(await page.evaluate("document.querySelectorAll('img, b, script:not([src], #data)').length"), 0)
            await page.click("#play")
            for frame in (2, 1):
                await page.until(f"document.getElementById('moment').textContent === '{frame} of 2'")
            await page.click("#play")
            await page.at_rest()
            # This frame has a key of the camera, which is then the only one.
            self.assertTrue(await page.evaluate("document.getElementById('save-path').disabled"))
            await page.click("#key")
            await page.until("document.getElementById('key').textContent === 'Remove key'")
            self.assertFalse(await page.evaluate("document.getElementById('save-path').disabled"))
            state = await self.state(page)
            self.assertEqual([key["frame"] for key in state["keys"]], [state["frame_number"]])
            self.assertEqual(state["keys"][0]["camera"], state["camera"])
            self.assertEqual(page.complaints, [])

    async def chips(self, page, count):
        await page.until(f"document.querySelectorAll('#chips li').length === {count}")
        await page.at_rest()
        await page.evaluate("document.getElementById('chips').scrollIntoView()")
        self.assertTrue(await page.evaluate("""(({right}) => [...document.querySelectorAll('#panel :is(button, input, select)')]
            .every((control) => control.getBoundingClientRect().right <= right))(document.getElementById('controls')
            .getBoundingClientRect())"""), "each control is in sight")
        return await page.evaluate("[...document.querySelectorAll('#chips span')].map((chip) => chip.textContent)")

    async def test_a_figure_is_made_in_the_page(self):
        preview = self.serve(MOLECULE, "--select", "polymer", "--color", "chain")
        async with Browser(CHROMIUM, (1100, 900)) as page:
            await page.open(preview.url)
            await self.act(page, "chain C", "Cartoon")
            await self.select(page, "resid 10-20 and (")
            await page.until("!document.getElementById('atoms-fault').hidden")
            self.assertNotIn("locate", await page.evaluate("document.getElementById('atoms-fault').textContent"))
            long = "chain A and (resid 1-60 or resid 80-120 or resid 140-160)"
            await self.act(page, long, "See through")
            await self.select(page, "resid 1-20")
            await page.until("document.querySelector('#card h2').textContent === 'resid 1-20'")
            await page.evaluate("document.querySelector('#card [type=color]').dispatchEvent(new Event('change')); 0")
            await page.click("#cut-x")
            self.assertEqual(await self.chips(page, 4), ["cartoon: chain C", "#e69f00: resid 1-20", f"see through: {long}",
                                                         "cut x >"])
            await page.click("#chips li:last-child .remove")
            await self.chips(page, 3)
            await page.evaluate("""const cut = document.getElementById('cut'); cut.value = 30;
                cut.dispatchEvent(new Event('input')); document.getElementById('legend-shown').click();
                const preset = document.getElementById('look-preset'); preset.value = 'publication';
                preset.dispatchEvent(new Event('change')); 0""")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['look.preset'] === 'publication'")
            state = await self.state(page)
            self.assertEqual(state["values"]["surface.clip"], ["depth>0.3"])
            self.assertTrue(state["values"]["legend.shown"])
            await self.shoot(page, "figure.png")
            # The shown picture, the written one, and the command's are equal.
            await page.click("#copy-command")
            words = await page.until("document.getElementById('command-text').value")
            await page.click("#save")
            saved = await self.downloaded(page, "figure.png")
            subprocess.run(["sh", "-c", words.replace("meniscus", PROGRAM, 1) + " -o made.png"], check=True,
                           capture_output=True, cwd=self.folder.name)
            self.assertTrue(same_pixels(self.path("made.png"), saved))
            # The button of a chip removes its object, and undo restores it.
            await page.click("#chips li:first-child .remove")
            self.assertEqual(len(await self.chips(page, 2)), 2)
            await page.click("#undo")
            self.assertEqual((await self.chips(page, 3))[0], "cartoon: chain C")
            # A click of the middle button centres, and a kept view returns.
            await page.evaluate("document.getElementById('view-name').value = 'front'; "
                                "document.getElementById('view-form').requestSubmit(); 0")
            await page.until("document.querySelector('#kept-views .recall')?.textContent === 'front'")
            before = (await self.state(page))["camera"]
            x, y = await page.evaluate("(({left, top, width, height}) => [left + 0.36 * width, top + 0.42 * height])("
                                       "document.getElementById('picture').getBoundingClientRect())")
            for kind in ("mousePressed", "mouseReleased"):
                await page.mouse(kind, x, y, button="middle", clickCount=1)
            await page.until("JSON.stringify(JSON.parse(document.getElementById('picture').dataset.state).camera.target)"
                             f" !== {json.dumps(json.dumps(before['target'], separators=(',', ':')))}")
            await page.click("#kept-views .recall")
            await page.until("JSON.stringify(JSON.parse(document.getElementById('picture').dataset.state).camera.target)"
                             f" === {json.dumps(json.dumps(before['target'], separators=(',', ':')))}")
            self.assertEqual(page.complaints, [])

    async def test_a_cut_along_any_direction_moves(self):
        preview = self.serve(MOLECULE, "--select", "chain D", "--clip", "1,-1,0>0")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            self.assertEqual(await self.chips(page, 1), ["cut 1,-1,0 >"])
            state = await self.state(page)
            reach = await page.evaluate("(({min, max}) => [min, max].map(Number))(document.querySelector('#chips input'))")
            self.assertEqual(reach, [math.floor(state["low"][0] - state["high"][1]), math.ceil(state["high"][0] - state["low"][1])])
            middle = round(sum(reach) / 2)
            await page.evaluate(f"""const cut = document.querySelector('#chips input'); cut.value = {middle};
                cut.dispatchEvent(new Event('input')); 0""")
            cuts = "JSON.parse(document.getElementById('picture').dataset.state).values['surface.clip'][0]"
            await page.until(f"{cuts} === '1,-1,0>{middle}'")
            await page.click("#chips button:not(.remove)")
            await page.until(f"{cuts} === '1,-1,0<{middle}'")
            self.assertEqual(page.complaints, [])

    async def test_scenes_are_kept_and_played(self):
        preview = self.serve(MOLECULE, "--select", "polymer", "--color", "chain", "--probe", "1")
        scenes = "document.querySelectorAll('#scenes li').length"
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            await page.click("#keep-scene")
            await page.until(f"{scenes} === 1 && document.getElementById('play-strip').disabled")
            await page.evaluate("""const probe = document.getElementById('probe-number');
                probe.value = 2; probe.dispatchEvent(new Event('change')); 0""")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.probe'] === 2")
            await page.click("#keep-scene")
            await page.until(f"{scenes} === 2 && !document.getElementById('play-strip').disabled")
            await page.until("document.querySelectorAll('#scenes canvas').length === 2")
            self.assertGreater(await page.evaluate("""(() => {  // colours of a small picture
                const canvas = document.querySelector('#scenes canvas'), {width, height} = canvas;
                return new Set(new Uint32Array(canvas.getContext('2d').getImageData(0, 0, width, height).data.buffer)).size; })()"""), 50)
            self.assertEqual(await page.evaluate("document.getElementById('film-of').value"), "strip")
            for item, what, seconds in ((1, "hold", 0.2), (1, "transition", 0.8), (2, "hold", 0.2)):
                await page.evaluate(f"""const field = document.querySelector('#scenes li:nth-child({item}) [name={what}]');
                    field.value = {seconds}; field.dispatchEvent(new Event('change')); 0""".replace("const field", "var field"))
            await page.until("document.getElementById('film-of').selectedOptions[0].text === 'Strip: 1.2 s'")
            self.assertTrue((await page.evaluate("document.getElementById('film-of').selectedOptions[0].title")).startswith("30 pictures of "))
            await page.click("#scenes li:first-child .recall")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.probe'] === 1")
            await page.evaluate("""window.radii = new Set();
                new MutationObserver(() => radii.add(JSON.parse(document.getElementById('picture').dataset.state).values['surface.probe']))
                  .observe(document.getElementById('picture'), {attributeFilter: ['data-state']}); 0""")
            await page.click("#play-strip")
            await page.until("document.getElementById('play-strip').textContent === 'Play film' && "
                             "JSON.parse(document.getElementById('picture').dataset.state).strip.place === 1")
            radii = sorted(await page.evaluate("[...radii]"))
            self.assertEqual(radii[-1], 2)
            self.assertGreater(len([radius for radius in radii if 1 < radius < 2]), 3, radii)
            await self.shoot(page, "film.png")
            # An edit while it plays pauses it, and remains.
            await page.click("#play-strip")
            await page.until("document.getElementById('play-strip').textContent === 'Pause film'")
            await page.evaluate("""var slider = document.getElementById('look-light_strength'); slider.value = slider.max;
                slider.dispatchEvent(new Event('input')); 0""")
            await page.until("document.getElementById('play-strip').textContent === 'Play film'")
            self.assertEqual((await self.state(page))["values"]["look.light_strength"], await page.evaluate("slider.valueAsNumber"))
            # The film is written, and a click on its link downloads it.
            await page.evaluate("""document.getElementById('width').value = 64; document.getElementById('height').value = 48;
                document.getElementById('export-samples').value = 1; 0""")
            await page.click("#writers [value=film]")
            await page.until("document.getElementById('message').textContent.includes('Written')", 120)
            await page.click("#save-story")
            await page.until("document.querySelectorAll('#written a').length === 2")
            await page.click("#written a[download=\"figure.mp4\"]")
            with open(self.path("figure.mp4"), "rb") as written, open(await self.downloaded(page, "figure.mp4"), "rb") as got:
                self.assertEqual(got.read(), written.read())
            await self.shoot(page, "written.png")
            await page.click("#scenes li:first-child .remove")
            await page.until(f"{scenes} === 1 && document.getElementById('play-strip').disabled")
            self.assertEqual(page.complaints, [])

    async def test_objects_scenes_and_exports_beside_the_pictures(self):
        preview = self.serve(MOLECULE, "--select", "polymer", "--color", "chain")
        async with Browser(CHROMIUM, (1100, 900)) as page:
            await page.open(preview.url)
            await self.act(page, "chain C", "Surface of")
            self.assertEqual(await self.chips(page, 1), ["surface: chain C"])
            await page.evaluate("""const [opacity, cut] = document.querySelectorAll('#chips li input[type=range]');
                opacity.value = 0.5; opacity.dispatchEvent(new Event('input'));
                cut.value = 0.4; cut.dispatchEvent(new Event('input')); 0""")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['figure.object'][0].clip === 'depth>0.4'")
            await page.click("#surface-shown")
            state = await self.state(page)
            self.assertFalse(state["values"]["surface.shown"])
            # Its atoms have no part of the molecule's surface, so no area is computed.
            x, y = await page.evaluate("(({width, height}) => [width / 2, height / 2])"
                                       "(document.getElementById('stage').getBoundingClientRect())")
            await page.drag([(x, y), (x, y)])
            await page.until("Boolean(document.querySelector('#card dd'))")
            self.assertNotIn("exposed", await page.evaluate("document.getElementById('card').textContent"))
            self.assertEqual(state["values"]["figure.object"], [{"representation": "surface", "selection": "chain C", "opacity": 0.5,
                                                                 "clip": "depth>0.4"}])
            await self.shoot(page, "objects.png")
            # The saved scene opens again after everything was undone.
            await page.click("#writers button[value=scene]")
            await page.until("document.getElementById('message').textContent.includes('Written')")
            with open(self.path("figure.json")) as file:
                scene = json.load(file)
            self.assertEqual([o["representation"] for o in scene["objects"]], ["surface"] * len(scene["objects"]))
            for _ in range(20):
                if (await self.state(page))["undo"] == 0:
                    break
                await page.click("#undo")
            self.assertEqual(await self.chips(page, 0), [])
            await page.click("#open-scene")
            await page.until("document.getElementById('message').textContent.includes('Opened')")
            opened = await self.state(page)
            for key in ("figure.object", "surface.shown"):
                self.assertEqual(opened["values"][key], state["values"][key])
            self.assertEqual(opened["camera"], state["camera"])
            # A large export is reported, does not block the page, and can be cancelled.
            await page.evaluate("""document.getElementById('width').value = 3000;
                document.getElementById('height').value = 3000;
                document.getElementById('export-samples').value = 1024; 0""")
            await page.click("#save")
            await page.until("!document.getElementById('job').hidden")
            await page.until("document.getElementById('job-text').textContent.includes('s')")
            before = (await page.evaluate("JSON.parse(document.getElementById('picture').dataset.state)"))["camera"]
            await page.drag([(300, 300), (340, 320), (380, 340)])
            await page.until("JSON.stringify(JSON.parse(document.getElementById('picture').dataset.state).camera)"
                             f" !== {json.dumps(json.dumps(before, separators=(',', ':')))}")
            self.assertFalse(await page.evaluate("document.getElementById('job').hidden"))
            await page.click("#job-cancel")
            await page.until("document.getElementById('message').textContent.includes('cancelled')")
            self.assertTrue(await page.evaluate("document.getElementById('job').hidden"))
            self.assertEqual(os.listdir(self.folder.name), ["figure.json"])
            self.assertEqual(page.complaints, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
