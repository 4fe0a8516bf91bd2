# SPDX-License-Identifier: BSD-3-Clause
"""client_tasks.py [PACKAGE...]: a hundred small tasks of people who use the Python package beside others, and what each gives. A
task is one expression, and a pattern that its value or its error has. Tasks whose packages are missing are left out, unless they
are named. Environment as of package_test.py."""
import importlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import warnings

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

import meniscus

NAMED = sys.argv[1:]
UBIQUITIN = pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb")

#: Code that the tasks of each package use; without the package they are left out.
SETUP = {
    "": """m = meniscus.read("1ubq.pdb"); s = meniscus.surface(m); xyz = np.array(m.positions); mesh = s.mesh(0.3)
scene = meniscus.Scene("1ubq.pdb", size="80x60"); small = meniscus.surface([[0, 0, 0], [3, 0, 0]], [1.7, 1.52])
gro = "\\n".join(["t", str(len(m)), *(f"{a.residue_number:5}{a.residue_name:<5}{a.name:>5}{a.row + 1:5}" + "".join(f"{c / 10:8.3f}"
      for c in a.position) for a in m), " 9 9 9"]) + "\\n"; _ = open("1ubq.gro", "w").write(gro)
def refused(call):
    try: return call()
    except Exception as error: return f"{type(error).__name__}, {', '.join(k.__name__ for k in type(error).__mro__[3:-3])}: {error}\"""",
    "pandas": "import pandas as pd",
    "MDAnalysis": """import MDAnalysis as mda; u = mda.Universe("1ubq.gro"); v = mda.Universe("1ubq.pdb").select_atoms("protein")""",
    "MDAnalysisTests": """import MDAnalysis as mda, MDAnalysisTests.datafiles as files
def run(top, trajectory): return meniscus.surface(mda.Universe(top, trajectory).select_atoms("protein"))
def mda_charged(top, trajectory): return meniscus.from_mdanalysis(mda.Universe(top, trajectory))""",
    "mdtraj": """import mdtraj; t = mdtraj.load("1ubq.pdb"); t = t.atom_slice(t.top.select("protein"))""",
    "biotite": """import biotite.structure.io.pdb as bpdb; array = bpdb.PDBFile.read("1ubq.pdb").get_structure(model=1)
array = array[array.res_name != "HOH"]; bare = array.copy(); bare.element[:] = \"\"""",
    "gemmi": """import gemmi; g = gemmi.read_structure("1ubq.pdb"); g.remove_waters()""",
    "rdkit": """from rdkit import Chem; from rdkit.Chem import AllChem; mols = [Chem.AddHs(Chem.MolFromSmiles(w)) for w in ("CCO", "c1ccccc1O")]
for one in mols: _ = AllChem.EmbedMultipleConfs(one, 2, randomSeed=7)
writer = Chem.SDWriter("poses.sdf"); _ = [writer.write(one, confId=c) for one in mols for c in (0, 1)]; writer.close()""",
    "Bio": """from Bio.PDB import PDBParser; b = PDBParser(QUIET=True).get_structure("x", "1ubq.pdb")""",
    "ase": """import ase.build; ethanol = ase.build.molecule("CH3CH2OH")""",
    "PIL": "from PIL import Image",
    "matplotlib": """import matplotlib; viridis = matplotlib.colormaps["viridis"]""",
    "trimesh": "import trimesh",
    "freesasa": "import freesasa",
}

