# SPDX-License-Identifier: BSD-3-Clause
"""Molecules that a user drops on the page, chooses, or fetches by their code. page_case.py describes the arguments."""

import base64
import json
import sys
import unittest

from browser import Browser
from page_case import CHROMIUM, PROGRAM, PageCase
from server_case import ATOMS

THREE = "".join(ATOMS.splitlines(keepends=True)[:3])
LARGE, PHONE = (1400, 900), (390, 844)
ENTRY = """data_4HHB
loop_
_atom_site.group_PDB
_atom_site.id
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_comp_id
_atom_site.label_asym_id
_atom_site.label_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
ATOM 1 C CA GLY A 1 0.0 0.0 0.0
ATOM 2 C C GLY A 1 1.5 0.0 0.0
"""

# Drops files, {name: text}, on an element; a folder is a file that cannot be read.
DROP = """((selector, files) => {
  const data = new DataTransfer();
  for (const [name, text] of Object.entries(files)) data.items.add(new File([text], name));
  const target = document.querySelector(selector);
  const fire = (kind) => { const event = new DragEvent(kind, {bubbles: true, cancelable: true, dataTransfer: data}); target.dispatchEvent(event); return event.defaultPrevented; };
  window.invited = fire("dragover") && !document.getElementById("drop").hidden;
  return fire("drop"); })"""


