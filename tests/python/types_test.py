# SPDX-License-Identifier: BSD-3-Clause
"""The types of the Python package: mypy --strict has no complaint about it, and sees what programs do wrong with it."""
import os
import pathlib
import subprocess
import sys
import tempfile

PACKAGE = pathlib.Path(os.environ["MENISCUS_PACKAGE"])

GOOD = '''
import numpy as np
import meniscus
s = meniscus.surface([[0, 0, 0]], 1.7, kind="sas")
s = meniscus.surface(meniscus.read("x.pdb", select="chain A", radii="united", model="all"))
smallest: float = s.distance([[0, 0, 0]]).min()
distances, feet = s.distance([[0, 0, 0]], nearest=True)
rows: int = feet.shape[0] + s.mesh(0.05).triangles.shape[0]
kind: str = s.kind
scene = meniscus.Scene("1ubq.cif", silhouettes="7pt", depth_cue=0.5, preset="flat", label=["resid 1=one"], legend=True)
scene.set(size="800x600", sticks="ligand").depth_cue = 0.25
picture: meniscus.Picture = scene.render("cpu")
picture = s.render(size="80x60", silhouettes=1.5, background="white", colors=(1, 0, 0))
'''
BAD = {
    'meniscus.surface([[0, 0, 0]], 1.7, kind="ess")': "surface",
    'meniscus.surface([[0, 0, 0]], 1.7, device="gpus")': "surface",
    'meniscus.surface([[0, 0, 0]])': "surface",
    'meniscus.surface([[0, 0, 0]], 1.7).gradient("mass")': "gradient",
    'meniscus.read("x.pdb", hydrogens="no")': "hydrogens",
    'meniscus.surface([[0, 0, 0]], 1.7).mesh().save("x", format="step")': "format",
    'meniscus.Scene("x.pdb", silhouetes="7pt")': "silhouetes",
    'meniscus.Scene("x.pdb", preset="flatt")': "preset",
    'meniscus.Scene("x.pdb", depth_cue="much")': "depth_cue",
    'meniscus.surface([[0, 0, 0]], 1.7).render(view="top")': "view",
    'meniscus.surface([[0, 0, 0]], 1.7).distance([[0, 0, 0]], nearest=True).min()': "min",
}


def mypy(*arguments, cache):
    environment = {**os.environ, "MYPYPATH": str(PACKAGE)}
    return subprocess.run([sys.executable, "-m", "mypy", "--strict", "--enable-incomplete-feature=Unpack",
                           "--cache-dir", cache, *arguments], text=True,
                          capture_output=True, env=environment, cwd=PACKAGE)


with tempfile.TemporaryDirectory() as folder:
    cache = str(pathlib.Path(folder) / "cache")
    if mypy("--version", cache=cache).returncode != 0:
        print("mypy is not installed")
        sys.exit(77)
    run = mypy("meniscus", cache=cache)
    assert run.returncode == 0, run.stdout
    program = pathlib.Path(folder) / "program.py"
    program.write_text(GOOD)
    run = mypy(str(program), cache=cache)
    assert run.returncode == 0, run.stdout
    program.write_text("import meniscus\n" + "\n".join(BAD) + "\n")
    run = mypy(str(program), cache=cache)
    for line, word in enumerate(BAD.values(), 2):
        said = [text for text in run.stdout.splitlines() if f"program.py:{line}: error" in text]
        assert any(word in text for text in said), f"line {line}: {said or 'nothing'}\n{run.stdout}"
    print(f"mypy: the package, a good program, {len(BAD)} bad lines")
