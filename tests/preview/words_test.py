# SPDX-License-Identifier: BSD-3-Clause
"""The preview, an exported page and the page of a notebook have the same words for the same things. Arguments as of
page_case.py. MENISCUS_LIBRARY names the library of the Python package; without it the notebook is left out.

A thing is a control, a button, a section or a key. Things are the same if they have the same id, keys if they are listed
with the same words."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from browser import Browser
from page_case import CHROMIUM, PROGRAM, PageCase

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "exporters/bindings/python"
PROTEASE = "/usr/share/pymol/data/tut/1hpv.pdb"

# Returns the words of controls and other things by their ids: labels, and the options of a list.
WORDS = """(() => {
  const own = (one) => { const copy = one.cloneNode(true); for (const part of copy.querySelectorAll("select, input, output")) part.remove();
    return copy.textContent.replace(/\\s+/g, " ").trim(); };
  const words = {}, add = (id, ...all) => { if (id) words[id] = all.filter(Boolean); };
  for (const one of document.querySelectorAll("#panel :is(input, select, output, progress)")) add(one.id, ...[...one.labels].map(own), one.ariaLabel, one.title);
  for (const one of document.querySelectorAll("button")) add(one.id, one.textContent.trim(), one.title);
  for (const one of document.querySelectorAll("details")) add(one.id, one.querySelector("h2")?.textContent);
  for (const id of ["projection", "cut-with"]) words[id].push(...[...document.getElementById(id).options].map((option) => option.text));
  for (const one of document.querySelectorAll("dl dt:not(.of-pages)")) words[`key ${own(one)}`] = [own(one.nextElementSibling)];
  words.schemes = [...document.getElementById("scheme").options].map((option) => option.text);
  return words; })()"""


class Words(PageCase):
    async def test_they_are_the_same(self):
        preview = self.serve(PROTEASE, "--device", "cpu")
        self.addCleanup(preview.end)
        subprocess.run([PROGRAM, "export", "page", PROTEASE, "-q", "-o", self.path("page.html")], check=True, capture_output=True)
        script = f"import meniscus; meniscus.Scene({PROTEASE!r}).show().save({self.path('notebook.html')!r})"
        urls = {"preview": preview.url, "page": f"file://{self.path('page.html')}"}
        if "MENISCUS_LIBRARY" in os.environ:
            subprocess.run([sys.executable, "-B", "-c", script], check=True, env={**os.environ, "PYTHONPATH": str(PACKAGE)})
            urls["notebook"] = f"file://{self.path('notebook.html')}"
        async with Browser(CHROMIUM, (1000, 700), ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")) as page:
            words = {}
            for name, url in urls.items():
                await page.navigate(url)
                await page.until("document.getElementById('scheme')?.options.length > 0")
                words[name] = json.loads(await page.evaluate(f"JSON.stringify({WORDS})"))
        self.assertEqual(words.get("notebook", words["page"]), words["page"])
        schemes = {name: those.pop("schemes") for name, those in words.items()}
        self.assertLessEqual(set(schemes["page"]), {text.split(":")[0] for text in schemes["preview"]})
        shared = words["page"].keys() & words["preview"].keys()
        differ = {key: (words["page"][key], words["preview"][key]) for key in shared if words["page"][key] != words["preview"][key]}
        print(f"\n{len(shared)} things of {', '.join(words)}: {len(differ)} differ")
        self.assertEqual(differ, {})
        self.assertGreater(len(shared), 30)

    def test_the_widget_adds_none(self):
        """The notebook adds only the figure's title to the words of its page."""
        script = re.search(r'_SCRIPT = """(.*?)"""', (PACKAGE / "meniscus/_widget.py").read_text(), re.DOTALL).group(1)
        self.assertEqual(re.findall(r"textContent|innerText|innerHTML|placeholder|aria|alert\(", script), [])
        self.assertIn('title: model.get("title")', script)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
