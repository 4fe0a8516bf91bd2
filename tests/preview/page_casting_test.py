# SPDX-License-Identifier: BSD-3-Clause
"""The preview's page where the browser casts the figure itself, in Chromium with software WebGL: arguments PROGRAM CHROMIUM
SESSION."""

import subprocess
import sys
import unittest

from browser import Browser
from page_case import CHROMIUM, MOLECULE, PageCase

SOFTWARE_GL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
# WATCHED counts the texts that the page sends, and the bytes that it gets.
WATCHED = """
    window.sent = [];
    window.got = 0;
    window.WebSocket = class extends WebSocket {
      constructor(...all) {
        super(...all);
        this.addEventListener("message", ({data}) => { got += data.byteLength ?? data.length; });
      }
      send(text) { sent.push(JSON.parse(text)); super.send(text); }
    };"""
DRAWN_BY = """(() => { const choice = document.getElementById('drawn'); choice.value = '%s';
    choice.dispatchEvent(new Event('change')); })()"""


class PageCasting(PageCase):
    async def begin(self, page, *arguments):
        """Opens the page of a small molecule, which the browser casts."""
        await page.send("Page.addScriptToEvaluateOnNewDocument", source=WATCHED)
        await page.open(self.serve(MOLECULE, "--select", "chain D and resid 1-12", *arguments).url)
        said = await page.until("document.getElementById('drawn-by').textContent")
        if "no WebGL 2" in said:
            print("skipped: this Chromium has no WebGL 2")
            sys.exit(77)
        # The page does not wait for software GL where the program is quick.
        self.assertRegex(said, "^The program draws.*(no graphics card|This browser takes)")
        await self.shoot(page, "drawn_by_the_program.png")
        await page.screenshot(self.path("program.png"))
        await page.evaluate(DRAWN_BY % "browser")
        await page.until("meniscus.casts", 120)
        await page.at_rest(200)

    def differing(self, a, b):
        """Returns the percentage of pixels of two screenshots that differ by more than the rays at edges do."""
        done = subprocess.run(["idiff", "-fail", "0.1", "-failpercent", "100", self.path(a), self.path(b)], capture_output=True, text=True)
        found = [line for line in done.stdout.splitlines() if "over" in line]
        return float(found[-1].split("(")[1].split("%")[0]) if found else 0.0

    async def test_both_show_the_same_and_moving_sends_nothing(self):
        async with Browser(CHROMIUM, (800, 300), SOFTWARE_GL) as page:
            await self.begin(page)
            await page.screenshot(self.path("browser.png"))
            self.assertLess(self.differing("program.png", "browser.png"), 1.0)
            camera = (await self.state(page))["camera"]
            await page.evaluate("sent.length = 0, got = 0")
            await page.drag([(200, 150), (230, 155), (260, 160)])
            await page.at_rest(200)
            words = [said.get("command") for said in await page.evaluate("sent")]
            self.assertLessEqual(set(words) - {None}, {"camera", "end_step"})
            self.assertLess(await page.evaluate("got"), 20_000, "no tables, no pictures")
            told = [said["camera"] for said in await page.evaluate("sent") if said.get("command") == "camera"][-1]
            self.assertNotEqual(told["position"], camera["position"])
            # The program's picture is the same.
            await page.screenshot(self.path("browser.png"))
            await page.evaluate(DRAWN_BY % "program")
            await page.until("!meniscus.casts")
            await page.at_rest(60)
            await page.screenshot(self.path("program.png"))
            self.assertLess(self.differing("program.png", "browser.png"), 1.0)
            self.assertEqual(page.complaints, [])

    async def test_a_change_sends_what_has_changed(self):
        async with Browser(CHROMIUM, (800, 300), SOFTWARE_GL) as page:
            await self.begin(page)
            await page.evaluate("got = 0")
            await page.evaluate("""const probe = document.getElementById('probe-number'); probe.value = 2;
                probe.dispatchEvent(new Event('change')); 0""")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.probe'] === 2")
            await page.at_rest(200)
            whole = await page.evaluate("got")
            # A change of colours sends only colours.
            await page.evaluate("got = 0")
            await page.evaluate("""const scheme = document.getElementById('scheme'); scheme.value = 'residue';
                scheme.dispatchEvent(new Event('change')); 0""")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['surface.color'][0] === 'residue'")
            await page.at_rest(200)
            colours = await page.evaluate("got")
            print(f"\ntables of another probe: {whole} bytes, of other colours: {colours} bytes")
            self.assertLess(colours, 0.5 * whole)
            # Sticks come with their own primitives.
            await self.act(page, "resid 3", "Sticks")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['figure.sticks'].length === 1")
            await page.at_rest(200)
            self.assertTrue(await page.evaluate("meniscus.casts"))
            self.assertEqual(page.complaints, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