#: Each row has the package, the task, the expression and the pattern.
TASKS = [
    ("", "area of a file", "round(s.area, 2)", "4027.76"),
    ("", "volume of a file", "round(s.volume, 2)", "9185.44"),
    ("", "accessible area", "round(s.atom_sas_areas.sum(), 2)", "4871.17"),
    ("", "area of arrays", "round(small.area, 2)", "60.71"),
    ("", "another probe", "round(meniscus.surface(m, probe=1.2).area, 1)", r"\d{4}\.\d"),
    ("", "area of one residue name", "round(float(s.atom_areas[m.residue_names == 'LYS'].sum()), 1)", "^[1-9]"),
    ("", "area of an element", "round(float(s.atom_areas[m.elements == 'C'].sum()), 1)", "^[1-9]"),
    ("", "elements by number", "int((m.atomic_numbers == 6).sum())", "^[1-9]"),
    ("", "numbers compared with texts", "refused(lambda: m.residue_numbers == '48')", "TypeError.*compared with texts"),
    ("", "texts compared with numbers", "refused(lambda: m.names == 48)", "TypeError.*compared with numbers"),
    ("", "area by residue", "s.areas_by('residue')['area'].round(1)[:3].tolist()", r"\[53.0, 65.8"),
    ("", "area by chain", "s.areas_by('chain')[['chain', 'atoms']].tolist()", r"\[\('A', 602\)\]"),
    ("", "a mask", "m[m.elements == 'N']", "105 of 602 atoms"),
    ("", "a slice", "m[:10]", "10 of 602 atoms"),
    ("", "an array of indices", "m[[5, 3]].indices.tolist()", r"\[5, 3\]"),
    ("", "a selection", "m.select('resid 48 and name CA').residue_names.tolist()", "LYS"),
    ("", "a text as an index", "refused(lambda: m['chain A'])", "TypeError.*molecule.select"),
    ("", "an atom", "m[0]", "Atom.*name='N'"),
    ("", "iteration by atom", "sum(atom.element == 'S' for atom in m)", "^1$"),
    ("", "iteration by residue", "len([r for r in m.split('residue')])", "^76$"),
    ("", "iteration by chain", "[c.chains[0] for c in m.split('chain')]", "A"),
    ("", "a molecule of arrays", "meniscus.Structure(xyz, m.elements)", "602 atoms"),
    ("", "its surface", "meniscus.surface(meniscus.Structure(xyz, m.elements)).area == s.area", "True"),
    ("", "elements guessed from names", "(meniscus.Structure(xyz, names=m.names, residue_names=m.residue_names).elements == m.elements).all()", "True"),
    ("", "partial charges of arrays", "meniscus.Structure(xyz[:4], ['C'] * 4, charges=[0.5, -0.5, 0.1, 0]).select('charge > 0')", "2 of 4 atoms"),
    ("", "radii by element", "meniscus.Structure(xyz, m.elements, radii={'C': 1.8}).radii[1]", "1.8"),
    ("", "a set of radii for arrays", "meniscus.Structure(xyz, m.elements, names=m.names, residue_names=m.residue_names, radii='protor').radii[0]", "1.64"),
    ("", "buried area of two parts", "meniscus.buried(m, 'resid 1-38', 'resid 39-76')", "Buried: .* Å² of"),
    ("", "interface of two parts", "meniscus.buried(m, 'resid 1-38', 'resid 39-76').interface", "of 602 atoms"),
    ("", "write mmCIF", "m.write('a.cif') or meniscus.read('a.cif')", "602 used"),
    ("", "write a part", "m[:8].write('b.cif') or len(meniscus.read('b.cif'))", "8"),
    ("gemmi", "write PDB", "m.write('a.pdb') or round(meniscus.surface(meniscus.read('a.pdb')).area, 2)", "4027.76"),
    ("", "read a file object", "meniscus.read(open('1ubq.pdb'))", "602 used"),
    ("", "read text in memory", "meniscus.read(io.StringIO(open('1ubq.pdb').read()))", "602 used"),
    ("", "read bytes", "meniscus.read(open('1ubq.pdb', 'rb').read())", "602 used"),
    ("", "a missing file", "refused(lambda: meniscus.read('none.pdb'))", "FileNotFoundError"),
    ("", "a folder", "refused(lambda: meniscus.read('.'))", "IsADirectoryError"),
    ("", "a path for surface()", "refused(lambda: meniscus.surface('1ubq.pdb'))", r"TypeError.*meniscus.read\(\)"),
    ("", "radii forgotten", "refused(lambda: meniscus.surface(xyz))", "TypeError.*radii are missing"),
    ("", "Martini radii for atoms", "refused(lambda: meniscus.read('1ubq.pdb', radii='martini2').radii_set)", "."),
    ("", "nanometres", "refused(lambda: meniscus.surface(xyz / 10, m.radii))", "UserWarning|Surface|nanometres"),
    ("", "one point", "round(float(s.distance([0, 0, 0])), 2)", r"^\d"),
    ("", "distances of points", "s.distance(xyz[:3]).round(2).tolist()", r"\[-"),
    ("", "gradient", "s.gradient('sas_area').shape", r"\(602, 3\)"),
    ("", "pockets", "s.pockets(min_volume=10)[:1]", "Pocket: (cavity|pocket|tunnel) of"),
    ("", "repr of patches", "s.patches", "Patches: .* convex"),
    ("", "repr of a surface", "s", r"ses of 602 atoms, 4027.76 Å², 9185.44 Å³, 3 components"),
    ("", "curvature of a mesh", "len(mesh.attribute('mean_curvature')) == len(mesh.vertices)", "True"),
    ("", "mesh into a stream", "(lambda f: mesh.save(f, format='stl') or len(f.getvalue()))(io.BytesIO())", r"^\d{4}"),
    ("", "mesh to a file", "mesh.save('a.ply') or os.path.getsize('a.ply')", r"^\d{4}"),
    ("", "mesh to a file again", "refused(lambda: mesh.save('a.ply'))", "FileExistsError.*replace=True"),
    ("", "mesh of a wrong format", "refused(lambda: mesh.save('a.xyz'))", "UsageError.*give a format: stl"),
    ("", "picture to a file", "s.render(size=(80, 60), device='cpu').save('a.png') or os.path.getsize('a.png')", r"^\d{3}"),
    ("", "picture as an array", "np.asarray(s.render(size=(80, 60), device='cpu')).shape", r"\(60, 80, 4\)"),
    ("PIL", "picture for Pillow", "Image.fromarray(s.render(size=(80, 60), device='cpu')).size", r"\(80, 60\)"),
    ("", "a colour by name", "s.render(size=(8, 6), device='cpu', colors='teal')", "8x6"),
    ("", "colours by names", "small.render(size=(8, 6), device='cpu', colors=['red', '#00ff00'])", "8x6"),
    ("matplotlib", "colours of a colour map", "s.render(size=(8, 6), device='cpu', colors=viridis(m.b_factors / 50))", "8x6"),
    ("", "half transparent colours", "refused(lambda: s.render(size=(8, 6), device='cpu', colors=(1, 0, 0, 0.5)))", "InputError.*opacity"),
    ("", "colours by chain", "m.colors('chain').shape", r"\(602, 3\)"),
    ("", "a value of a scene", "'size' in scene, 'color' in scene", r"\(True, False\)"),
    ("", "iterate over a scene", "[name for name in scene]", r"\['file', 'size'\]"),
    ("", "a scene as a dict", "dict(scene)", "{'file': '1ubq.pdb', 'size': '80x60'}"),
    ("", "a wrong name", "refused(lambda: setattr(scene, 'depth_cu', 1))", "AttributeError.*did you mean depth_cue"),
    ("", "a wrong key", "refused(lambda: scene['depth_cu'])", "KeyError.*did you mean depth_cue"),
    ("", "a wrong value", "refused(lambda: setattr(scene, 'depth_cue', 'abc'))", "UsageError.*from 0 to 1"),
    ("", "a scene of a molecule", "meniscus.Scene(m, size=(80, 60)).render('cpu')", "80x60"),
    ("", "a scene of a part", "meniscus.Scene(m.select('resid 1-20'), size=(80, 60), sticks='resid 5').render('cpu')", "80x60"),
    ("", "a page of a scene", "meniscus.Scene(m).show()", "Page of 1ubq.cif"),
    ("", "a page of a surface", "s.show(structure=m).title", "1ubq"),
    ("", "the next frame", "small.update([[0, 0, 0], [3.2, 0, 0]]) is small", "True"),
    ("", "a pickled molecule keeps colours", "__import__('pickle').loads(__import__('pickle').dumps(m)).colors('chain').shape", r"\(602, 3\)"),
    ("", "GRO by read()", "round(meniscus.surface(meniscus.read('1ubq.gro')).area)", "^40"),
    ("", "models of a file as frames", "[s.structure for s in meniscus.frames('1ubq.pdb')]", "602"),
    ("", "series of a file", "meniscus.series('1ubq.pdb')['area'].round(2)", "4027.76"),
    ("", "help with an example", "'>>>' in meniscus.Structure.__doc__", "True"),
    ("", "python -m meniscus", "subprocess.run([sys.executable, '-m', 'meniscus', '--version'], capture_output=True, text=True, env={**os.environ, "
     "'PYTHONPATH': os.pathsep.join(sys.path), 'PATH': os.path.dirname(os.environ.get('MENISCUS_PROGRAM', '')) + ':' + os.environ['PATH']}).stdout "
     "or 'not installed'", r"meniscus \d+\.\d+\.\d+|not installed"),
    ("pandas", "DataFrame of atoms", "m.to_dataframe().groupby('element').size()['N']", "105"),
    ("pandas", "DataFrame of residues", "s.to_dataframe('residue').shape", r"\(76, 8\)"),
    ("pandas", "DataFrame of atoms and areas", "round(s.to_dataframe().groupby('residue_name')['area'].sum()['LYS'])", "^[1-9]"),
    ("pandas", "DataFrame of a series", "pd.DataFrame(meniscus.series('1ubq.pdb')).shape", r"\(1, 7\)"),
    ("MDAnalysis", "AtomGroup", "meniscus.surface(v)", "4027.76"),
    ("MDAnalysis", "its structure", "meniscus.from_mdanalysis(v)", "Structure: 602 atoms of 1ubq.pdb"),
    ("MDAnalysis", "GRO without elements", "meniscus.surface(u)", "602 atoms, 40"),
    ("MDAnalysis", "selections before and after", "meniscus.from_mdanalysis(v).select('resid 48')", "9 of 602 atoms"),
    ("MDAnalysis", "frames", "[round(s.area) for s in meniscus.frames(v)]", "4028"),
    ("MDAnalysis", "scene of a frame", "meniscus.Scene(v, size=(80, 60), color='element').render('cpu')", "80x60"),
    ("MDAnalysis", "trajectory with a topology", "next(meniscus.frames('1ubq.gro', topology='1ubq.gro'))", "602 atoms, 40"),
    ("MDAnalysisTests", "GRO and XTC", "run(files.GRO, files.XTC)", "3341 atoms, 11553.78"),
    ("MDAnalysisTests", "PSF and DCD", "run(files.PSF, files.DCD)", "3341 atoms, 10096.67"),
    ("MDAnalysisTests", "prmtop and TRJ", "run(files.PRM, files.TRJ_bz2)", "252 atoms"),
    ("MDAnalysisTests", "TPR and XTC", "run(files.TPR, files.XTC)", "3341 atoms, 11553.78"),
    ("MDAnalysisTests", "partial charges of a PSF", "mda_charged(files.PSF, files.DCD).select('charge < -0.5 and segid 4AKE')", r"^<meniscus.Structure: [1-9]"),
    ("mdtraj", "Trajectory", "meniscus.surface(t)", "602 atoms, 4027.76"),
    ("mdtraj", "series", "meniscus.series(t)['area'].round(1)", r"4027\.8"),
    ("biotite", "AtomArray", "meniscus.surface(array)", "4027.76"),
    ("biotite", "AtomArray without elements", "meniscus.surface(bare)", "4027.76"),
    ("biotite", "chains of an AtomArray", "meniscus.from_biotite(array).chains[0]", "A"),
    ("gemmi", "Structure", "meniscus.surface(g)", "4027.76"),
    ("gemmi", "residues of a chain", "len(meniscus.surface(g[0]['A']).areas_by('residue'))", "76"),
    ("rdkit", "Mol", "meniscus.surface(mols[0])", "9 atoms"),
    ("rdkit", "list of Mols", "[len(s) for s in meniscus.frames(mols)]", r"\[9, 9, 13, 13\]"),
    ("rdkit", "poses of SDF", "[len(s) for s in meniscus.frames('poses.sdf')]", r"\[9, 9, 13, 13\]"),
    ("rdkit", "SDMolSupplier", "[len(s) for s in meniscus.frames(Chem.SDMolSupplier('poses.sdf', removeHs=False))]", r"\[9, 9, 13, 13\]"),
    ("rdkit", "a Mol where a surface is wanted by arrays", "refused(lambda: meniscus.surface(mols[0], probe='1.4'))", "TypeError.*probe"),
    ("Bio", "Bio.PDB Structure", "len(meniscus.surface(b))", "660"),
    ("ase", "ase.Atoms", "meniscus.surface(ethanol)", "9 atoms, 78.82"),
    ("trimesh", "mesh for trimesh", "mesh.to_trimesh().is_watertight", "True"),
    ("freesasa", "the area that FreeSASA has", "abs(freesasa.calcCoord(xyz.ravel().tolist(), m.radii.tolist()).totalArea() / s.atom_sas_areas.sum() - 1) < 0.01", "True"),
]


