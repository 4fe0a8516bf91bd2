# SPDX-License-Identifier: BSD-3-Clause
"""A page of the preview, and the common part of its tests: arguments PROGRAM CHROMIUM SESSION. With
MENISCUS_SCREENSHOTS=FOLDER in the environment, they leave pictures of the page there."""

import asyncio
import json
import os
import sys
import tempfile
import unittest

from browser import Preview

PROGRAM, CHROMIUM, SESSION = sys.argv[1:4]
MOLECULE = "/usr/share/pymol/data/demo/1tii.pdb"
SIZE = (760, 420)  # size of the browser's window; the picture is smaller by the panel


class PageCase(unittest.IsolatedAsyncioTestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def serve(self, file, *arguments, **options):
        preview = Preview(PROGRAM, file, "--output-dir", self.folder.name, *arguments, **options)
        self.addCleanup(preview.end)
        return preview

    async def select(self, page, atoms):
        """Selects atoms by an expression."""
        await page.evaluate(f"document.getElementById('atoms').value = {json.dumps(atoms)}; document.getElementById('figure-form').requestSubmit(); 0")

    async def act(self, page, atoms, words):
        """Selects atoms, and presses a button of their card."""
        await self.select(page, atoms)
        await page.until(f"document.querySelector('#card h2').textContent === {json.dumps(atoms)}")
        await page.evaluate(f"[...document.querySelectorAll('#card button')].find((one) => one.textContent === {json.dumps(words)}).click()")

    async def shoot(self, page, name):
        if "MENISCUS_SCREENSHOTS" in os.environ:
            await page.screenshot(os.path.join(os.environ["MENISCUS_SCREENSHOTS"], name))

    async def downloaded(self, page, name):
        path = os.path.join(page.downloads, name)
        for _ in range(200):
            if os.path.exists(path):
                return path
            await asyncio.sleep(0.05)
        self.fail(f"{name} was not downloaded; there are {os.listdir(page.downloads)}")

    async def state(self, page):
        await page.at_rest()
        return await page.evaluate("JSON.parse(document.getElementById('picture').dataset.state)")

    async def press(self, page, key):
        text = key if len(key) == 1 else ""
        await page.send("Input.dispatchKeyEvent", type="keyDown", key=key, text=text)
        await page.send("Input.dispatchKeyEvent", type="keyUp", key=key)
