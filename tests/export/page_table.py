# SPDX-License-Identifier: BSD-3-Clause
"""page_table.py PROGRAM CHROMIUM FREESASA_DATA pixels [NAME...] | turning [FOLDER] | speed FILE...: tables of what pages of
`export page` show in a browser, for docs/validation/page-pixels.md.

pixels: more than twenty molecules and scenes, or those of the molecules named, each pixel beside that of `meniscus render`;
ends with an error where more than one in a thousand differs, or an outline is off by more than half a pixel. turning: thirty
steps of a whole turn, each beside the picture by `meniscus render` from the same camera, and the draft of each; an error, too,
where a pixel shows the background though there is a surface. FOLDER: for pictures of all frames (of the second film from 100
on), the page's beside the one by render and the draft. speed: what a picture of each FILE costs."""

import asyncio
import json
import math
import os
import pathlib
import sys
import tempfile

PROGRAM, CHROMIUM, FREESASA, WHAT, *FILES = sys.argv[1:]
sys.argv[1:] = [PROGRAM, CHROMIUM, FREESASA]
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/export"))

import numpy
import OpenImageIO
import figure_page
from browser import Browser

PYMOL = "/usr/share/pymol/data"
TOXIN, PROTEASE, UBIQUITIN = f"{PYMOL}/demo/1tii.pdb", f"{PYMOL}/tut/1hpv.pdb", f"{FREESASA}/1ubq.pdb"
TWICE = 2 ** 0.5


def cage(count=120, radius=8.0, ball=1.9):
    """Returns balls all around a cavity."""
    balls = []
    for n in range(count):
        y, turn = 1 - 2 * (n + 0.5) / count, n * 2.399963
        around = math.sqrt(1 - y * y)
        balls.append((radius * around * math.cos(turn), radius * y, radius * around * math.sin(turn), ball))
    return balls


BALLS = {
    "one ball": [(0, 0, 0, 1.7)], "two that touch": [(0, 0, 0, 1.5), (3, 0, 0, 1.5)],
    "spindle": [(0, 0, 0, 1.5), (5.4, 0, 0, 1.5), (8, 1, 0, 1.2)],
    "square": [(0, 0, 0, 1.5), (4, 0, 0, 1.5), (4, 4, 0, 1.5), (0, 4, 0, 1.5)],
    "cube": [(x, y, z, 1.5) for x in (0, 3.5) for y in (0, 3.5) for z in (0, 3.5)],
    "row of seven": [(3.0 * n, 0, 0, 1.6) for n in range(7)],
    "octahedron": [(s * TWICE * 2, 0, 0, 1.4) for s in (-1, 1)] + [(0, s * TWICE * 2, 0, 1.4) for s in (-1, 1)] +
                  [(0, 0, s * TWICE * 2, 1.4) for s in (-1, 1)],
    "cage": cage(),
}
INSIDE = {"position": [0, 0, 0], "target": [1, 0.2, 0.1], "up": [0, 1, 0], "projection": "perspective", "vertical_fov": 80}
SCENES = [
    *[(name, "--color", "kind") for name in BALLS if name != "cage"],
    ("cage", "--camera", "{inside}"), ("cage", "--clip", "z<0", "--color", "kind"),
    ("cage", "--cavities", "only", "--projection", "orthographic"),
    (UBIQUITIN,), (UBIQUITIN, "--projection", "orthographic", "--color", "kind", "--preset", "flat"),
    (UBIQUITIN, "--surface", "sas", "--color", "residue"), (UBIQUITIN, "--surface", "vdw", "--preset", "cover"),
    (UBIQUITIN, "--probe", "3"), (UBIQUITIN, "--probe", "0.6", "--color", "kind"),
    (UBIQUITIN, "--patches", "hydrophobicity > 1.5", "--color", "hydrophobicity"), (UBIQUITIN, "--opacity", "0.4", "--tube", "polymer"),
    (UBIQUITIN, "--hide-surface", "--balls", "all"),
    (TOXIN, "--color", "chain"), (TOXIN, "--show", "chain A", "--sticks", "chain C", "--zoom-to", "chain C"),
    (TOXIN, "--clip", "depth>0.5", "--cap-hatching", "2", "--color", "chain"),
    (PROTEASE, "--look-into", "ligand", "--sticks", "ligand"), (PROTEASE, "--by", "chain", "--color", "chain"), (UBIQUITIN, "--color", "lipophilicity"), (f"{PYMOL}/demo/il2.pdb", "--color", "bfactor"), (f"{PYMOL}/demo/pept.pdb", "--color", "rainbow"),
    (f"{FREESASA}/1a0q.pdb", "--color", "secondary", "--tube", "polymer", "--show", "resid 1-60"), (f"{FREESASA}/2jo4.pdb", "--color", "residue"),
    (f"{FREESASA}/1d3z.pdb", "--color", "index", "--view", "back"),
]

