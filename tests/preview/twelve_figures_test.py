# SPDX-License-Identifier: BSD-3-Clause
"""Makes the twelve most common figures in the preview by mouse and keyboard, from a page that was just opened, with
Playwright in Chromium or in Debian's Firefox: arguments PROGRAM BROWSER.

Controls are found by the words that a user sees. Playwright refuses to click what is hidden, disabled or covered.
With MENISCUS_SCREENSHOTS=FOLDER each figure is pictured there at 1400x900 and 390x844. The version of Playwright must
speak WebDriver BiDi as the Firefox does: 1.60 does for Firefox 153."""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

from browser import Preview
from playwright.sync_api import sync_playwright

PROGRAM, BROWSER = sys.argv[1:3]
PROTEASE = "/usr/share/pymol/data/tut/1hpv.pdb"
PEPTIDE = "/usr/share/pymol/data/demo/pept.pdb"
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
LARGE, SMALL, PHONE = {"width": 1400, "height": 900}, {"width": 900, "height": 640}, {"width": 390, "height": 844}
SHOTS = os.environ.get("MENISCUS_SCREENSHOTS")
PATIENCE = 90_000  # ms

# Returns faults of the visible controls: cut off, without a name, or smaller than a finger.
FAULTS = """(least) => {
  const faults = [];
  for (const one of document.querySelectorAll("#panel :is(button, select, input, summary), #card :is(button, input)")) {
    if (!one.checkVisibility({ visibilityProperty: true })) continue;
    const words = one.labels?.length ? one.labels[0].textContent : one.ariaLabel ?? one.textContent;
    const name = `${one.tagName} ${one.id} ${words.trim()}`;
    if (!words.trim()) faults.push(`${name}: no name`);
    const target = one.type === "checkbox" ? one.labels[0] : one, { width, height, left, right } = target.getBoundingClientRect();
    if (left < -1 || right > innerWidth + 1) if (!one.closest("#card .buttons")) faults.push(`${name}: beyond the window`);
    if (Math.min(width, height) < least) faults.push(`${name}: ${width} x ${height}`);
  }
  if (document.documentElement.scrollWidth > innerWidth) faults.push("the page is wider than the window");
  return faults; }"""

