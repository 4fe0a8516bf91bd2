#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""preview_pictures.py PROGRAM FOLDER [WIDTHxHEIGHT]: writes FOLDER/preview_page.png, the page of the preview in a headless
Chromium with the scene docs/gallery/cut.json, whose molecule is in FOLDER. The window has 1280x800 pixels by default."""

import asyncio
import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/preview"))
from browser import Browser, Preview  # noqa: E402

PATIENCE = 150  # seconds


async def shoot_page(program, scene, target, size):
    with tempfile.TemporaryDirectory() as folder, Preview(program, "--scene", scene, "--output-dir", folder) as preview:
        async with Browser(shutil.which("chromium"), size) as page:
            await page.send("Page.navigate", url=preview.url)
            await page.at_rest(PATIENCE)
            await page.until("document.querySelectorAll('#entries li').length > 0", PATIENCE)
            await page.at_rest(PATIENCE)
            await page.screenshot(target)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.copy(ROOT / "docs/gallery/cut.json", folder)
    size = tuple(map(int, (sys.argv[3] if len(sys.argv) > 3 else "1280x800").split("x")))
    asyncio.run(shoot_page(program, str(folder / "cut.json"), folder / "preview_page.png", size))


if __name__ == "__main__":
    main()
