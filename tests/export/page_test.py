# SPDX-License-Identifier: BSD-3-Clause
"""The page of `export page` in a real browser, pixel by pixel against `render`: arguments PROGRAM CHROMIUM FREESASA_DATA,
and then perhaps names of tests (PageTest.test_turns_and_picks), or --share N/OF for a part of all tests.

With MENISCUS_SCREENSHOTS=FOLDER in the environment, pictures of the pages are left there to be looked at."""

import base64
import json
import math
import os
import subprocess
import sys
import unittest

import numpy
import OpenImageIO
from figure_page import DEPTH_CUE, PROGRAM, PROTEASE, SIZE, TOXIN, UBIQUITIN, PageCase


class PageTest(PageCase):
    def run_of(self, molecule, last, frames):
        """Writes a file of models and returns its path: the residues up to `last` are bent more in each."""
        with open(molecule) as file:
            rows = [row for row in file if row.startswith("ATOM") and int(row[22:26]) <= last]
        with open(self.path("run.pdb"), "w") as file:
            for frame in range(frames):
                file.write(f"MODEL     {frame + 1:4d}\n")
                for row in rows:
                    x, y, z = (float(row[30 + 8 * n:38 + 8 * n]) for n in range(3))
                    turn = int(row[22:26]) / 3
                    x, y = x + 0.8 * frame * math.sin(turn), y + 0.5 * frame * math.cos(turn)
                    file.write(f"{row[:30]}{x:8.3f}{y:8.3f}{z:8.3f}{row[54:]}")
                file.write("ENDMDL\n")
        return file.name

    def rings(self):
        """Writes a base and a sugar, each a flat ring."""
        with open(self.path("rings.pdb"), "w") as file:
            for number, residue, names in ((1, "LIG", "N1 C2 N3 C4 C5 C6"), (2, "NAG", "C1 C2 C3 C4 C5 O5")):
                for n, name in enumerate(names.split()):
                    x, y = 8 * number + 1.4 * math.cos(n * math.pi / 3), 1.4 * math.sin(n * math.pi / 3)
                    file.write(f"HETATM{6 * number + n:5d}  {name:<3} {residue} A{number:4d}    {x:8.3f}{y:8.3f}{0:8.3f}  1.00  0.00          {name[0]:>2}\n")
        return file.name

    async def test_pixels_are_those_of_render(self):
        async with self.browser() as page:
            await self.compare(page, UBIQUITIN)
            await self.shoot(page, "page_1ubq.png")
            await self.compare(page, UBIQUITIN, "--projection", "orthographic", "--color", "kind", "--preset", "flat")
            await self.compare(page, UBIQUITIN, "--patches", "hydrophobicity > 1.5")
            await self.compare(page, TOXIN, "--color", "chain")
            await self.shoot(page, "page_1tii.png")
            await self.compare(page, TOXIN, "--show", "chain A", "--sticks", "chain C", "--zoom-to", "chain C")
            self.assertEqual(page.complaints, [])

    async def test_rare_surfaces_and_shapes_are_those_of_render(self):
        inside, cage, part = self.path("inside.json"), [], self.part_of(UBIQUITIN, 1, 30)
        with open(inside, "w") as file:
            json.dump({"position": [0, 0, 0], "target": [1, 0.2, 0.1], "up": [0, 1, 0], "projection": "perspective", "vertical_fov": 80}, file)
        for n in range(120):
            y, turn = 1 - 2 * (n + 0.5) / 120, n * 2.399963
            cage.append((8 * math.sqrt(1 - y * y) * math.cos(turn), 8 * y, 8 * math.sqrt(1 - y * y) * math.sin(turn), 1.9))
        async with self.browser() as page:
            # One torus meets itself, and one probe touches four atoms at once.
            await self.compare(page, self.balls("spindle.xyzr", [(0, 0, 0, 1.5), (5.4, 0, 0, 1.5), (8, 1, 0, 1.2)]), "--color", "kind")
            await self.compare(page, self.balls("square.xyzr", [(0, 0, 0, 1.5), (4, 0, 0, 1.5), (4, 4, 0, 1.5), (0, 4, 0, 1.5)]), "--color", "kind")
            await self.compare(page, self.balls("cage.xyzr", cage), "--camera", inside)
            await self.shoot(page, "page_cage.png")
            await self.compare(page, part, "--surface", "sas", "--color", "residue")
            await self.compare(page, part, "--surface", "vdw", "--color", "residue")
            await self.compare(page, self.rings(), "--glycans", "resname NAG", "--bases", "resname LIG", "--hide-surface")
            await self.compare(page, self.rings(), "--bases", "resname LIG", "--opacity", "0.5")
            self.assertEqual(page.complaints, [])

    async def test_colours_of_points_are_those_of_render(self):
        part, grid = self.part_of(UBIQUITIN, 1, 15), self.path("map.dx")
        with open(part) as file:
            places = [[float(row[30 + 8 * n:38 + 8 * n]) for n in range(3)] for row in file]
        low, high = numpy.min(places, axis=0) - 6, numpy.max(places, axis=0) + [6, 6, 1]  # A part of the surface is beyond the map.
        count = ((high - low) / 1.3).astype(int)
        values = numpy.random.default_rng(1).normal(size=count)
        with open(grid, "w") as file:
            file.write("object 1 class gridpositions counts %d %d %d\norigin %f %f %f\ndelta 1.3 0.2 0\ndelta 0 1.3 0\ndelta 0 0 1.3\n"
                       "object 2 class gridconnections counts %d %d %d\nobject 3 class array type double rank 0 items %d data follows\n"
                       % (*count, *low, *count, values.size))
            file.write("\n".join(f"{value:.6f}" for value in values.ravel()) + "\n")
        by_map = ["--color-map-file", grid, "--color-range=-1:1"]
        async with self.browser() as page:
            await self.compare(page, part, *by_map, "--sticks", "resid 1-3")
            await page.evaluate("meniscus.set_scheme(meniscus.figure.schemes.findIndex(({ name }) => name === 'residue'))")
            # Colours by a scale neither fade nor shine; other colours keep their look.
            self.check("another scheme", await self.cast(page), self.rendered(part, "--color", "residue", "--sticks", "resid 1-3"))
            await page.evaluate("meniscus.set_scheme(meniscus.figure.schemes.findIndex(({ name }) => name === 'bfactor'))")
            self.check("another scale", await self.cast(page), self.rendered(part, "--color", "bfactor", "--sticks", "resid 1-3"))
            await self.compare(page, part, *by_map, "--clip", "depth>0.4", "--opacity", "0.6", "--set", "surface.map_offset=1.4", "--color", "resid 5-9=orange")
            await self.compare(page, part, "--color", "lipophilicity", "--projection", "orthographic")
            await self.shoot(page, "page_lipophilicity.png")
            self.assertEqual(page.complaints, [])

    async def test_cuts_and_what_is_seen_through_are_those_of_render(self):
        part = self.part_of(UBIQUITIN, 1, 40)
        async with self.browser() as page:
            await self.compare(page, part, "--clip", "depth>0.4", "--sticks", "resid 1-10", "--color", "residue")
            await self.shoot(page, "page_cut.png")
            await self.compare(page, part, "--clip", "1,1,0<60", "--clip", "depth>0.2", "--cap-color", "orange", "--cap-hatching", "1.5",
                               "--projection", "orthographic")
            await self.compare(page, part, "--opacity", "0.5", "--sticks", "backbone", "--color", "chain")
            await self.shoot(page, "page_seen_through.png")
            await self.compare(page, part, "--opacity", "resid 1-20=0.4", "--film-opacity", "--clip", "depth>0.3", "--show",
                               "resid 1-35", "--preset", "cover")
            self.assertEqual(page.complaints, [])

    async def test_what_readers_hide_cut_and_see_through_is_that_of_render(self):
        camera, size, few = self.path("camera.json"), "%dx%d" % SIZE, self.part_of(PROTEASE, 20, 60)
        async with self.browser() as page:
            await self.load(page, self.export(few, "--size", size, "--color", "chain", "--save-camera", camera))
            look = ["--size", size, "--color", "chain", "--camera", camera, "--depth-cue", "0"]
            await page.evaluate("meniscus.figure.look.finish[%d] = 0" % DEPTH_CUE)
            await page.evaluate("meniscus.show_chains(new Set(['A']))")
            self.check("chain A alone", await self.cast(page), self.rendered(few, *look, "--show", "chain A"))
            await page.evaluate("meniscus.set_cut(0.5)")
            plane = await page.evaluate("(() => { const [x, y, z, w] = meniscus.cut, o = meniscus.figure.origin;"
                                        " return [x, y, z, w + x * o[0] + y * o[1] + z * o[2]]; })()")
            clip = "%.9f,%.9f,%.9f<%.9f" % tuple(plane)
            self.check("cut, chain A alone", await self.cast(page), self.rendered(few, *look, "--show", "chain A", "--clip", clip))
            await page.evaluate("meniscus.show_chains(new Set(meniscus.figure.names.chains)), meniscus.opacity = 0.5, meniscus.set_cut(0)")
            self.check("seen through", await self.cast(page), self.rendered(few, *look, "--opacity", "0.5"))
            # Sticks move with their chain, also where the surface is cut.
            await self.load(page, self.export(few, "--size", size, "--color", "chain", "--camera", camera, "--sticks", "backbone", "--clip", clip))
            await page.evaluate("meniscus.figure.look.finish[%d] = 0" % DEPTH_CUE)
            await page.evaluate("meniscus.show_chains(new Set(['A']))")
            self.check("sticks of chain A", await self.cast(page), self.rendered(few, *look, "--show", "chain A", "--clip", clip, "--sticks", "backbone and chain A"))
            self.assertEqual(page.complaints, [])

    async def test_views_are_those_of_their_files(self):
        part, camera = self.part_of(UBIQUITIN, 1, 15), self.path("back.json")
        inside = ["--size", "%dx%d" % SIZE, "--color", "residue", "--clip", "depth>0.4", "--view", "left", "--zoom-to", "resid 5", "--opacity", "0.6"]
        self.run_program("render", part, "-o", self.path("back.png"), "--force", "-q", "--size", "%dx%d" % SIZE, "--view", "back", "--projection",
                         "orthographic", "--save-camera", camera)
        self.run_program("render", part, "-o", self.path("inside.png"), "--force", "-q", "--samples", "1", *inside)
        async with self.browser() as page:
            await self.load(page, self.export(part, "--size", "%dx%d" % SIZE, "--color", "residue", "--named-view", f"<b>Back</b>={camera}",
                                              "--named-view", f"Inside={self.path('inside.png')}"))
            names = await page.evaluate("[...document.querySelectorAll('#views button')].map((button) => button.textContent)")
            self.assertEqual(names, ["Reset view", "<b>Back</b>", "Inside"])
            first = await page.evaluate("meniscus.camera")
            await page.evaluate("window.held = false, meniscus.waiting = 0, meniscus.figure.samples.length = 1, meniscus.change()")
            await page.at_rest(100)
            await page.click("#views button:nth-child(2)")
            self.assertEqual(await page.evaluate("document.getElementById('picked').textContent"), "<b>Back</b>")
            self.assertTrue(await page.evaluate("meniscus.camera.orthographic"))
            await page.until("meniscus.gliding === null", 30)
            with open(camera) as file:
                wanted = json.load(file)
            seen = await page.evaluate("({ ...meniscus.camera, origin: meniscus.figure.origin })")
            for key in ("position", "target"):
                numpy.testing.assert_allclose(numpy.add(seen[key], seen["origin"]), wanted[key], atol=1e-9)
            self.assertEqual((seen["orthographic"], seen["height"]), (True, wanted["height"]))
            # The middle of a half turn looks at a right angle to its start.
            middle = await page.evaluate("((v) => between({ ...v[0].camera }, { ...v[1].camera, orthographic: false, fov: v[0].camera.fov }, 0.5))"
                                         "(meniscus.figure.views)")
            ahead = numpy.subtract(middle["target"], middle["position"])
            self.assertLess(abs(numpy.dot(ahead, numpy.subtract(first["target"], first["position"]))), 1e-6 * numpy.dot(ahead, ahead))
            await page.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
            await page.evaluate("window.held = true")
            await page.click("#views button:nth-child(3)")
            self.assertEqual(await page.evaluate("document.getElementById('opacity').value"), "60")
            self.check("view Inside", await self.cast(page), self.rendered(part, *inside))
            await page.click("#reset")
            self.assertEqual(await page.evaluate("meniscus.camera"), first)
            self.assertEqual(page.complaints, [])
        for bad, words in ((["--named-view", "Back"], "write NAME=FILE"), (["--named-view", f"A={camera}", "--named-view", f"A={camera}"], "choose another"),
                           (["--named-view", "A=none.json"], "cannot be opened")):
            done = subprocess.run([PROGRAM, "export", "page", part, "-o", self.path("bad.html"), *bad], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(words, done.stderr)
            self.assertFalse(os.path.exists(self.path("bad.html")))

    async def compare_frames(self, page, run, shown, *options, before="0"):
        """before: script that runs before frames are shown."""
        await self.load(page, self.export(run, "--frames", "all", "--size", "%dx%d" % SIZE, *options))
        await page.evaluate(before)
        for frame in shown:
            await page.evaluate(f"meniscus.frames.show({frame}).then(() => 0)")
            self.assertEqual(await page.evaluate("meniscus.figure.number"), frame)
            self.check(f"frame {frame} {' '.join(options)}", await self.cast(page), self.rendered(run, "--frames", "all", *options, frame=frame))

    async def test_frames_are_those_of_render(self):
        run = self.run_of(UBIQUITIN, 12, 4)
        async with self.browser() as page:
            await self.compare_frames(page, run, (0, 3, 1, 2), "--color", "radial", "--sticks", "resid 1-3")
            self.assertEqual(await page.evaluate("meniscus.figure.sources.shown"), await page.evaluate("meniscus.figure.first.tables.shown[0]"))
            self.assertEqual(await page.evaluate("document.getElementById('frame').getAttribute('aria-valuetext')"), "3 of 4: frame 2")
            # Atoms may differ from frame to frame; planes are placed anew in each, and a view may have a name.
            await self.compare_frames(page, run, (2, 0), "--select", "x < 36", "--color", "secondary")
            await self.compare_frames(page, run, (3,), "--clip", "depth>0.4", "--cap-color", "orange")
            self.run_program("render", run, "-o", self.path("in.png"), "--force", "-q", "--samples", "1", "--clip", "depth>0.3")
            look = ("--size", "%dx%d" % SIZE)
            await self.load(page, self.export(run, "--frames", "all", *look, "--named-view", f"In={self.path('in.png')}"))
            await page.evaluate("meniscus.frames.show(2).then(() => 0)")
            await page.send("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
            await page.click("#views button:nth-child(2)")
            self.check("frame 2, a view", await self.cast(page), self.rendered(run, "--frames", "all", "--clip", "depth>0.3", frame=2))
            self.assertEqual(page.complaints, [])

    async def test_frames_are_played(self):
        run = self.run_of(UBIQUITIN, 3, 3)
        async with self.browser() as page:
            await self.open(page, self.export(run, "--frames", "all", "--color", "residue"))
            await page.at_rest(100)
            shown = "meniscus.figure.number"
            await page.click("#play")
            self.assertEqual(await page.evaluate("document.getElementById('play').textContent"), "Pause")
            for frame in (1, 2, 0):
                await page.until(f"{shown} === {frame}", 60)
            await page.evaluate("meniscus.canvas.focus()")
            for key, wanted in ((" ", None), ("PageDown", 1), ("PageUp", -1), ("PageUp", -1)):
                before = await page.evaluate("meniscus.frames.wanted")
                await page.send("Input.dispatchKeyEvent", type="keyDown", key=key)
                await page.send("Input.dispatchKeyEvent", type="keyUp", key=key)
                if wanted is None:
                    self.assertFalse(await page.evaluate("meniscus.playing"))
                else:
                    wanted = min(2, max(0, before + wanted))
                    await page.until(f"{shown} === {wanted}", 60)
            await page.at_rest(100)
            self.assertEqual(page.complaints, [])
        done = subprocess.run([PROGRAM, "export", "page", self.run_of(UBIQUITIN, 12, 2), "--frames", "all", "--interpolate", "20000", "-o",
                               self.path("large.html"), "--device", "cpu"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"20,001 frames come to about [\d,]+ bytes")
        self.assertRegex(done.stderr, r"browsers open no more than 250,000,000; choose fewer frames \(--stride \d\)")
        self.assertFalse(os.path.exists(self.path("large.html")))

    async def png(self, page, times, tiles):
        """Returns the sRGB pixels of a PNG that is `times` as large as the window."""
        text = await page.evaluate(
            "(async () => { Object.assign(kTiles, %s); const png = await draw_png(meniscus, meniscus.pixels().map((side) => %d * side), () => {});"
            " let all = ''; for (const byte of new Uint8Array(await png.arrayBuffer())) all += String.fromCharCode(byte); return btoa(all); })()"
            % (json.dumps(tiles), times))
        with open(self.path("page.png"), "wb") as file:
            file.write(base64.b64decode(text))
        image = OpenImageIO.ImageInput.open(self.path("page.png"))
        return image.read_image(OpenImageIO.UINT8)[:, :, :3].astype(numpy.float64)

    async def test_a_png_has_any_size_and_no_seams(self):
        part = self.part_of(UBIQUITIN, 1, 15)
        async with self.browser((420, 240)) as page:
            await self.load(page, self.export(part, "--color", "residue", "--label", "resid 5=Val 5", "--background", "white"))
            await page.evaluate("meniscus.figure.samples.length = 2")
            own = {"whole": 2048, "tile": 1024}
            small, large = await self.png(page, 1, own), await self.png(page, 3, own)
            width, height = await page.evaluate("meniscus.pixels()")
            self.assertEqual((small.shape, large.shape), ((height, width, 3), (3 * height, 3 * width, 3)))
            reduced = large.reshape(height, 3, width, 3, 3).mean(axis=(1, 3))
            off = numpy.abs(reduced - small).mean()
            tiled = numpy.abs(await self.png(page, 3, {"whole": 64, "tile": 160}) - large)
            print(f"png: {width} x {height}, three times as large and reduced {off:.2f} of 255 off; in tiles at most {tiled.max():.0f}")
            self.assertLess(off, 3)
            self.assertLessEqual(tiled.max(), 1)
            await page.evaluate("meniscus.opacity = 0.5, meniscus.set_cut(0.4)")
            whole, parts = await self.png(page, 1, own), await self.png(page, 1, {"whole": 64, "tile": 80})
            self.assertGreater(numpy.abs(whole - small).mean(), 1)
            self.assertLessEqual(numpy.abs(whole - parts).max(), 1)
            await page.evaluate("document.getElementById('width').value = 900, document.getElementById('save').click()")
            self.assertEqual(await page.evaluate("document.getElementById('save').textContent"), "Stop")
            self.assertRegex(await page.evaluate("document.getElementById('picked').textContent"), r"^Drawing 900 × \d+ pixels: \d+ %$")
            await page.click("#save")
            await page.until("document.getElementById('save').textContent === 'Save PNG'", 60)
            self.assertEqual(await page.evaluate("document.getElementById('picked').textContent"), "Nothing is saved.")
            await page.evaluate("document.getElementById('width').value = 90000, document.getElementById('save').click()")
            self.assertRegex(await page.evaluate("document.getElementById('message').textContent"), r"is 16 to \d+ pixels")
            self.assertEqual(page.complaints, [])

    async def test_turns_and_picks(self):
        async with self.browser() as page:
            await self.open(page, self.export(UBIQUITIN, "--color", "residue", "--label", "resid 48=Lys <48>"))
            await page.at_rest(100)
            text, x, y = await page.evaluate("(() => { const t = document.querySelector('#labels text');"
                                             " return [t.textContent, +t.getAttribute('x'), +t.getAttribute('y')]; })()")
            self.assertEqual(text, "Lys <48>")
            seen = await page.evaluate("(() => { const v = meniscus, atom = v.figure.tables.shown.findIndex((_, a) =>"
                                       " v.atom_name(a) === 'A LYS 48 CB'); return v.places([v.caster.center_of(atom)])[0]; })()")
            self.assertLess(max(abs(x - seen[0]), abs(y - seen[1])), 25)
            before = await page.evaluate("window.meniscus.camera.position")
            box = await page.evaluate("(() => { const b = meniscus.canvas.getBoundingClientRect();"
                                      " return [b.left + b.width / 2, b.top + b.height / 2]; })()")
            await page.drag([box, [box[0] + 60, box[1] + 20]])
            await page.at_rest(100)
            self.assertNotEqual(before, await page.evaluate("window.meniscus.camera.position"))
            await page.drag([box])
            self.assertRegex(await page.evaluate("document.getElementById('picked').textContent"),
                             r"^A [A-Z]{3} \d+ \w+ – (convex|toroidal|concave) patch")
            await page.drag([[box[0] - 20, box[1] - 5]])
            self.assertRegex(await page.evaluate("document.getElementById('picked').textContent"), r"; \d+\.\d\d Å from A [A-Z]{3} \d+ ")
            await page.evaluate("meniscus.canvas.focus()")
            for key in ("ArrowLeft", "+", ".", "o", "p", "o", "r"):
                await page.send("Input.dispatchKeyEvent", type="keyDown", key=key)
                await page.send("Input.dispatchKeyEvent", type="keyUp", key=key)
            await page.until("meniscus.gliding === null", 60)
            self.assertEqual(before, await page.evaluate("window.meniscus.camera.position"))
            await page.evaluate("(() => { const cut = document.getElementById('cut'); cut.value = 50; cut.dispatchEvent(new Event('input')); })()")
            await page.at_rest(200)
            self.assertEqual(1, await page.evaluate("meniscus.caster.layers.planes.length"))
            on_caps = await page.evaluate("(() => { const c = meniscus.caster, words = c.read(0, 0, ...c.size, 2); let count = 0;"
                                          " for (let n = 1; n < words.length; n += 4) count += words[n] === kOnPlane; return count; })()")
            self.assertGreater(on_caps, 100)
            await page.evaluate("document.getElementById('reset').click()")
            self.assertFalse(await page.evaluate("meniscus.caster.has_layers()"))
            self.assertEqual(page.complaints, [])

    async def test_distances_of_sticks(self):
        """Distances between atoms of sticks and surfaces are the file's own; meshes know no atoms."""
        places = {}
        with open(UBIQUITIN) as file:
            for row in file:
                if row.startswith("ATOM"):
                    places[f"{row[21]} {row[17:20]} {int(row[22:26])} {row[12:16].strip()}"] = [
                        float(row[30 + 8 * n:38 + 8 * n]) for n in range(3)]
        async with self.browser() as page:
            await self.open(page, self.export(UBIQUITIN, "--select", "resid 1-40", "--sticks", "resid 48 5", "--balls", "resid 60",
                                              "--tube", "resid 60-70"))
            await page.at_rest(100)
            last = "meniscus.figure.tables.shown.length - 1 - [...meniscus.figure.tables.shown.keys()].reverse().findIndex"
            for one, other in (("A LYS 48 CB", "A LYS 48 NZ"), ("A LYS 48 NZ", "A ASN 60 CA"), ("A VAL 5 CA", "A LYS 48 NZ")):
                for find in ("meniscus.figure.tables.shown.findIndex", last):
                    words = await page.evaluate(f"(() => {{ const v = meniscus, find = (name) => [...v.figure.tables.shown.keys()].filter((a) =>"
                                                f" v.atom_name(a) === name && v.caster.center_of(a)).at({-1 if find == last else 0});"
                                                f" v.tell({{atom: find('{one}'), primitive: 0}});"
                                                f" return v.tell({{atom: find('{other}'), primitive: 0}}); }})()")
                    self.assertIn(f"{math.dist(places[one], places[other]):.2f} Å from {one}", words)
            self.assertTrue(await page.evaluate("[...meniscus.figure.tables.shown.keys()].some((a) => meniscus.caster.center_of(a) === null)"))
            # The selection is tinted, but not in the picture that is saved.
            read = "[...meniscus.caster.read(0, 0, ...meniscus.caster.size, 0)].reduce((sum, word) => (sum * 31 + word) >>> 0, 7)"
            before = await page.evaluate(read)
            plain = await self.png(page, 1, None)
            await page.evaluate("meniscus.select([...meniscus.figure.names.atoms.keys()].slice(0, 100))")
            await page.at_rest(100)
            self.assertNotEqual(await page.evaluate(read), before)
            self.assertEqual(numpy.abs(await self.png(page, 1, None) - plain).max(), 0)
            await page.at_rest(100)
            self.assertNotEqual(await page.evaluate(read), before)
            await page.evaluate("meniscus.select([])")
            await page.at_rest(100)
            self.assertEqual(await page.evaluate(read), before)
            self.assertEqual(page.complaints, [])

    async def test_what_files_say_runs_nowhere(self):
        evil = "</script><script>window.stolen=1</script><!--"
        with open(UBIQUITIN) as file:
            rows = [line for line in file if line.startswith("ATOM")][:40]
        molecule = self.path("<script>window.stolen=1<!--.cif")
        fields = ["group_PDB", "id", "type_symbol", "label_atom_id", "label_comp_id", "label_asym_id", "label_seq_id",
                  "auth_asym_id", "Cartn_x", "Cartn_y", "Cartn_z"]
        with open(molecule, "w") as file:
            file.write("data_x\nloop_\n" + "".join(f"_atom_site.{field}\n" for field in fields))
            for n, row in enumerate(rows):
                file.write(f"ATOM {n + 1} {row[76:78].strip()} '{row[12:16].strip()}{evil}' '{evil}' '{evil}' 1 '{evil}' "
                           f"{row[30:38]} {row[38:46]} {row[46:54]}\n")
        async with self.browser((600, 400)) as page:
            path = self.export(molecule, "--color", "chain", "--unknown-element", "guess")
            await self.open(page, path)
            self.assertIsNone(await page.evaluate("window.stolen"))
            self.assertIn("window.stolen", await page.evaluate("document.getElementById('legend').textContent"))
            self.assertIn("window.stolen", await page.evaluate("window.meniscus.atom_name(0)"))
            # Later scripts and foreign content do not run, either.
            await page.evaluate("(() => { const s = document.createElement('script'); s.textContent = 'window.stolen=1';"
                                " document.body.append(s); })()")
            self.assertIsNone(await page.evaluate("window.stolen"))
            self.assertEqual(await page.evaluate("fetch('https://example.org').then(() => 'came', () => 'refused')"), "refused")
        with open(path) as file:
            self.assertEqual(file.read().count("<script"), 3)

    def test_a_page_of_five_thousand_atoms_is_small(self):
        size = os.path.getsize(self.export(TOXIN))
        print(f"1tii: {size} bytes")
        self.assertLessEqual(size, 1_150_000)


def asked(words):
    """Returns the names of a share's tests, or the words that are given."""
    if not words or words[0] != "--share":
        return words
    n, of = map(int, words[1].split("/"))
    return [f"PageTest.{name}" for name in unittest.defaultTestLoader.getTestCaseNames(PageTest)][n - 1::of]


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + asked(sys.argv[4:]))
