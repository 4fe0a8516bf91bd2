#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each option of each command changes a result, is refused, or is reported as having no effect."""

import concurrent.futures
import functools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)

# These options change how the work is done or what is reported, but not the result.
HOW = {"--threads", "--jobs", "--serve", "--no-open", "--token-file", "--device", "--require-gpu", "--verify", "--progress", "--warnings", "--quiet", "--verbose", "--trust-host", "--help",
       "--help-all", "--force", "--stats", "--extent", "--trust-scene", "--any-cost", "--trust-atom-order", "--addon"}
# These options are for things that a file may contain; without them they have no effect and no message.
POLICIES = {"--unknown-element", "--missing-color", "--altloc", "--hydrogens", "--keep-water", "--keep-ions", "--whole",
            "--select-once", "--cavities", "--instances", "--min-volume", "--cap-color", "--cap-hatching",
            "--sticks", "--balls", "--spheres", "--tube", "--bases", "--glycans", "--object",
            "--hydrogen-bonds", "--distance"}


def pdb(atoms, record="ATOM"):
    return [f"{record:<6}{serial:5d} {name if len(name) > 3 else ' ' + name:<4}{altloc}{residue:>3} {chain}{number:4d}    "
            f"{x:8.3f}{y:8.3f}{z:8.3f}{ {'A': 0.6, 'B': 0.4}.get(altloc, 1.0 - 0.01 * serial):6.2f}"
            f"{10.0 + 3 * serial:6.2f}          {element:>2}"
            for serial, (name, altloc, residue, chain, number, x, y, z, element) in enumerate(atoms, 1)]


def molecule(models, turn=0.4, water=True, broken=False, shift=0.0):
    """Returns two chains, a ligand, water, an ion, a hydrogen and alternate locations, in models that move."""
    atoms = [("N", " ", "ALA", "A", 1, 0.0, 0.0, 0.0, "N"), ("CA", " ", "ALA", "A", 1, 1.46, 0.0, 0.0, "C"),
             ("C", " ", "ALA", "A", 1, 2.0, 1.42, 0.0, "C"), ("O", " ", "ALA", "A", 1, 1.3, 2.4, 0.1, "O"),
             ("CB", " ", "ALA", "A", 1, 2.0, -0.8, 1.2, "C"), ("H", " ", "ALA", "A", 1, -0.5, 0.8, 0.3, "H"),
             ("N", " ", "GLY", "A", 2, 3.3, 1.5, 0.0, "N"), ("CA", " ", "GLY", "A", 2, 4.0, 2.8, 0.2, "C"),
             ("C", " ", "GLY", "A", 2, 5.4, 2.6, 0.6, "C"), ("O", "A", "GLY", "A", 2, 6.0, 1.5, 0.5, "O"),
             ("O", "B", "GLY", "A", 2, 6.1, 3.6, 0.9, "O"),
             ("N", " ", "ASP", "B", 1, 1.0, 1.0, 6.0, "N"), ("CA", " ", "ASP", "B", 1, 2.4, 1.0, 6.2, "C"),
             ("C", " ", "ASP", "B", 1, 3.0, 2.4, 6.1, "C"), ("O", " ", "ASP", "B", 1, 2.4, 3.4, 6.0, "O"),
             ("C1", " ", "LIG", "A", 9, 6.0, 0.0, 4.0, "C"), ("C2", " ", "LIG", "A", 9, 7.4, 0.2, 4.1, "C"),
             ("O", " ", "HOH", "A", 21, -4.0, 1.0, 2.0, "O"), ("NA", " ", " NA", "A", 31, 0.0, -6.0, 3.0, "NA")]
    lines = ["CRYST1   40.000   40.000   40.000  90.00  90.00  90.00 P 1           1",
             "REMARK 350 BIOMOLECULE: 1", "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A, B"]
    for number, step in ((1, 0.0), (2, 25.0)):
        lines += [f"REMARK 350   BIOMT{row + 1}{number:4d}{float(row == 0):10.6f}{float(row == 1):10.6f}"
                  f"{float(row == 2):10.6f}{step if row == 0 else 0.0:15.5f}" for row in range(3)]
    for model in range(models):
        cosine, sine = math.cos(turn * model), math.sin(turn * model)
        moved = [(*atom[:5], cosine * atom[5] - sine * atom[6] + 1.5 * model + shift, sine * atom[5] + cosine * atom[6],
                  atom[7] + 0.05 * model * n + (40.0 if broken and atom[:4] == ("O", " ", "ASP", "B") else 0.0), atom[8])
                 for n, atom in enumerate(atoms) if water or atom[2] != "HOH"]
        lines += [f"MODEL     {model + 1:4d}"] * (models > 1) + pdb(moved) + ["ENDMDL"] * (models > 1)
    return "\n".join(lines + ["END", ""])


