# SPDX-License-Identifier: BSD-3-Clause
"""preview_speed.py PROGRAM FILE...: how soon `meniscus preview` shows a molecule, and how many pictures a drag has.

A client asks for pictures as the page does, without drawing them. Of each file a row, in Markdown: seconds on the clock and
CPU seconds of the server until the first picture, which is of balls where a surface takes long, until the first one of the
exact surface, and until the one at rest, with shade and lines; then, for eight seconds of a drag with 60 steps a second,
pictures a second and the CPU seconds of each. Pictures have 1024 x 768 pixels, drafts a quarter of them."""

import asyncio
import json
import os
import pathlib
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/preview"))
from browser import Preview  # noqa: E402

SECONDS = 8.0
STEPS = 60  # a second


def cpu_seconds(process):
    with open(f"/proc/{process.pid}/stat", encoding="ascii", errors="replace") as file:
        return sum(int(word) for word in file.read().rsplit(")", 1)[1].split()[11:13]) / os.sysconf("SC_CLK_TCK")


async def next_picture(client):
    """The message of the next picture, which has come whole."""
    await client.send('{"request":"picture"}')
    while True:
        data = await client.recv()
        if isinstance(data, str) and json.loads(data).get("event") == "picture":
            await client.recv()
            return json.loads(data)


async def drag(client, until):
    while time.monotonic() < until:
        await client.send('{"id":1,"command":"orbit","dx":0.004,"dy":0.002}')
        await asyncio.sleep(1 / STEPS)


async def row(program, file):
    began = time.monotonic()
    cells, shown = [], None
    with Preview(program, file, "--size", "1024x768", "--device", "cpu") as preview:
        async with preview.socket() as client:
            for enough in (lambda shown: True, lambda shown: not shown["balls"], lambda shown: shown["full"]):
                while not (shown and enough(shown)):
                    shown = await next_picture(client)
                cells += [f"{time.monotonic() - began:.2f}", f"{cpu_seconds(preview.process):.2f}"]
            busy, began = cpu_seconds(preview.process), time.monotonic()
            dragging = asyncio.create_task(drag(client, began + SECONDS))
            pictures = 0
            while time.monotonic() < began + SECONDS:
                await next_picture(client)
                pictures += 1
            spent = time.monotonic() - began
            await dragging
            cells += [f"{pictures / spent:.1f}", f"{(cpu_seconds(preview.process) - busy) / pictures:.2f}"]
    return cells


def main(program, *files):
    print("| molecule | first picture, s | CPU s | of the surface, s | CPU s | at rest, s | CPU s | drag: pictures a second "
          "| CPU s each |\n|---|---|---|---|---|---|---|---|---|")
    for file in files:
        print(f"| {os.path.basename(file)} | {' | '.join(asyncio.run(row(program, file)))} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