# Times a draft of a moving view, or a sample of one at rest, in a second run; reading a pixel waits for the device.
SPEED = """(() => {
  const viewer = window.meniscus, caster = viewer.caster, gl = caster.gl, [width, height] = [%d, %d], counts = { calls: 0, bytes: 0 };
  for (const name in gl) {
    if (typeof gl[name] !== "function") continue;
    const real = gl[name].bind(gl);
    gl[name] = (...words) => {
      ++counts.calls;
      if (name === "bufferData" || name === "texImage2D") for (const word of words) counts.bytes += word?.byteLength ?? 0;
      return real(...words);
    };
  }
  const time = (effects) => {
    const all = [];
    for (let n = 0; n < 2; ++n) {
      Object.assign(counts, { calls: 0, bytes: 0 });
      const began = performance.now();
      caster.begin(viewer.camera, width, height);
      const sorted = performance.now();
      caster.cast(0, effects);
      caster.read(0, 0, 1, 1, 2);
      all.push([performance.now() - began, sorted - began]);
    }
    const [took, sort] = all.slice(1).sort((a, b) => a[0] - b[0])[0];
    return { took, sort, ...counts };
  };
  const found = time(%s ? { shade: false, lines: false, draft: true } : viewer.effects);
  // Each primitive draws the rectangle around its bound, as footprint.vert has it.
  const { forward, eye_distance, pixel_size, orthographic, pivot } = caster.frame;
  let fragments = 0;
  for (let n = 0; n < caster.primitive_count; ++n) {
    const from = minus([...caster.centers.subarray(3 * n, 3 * n + 3)], pivot), depth = orthographic ? eye_distance : eye_distance + dot(from, forward);
    const side = 2 * caster.radii[n] * eye_distance / (pixel_size * Math.max(depth, 1e-3));
    fragments += Math.min(side, width) * Math.min(side, height);
  }
  return { ...found, fragments, primitives: caster.primitive_count };
})()"""

