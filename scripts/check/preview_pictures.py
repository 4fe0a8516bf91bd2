#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""preview_pictures.py PROGRAM FOLDER: pictures of the preview for its page, with scenes of docs/gallery whose molecules are in FOLDER.

preview.png is the window with chains.json on a virtual screen, preview_page.png the page with cut.json in a headless Chromium."""

import asyncio
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/preview"))
from browser import Browser, Preview  # noqa: E402

WINDOW = (1200, 675)  # the picture of chains.json and the panel
BROWSER = (1280, 800)
PATIENCE = 150  # seconds


def until(holds):
    end = time.monotonic() + PATIENCE
    while not holds():
        if time.monotonic() > end:
            sys.exit("preview_pictures: the window draws nothing")
        time.sleep(0.5)


def is_at_rest(state):
    try:
        said = json.loads(state.read_text())
    except (OSError, ValueError):
        return False
    return said.get("full", False) and said.get("idle", False)


def read_screen(path):
    """A screen that Xvfb keeps as an XWD file: header size, width, height, bytes a line and colours are words of its head."""
    data = path.read_bytes()
    words = struct.unpack(">25I", data[:100])
    begin, size, row = words[0] + 12 * words[19], (words[4], words[5]), words[12]
    return Image.frombuffer("RGB", size, data[begin:], "raw", "BGRX", row, 1)


def shoot_window(program, scene, target):
    with tempfile.TemporaryDirectory() as folder:
        state = pathlib.Path(folder) / "state.json"
        ends = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(ends[1]), "-screen", "0", f"{WINDOW[0]}x{WINDOW[1]}x24", "-fbdir", folder,
                                   "-nolisten", "tcp", "-noreset"], pass_fds=[ends[1]], stderr=subprocess.DEVNULL)
        os.close(ends[1])
        display = ":" + os.fdopen(ends[0]).readline().strip()
        window = subprocess.Popen([program, "preview", "--scene", scene, "--output-dir", folder, "--quiet"],
                                  env={**os.environ, "DISPLAY": display, "MENISCUS_WINDOW_STATE": str(state)})
        try:
            until(lambda: is_at_rest(state))
            subprocess.run(["xdotool", "mousemove", "420", "300"], env={**os.environ, "DISPLAY": display}, check=True)
            time.sleep(5)  # the tip comes when the mouse rests
            until(lambda: is_at_rest(state))
            read_screen(pathlib.Path(folder) / "Xvfb_screen0").save(target)
        finally:
            for process in (window, server):
                process.terminate()
                process.wait()


async def shoot_page(program, scene, target):
    with tempfile.TemporaryDirectory() as folder, Preview(program, "--scene", scene, "--output-dir", folder) as preview:
        async with Browser(shutil.which("chromium"), BROWSER) as page:
            await page.send("Page.navigate", url=preview.url)
            await page.at_rest(PATIENCE)
            await page.evaluate("document.getElementById('figure').scrollIntoView()")
            await asyncio.sleep(3)  # for the panel's chips
            await page.at_rest(PATIENCE)
            await page.evaluate("document.getElementById('speed').hidden = true")  # this machine's
            await page.screenshot(target)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    for name in ("chains", "cut"):
        shutil.copy(ROOT / f"docs/gallery/{name}.json", folder)
    shoot_window(program, str(folder / "chains.json"), folder / "preview.png")
    asyncio.run(shoot_page(program, str(folder / "cut.json"), folder / "preview_page.png"))


if __name__ == "__main__":
    main()