def names_of():
    """Returns the names for the tasks, and the packages that are missing."""
    names, missing = {"meniscus": meniscus, "np": np, "io": io, "os": os, "sys": sys, "subprocess": subprocess}, []
    for package, code in SETUP.items():
        try:
            if package:
                importlib.import_module(package)
        except ImportError:
            if package in NAMED:
                raise
            missing.append(package)
            continue
        exec(code, names)
    return names, missing


def main():
    if not UBIQUITIN.exists():
        print(f"skipped: there is no {UBIQUITIN}; Debian's freesasa has it")
        return 77
    shutil.copy(UBIQUITIN, "1ubq.pdb")
    names, missing = names_of()
    wrong, left_out = 0, 0
    for number, (package, task, code, pattern) in enumerate(TASKS, 1):
        if package in missing:
            left_out += 1
            continue
        try:
            value = str(eval(code, names))
        except Exception as error:
            value = f"!! {type(error).__name__}: {error}"
        good = re.search(pattern, value, re.S) and not value.startswith("!!")
        wrong += not good
        print(f"{number:3} {'  ' if good else '✗ '}{package + ': ' if package else ''}{task}: {' '.join(value.split())[:150]}")
    print(f"{len(TASKS)} tasks: {len(TASKS) - wrong - left_out} as expected, {wrong} not, {left_out} left out ({', '.join(missing)})")
    return 1 if wrong or len(TASKS) < 100 else 0


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        code = main()
        os.chdir(before)
    sys.exit(code)
