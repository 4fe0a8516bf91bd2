# SPDX-License-Identifier: BSD-3-Clause
"""page_screens.py PROGRAM FREESASA_DATA FOLDER CHROMIUM|FIREFOX... [--only NAME]: pages of six scenes in each browser, as a
desktop and as a phone shows them. The pictures are left in FOLDER to be looked at; an error where a page complains."""

import argparse
import asyncio
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/preview"))

from browser import Browser
from firefox import Firefox

PYMOL = pathlib.Path("/usr/share/pymol/data")
SIZES = {"desktop": (1280, 800), "phone": (390, 844)}
SOFTWARE_GL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SAMPLES = 3  # fewer than the usual 16, for software GL is slow
FILM = '{"representation": "surface", "selection": "polymer", "color": "#b0b8c0", "opacity": 0.12, "film_opacity": true}'
# Each page comes from a scene of the gallery, or from options.
SCENES = {
    "chains": (PYMOL / "demo/1tii.pdb", "--scene", "chains"),
    "cut": (PYMOL / "tut/1hpv.pdb", "--scene", "cut"),
    "lipophilicity": ("1ubq.pdb", "--scene", "lipophilicity"),
    "labels": ("1ubq.pdb", "--scene", "labels_a"),
    "cavities": (PYMOL / "tut/1hpv.pdb", "--select", "polymer", "--cavities", "only", "--color", "component", "--object", FILM, "--sticks", "ligand",
                 "--label", "chain A and resid 25=Asp <25>", "--background", "#202830"),
    "frames": ("run.pdb", "--frames", "all", "--color", "bfactor", "--named-view", "Back, from the other side=back.png", "--opacity", "0.6",
               "--tube", "polymer"),
}


def run_of(molecule, path, last=30, frames=4):
    """Writes models of the first residues, which move apart."""
    rows = [row for row in molecule.read_text().splitlines() if row.startswith("ATOM") and int(row[22:26]) <= last]
    models = []
    for frame in range(frames):
        moved = [f"{row[:30]}{float(row[30:38]) * (1 + 0.03 * frame):8.3f}{row[38:]}" for row in rows]
        models.append("\n".join([f"MODEL     {frame + 1:4d}", *moved, "ENDMDL\n"]))
    path.write_text("".join(models))


def page_of(asked, name):
    molecule, *options = SCENES[name]
    if options[0] == "--scene":
        scene = asked.folder / f"{options[1]}.json"
        shutil.copy(ROOT / "docs/gallery" / scene.name, scene)
        options = ["--scene", scene]
    path = asked.folder / f"{name}.html"
    subprocess.run([asked.program, "export", "page", asked.folder / molecule, *options, "-o", path, "--force"], check=True, cwd=asked.folder)
    return path


async def shoot(program, page_path, size, shot):
    async with Firefox(program, size) if "firefox" in program else Browser(program, size, SOFTWARE_GL) as page:
        await page.navigate(page_path.as_uri())
        await page.until("window.meniscus ? 1 : 0", 120)
        await page.evaluate(f"meniscus.figure.samples.length = {SAMPLES}, meniscus.change(), 1")
        await page.at_rest(500)
        await page.screenshot(shot)
        wide = await page.evaluate("document.documentElement.scrollWidth > innerWidth ? 1 : 0")
        return page.complaints + (["it is wider than the window"] if wide else [])


async def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("freesasa", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("browsers", nargs="+")
    parser.add_argument("--only", choices=SCENES, action="append")
    asked = parser.parse_args()
    asked.program, asked.folder = asked.program.resolve(), asked.folder.resolve()
    shutil.copy(asked.freesasa / "1ubq.pdb", asked.folder)
    run_of(asked.folder / "1ubq.pdb", asked.folder / "run.pdb")
    subprocess.run([asked.program, "render", "run.pdb", "-o", "back.png", "--force", "-q", "--size", "160x120", "--view", "back"], check=True, cwd=asked.folder)
    bad = 0
    for name in asked.only or SCENES:
        page_path = page_of(asked, name)
        for program in asked.browsers:
            for what, size in SIZES.items():
                shot = asked.folder / f"{name}_{pathlib.Path(program).name}_{what}.png"
                complaints = await shoot(program, page_path, size, shot)
                print(f"{shot.name}: {'; '.join(complaints) or 'no complaints'}", flush=True)
                bad += len(complaints) > 0
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    asyncio.run(main())