def sphere(lid, models=1):
    """Returns atoms on a sphere with a cavity; without its lid, it is a pocket. Models are moved."""
    points = [(math.acos(1 - 2 * (n + 0.5) / 44), math.pi * (1 + 5 ** 0.5) * n) for n in range(44)]
    places = [(5 * math.sin(a) * math.cos(b), 5 * math.sin(a) * math.sin(b), 5 * math.cos(a)) for a, b in points]
    lines = []
    for model in range(models):
        atoms = [("CA", " ", "ALA", "A", n, x + 9 * model, y, z - 0.05 * model ** 2 * (n % 3), "C")
                 for n, (x, y, z) in enumerate(places, 1) if lid or z < 3.6]
        lines += [f"MODEL     {model + 1:4d}"] * (models > 1) + pdb(atoms) + ["ENDMDL"] * (models > 1)
    return "\n".join(lines + ["END", ""])


def rings():
    """Returns a base and a sugar, each a flat ring."""
    atoms = [(name, " ", residue, "A", number, 1.4 * math.cos(math.pi * n / 3) + 8 * number, 1.4 * math.sin(math.pi * n / 3), 0.0, name[0])
             for number, residue, names in ((1, "LIG", "N1 C2 N3 C4 C5 C6"), (2, "NAG", "C1 C2 C3 C4 C5 O5"))
             for n, name in enumerate(names.split())]
    return "\n".join(pdb(atoms, "HETATM") + ["END", ""])


def pair():
    """Returns two oxygens with a hydrogen bond."""
    return "\n".join(pdb([("O1", " ", "LGA", "A", 1, 0.0, 0.0, 0.0, "O"), ("O1", " ", "LGB", "B", 2, 2.8, 0.0, 0.0, "O")], "HETATM") + ["END", ""])


def potential():
    """Returns a volume map around the molecule that falls along x."""
    values = "\n".join(f"{0.3 * x - 2.0:.3f}" for x in range(14) for _ in range(14 * 14))
    return ("object 1 class gridpositions counts 14 14 14\norigin -12 -14 -8\ndelta 2.5 0 0\ndelta 0 2.5 0\n"
            "delta 0 0 2.5\nobject 2 class gridconnections counts 14 14 14\n"
            "object 3 class array type double rank 0 items 2744 data follows\n" + values + "\n")


def camera(x):
    return {"position": [x, 5, 60], "target": [2, 1, 3], "up": [0, 1, 0], "projection": "perspective", "vertical_fov": 30}


INPUTS = {
    "one.pdb": molecule(1), "run.pdb": molecule(4), "other.pdb": molecule(3, 0.9), "dry.pdb": molecule(3, water=False),
    "broken.pdb": molecule(3, broken=True), "moved.pdb": molecule(1, shift=9.0), "odd.pdb": molecule(1).replace(" H\n", " Q\n").replace(" H   ALA", " Q   ALA"),
    "rings.pdb": rings(), "pair.pdb": pair(), "cup.pdb": sphere(lid=False), "hollow.pdb": sphere(lid=True), "cups.pdb": sphere(False, 3), "map.dx": potential(),
    "numbers.csv": "chain,number,first,second\nA,1,1.0,7\nA,2,2.0,5\nB,1,3.0,1\n",
    "plain.txt": "A 1 1.0\nA 2 2.0\nB 1 3.0\n", "ramp.txt": "#ff0000\n#00ff00\n#0000ff\n", "radii.txt": "ALA CA 2.5\n",
    "curve.csv": "frame,time,area,volume\n" + "".join(f"{n},{n},{n * n},{5 - n}\n" for n in range(4)),
    "camera.json": json.dumps(camera(30)),
    "path.json": json.dumps({"keys": [{"frame": n, "camera": camera(30 + 9 * n)} for n in (0, 3)]}),
    "scene.json": json.dumps({"meniscus_scene": 1, "molecule": {"select": "chain A"}}),
    "a.json": json.dumps({"meniscus_scene": 1, "molecule": {"file": "one.pdb"}, "objects": [{"representation": "surface", "color": "bfactor"}]}),
    "b.json": json.dumps({"meniscus_scene": 1, "molecule": {"file": "moved.pdb", "select": "chain B"}, "objects": [{"representation": "surface", "color": "bfactor"}]}),
    "chains.json": json.dumps({"meniscus_scene": 1, "molecule": {"file": "one.pdb"}, "objects": [{"representation": "surface", "color": "chain"}]}),
    "bent.pdb": molecule(1).replace("   2.000  -0.800   1.200", "   2.000  -0.900   0.700"),
    "look.jsonl": "", "other.jsonl": '{"command": "set", "key": "surface.color", "value": "chain"}\n',
}
# Questions to a preview: its state and a picture of each frame.
QUESTIONS = [{"command": "state"}, {"command": "render_command"}]
for frame in range(4):
    QUESTIONS += [{"command": "export", "format": "png", "path": f"p{frame}.png", "wait": True, "force": True}, {"command": "next_frame"}]