class Open(PageCase):
    def preview(self, *arguments):
        with open(self.path("five.pdb"), "w") as file:
            file.write(ATOMS)
        return self.serve(self.path("five.pdb"), *arguments)

    async def drop(self, page, selector="#stage", **files):
        files = {name.replace("__", "."): text for name, text in files.items()}
        self.assertTrue(await page.evaluate(f"{DROP}({json.dumps(selector)}, {json.dumps(files)})"), "the browser does not open it itself")
        self.assertTrue(await page.evaluate("window.invited"))

    async def shows(self, page, name, atoms):
        await page.until(f"document.title.startsWith('{name}') && document.querySelector('#picture')?.dataset.rest === 'true'")
        self.assertEqual((await self.state(page))["atoms"], atoms)

    async def says(self, page, text, where="#message"):
        await page.until(f"(one => !one.hidden && one.textContent.includes({json.dumps(text)}))(document.querySelector('{where}'))")

    async def test_files_are_dropped_and_chosen(self):
        preview = self.preview()
        async with Browser(CHROMIUM, LARGE) as page:
            await page.open(preview.url)
            await page.evaluate("document.getElementById('view-name').value = 'front'; document.getElementById('view-form').requestSubmit(); 0")
            self.assertEqual(await page.evaluate("document.getElementById('kept-views').children.length"), 1)
            await self.drop(page, three__pdb=THREE)
            await self.shows(page, "three.pdb", 3)
            self.assertEqual(await page.evaluate("document.getElementById('kept-views').children.length"), 0, "it is of another molecule")
            self.assertTrue(await page.evaluate("document.getElementById('role').hidden"), "it controls as before")
            await self.drop(page, "#entries", **{"été 5.pdb": ATOMS})
            await self.shows(page, "_t_5.pdb", 5)
            await page.evaluate("document.getElementById('opening').open = true")
            await self.shoot(page, "open_1400.png")
            node = (await page.send("DOM.querySelector", nodeId=(await page.send("DOM.getDocument"))["root"]["nodeId"], selector="#files"))["nodeId"]
            with open(self.path("chosen.pdb"), "w") as file:
                file.write(THREE)
            await page.send("DOM.setFileInputFiles", files=[self.path("chosen.pdb")], nodeId=node)
            await self.shows(page, "chosen.pdb", 3)
            self.assertEqual(page.complaints, [])

    async def test_a_person_sees_what_is_wrong(self):
        preview = self.preview()
        async with Browser(CHROMIUM, LARGE) as page:
            await page.open(preview.url)
            await self.drop(page, nonsense__pdb="nonsense")
            await self.says(page, "nonsense.pdb: ")
            text = await page.evaluate("document.getElementById('message').textContent")
            self.assertNotIn("/", text, "no folder of the program's")
            self.assertTrue(await page.evaluate("document.getElementById('message').classList.contains('error')"))
            await self.shoot(page, "open_wrong_1400.png")
            await self.drop(page, a__pdb=THREE, b__pdb=THREE, c__pdb=THREE)
            await self.says(page, "one molecule at a time")
            await self.drop(page, x__psf="PSF\n\n       1 !NTITLE\n REMARKS x\n\n       1 !NATOM\n       1 A    1    GLY  CA   CT1    0.000000       12.0110           0\n\n       0 !NBOND: bonds\n\n")
            await self.says(page, "lists atoms without coordinates; open its trajectory together with it")
            self.assertNotIn("--", await page.evaluate("document.getElementById('message').textContent"))
            # The page does not send a file that is too large.
            await page.evaluate("Object.defineProperty(File.prototype, 'size', {get() { return 6e8; }, configurable: true}); 0")
            await self.drop(page, large__pdb=THREE)
            await self.says(page, "large.pdb has 600 MB, and a page can hand over 512 MB at most")
            self.assertEqual((await self.state(page))["atoms"], 5)
            await self.press(page, "k")
            await page.until("document.getElementById('message').hidden")
            self.assertEqual(page.complaints, [])

    async def test_unsaved_changes_are_asked_about(self):
        preview = self.preview()
        async with Browser(CHROMIUM, LARGE) as page:
            await page.open(preview.url)
            await self.press(page, "k")
            await page.until("JSON.parse(document.getElementById('picture').dataset.state).unsaved")
            await page.evaluate("window.asked = []; window.confirm = (text) => { asked.push(text); return asked.length > 1; }; 0")
            await self.drop(page, three__pdb=THREE)
            self.assertIn("changes that no file has", await page.evaluate("asked[0]"))
            self.assertEqual((await self.state(page))["atoms"], 5)
            await self.drop(page, three__pdb=THREE)
            await self.shows(page, "three.pdb", 3)

    async def test_who_looks_on_is_told_so_and_sees_the_other_molecule(self):
        preview = self.preview()
        async with Browser(CHROMIUM, LARGE) as page, Browser(CHROMIUM, LARGE) as other:
            await page.open(preview.url)
            await other.open(preview.url)
            await self.drop(other, three__pdb=THREE)
            await self.says(other, "Take control here before you open a molecule")
            await self.drop(page, three__pdb=THREE)
            await self.shows(page, "three.pdb", 3)
            await self.shows(other, "three.pdb", 3)
            await page.until("document.getElementById('role').hidden")
            await other.until("!document.getElementById('role').hidden")

    async def fetched(self, page, answers):
        """Answers for the bank, and returns the requested addresses. answers: status or text by code; none: no
        network."""
        addresses = []

        async def answer(parameters):
            url, number = parameters["request"]["url"], parameters["requestId"]
            addresses.append(url)
            self.assertNotIn("Referer", parameters["request"]["headers"])
            given = answers.get(url.split("/")[-1].split(".")[0])
            if given is None:
                return await page.send("Fetch.failRequest", requestId=number, errorReason="InternetDisconnected")
            status, text = (given, "") if isinstance(given, int) else (200, given)
            await page.send("Fetch.fulfillRequest", requestId=number, responseCode=status, body=base64.b64encode(text.encode()).decode(),
                            responseHeaders=[{"name": "Access-Control-Allow-Origin", "value": "*"}])

        page.handlers["Fetch.requestPaused"] = answer
        await page.send("Fetch.enable", patterns=[{"urlPattern": "*://*.rcsb.org/*"}])
        return addresses

    async def ask_for(self, page, code):
        await page.evaluate(f"document.getElementById('opening').open = true; document.getElementById('code').value = {json.dumps(code)}; 0")
        await page.click("#code-form button")

    async def test_an_entry_is_fetched_when_its_button_is_pressed(self):
        preview = self.preview()
        async with Browser(CHROMIUM, PHONE) as page:
            addresses = await self.fetched(page, {"4hhb": ENTRY, "9zzz": 404, "1abc": 503})
            await page.open(preview.url)
            self.assertEqual(await page.evaluate("document.querySelector('#code-form button').textContent"), "Fetch from files.rcsb.org")
            for wrong in ("", "hhb", "4hhb5", "4h b", "../4hhb", "pdb_4hhb"):
                await self.ask_for(page, wrong)
                await self.says(page, "four letters and digits", "#code-fault")
            self.assertEqual(addresses, [])
            await self.shoot(page, "open_390.png")
            for code, said in (("9zzz", "no entry 9zzz"), ("1abc", "does not give 1abc now"), ("1xyz", "cannot be reached: this browser has no network")):
                await self.ask_for(page, code)
                await self.says(page, said, "#code-fault")
                self.assertTrue(await page.evaluate("document.getElementById('message').hidden"))
            self.assertEqual((await self.state(page))["atoms"], 5)
            for code in (" 4HHB ", "pdb_00004hhb"):
                await self.ask_for(page, code)
                await self.shows(page, "4hhb.cif", 2)
            bank = "https://files.rcsb.org/download/"
            self.assertEqual(addresses, [f"{bank}{code}.cif" for code in ("9zzz", "1abc", "1xyz", "4hhb", "4hhb")])

    async def test_no_other_host_is_asked(self):
        preview = self.preview()
        async with Browser(CHROMIUM, LARGE) as page:
            await page.open(preview.url)
            for address in ("https://www.rcsb.org/", "http://files.rcsb.org/download/4hhb.cif", "https://example.org/"):
                refused = await page.evaluate(f"""new Promise((told) => {{
                    document.addEventListener("securitypolicyviolation", (event) => told(event.effectiveDirective), {{once: true}});
                    fetch({json.dumps(address)}).catch(() => {{}}); }})""")
                self.assertEqual(refused, "connect-src", address)

    async def test_codes_and_names(self):
        preview = self.preview()
        async with Browser(CHROMIUM, LARGE) as page:
            await page.open(preview.url)
            for text, code in (("4hhb", "4hhb"), (" 1ABC\n", "1abc"), ("pdb_00004hhb", "4hhb"), ("PDB_10004HHB", "pdb_10004hhb"),
                               ("0abc", None), ("4hh", None), ("pdb_004hhb", None), ("4hhb.cif", None)):
                self.assertEqual(await page.evaluate(f"import('./open.js').then((one) => one.code_of({json.dumps(text)}) ?? null)"), code, text)
            for name, plain in (("1abc.pdb", "1abc.pdb"), ("C:\\\\x\\\\a b.cif.gz", "a_b.cif.gz"), ("../.hidden", "hidden"), ("--a.pdb", "a.pdb"), ("分子", "_")):
                self.assertEqual(await page.evaluate(f"import('./open.js').then((one) => one.plain_name('{name}'))"), plain)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
