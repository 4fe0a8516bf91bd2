# SPDX-License-Identifier: BSD-3-Clause
"""Work by hand in the preview: clicks that select, the list of contents, the sequence, and the actions of a card.
page_case.py describes the arguments. With MENISCUS_SCREENSHOTS=FOLDER pictures are left there."""

import asyncio
import json
import math
import sys
import unittest

from browser import Browser
from page_case import CHROMIUM, MOLECULE, PageCase

PROTEASE = "/usr/share/pymol/data/tut/1hpv.pdb"
LIGAND = "chain 1HPV and resid 200 and resname 478"
LARGE, PHONE = (1400, 900), (390, 844)


class Selecting(PageCase):
    async def click(self, page, x, y, count=1, shift=False):
        await asyncio.sleep(0.45)  # otherwise the click would continue the previous series
        await page.mouse("mouseMoved", x, y)
        for n in range(1, count + 1):
            for kind in ("mousePressed", "mouseReleased"):
                await page.mouse(kind, x, y, button="left", clickCount=n, modifiers=8 if shift else 0)

    async def press_button(self, page, words):
        """Clicks the middle of a button like a mouse."""
        script = ("(() => { const b = [...document.querySelectorAll('button')].find((b) => b.checkVisibility() && "
                  f"b.textContent.startsWith({json.dumps(words)})); if (!b) return null; b.scrollIntoView({{block: 'nearest'}}); "
                  "const r = b.getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2]; })()")
        await self.click(page, *await page.until(script))

    async def selected(self, page, text):
        await page.until(f"document.getElementById('atoms').value === {json.dumps(text)}")

    async def chosen(self, page):
        return await page.evaluate("[...document.querySelectorAll('#letters [aria-pressed=true]')].map((b) => b.ariaLabel)")

    async def open(self, page, *arguments):
        preview = self.serve(*arguments, "--device", "cpu")
        await page.open(preview.url)
        await page.until("document.querySelectorAll('#entries li').length > 0")

    async def test_a_drug_in_its_pocket_is_two_clicks(self):
        for size in (LARGE, PHONE):
            async with Browser(CHROMIUM, size) as page:
                await self.open(page, PROTEASE)
                await self.shoot(page, f"select_begin_{size[0]}.png")
                before = await self.state(page)
                self.assertEqual(before["values"]["surface.clip"], [])
                await self.press_button(page, "478 200")
                await self.selected(page, LIGAND)
                await self.press_button(page, "Look into")
                await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.clip'].length === 1")
                state = await self.state(page)
                self.assertEqual(state["values"]["surface.clip"], [f"before first ({LIGAND})"])
                self.assertNotEqual(state["camera"], before["camera"])
                await self.shoot(page, f"select_pocket_{size[0]}.png")
                self.assertEqual(page.complaints, [])

    async def test_clicks_select_atom_residue_and_chain(self):
        async with Browser(CHROMIUM, LARGE) as page:
            await self.open(page, PROTEASE)
            x, y = 560, 520
            await self.click(page, x, y)
            await page.until("!document.getElementById('card').hidden")
            atom = await page.until("document.getElementById('atoms').value")
            self.assertRegex(atom, r"^chain [AB] and resid \d+ and resname [A-Z]{3} and name \w+$")
            residue = atom[:atom.index(" and name")]
            # The server sends the letters of the chain, so they come after the selection.
            await page.until("document.querySelectorAll('#letters [aria-pressed=true]').length === 1")
            await self.click(page, x, y, 2)
            await self.selected(page, residue)
            await self.shoot(page, "select_residue.png")
            await self.click(page, x, y, 3)
            await self.selected(page, residue[:7] + " and polymer")
            await page.until("document.querySelectorAll('#letters [aria-pressed=true]').length === 99")
            self.assertEqual(await page.evaluate("document.querySelectorAll('#entries .recall[aria-pressed=true]').length"), 1)
            # Rings are at the atoms: in the picture of the chain, near its pixels.
            await page.until("document.querySelectorAll('#rings circle').length > 100")
            # Shift adds atoms, and removes them again.
            await self.click(page, x, y)
            await self.selected(page, atom)
            await self.click(page, x - 200, y, shift=True)
            await page.until("document.getElementById('atoms').value.includes(') or (')")
            await page.until("document.querySelectorAll('#rings circle').length === 2")
            await self.click(page, x - 200, y, shift=True)
            await self.selected(page, atom)
            # A click on the background and Escape select nothing.
            await self.click(page, 30, 30)
            await self.selected(page, "")
            self.assertTrue(await page.evaluate("document.getElementById('card').hidden"))
            await self.click(page, x, y)
            await self.selected(page, atom)
            await self.press(page, "Escape")
            await self.selected(page, "")
            self.assertEqual(page.complaints, [])

    async def test_the_ring_of_an_atom_is_at_its_sphere(self):
        """The ring of a single atom is in the middle of the picture, whatever the view and the legend."""
        path = self.path("one.pdb")
        with open(path, "w") as file:
            file.write("HETATM    1  C1  LIG A   1      10.000  20.000  30.000  1.00  0.00           C\n"
                       "HETATM    2  C2  LIG B   2      10.000  20.000  38.000  1.00  0.00           C\n")
        for options in ((), ("--projection", "orthographic"), ("--legend", "--legend-place", "right")):
            async with Browser(CHROMIUM, (760, 420)) as page:
                await self.open(page, path, "--color", "chain", *options)
                await self.press_button(page, "LIG 1")
                await page.until("document.querySelectorAll('#rings circle').length === 1")
                for _ in range(2):
                    await page.at_rest()
                    # The script returns the distance from the middle of the pixels of its colour.
                    off, count = await page.evaluate("""(() => {
                        const canvas = document.getElementById('pictures'), {width, height} = canvas;
                        const {data} = canvas.getContext('2d').getImageData(0, 0, width, height);
                        const ring = document.querySelector('#rings circle');
                        const [cx, cy] = ['cx', 'cy'].map((name) => Number(ring.getAttribute(name)));
                        const at = 4 * (Math.round(cy) * width + Math.round(cx)), hue = (n) => data[n] - data[n + 2];
                        let sum = [0, 0], count = 0;
                        for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) {
                          const n = 4 * (y * width + x);
                          if (Math.hypot(x - cx, y - cy) > 90 || Math.min(data[n], data[n + 1], data[n + 2]) > 250 ||
                              Math.sign(hue(n)) !== Math.sign(hue(at))) continue;
                          sum = [sum[0] + x, sum[1] + y]; ++count;
                        }
                        return [Math.hypot(sum[0] / count - cx, sum[1] / count - cy), count]; })()""")
                    self.assertGreater(count, 1000)
                    self.assertLess(off, 4, options)
                    await page.drag([(300, 200), (330, 240)])
                self.assertEqual(page.complaints, [])

    async def test_the_sequence_and_the_stage_select_each_other(self):
        async with Browser(CHROMIUM, LARGE) as page:
            await self.open(page, PROTEASE)
            await self.press_button(page, "Chain B")
            await page.until("document.querySelectorAll('#letters button').length === 99")
            self.assertEqual(await page.evaluate("[...document.querySelectorAll('#letters button')].slice(0, 6)"
                                                 ".map((b) => b.textContent).join('')"), "PQITLW")
            await page.evaluate("document.querySelectorAll('#letters button')[24].focus(), 0")
            await self.press(page, " ")
            await self.selected(page, "chain B and resid 25 and resname ASP")
            for key in ("ArrowRight", "ArrowRight"):
                await page.send("Input.dispatchKeyEvent", type="keyDown", key=key, modifiers=8)
                await page.send("Input.dispatchKeyEvent", type="keyUp", key=key, modifiers=8)
            await page.until("document.querySelectorAll('#letters [aria-pressed=true]').length === 3")
            self.assertEqual(await self.chosen(page), ["25 ASP", "26 THR", "27 GLY"])
            self.assertEqual(await page.evaluate("document.querySelectorAll('#letters [tabindex=\"0\"]').length"), 1)
            await self.shoot(page, "select_sequence.png")
            await self.press_button(page, "Sticks")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['figure.sticks'].length === 1")
            self.assertEqual(page.complaints, [])

    async def test_hides_colours_and_measures(self):
        async with Browser(CHROMIUM, LARGE) as page:
            await self.open(page, PROTEASE)

            async def eye(name, pressed):
                await page.until(f"document.querySelector('.eye[aria-label=\"Show {name}\"]').ariaPressed === '{pressed}'")

            await page.click(".eye[aria-label='Show Chain A']")
            await eye("Chain A", "false")
            self.assertEqual((await self.state(page))["values"]["surface.show"], "all and not (chain A and polymer)")
            await page.click(".eye[aria-label='Show 478 1HPV 200']")
            await eye("478 1HPV 200", "false")
            await page.click(".eye[aria-label='Show Water']")
            await eye("Water", "true")
            await self.shoot(page, "select_hidden.png")
            for name in ("Chain A", "478 1HPV 200"):
                await page.click(f".eye[aria-label='Show {name}']")
                await eye(name, "true")
            self.assertIsNone((await self.state(page))["values"]["surface.show"])
            await page.evaluate("""(() => { const c = document.querySelector("[aria-label='Colour of Chain A']");
                c.value = '#aa3377'; c.dispatchEvent(new Event('change')); })()""")
            await page.until("document.querySelector(\"[aria-label='Colour of Chain A']\").value === '#aa3377'")
            # The distance of two residues is that of their nearest atoms.
            await self.press_button(page, "Chain A")
            await page.until("document.querySelectorAll('#letters button').length === 99")
            await page.evaluate("(() => { const b = document.querySelectorAll('#letters button'); b[24].click(); "
                                "b[49].dispatchEvent(new MouseEvent('click', {bubbles: true, shiftKey: true})); })()")
            await self.press_button(page, "Distance")
            length = await page.until("document.querySelector('#rings text')?.textContent")
            atoms = {}
            with open(PROTEASE) as file:
                for row in file:
                    if row.startswith("ATOM") and row[21] == "A" and int(row[22:26]) in (25, 50):
                        atoms.setdefault(int(row[22:26]), []).append([float(row[30 + 8 * n:38 + 8 * n]) for n in range(3)])
            nearest = min(math.dist(a, b) for a in atoms[25] for b in atoms[50])
            self.assertEqual(length, f"{nearest:.2f} Å")
            objects = (await self.state(page))["values"]["figure.object"]
            self.assertEqual(objects[-1]["representation"], "distance")
            self.assertEqual(page.complaints, [])

    async def test_other_pages_may_look(self):
        """A page that does not control the preview selects, too, but changes nothing."""
        preview = self.serve(MOLECULE, "--device", "cpu")
        async with Browser(CHROMIUM, (760, 420)) as first, Browser(CHROMIUM, (760, 420)) as second:
            await first.open(preview.url)
            await second.navigate(preview.url)
            await second.until("document.querySelectorAll('#entries li').length > 0")
            self.assertTrue(await second.evaluate("document.getElementById('controls').disabled"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