for name in ("look.jsonl", "other.jsonl"):
    INPUTS[name] += "".join(json.dumps(question) + "\n" for question in QUESTIONS + [{"command": "quit"}])

# The conditions under which an option has an effect, as words of a command; {name} is an input.
CONTEXTS = {
    "plain": ["{one.pdb}"], "added": ["{one.pdb}", "--add", "{moved.pdb}"], "models": ["{run.pdb}"], "odd": ["{odd.pdb}"],
    "frames": ["{run.pdb}", "--frames", "all"], "film": ["{run.pdb}", "--frames", "0-1"], "usd": ["{run.pdb}", "--frames", "0-1"],
    "moving": ["{run.pdb}", "--frames", "all", "--select", "x < 4"],
    "near": ["{run.pdb}", "--frames", "all", "--select", "within 6 of resname LIG"],
    "broken": ["{broken.pdb}", "--frames", "all"], "fit": ["{run.pdb}", "--frames", "all", "--superpose", "name CA"],
    "dry": ["{one.pdb}", "--trajectory", "{dry.pdb}"],
    "curve": ["{run.pdb}", "--frames", "all", "--curve", "{curve.csv}"],
    "assembly": ["{one.pdb}", "--assembly", "1"], "hollow": ["{hollow.pdb}"],
    "exr": ["{one.pdb}"], "tiff": ["{one.pdb}"], "auto": ["{one.pdb}", "--width", "64px", "--height", "auto"], "clip": ["{one.pdb}", "--clip", "depth>0.5"], "clip sticks": ["{one.pdb}", "--sticks", "chain A", "--clip", "depth>0.5"], "seen through": ["{one.pdb}", "--opacity", "0.4"],
    "shapes": ["{one.pdb}", "--sticks", "chain A"], "sticks": ["{one.pdb}", "--sticks", "chain A", "--hide-surface"],
    "ring": ["{rings.pdb}", "--opacity", "0.1"], "covered ring": ["{rings.pdb}"],
    "pair": ["{pair.pdb}", "--opacity", "0.1"], "covered pair": ["{pair.pdb}"],
    "dashes": ["{pair.pdb}", "--opacity", "0.1", "--hydrogen-bonds", "all"], "covered dashes": ["{pair.pdb}", "--hydrogen-bonds", "all"],
    "tube": ["{one.pdb}", "--tube", "protein", "--hide-surface"],
    "mesh sticks": ["{one.pdb}", "--sticks", "chain A"], "mesh tube": ["{one.pdb}", "--tube", "protein"],
    "bare": ["{one.pdb}", "--opacity", "0.1"],
    "table": ["{one.pdb}", "--color-by-file", "{numbers.csv}", "--color-column", "first"],
    "some numbers": ["{one.pdb}", "--select", "all", "--color-by-file", "{plain.txt}"],
    "number": ["{one.pdb}", "--color", "bfactor"],
    "range": ["{one.pdb}", "--color-range", "-2:2"],
    "volume": ["{one.pdb}", "--color-map-file", "{map.dx}", "--color-range", "-2:2"],
    "legend": ["{one.pdb}", "--color", "bfactor", "--legend"],
    "named legend": ["{one.pdb}", "--color", "chain", "--legend"], "label": ["{one.pdb}", "--label", "resid 9=x"],
    "bar": ["{one.pdb}", "--scale-bar", "5"], "panel": ["{one.pdb}", "--panel", "a"],
    "shiny": ["{one.pdb}", "--specular", "0.9", "--ambient", "0.1"],
    "flat": ["{one.pdb}", "--preset", "flat"],
    "shade": ["{one.pdb}", "--ambient-occlusion", "1"], "rays": ["{one.pdb}", "--ambient-occlusion-rays", "9"], "table of atoms": ["{one.pdb}", "--csv", "a.csv"], "summary": ["{one.pdb}", "--csv-summary", "s.csv"],
    "shadows": ["{one.pdb}", "--shadows", "1"], "patches": ["{one.pdb}", "--patches", "chain A"],
    "length": ["{one.pdb}", "--width", "10mm"],
    "pixels": ["{one.pdb}", "--tolerance-pixels", "2"], "choice": ["{one.pdb}", "--select", "chain A"],
    "pocket fit": ["{cups.pdb}", "--frames", "all", "--csv", "p.csv", "--superpose", "name CA"],
    "cup": ["{cup.pdb}"], "pocket run": ["{cups.pdb}", "--frames", "all", "--csv", "p.csv"], "pocket mesh": ["{cup.pdb}", "--mesh", "p.ply"], "pocket figure": ["{cup.pdb}", "--figure", "p.json"],
    "panels": ["{a.json}", "{b.json}"], "panels tiff": ["{a.json}", "{b.json}", "--background", "white"], "panels legend": ["{a.json}", "{b.json}", "--legend", "--one-scale"],
    "panels scale": ["{a.json}", "{b.json}", "--one-scale"],
    "panels length": ["{a.json}", "{b.json}", "--width", "20mm"], "panels chains": ["{chains.json}", "--legend"],
    "panels camera": ["{a.json}", "{b.json}", "--one-camera"],
    "story": ["{a.json}", "{b.json}"], "story legend": ["{a.json}", "{b.json}", "--legend"], "story film": ["{a.json}", "{b.json}"],
    "story chains": ["{chains.json}", "{chains.json}", "--legend"],
    "path": ["{one.pdb}", "{bent.pdb}"],
    "bundle": [], "bundled film": ["--film", "f.mp4"], "": [],
}

