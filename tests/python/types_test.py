# SPDX-License-Identifier: BSD-3-Clause
"""types_test.py CHECKER...: mypy --strict and pyright have no complaint about the Python package, and see what programs do
wrong with it. Without names those that are installed are tried."""
import json
import os
import pathlib
import re
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
areas = [t.area for t in meniscus.frames(None, probe=1.2, kind="ses")] + [meniscus.surface(meniscus.from_rdkit(None, radii=[1.7])).area]
scene = meniscus.Scene("1ubq.cif", silhouettes="7pt", depth_cue=0.5, preset="flat", label=["resid 1=one"], legend=True)
scene.set(size="800x600", sticks="ligand").depth_cue = 0.25
picture: meniscus.Picture = scene.render("cpu")
picture = s.render(size=(80, 60), silhouettes=1.5, background="white", colors="red")
picture.save("a.png", replace=True)
molecule = meniscus.read(open("x.pdb", "rb"), radii="martini3")
part: meniscus.Structure = molecule[molecule.elements == "C"].select("chain A")
names = [atom.name for atom in molecule] + [molecule[0].name]
sizes = [len(residue) for residue in molecule.split("residue")]
made = meniscus.Structure(np.zeros((2, 3)), ["C", "O"], radii=1.7, names=["C1", "O1"], name="two")
lost: float = meniscus.buried(made, "chain A", molecule.chains == "B").total
area: float = meniscus.surface(made).areas_by("chain")["area"].sum()
distances = s.distance([0, 0, 0])
scene.depth_cue = None
scene.size = (3, 4)
colored: bool = "color" in scene and dict(scene)["color"] is not None
'''
BAD = {
    'meniscus.surface([[0, 0, 0]], 1.7, kind="ess")': "surface",
    'meniscus.surface([[0, 0, 0]], 1.7, device="gpus")': "surface",
    'meniscus.surface([[0, 0, 0]])': "surface",
    'meniscus.surface([[0, 0, 0]], 1.7).gradient("mass")': "gradient",
    'meniscus.from_mdtraj(None, prob=1.4)': "prob",
    'meniscus.from_openmm(None, kind="ess")': "kind",
    'meniscus.frames(None, threads="two")': "threads",
    'meniscus.surface([[0, 0, 0]], 1.7).prob = 3': "prob",
    'meniscus.read("x.pdb", hydrogens="no")': "hydrogens",
    'meniscus.surface([[0, 0, 0]], 1.7).mesh().save("x", format="step")': "format",
    'meniscus.Scene("x.pdb", silhouetes="7pt")': "silhouetes",
    'meniscus.Scene("x.pdb").depth_cu = 3': "depth_cu",
    'meniscus.Scene("x.pdb").depth_cue = "abc"': "float",
    'meniscus.Scene("x.pdb").preset = "flatt"': "flatt",
    'meniscus.read("x.pdb").element': "element",
    'meniscus.from_mdtraj(None).area': "area",
    'meniscus.read("x.pdb").split("atom")': "split",
    'meniscus.Scene("x.pdb", preset="flatt")': "preset",
    'meniscus.Scene("x.pdb", depth_cue="much")': "depth_cue",
    'meniscus.surface([[0, 0, 0]], 1.7).render(view="top")': "view",
    'meniscus.surface([[0, 0, 0]], 1.7).distance([[0, 0, 0]], nearest=True).min()': "min",
}


def mypy(path, folder):
    """Returns line and text of each complaint."""
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--enable-incomplete-feature=Unpack", "--cache-dir",
                          str(folder / "cache"), str(path)], text=True, capture_output=True, cwd=PACKAGE,
                         env={**os.environ, "MYPYPATH": str(PACKAGE)})
    found = re.findall(r"^.*?:(\d+): error: (.*)$", run.stdout, re.M)
    assert bool(found) == (run.returncode != 0), run.stdout + run.stderr
    return [(int(line), text) for line, text in found]


def pyright_told(*arguments):
    """Runs pyright, which finds packages by the first python of PATH."""
    path = os.pathsep.join([os.path.dirname(sys.executable), os.environ["PATH"]])
    run = subprocess.run([sys.executable, "-m", "pyright", "--outputjson", *arguments], text=True, capture_output=True,
                         env={**os.environ, "PYTHONPATH": str(PACKAGE), "PATH": path})
    return json.loads(run.stdout)


def pyright(path, folder):
    return [(one["range"]["start"]["line"] + 1, one["message"]) for one in pyright_told(str(path))["generalDiagnostics"]]


def of_unknown_type():
    symbols = pyright_told("--ignoreexternal", "--verifytypes", "meniscus")["typeCompleteness"]["symbols"]
    return [symbol["name"] for symbol in symbols if symbol["isExported"] and not symbol["isTypeKnown"]]


def installed(checker):
    return subprocess.run([sys.executable, "-m", checker, "--version"], capture_output=True).returncode == 0


def check(checker):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        complaints = checker(PACKAGE / "meniscus", folder)
        assert not complaints, complaints
        program = folder / "program.py"
        program.write_text(GOOD)
        complaints = checker(program, folder)
        assert not complaints, complaints
        program.write_text("import meniscus\n" + "\n".join(BAD) + "\n")
        complaints = checker(program, folder)
        for line, word in enumerate(BAD.values(), 2):
            said = [text for at, text in complaints if at == line]
            assert any(word in text for text in said), f"line {line}: {said or 'nothing'}"
    print(f"{checker.__name__}: the package, a good program, {len(BAD)} bad lines")


CHECKERS = {"mypy": mypy, "pyright": pyright}
names = sys.argv[1:] or [name for name in CHECKERS if installed(name)]
if not names:
    print("neither mypy nor pyright is installed")
    sys.exit(77)
for name in names:
    check(CHECKERS[name])
if "pyright" in names:
    assert not of_unknown_type(), of_unknown_type()
