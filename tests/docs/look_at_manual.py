# SPDX-License-Identifier: BSD-3-Clause
"""look_at_manual.py SITE AXE FOLDER: opens pages of the manual in Chromium, as wide as a desktop and as a phone.

axe-core must find no violation, nothing may be fetched from elsewhere or reach beyond the width, and the search must find
a page, also if the site is opened as a file. Pictures go to FOLDER.
"""

import asyncio
import functools
import http.server
import pathlib
import sys
import threading

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "preview"))
from browser import Browser

SITE, AXE, FOLDER = (pathlib.Path(argument) for argument in sys.argv[1:4])
PAGES = ["how-to/1tii.html", "tutorials/first-figure.html", "how-to/figures.html", "reference/options/info.html",
         "explanation/how-it-works.html", "validation/benchmarks.html", "index.html"]
WIDTHS = {"desktop": (1280, 900), "phone": (390, 844)}


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


async def look(page, address, name):
    """Returns the faults of a page as lines."""
    await page.send("Page.navigate", url=address)
    while await page.evaluate("document.readyState") != "complete":
        await asyncio.sleep(0.05)
    await asyncio.sleep(0.5)
    await page.evaluate(AXE.read_text() + "; 0")
    found = await page.evaluate("axe.run().then((result) => result.violations.map((v) => `${v.id}: ${v.nodes.length}, "
                                "first ${v.nodes[0].html.slice(0, 150)}`))")
    foreign = await page.evaluate("performance.getEntriesByType('resource').map((r) => r.name)"
                                  ".filter((name) => !name.startsWith(location.origin) && !name.startsWith('data:'))")
    over = await page.evaluate("document.documentElement.scrollWidth - window.innerWidth")
    await page.screenshot(str(FOLDER / f"{name}.png"))
    return [*found, *(f"fetched: {address}" for address in foreign), *([f"{over} px too wide"] if over > 0 else [])]


async def search(page, address):
    """Returns how many pages the search for "pocket" finds."""
    await page.send("Page.navigate", url=address)
    while await page.evaluate("document.readyState") != "complete":
        await asyncio.sleep(0.05)
    await page.evaluate("(() => { document.querySelector('[data-md-toggle=search]').click();"
                        " const i = document.querySelector('.md-search__input'); i.focus(); i.value = 'pocket';"
                        " i.dispatchEvent(new Event('input', {bubbles: true}));"
                        " i.dispatchEvent(new KeyboardEvent('keyup', {bubbles: true})); return 0 })()")
    for _ in range(100):
        if hits := await page.evaluate("document.querySelectorAll('.md-search-result__item').length"):
            return hits
        await asyncio.sleep(0.1)
    return 0


async def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=SITE))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    root = f"http://127.0.0.1:{server.server_port}/"
    cases = failures = 0
    for width, size in WIDTHS.items():
        async with Browser("chromium", size) as page:
            for place in PAGES:
                wrong = await look(page, root + place, f"{width}-{place.replace('/', '-')[:-5]}")
                print(f"{width} {place}: {'; '.join(wrong) or 'good'}")
                cases, failures = cases + 1, failures + bool(wrong)
            for address in (root, SITE.resolve().as_uri() + "/"):
                hits = await search(page, address + "index.html")
                print(f"{width} {address[:4]}: the search for pocket finds {hits} pages")
                cases, failures = cases + 1, failures + (not hits)
            for complaint in page.complaints:
                print(f"{width}: {complaint}")
                failures += 1
    print(f"cases {cases} failures {failures}")
    return 1 if failures else 0


sys.exit(asyncio.run(main()))