# For each option, a value and a context in which it changes the result.
ROWS = {
    "--add": ("{moved.pdb}", "plain"), "--superpose-on": ("backbone", "added"), "--model": ("2", "models"), "--altloc": ("all", "plain"), "--select": ("chain A", "plain"),
    "--show": ("chain A", "plain"), "--bare": (None, "plain"), "--keep-water": (None, "plain"), "--keep-ions": (None, "plain"),
    "--unknown-element": ("guess", "odd"), "--surface": ("sas", "plain"), "--probe": ("2", "plain"),
    "--by": ("chain", "plain"), "--cavities": ("drop", "hollow"), "--hydrogens": ("drop", "plain"),
    "--radii": ("united", "plain"), "--radii-file": ("{radii.txt}", "plain"), "--radius": ("chain A=2.2", "plain"),
    "--assembly": ("1", "plain"), "--instances": ("separate", "assembly"), "--trajectory": ("{other.pdb}", "plain"),
    "--trajectory-atoms": ("not water", "dry"), "--repeat": ("2", "frames"), "--resume": (None, "frames"), "--draft": (None, "plain"), "--motion-blur": ("3", "frames"), "--interpolate": ("2", "frames"),
    "--frames": ("1-2", "models"), "--stride": ("2", "frames"), "--begin": ("1", "frames"), "--end": ("1", "frames"),
    "--only": ("1", "frames"), "--select-once": (None, "near"), "--whole": ("guess", "broken"), "--superpose": ("name CA", "frames"),
    "--center": ("name CA", "frames"), "--reference": ("2", "fit"), "--smooth": ("3", "frames"), "--fps": ("10", "film"),
    "--codec": ("h265", "film"), "--crf": ("40", "film"), "--bits": ("10", "film"), "--chroma": ("444", "film"),
    "--camera-path": ("{path.json}", "frames"), "--turntable": ("0.4", "frames"), "--follow": ("chain B", "frames"),
    "--sticks": ("chain A", "bare"), "--balls": ("chain A", "bare"), "--spheres": ("chain A", "bare"),
    "--tube": ("protein", "bare"), "--bases": ("resname LIG", "ring"), "--glycans": ("resname NAG", "ring"),
    "--hydrogen-bonds": ("chain A", "pair"), "--distance": ("chain A to chain B", "pair"), "--hide-lengths": (None, "dashes"),
    "--stick-radius": ("0.7", "sticks"), "--tube-radius": ("0.9", "tube"),
    "--object": ('{"representation": "surface", "selection": "resname LIG", "probe": 3}', "bare"),
    "--hide-surface": (None, "shapes"), "--opacity": ("0.4", "plain"), "--film-opacity": (None, "seen through"),
    "--clip": ("depth>0.5", "plain"), "--clip-all": (None, "clip sticks"), "--cap-color": ("red", "clip"), "--cap-hatching": ("1", "clip"),
    "--interface": ("A:B", "plain"), "--color": ("residue", "plain"), "--color-by-file": ("{plain.txt}", "plain"),
    "--color-column": ("second", "table"), "--map": ("magma", "number"), "--map-file": ("{ramp.txt}", "number"),
    "--color-range": ("0:99", "number"), "--color-map-file": ("{map.dx}", "range"), "--map-offset": ("2", "volume"),
    "--color-title": ("Heat", "legend"), "--color-unit": ("K", "legend"), "--missing-color": ("red", "some numbers"),
    "--size": ("48x30", "plain"), "--margin": ("9", "auto"), "--tiff-compression": ("lzw", "tiff"), "--tiff-bits": ("8", "tiff"), "--dpi": ("90", "plain"), "--width": ("5mm", "plain"), "--height": ("5mm", "plain"),
    "--camera": ("{camera.json}", "plain"), "--projection": ("orthographic", "plain"), "--view": ("top", "plain"),
    "--turn": ("y40", "plain"), "--zoom-to": ("chain B", "plain"), "--look-into": ("chain B", "plain"), "--preset": ("soft", "plain"),
    "--light": ("1,0,1", "plain"), "--light-strength": ("3", "plain"), "--ambient": ("0.1", "plain"),
    "--roughness": ("0.9", "plain"), "--specular": ("0.9", "plain"), "--shininess": ("9", "shiny"),
    "--ambient-occlusion": ("0.5", "plain"), "--ambient-occlusion-radius": ("3", "rays"),
    "--ambient-occlusion-rays": ("9", "shade"), "--shadows": ("0.8", "plain"), "--shadow-softness": ("20", "shadows"), "--silhouettes": ("3", "plain"),
    "--patch-lines": ("5", "patches"), "--patch-line-color": ("red", "patches"),
    "--outer-lines": ("3", "plain"), "--inner-lines": ("3", "plain"), "--part-lines": ("3", "plain"),
    "--depth-cue": ("1", "plain"), "--linear-alpha": (None, "plain"), "--samples": ("3", "plain"),
    "--background": ("white", "plain"), "--legend": (None, "number"), "--legend-file": ("legend.png", "number"),
    "--legend-name": ("A=Alpha", "named legend"), "--letter-size": ("7", "legend"), "--letter-color": ("red", "legend"),
    "--font": ("DejaVu Sans Mono", "legend"), "--font-file": ("/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "legend"),
    "--label-size": ("7", "label"), "--scale-bar-size": ("7", "bar"), "--panel-size": ("8", "panel"),
    "--legend-title": ("Heat", "legend"), "--legend-size": ("7", "legend"), "--legend-place": ("below", "legend"),
    "--panel": ("B", "plain"), "--title": ("One", "plain"), "--scale-bar": ("5", "plain"), "--label": ("resid 9=Here", "plain"),
    "--time-stamp": (None, "frames"), "--curve": ("{curve.csv}", "frames"), "--curve-column": ("volume", "curve"),
    "--aovs": (None, "plain"), "--cryptomatte": (None, "exr"), "--color-space": ("acescg", "exr"), "--provenance": (None, "plain"), "--no-provenance": (None, "plain"),
    "--save-camera": ("saved.json", "plain"), "--scene": ("{scene.json}", "plain"), "--save-scene": ("saved.json", "plain"),
    "--set": ("surface.probe=2", "plain"), "--json": (None, "plain"), "--csv": ("a.csv", "plain"), "--open-sky": (None, "table of atoms"), "--csv-series": ("s.csv", "frames"), "--csv-summary": ("s.csv", "plain"),
    "--csv-cavities": ("c.csv", "frames"), "--csv-residues": ("r.csv", "plain"), "--plot": ("p.svg", "frames"),
    "--gradients": ("g.csv", "plain"), "--context": ("chain B", "choice"), "--ligand": ("resid 1-9", "cup"),
    "--patches": ("chain A", "plain"), "--csv-patches": ("p.csv", "patches"), "--min-patch": ("9999", "patches"),
    "--mesh": ("p.ply", "cup"), "--figure": ("f.json", "cup"), "--large-probe": ("6", "cup"), "--trim": ("0", "cup"),
    "--min-volume": ("9999", "cup"), "--mouth-tolerance": ("0.5", "cup"), "--material": ("glass", "plain"),
    "--comments": (None, "plain"), "--tolerance": ("0.3", "plain"), "--tolerance-pixels": ("2", "plain"),
    "--density": ("1", "plain"), "--even": (None, "plain"), "--format": ("obj", "plain"), "--attributes": ("all", "plain"),
    "--unit": ("nanometer", "plain"), "--scale": ("3", "plain"), "--voxel": ("1", "plain"), "--band": ("1", "plain"),
}

# Options that the help leaves out, because few users need them.
RARE = {
    **{option: ("render", "preview") for option in ("--outer-lines", "--inner-lines", "--part-lines", "--linear-alpha")},
    "--legend-place": ("render", "preview", "panels", "film"),
    "--tiff-compression": ("render", "panels"), "--tiff-bits": ("render", "panels"),
    **{option: ("render",) for option in ("--curve-column", "--stats")},
    "--any-cost": ("render", "film", "panels"),
    **{option: ("render", "film", "farm bundle") for option in ("--bits", "--chroma")},
    "--map-offset": ("render", "preview", "export povray", "export blender", "export mitsuba", "export pbrt", "export mesh",
                     "export atoms"),
}

# Commands for which an option has another value or another context.
OWN_ROWS = {
    ("surface", "--hydrogens"): ("drop", "plain"), ("surface", "--resume"): (None, "summary"), ("pockets", "--show"): ("chain A", "pocket figure"),
    ("pockets", "--select-once"): (None, "moving"),
    **{("pockets", option): (value, "pocket run")
       for option, value in (("--superpose", "name CA"), ("--center", "name CA"))},
    ("pockets", "--reference"): ("1", "pocket fit"),
    ("pockets", "--tolerance"): ("0.5", "pocket mesh"), ("export blender", "--fps"): ("10", "frames"),
    ("export mesh", "--fps"): ("10", "usd"), ("export ply", "--fps"): ("10", "frames"),
    ("render", "--aovs"): (None, "exr"), ("preview", "--background"): ("black", "plain"),
    ("preview", "--commands"): ("{other.jsonl}", "plain"), ("preview", "--record"): ("r.jsonl", "plain"),
    ("preview", "--output-dir"): ("{exports.folder}", "plain"),
    ("formats", "--json"): (None, ""), ("farm bundle", "--engine"): ("slurm", "bundle"),
    ("farm bundle", "--chunk-minutes"): ("2", "bundle"), ("farm bundle", "--chunk-frames"): ("1", "bundle"),
    ("farm bundle", "--task-cores"): ("3", "bundle"), ("farm bundle", "--task-memory"): ("999", "bundle"),
    ("farm bundle", "--by-reference"): (None, "bundle"),
    ("farm bundle", "--film"): ("f.mp4", "bundle"), ("farm bundle", "--farm-path"): ("/mnt/farm", "bundle"),
    **{("panels", option): (value, context) for option, value, context in (
        ("--superpose-on", "backbone", "panels camera"), ("--columns", "1", "panels"), ("--gap", "9", "panels"),
        ("--letters", "none", "panels"), ("--one-camera", None, "panels"), ("--one-scale", None, "panels"),
        ("--samples", "3", "panels"), ("--background", "white", "panels"), ("--size", "90x40", "panels"), ("--width", "10mm", "panels"),
        ("--height", "10mm", "panels"), ("--dpi", "90", "panels length"), ("--legend", None, "panels scale"),
        ("--legend-title", "Heat", "panels legend"), ("--legend-size", "7", "panels legend"),
        ("--legend-place", "below", "panels legend"), ("--legend-name", "A=Alpha", "panels chains"),
        ("--letter-size", "7", "panels"), ("--letter-color", "red", "panels"), ("--font", "DejaVu Sans Mono", "panels"),
        ("--font-file", "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "panels"), ("--tiff-compression", "lzw", "panels tiff"),
        ("--tiff-bits", "8", "panels tiff"))},
    **{("film", option): (value, context) for option, value, context in (
        ("--hold", "0.08", "story"), ("--transition", "0.12", "story"), ("--ease", "even", "story"), ("--to", "povray", "story"), ("--draft", None, "story"), ("--size", "40x20", "story"),
        ("--samples", "3", "story"), ("--background", "white", "story"), ("--legend", None, "story"),
        ("--legend-title", "Heat", "story legend"), ("--legend-size", "7", "story legend"), ("--legend-place", "below", "story legend"),
        ("--legend-name", "A=Alpha", "story chains"), ("--letter-size", "7", "story legend"), ("--letter-color", "red", "story legend"),
        ("--font", "DejaVu Sans Mono", "story legend"), ("--font-file", "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "story legend"),
        ("--fps", "10", "story film"), ("--codec", "h265", "story film"), ("--crf", "40", "story film"), ("--bits", "10", "story film"),
        ("--chroma", "444", "story film"), ("--progress", "json", "story"))},
    ("looks", "--size"): ("240x150", "plain"),
    ("morph", "--select"): ("chain A", "path"), ("morph", "--superpose-on"): ("name CB or backbone and chain A", "path"),
    ("morph", "--steps"): ("3", "path"),
    **{("farm bundle", option): (value, "bundled film")
       for option, value in (("--fps", "10"), ("--codec", "h265"), ("--crf", "40"), ("--bits", "10"), ("--chroma", "444"))},
}
for export in ("povray", "blender", "mitsuba", "pbrt", "mvs"):
    OWN_ROWS["export " + export, "--dpi"] = ("90", "length")
for shape in ("--sticks", "--balls", "--spheres", "--tube", "--bases", "--glycans"):
    OWN_ROWS["export page", shape] = (ROWS[shape][0], "covered ring" if shape in ("--bases", "--glycans") else "plain")
for option, context in (("--hydrogen-bonds", "pair"), ("--distance", "pair"), ("--hide-lengths", "dashes")):
    OWN_ROWS["export page", option] = (ROWS[option][0], "covered " + context)
OWN_ROWS["export page", "--background"] = ("black", "plain")
OWN_ROWS["export page", "--named-view"] = ("Back={camera.json}", "plain")
OWN_ROWS["export mesh", "--preset"] = ("cover", "plain")
for export in ("mesh", "ply"):
    OWN_ROWS["export " + export, "--stick-radius"] = ("0.7", "mesh sticks")
    OWN_ROWS["export " + export, "--tube-radius"] = ("0.9", "mesh tube")
    for shape in ("--sticks", "--balls", "--spheres", "--tube", "--bases", "--glycans"):
        OWN_ROWS["export " + export, shape] = (ROWS[shape][0], "ring" if shape in ("--bases", "--glycans") else "plain")
    for option in ("--size", "--width", "--height", "--projection", "--zoom-to", "--camera"):
        OWN_ROWS["export " + export, option] = (ROWS[option][0], "pixels")
    for option in ("--dpi", "--view", "--turn"):
        OWN_ROWS["export " + export, option] = (ROWS[option][0], None)

SMALL = {"render": ["--size", "32x24", "--samples", "1", "--no-provenance"], "preview": ["--size", "32x24", "--samples", "1"],
         "export page": ["--size", "32x24"],
         "panels": ["--size", "200x100", "--samples", "1"], "looks": ["--size", "200x150", "--samples", "1"],
         "film": ["--size", "32x24", "--samples", "1", "--hold", "0", "--transition", "0.08"]}
MESHES = {"export blender", "export mitsuba", "export pbrt", "export mvs", "export mesh", "export ply"}
EXCLUDES = {"--tolerance-pixels": "--tolerance", "--density": "--tolerance", "--width": "--size", "--height": "--size",
            "--provenance": "--no-provenance", "--no-provenance": "--no-provenance"}


def output_of(command, context):
    of_run = "--frames" in CONTEXTS[context] or "--trajectory" in CONTEXTS[context]
    return {"film": "a.mp4" if context == "story film" else "a_#.png", "render": "a.mp4" if context == "film" else "a.exr" if context == "exr" else "a.tif" if context == "tiff" else "a_#.png" if of_run else "a.png", "export mesh": "a.usda" if context == "usd" else "a_#.glb" if of_run else "a.glb",
            "panels": "a.tif" if context == "panels tiff" else "a.png", "looks": "a.png", "morph": "a.pdb", "export ply": "a_#.ply" if of_run else "a.ply", "export atoms": "a.atoms", "export vdb": "a_#.vdb" if of_run else "a.vdb", "export page": "a.html", "export mvs": "a.mvsx", "export blender": "a" if of_run else "a.mns"}.get(command, "a")


def options_of(command):
    """Returns the options of a command from its help, and those that the help leaves out."""
    text = subprocess.run([PROGRAM, *command.split(), "--help-all"], capture_output=True, text=True).stdout
    shown = set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.M)) - {"--output"}
    return sorted(shown | {option for option, commands in RARE.items() if command in commands})


class Result:
    """The result of one run: its printed text without times, and its files."""

    def __init__(self, words, folder):
        with tempfile.TemporaryDirectory(dir=folder) as place:
            done = subprocess.run([PROGRAM, *words], capture_output=True, cwd=place, stdin=subprocess.DEVNULL, timeout=120)
            paths = [path for path in sorted(Path(place).rglob("*")) if path.is_file()]
            self.files = {str(path.relative_to(place)): path.read_bytes() for path in paths}
        self.code, self.err = done.returncode, done.stderr.decode().replace(str(folder), "")
        self.out = re.sub(r'(?m)"ms": [-+0-9.e]+|^time .*$', "", done.stdout.decode())

    def differs_from(self, base):
        return (self.code, self.out, self.files) != (base.code, base.out, base.files)


class OptionUse(unittest.TestCase):
    """Every option is tried alone, in its own context, and with frames, a cut or constant colours."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for name, text in INPUTS.items():
            (cls.folder / name).write_text(text)
        (cls.folder / "exports.folder").mkdir()
        cls.pool = concurrent.futures.ThreadPoolExecutor(os.cpu_count())
        cls.addClassCleanup(cls.pool.shutdown)
        cls.commands = re.findall(r"^  ([a-z]+) ", subprocess.run([PROGRAM, "--help"], capture_output=True, text=True)
                                  .stdout.split("Commands:")[1], re.M)
        below = {name: re.findall(r"^  ([a-z]+) ", cls.help_of(name).split("Options:")[1], re.M) for name in ("export", "farm")}
        cls.commands = [name for name in cls.commands if name not in below] + \
            [f"{name} {part}" for name, parts in below.items() for part in parts]

    @staticmethod
    def help_of(command):
        return subprocess.run([PROGRAM, *command.split(), "--help"], capture_output=True, text=True).stdout

    @functools.cache
    def begun(self, words):
        return self.pool.submit(Result, words, self.folder)

    def words(self, command, context, option, value):
        """Returns the words of the run with the option; without their last part, those without it."""
        def filled(word):
            if command == "pockets":
                word = word.replace("{run.pdb}", "{cups.pdb}")
            return re.sub(r"\{(\w+\.\w+)\}", lambda name: str(self.folder / name.group(1)), word)
        own = list(SMALL.get(command, []))
        if command in MESHES and "--tolerance-pixels" not in CONTEXTS[context]:
            own += ["--tolerance", "0.5"]
        if command in SMALL and {"--legend", "--legend-file", "--label", "--hydrogen-bonds"} & {*CONTEXTS[context], option}:
            own[1] = "400x150" if command == "panels" else "200x150"
        excluded = {EXCLUDES.get(word) for word in (option, *CONTEXTS[context])}
        for name in excluded & set(own):
            at = own.index(name)
            del own[at:at + (1 if name == "--no-provenance" else 2)]
        words = [filled(word) for word in CONTEXTS[context]] + own
        if command == "farm bundle":
            words = ["b", *words] if option == "--chunk-minutes" else ["b", "--chunk-frames", "2", *words]
        elif command not in ("info", "formats", "morph") and "--device" not in words:
            words += ["--device", "cpu", *(["--threads", "1"] if command != "preview" else [])]
        if command == "preview":
            words += ["--serve", "--commands", str(self.folder / "look.jsonl")]
        if command in ("render", "film", "panels", "looks", "morph") or command.startswith("export"):
            words += ["-o", output_of(command, context)]
        tail = ["--", "render", str(self.folder / "run.pdb"), "--frames", "all", "--size", "64x48"] if command == "farm bundle" else []
        asked = [option] if value is None else [option, filled(value)]
        return (*command.split(), *words, *tail), (*command.split(), *words, *asked, *tail)

    def pairs(self, contexts):
        """Yields (command, option, context, whether it is the option's own, base, with the option)."""
        pairs = []
        for command in TESTED:
            options = options_of(command)
            for option in options:
                if option in HOW:
                    continue
                value, own = OWN_ROWS.get((command, option)) or ROWS[option]
                for context in dict.fromkeys([own, *contexts]):
                    if context is None or (context != own and command in ("formats", "farm bundle", "pockets", "film", "panels", "looks", "morph")):
                        continue
                    if any(word.startswith("--") and word not in options for word in CONTEXTS[context]):
                        continue
                    base, more = self.words(command, context, option, value)
                    pairs.append((command, option, context, context == own, self.begun(base), self.begun(more)))
        return [(*pair[:4], pair[4].result(), pair[5].result()) for pair in pairs]

    def test_each_option_has_a_row(self):
        for command in self.commands:
            for option in options_of(command):
                if command in TESTED and option not in HOW:
                    self.assertTrue((command, option) in OWN_ROWS or option in ROWS, f"{command} {option}")

    def test_cuts_that_cut_nothing_are_said(self):
        for command in TESTED:
            if "--clip" not in options_of(command):
                continue
            for context in ("plain", "frames") if "--frames" in options_of(command) else ("plain",):
                for cut, words in (("x<500", "cuts nothing"), ("depth>0", "cuts nothing"), ("x<-500", "leaves nothing"), ("x<2", None)):
                    with self.subTest(command=command, context=context, cut=cut):
                        result = self.begun(self.words(command, context, "--clip", cut)[1]).result()
                        said = [line for line in result.err.splitlines() if f"--clip {cut} {words}" in line]
                        self.assertEqual(len(said), 0 if words is None else 1, result.err)
                        self.assertTrue(words or f"--clip {cut}" not in result.err, result.err)

    def test_pictures_of_a_preview_have_the_resolution_asked_for(self):
        for option, value in (("--dpi", "90"), ("--width", "5mm"), ("--size", "48x30")):
            picture = self.begun(self.words("preview", "plain", option, value)[1]).result().files["p0.png"]
            self.assertEqual(b"pHYs" in picture, option != "--size", option)

    def test_no_option_does_nothing_without_a_word(self):
        for command, option, context, is_own, base, more in self.pairs(["plain", "frames", "flat"]):
            with self.subTest(command=command, option=option, context=context):
                if more.code != 0:
                    self.assertTrue(more.err.strip())
                    if is_own:
                        self.assertIn((command, option), REFUSED, more.err)
                    continue
                if (command, option) in SILENT or (option in POLICIES and not is_own):
                    continue
                said = set(more.err.splitlines()) - set(base.err.splitlines())
                self.assertTrue(more.differs_from(base) or any(option in line for line in said), more.err)


TESTED = ["surface", "pockets", "info", "render", "film", "panels", "looks", "morph", "preview", "export povray", "export blender", "export mitsuba", "export pbrt",
          "export mvs", "export mesh", "export ply", "export vdb", "export atoms", "export page", "formats", "farm bundle"]
# The command lacks the feature of the option, or lacks it for an output of that name.
REFUSED = {("pockets", "--instances"), ("export vdb", "--instances"), ("export atoms", "--instances"), ("render", "--frames"), ("render", "--trajectory"),
           *((f"export {mesh}", option) for mesh in ("mesh", "ply", "vdb") for option in ("--frames", "--trajectory")),
           ("preview", "--color-map-file"), ("preview", "--map-offset"), ("export atoms", "--color-map-file"), ("export atoms", "--map-offset"), ("export pbrt", "--color-map-file"),
           ("export pbrt", "--map-offset"), ("export mitsuba", "--cap-hatching"), ("export mitsuba", "--film-opacity"),
           ("export pbrt", "--cap-hatching"), ("export pbrt", "--film-opacity"), ("export page", "--object"),
           ("export mvs", "--cap-hatching"), ("export mvs", "--film-opacity"), ("export mvs", "--material")}
# Complete molecules have no pockets, a cavity is not visible from outside, and separate copies look the same.
SILENT = {("pockets", "--whole"), ("export ply", "--preset"), ("render", "--instances"), ("render", "--cavities")}

if __name__ == "__main__":
    unittest.main()