# Molecules and options of the films of a turn.
FILMS = [
    (TOXIN, "--color", "chain"),
    (UBIQUITIN, "--color", "residue", "--opacity", "0.5", "--opacity", "resid 1-20=1", "--clip", "1,0.2,0<36", "--tube", "polymer"),
]
STEPS = 30
STEP = f"meniscus.camera = orbited(meniscus.camera, {2 / STEPS}, 0)"  # a part of a whole turn
CAMERA = """(() => {
  const { position, target, up, orthographic, fov, height } = meniscus.camera, { origin } = meniscus.figure;
  const size = orthographic ? { height } : { vertical_fov: fov };
  return { position: plus(position, origin), target: plus(target, origin), up, projection: orthographic ? "orthographic" : "perspective", ...size };
})()"""
# Pixels where the draft of moving views, half as wide as the picture, has met something.
DRAFT_SIZE = tuple(side // 2 for side in figure_page.SIZE)
DRAFT = """(() => {
  const viewer = meniscus, caster = viewer.caster, [width, height] = [%d, %d];
  caster.begin(viewer.camera, width, height);
  caster.cast(0, { shade: false, lines: false, draft: true });
  const what = caster.read(0, 0, width, height, 2), met = [];
  for (let n = 1; n < what.length; n += 4) met.push(what[n] === kNoPrimitive ? 0 : 1);
  return met;
})()""" % DRAFT_SIZE


class Pages(figure_page.PageCase):
    def runTest(self):
        pass


async def pixels(pages):
    names = {}
    for name, balls in BALLS.items():
        names[name] = pages.balls(name.replace(" ", "_") + ".xyzr", balls)
    with open(pages.path("inside.json"), "w") as file:
        json.dump(INSIDE, file)
    print("| molecule | options | depth | atom | colour | any |\n|---|---|--:|--:|--:|--:|")
    bad, lines = [], []
    check = pages.check

    def row(name, found, wanted):
        with open(os.devnull, "w") as nothing:
            out, sys.stdout = sys.stdout, nothing
            try:
                differs = check(name, found, wanted)
            except AssertionError as error:
                differs = None
                bad.append(f"{name}: {error}")
            finally:
                sys.stdout = out
        lines.append(differs)

    pages.check = row
    scenes = [scene for scene in SCENES if not FILES or pathlib.Path(scene[0]).stem in FILES]
    for molecule, *options in scenes:
        words = [word.replace("{inside}", pages.path("inside.json")) for word in options]
        async with pages.browser() as page:
            await pages.compare(page, names.get(molecule, molecule), *words)
        counts = lines[-1]
        shown = " ".join(f"'{word}'" if " " in word or ">" in word else word for word in options).replace("{inside}", "inside.json")
        print(f"| {pathlib.Path(molecule).stem} | `{shown or '(none)'}` | " +
              (" | ".join(str(n) for n in counts[:3]) + f" | {100 * counts[3]:.3f} % |" if counts else "failed | | | |"), flush=True)
    print(f"{len(scenes)} scenes of {figure_page.SIZE[0]} x {figure_page.SIZE[1]} pixels; not as they should be: {len(bad)}")
    for line in bad:
        print(line)
    return len(bad)


async def turning(pages):
    """Compares the frames of turns. A hole is a background pixel amid pixels of a surface in the picture by render."""
    width, height = figure_page.SIZE
    print("| molecule | options | frames | most that differ in one | holes | holes of drafts |\n|---|---|--:|--:|--:|--:|")
    bad = 0
    for film, (molecule, *options) in enumerate(FILMS):
        differ, holes, draft_holes = [], 0, 0
        async with pages.browser() as page:
            await pages.load(page, pages.export(molecule, "--size", f"{width}x{height}", *options))
            for step in range(STEPS):
                await page.evaluate(STEP)
                with open(pages.path("turned.json"), "w") as file:
                    json.dump(await page.evaluate(CAMERA), file)
                from_there = (molecule, *options, "--camera", pages.path("turned.json"))
                wanted, found = pages.rendered(*from_there), await pages.cast(page)
                small, draft = pages.rendered(*from_there, size=DRAFT_SIZE), numpy.reshape(await page.evaluate(DRAFT), DRAFT_SIZE[::-1]) == 1
                solid, met = numpy.isfinite(wanted[1]), numpy.isfinite(found[1])
                off = (solid != met) | (numpy.abs(numpy.where(met, found[1], 0) - numpy.where(solid, wanted[1], 0)) > 2e-3)
                off |= (found[2] != wanted[2]) | (numpy.abs(found[0] - wanted[0]).max(axis=2) > 2 / 255)
                differ.append(off.mean())
                holes += (inside(solid) & ~met).sum()
                draft_holes += (inside(numpy.isfinite(small[1])) & ~draft).sum()
                if FILES:
                    both = numpy.concatenate([found[0], wanted[0], numpy.repeat(numpy.repeat(draft, 2, 0), 2, 1)[:, :, None] * numpy.ones(3)], axis=1)
                    save(both, os.path.join(FILES[0], f"{100 * film + step:03d}.png"))
        shown = " ".join(f"'{word}'" if " " in word or "<" in word else word for word in options)
        print(f"| {pathlib.Path(molecule).stem} | `{shown}` | {STEPS} | {100 * max(differ):.3f} % | {holes} | {draft_holes} |", flush=True)
        bad += max(differ) > 1e-3 or holes > 0 or draft_holes > 0
    return bad


def inside(solid):
    """Returns pixels whose neighbours have a surface, too: outlines may be off by half a pixel."""
    around = numpy.pad(solid, 1)
    return numpy.all([around[1 + y:around.shape[0] - 1 + y, 1 + x:around.shape[1] - 1 + x] for y in (-1, 0, 1) for x in (-1, 0, 1)], axis=0)


def save(pixels, path):
    height, width, channels = pixels.shape
    out = OpenImageIO.ImageOutput.create(path)
    out.open(path, OpenImageIO.ImageSpec(width, height, channels, OpenImageIO.UINT8))
    out.write_image(numpy.ascontiguousarray(numpy.clip(255 * pixels + 0.5, 0, 255).astype(numpy.uint8)))
    out.close()


async def speed(pages):
    print("| molecule | pixels | primitives | page, bytes | draft, frames/s | at rest, samples/s | sorting, ms | calls | bytes | fragments |")
    print("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|")
    for molecule in FILES:
        page_path = pages.export(molecule, "--color", "chain")
        for size in ((640, 480), (1280, 960)):
            found = []
            for draft in ("true", "false"):
                async with Browser(CHROMIUM, (500, 300), figure_page.SOFTWARE_GL) as page:
                    await pages.load(page, page_path)
                    found.append(await page.evaluate(SPEED % (*size, draft)))
            draft, rest = found
            print(f"| {pathlib.Path(molecule).name.split('.')[0]} | {size[0]} x {size[1]} | {draft['primitives']:,} | {os.path.getsize(page_path):,} | "
                  f"{1000 / draft['took']:.2f} | {1000 / rest['took']:.2f} | {draft['sort']:.0f} | {draft['calls']} / {rest['calls']} | "
                  f"{draft['bytes']:,} | {draft['fragments']:,.0f} |", flush=True)
    return 0


def main():
    pages = Pages()
    with tempfile.TemporaryDirectory() as folder:
        pages.folder = type("Folder", (), {"name": folder})
        sys.exit(1 if asyncio.run({"pixels": pixels, "turning": turning, "speed": speed}[WHAT](pages)) else 0)


if __name__ == "__main__":
    main()