IN_SIGHT = """(one) => (({ left, top, width, height }) => one.contains(document.elementFromPoint(left + width / 2, top + height - 1)))(
  one.getBoundingClientRect())"""


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        playwright = sync_playwright().start()
        cls.addClassCleanup(playwright.stop)
        if "firefox" in BROWSER:
            cls.browser = playwright.firefox.launch(channel="moz-firefox", executable_path=BROWSER)
        else:
            cls.browser = playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox", "--disable-gpu", "--disable-3d-apis"])
        cls.addClassCleanup(cls.browser.close)

    def open(self, file, *options, size=SMALL):
        """Begins a preview, and shows its page at rest. Pictures for people are large."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        preview = Preview(PROGRAM, file, "--device", "cpu", "--output-dir", folder.name, *options, stdin=subprocess.DEVNULL)
        self.addCleanup(preview.end)
        self.page = self.browser.new_page(viewport=LARGE if SHOTS else size)
        self.addCleanup(self.page.close)
        self.complaints = []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.set_default_timeout(PATIENCE)
        self.page.goto(preview.url)
        self.rest()
        self.page.locator("#entries li").first.wait_for()

    def until(self, script, argument=None):
        self.page.wait_for_function(script, arg=argument, timeout=PATIENCE)

    def rest(self):
        self.page.locator("#picture[data-rest=true]").wait_for()

    def value(self, key):
        """Returns the value of a property in the state of the picture at rest."""
        self.rest()
        return json.loads(self.page.locator("#picture").get_attribute("data-state"))["values"][key]

    def becomes(self, key, value):
        """Waits until a property has this value, and for its picture."""
        self.until("([key, value]) => JSON.stringify(JSON.parse(document.getElementById('picture').dataset.state).values[key])"
                   " === JSON.stringify(value)", [key, value])
        self.rest()

    def has_rule(self, count=1):
        """Waits until so many colours are set."""
        self.until("([count]) => JSON.parse(document.getElementById('picture').dataset.state).values['surface.color'].length === 1 + count", [count])
        self.rest()

    # Actions of a user

    def press(self, words):
        self.page.get_by_role("button", name=words, exact=True).click()

    def section(self, words):
        self.page.locator("summary", has_text=words).first.click()

    def choose(self, label, option):
        self.page.get_by_role("combobox", name=label, exact=True).select_option(option)

    def tick(self, label):
        self.page.get_by_role("checkbox", name=label, exact=True).click()

    def type(self, label, text):
        """Types into a field, and leaves it."""
        field = self.page.get_by_label(label, exact=True)
        field.click()
        field.fill("")
        self.page.keyboard.type(text)
        self.page.keyboard.press("Tab")

    def slide(self, label, share):
        """Clicks a slider at a share of its length."""
        slider = self.page.get_by_label(label, exact=True)
        slider.scroll_into_view_if_needed()
        box = slider.bounding_box()
        self.page.mouse.click(box["x"] + 8 + share * (box["width"] - 16), box["y"] + box["height"] / 2)

    def list_entry(self, words):
        self.page.locator("#entries .recall", has_text=words).click()

    def color(self, label, value):
        """Chooses a colour, like the browser's own window for colours."""
        self.page.get_by_label(label, exact=True).fill(value)

    def drag(self, dx, dy):
        self.page.mouse.move(200, 300)
        self.page.mouse.down()
        self.page.mouse.move(200 + dx / 2, 300 + dy / 2)
        self.page.mouse.move(200 + dx, 300 + dy)
        self.page.mouse.up()
        self.rest()

    def written(self, button, name):
        """Presses a button that writes a file; returns its path when the page shows it."""
        self.press(button)
        self.page.locator("#written li", has_text=name).first.wait_for(timeout=3 * PATIENCE)
        self.page.locator("#job").wait_for(state="hidden", timeout=3 * PATIENCE)
        self.assertTrue((self.folder / name).exists())
        return self.folder / name

    def shoot(self, name):
        if SHOTS:
            for size in (LARGE, PHONE):
                self.page.set_viewport_size(size)
                self.until("([w]) => Math.abs(JSON.parse(document.getElementById('picture').dataset.state).width"
                           " - document.getElementById('stage').clientWidth) < 2", [size["width"]])
                self.rest()
                self.page.screenshot(path=os.path.join(SHOTS, f"{name}_{size['width']}.png"))
        self.assertEqual(self.complaints, [])
        self.assertTrue(self.page.locator("#message.error").is_hidden())

    # The figures

    def test_01_as_it_opens(self):
        self.open(PROTEASE, size=LARGE)
        self.assertEqual(self.page.evaluate(FAULTS, 0), [])
        self.assertGreater(self.written("Save PNG", "figure.png").stat().st_size, 10_000)
        # All controls that begin a task are visible.
        for words in ("Contents", "Surface", "Colours", "Shown", "Cut", "View", "Look", "Film"):
            self.assertTrue(self.page.locator("summary", has_text=words).first.evaluate(IN_SIGHT), words)
        self.shoot("01_default")

    def test_02_colours_with_a_legend(self):
        self.open(PROTEASE)
        self.tick("Legend")
        for scheme in ("chain", "hydrophobicity", "bfactor"):
            self.choose("By", scheme)
            self.becomes("surface.color", [scheme])
            self.becomes("legend.shown", True)
            self.shoot(f"02_{scheme}")
        self.choose("By", "one colour")
        self.rest()
        self.color("Colour", "#88aadd")
        self.becomes("surface.color", ["#88aadd"])

    def test_03_a_drug_in_its_pocket(self):
        self.open(PROTEASE)
        self.list_entry("478")
        self.press("Look into")
        self.becomes("surface.clip", ["before first (chain 1HPV and resid 200 and resname 478)"])
        self.shoot("03_pocket")

    def test_04_an_interface(self):
        self.open(PROTEASE)
        self.list_entry("Chain A")
        self.press("Surface of")
        self.list_entry("Chain B")
        self.press("Around")
        self.page.locator("#card h2", has_text="5 Å around Chain B").wait_for()
        self.color("Colour of what is selected", "#d55e00")
        self.has_rule()
        self.page.keyboard.press("Escape")
        self.tick("The molecule's surface")
        self.becomes("surface.shown", False)
        self.drag(300, 0)
        self.shoot("04_interface")

    def test_05_a_ghost_with_its_fold(self):
        self.open(PROTEASE)
        self.section("Look")
        self.choose("Preset", "ghost")
        self.becomes("look.preset", "ghost")
        self.assertEqual(self.value("surface.opacity"), [0.15])
        self.shoot("05_ghost")

    def test_06_a_cavity_cut_open(self):
        self.open(PROTEASE)
        self.section("Cut")
        self.slide("Cut away", 0.45)
        self.until("() => /^depth>0.4/.test(JSON.parse(document.getElementById('picture').dataset.state).values['surface.clip'][0])")
        self.type("Cap hatching, Å", "2")
        self.becomes("surface.cap_hatching", 2)
        self.shoot("06_cavity")

    def test_07_charges(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        charged = pathlib.Path(folder.name) / "1ubq.pqr"
        lines = []
        signs = {"ASP": ("OD1", "OD2", -0.5), "GLU": ("OE1", "OE2", -0.5), "LYS": ("NZ", "NZ", 1), "ARG": ("NH1", "NH2", 0.5)}
        for line in pathlib.Path(UBIQUITIN).read_text().splitlines():
            if line.startswith("ATOM"):
                atom, residue = line[12:16].strip(), line[17:20]
                charge = signs[residue][2] if atom in signs.get(residue, ())[:2] else 0
                radius = {"C": 1.7, "N": 1.55, "O": 1.52, "S": 1.8}[atom[0]]
                lines.append(f"{line[:54]} {charge:.3f} {radius:.3f}\n")
        charged.write_text("".join(lines))
        self.open(charged)
        self.choose("By", "charge")
        self.becomes("surface.color", ["charge"])
        self.tick("Legend")
        self.rest()
        self.shoot("07_charges")

    def test_08_residues_painted(self):
        self.open(UBIQUITIN)
        self.list_entry("Chain A")
        letters = self.page.locator("#letters button")
        letters.nth(43).click()
        for place in (47, 69):
            letters.nth(place).click(modifiers=["Shift"])
        self.until("() => document.querySelectorAll('#letters [aria-pressed=true]').length === 3")
        self.color("Colour of what is selected", "#cc3311")
        self.has_rule()
        self.shoot("08_painted")

    def test_09_labels_and_a_distance(self):
        self.open(PROTEASE)
        self.section("Look")
        self.choose("Preset", "ribbon")
        self.becomes("look.preset", "ribbon")
        self.section("Look")
        self.list_entry("Chain A")
        letters = self.page.locator("#letters button")
        letters.nth(24).click()
        letters.nth(49).click(modifiers=["Shift"])
        self.press("Sticks")
        self.rest()
        self.press("Label")
        self.rest()
        self.press("Distance")
        self.page.locator("#rings text", has_text=" Å").wait_for()  # the length appears on the stage
        self.assertEqual(self.page.locator("#rings text").all_text_contents()[:2], ["ASP 25", "ILE 50"])
        self.assertEqual([label.rsplit("=", 1)[1] for label in self.value("annotations.labels")], ["ASP 25", "ILE 50"])
        self.assertEqual(self.value("figure.object")[-1]["representation"], "distance")
        self.shoot("09_labels")
        self.page.locator("#chips li", has_text="label: ILE 50").locator(".remove").click()
        self.until("() => JSON.parse(document.getElementById('picture').dataset.state).values['annotations.labels'].length === 1")

    def test_10_for_print(self):
        self.open(PROTEASE)
        self.section("Look")
        self.choose("Preset", "goodsell")
        self.becomes("look.preset", "goodsell")
        self.section("Size and more")
        self.type("Width", "40mm")
        self.type("Dots per inch", "300")
        self.until("() => document.getElementById('width').value === '472'")
        self.choose("Picture as", "TIFF")
        self.shoot("10_print")
        data = self.written("Save TIFF", "figure.tif").read_bytes()
        order = "<" if data[:2] == b"II" else ">"
        start = struct.unpack(order + "I", data[4:8])[0]
        tags = {}
        for n in range(struct.unpack(order + "H", data[start:start + 2])[0]):
            tag, kind, _, value = struct.unpack(order + "HHII", data[start + 2 + 12 * n:start + 14 + 12 * n])
            tags[tag] = struct.unpack(order + "II", data[value:value + 8]) if kind == 5 else value
        self.assertEqual(tags[256], 472)
        self.assertAlmostEqual(tags[282][0] / tags[282][1], 300)

    def test_11_a_turntable(self):
        self.open(PEPTIDE)
        self.type("Pixels wide", "96")
        self.assertIn("Turntable", self.page.get_by_label("Film of").text_content())
        self.shoot("11_turntable")
        self.assertEqual(self.written("Film", "figure.mp4").read_bytes()[4:8], b"ftyp")

    def test_12_a_film_of_three_scenes(self):
        self.open(PEPTIDE)
        self.section("Film")
        for n, scheme in enumerate(("chain", "element", "residue")):
            self.choose("By", scheme)
            self.becomes("surface.color", [scheme])
            self.drag(60, 20)
            self.press("Keep scene")
            self.page.locator("#scenes canvas").nth(n).wait_for()
        for n, field in enumerate(self.page.locator("#scenes input").all()):
            field.fill("0.2")
            field.press("Tab")
        self.until("() => document.getElementById('film-of').selectedOptions[0].text === 'Strip: 1 s'")
        self.type("Pixels wide", "96")
        self.shoot("12_strip")
        self.written("Film", "figure.mp4")
        frames = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,width", "-of", "csv=p=0",
                                 self.folder / "figure.mp4"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(frames.strip(), "96,25")

    def test_13_for_other_programs(self):
        self.open(PEPTIDE)
        self.written("Blender", "figure.mns")
        self.written("POV-Ray", "figure.zip")
        self.written("Save scene", "figure.json")

    def test_14_fingers(self):
        self.open(PROTEASE)
        self.page.set_viewport_size(PHONE)
        self.rest()
        self.list_entry("478")
        for words in ("Cut", "View", "Look", "Film", "Size and more"):
            self.section(words)
        self.press("Keep scene")
        self.page.locator("#scenes canvas").wait_for()
        self.assertEqual(self.page.evaluate(FAULTS, 44), [])


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1] + sys.argv[3:], exit=False).result
    failures = len(result.failures) + len(result.errors)
    print(f"cases {result.testsRun} failures {failures}")
    sys.exit(failures > 0)
