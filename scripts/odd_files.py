# SPDX-License-Identifier: BSD-3-Clause
"""odd_files.py PROGRAM: prints docs/validation/odd-files.md: what the program says about damaged and unusual files.

Each file is made here and read by `meniscus surface FILE`."""

import datetime
import gzip
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def atom(serial="1", name=" CA ", altloc=" ", residue="ALA", chain=" A", number="   1", x="0.000", y="0.000", z="0.000",
         occupancy="  1.00", b=" 10.00", element=" C", record="ATOM  ", insertion=" "):
    return f"{record}{serial:>5} {name}{altloc}{residue}{chain}{number}{insertion}   {x:>8}{y:>8}{z:>8}{occupancy}{b}          {element}\n"


def two(**second):
    return atom() + atom(**{"serial": "2", "name": " CB ", "x": "1.500", **second})


def gro(count, *atoms, box="   5.00000   5.00000   5.00000\n"):
    return f"title\n{count}\n" + "".join(f"    1ALA     {name:>2}{n:>5}{x:8.3f}{0:8.3f}{0:8.3f}\n" for n, (name, x) in enumerate(atoms, 1)) + box


CIF = "data_a\nloop_\n" + "".join(f"_atom_site.{name}\n" for name in ("id", "type_symbol", "label_atom_id", "label_comp_id", "label_asym_id",
                                                                      "Cartn_x", "Cartn_y", "Cartn_z"))
PQR = "ATOM      1  N   ALA A   1       0.000   0.000   0.000  0.100  1.500\n"
SDF = ("ligand\n  test    01012600003D\n\n{counts} V2000\n    0.0000    0.0000    0.0000 C   0  0\n    1.5000    0.0000    0.5000 O   0  0\n"
       "  1  2  1  0\nM  END\n$$$$\n")
COUNTS = "  2  1  0  0  0  0  0  0  0  0999"
MOL2 = "@<TRIPOS>MOLECULE\nligand\n{counts}\nSMALL\nUSER_CHARGES\n@<TRIPOS>ATOM\n1 C1 0 0 0 {type} 1 LIG1 0.1\n@<TRIPOS>BOND\n"
PDBQT = "ATOM      1  C   UNL A   1       0.000   0.000   0.000  1.00  0.00    {charge:>6} A \n"
PAIR = (("CA", 0.0), ("CB", 0.15))
MODEL = "MODEL        1\n{}ENDMDL\nMODEL        2\n{}ENDMDL\n"

# What it is, its name, its text or bytes, and options.
FILES = [
    ("a folder", ".", None),
    ("/dev/zero", "/dev/zero", None),
    ("empty", "empty.pdb", ""),
    ("PDB named .cif", "a.cif", two()),
    ("PQR named .pdb", "b.pdb", PQR),
    ("GRO without a name", "gro", gro(1, PAIR[0])),
    ("UTF-16", "u.pdb", two().encode("utf-16")),
    ("CR line ends, BOM", "cr.pdb", b"\xef\xbb\xbf" + two().replace("\n", "\r").encode()),
    ("NUL bytes", "nul.pdb", two().encode() + b"\0\0\0\n"),
    ("gzip cut short", "c.pdb.gz", gzip.compress(two().encode() * 50)[:60]),
    ("two gzip members", "m.pdb.gz", gzip.compress(atom().encode()) + gzip.compress(atom("2", " CB ", x="1.500").encode())),
    ("water only", "w.pdb", atom(record="HETATM", name=" O  ", residue="HOH", element=" O")),
    ("record cut short", "s.pdb", "REMARK a\n" + atom() + atom()[:40] + "\n"),
    ("coordinate stars", "st.pdb", "REMARK a\n" + two(x="********")),
    ("inf occupancy, stars as B", "inf.pdb", two() + atom("3", " C  ", x="3.000", occupancy="   inf", b="******")),
    ("1 mm away", "far.pdb", "REMARK a\n" + two(x="1.0e+7")),
    ("serial stars and hex", "ser.pdb", two(serial="186A0").replace("    1 ", "***** ", 1)),
    ("hybrid-36, negative, insertion", "res.pdb", atom(number="A000") + atom("2", " CB ", number="  -5", x="1.500")
     + atom("3", " C  ", number="   5", insertion="A", x="3.000")),
    ("residue number stars", "rs.pdb", atom(number="****") + atom("2", " CB ", number="****", x="1.500")),
    ("two-letter chain", "ch.pdb", two().replace(" A   1", "AB   1")),
    ("no element column", "el.pdb", two(element="  ").replace("          C\n", "\n")),
    ("unknown element", "x.pdb", two() + atom("3", " X1 ", residue="UNL", number="   3", x="3.000", element=" X")),
    ("the same, --unknown-element skip", "x.pdb", two() + atom("3", " X1 ", residue="UNL", number="   3", x="3.000", element=" X"),
     "--unknown-element", "skip"),
    ("two altlocs", "alt.pdb", atom(altloc="A", occupancy="  0.60") + atom("2", altloc="B", x="0.500", occupancy="  0.40")),
    ("the same, --altloc C", "alt.pdb", atom(altloc="A", occupancy="  0.60") + atom("2", altloc="B", x="0.500", occupancy="  0.40"),
     "--altloc", "C"),
    ("coincident atoms", "co.pdb", two() + atom("3", " C  ", number="   2")),
    ("the same, --warnings full", "co.pdb", two() + atom("3", " C  ", number="   2"), "--warnings", "full"),
    ("two models, --model 3", "mod.pdb", MODEL.format(two(), two()), "--model", "3"),
    ("MODEL without ENDMDL", "em.pdb", MODEL.format(two(), two()).replace("ENDMDL\n", "", 1)),
    ("unclosed quote", "q.cif", CIF + "1 C 'CA ALA A 0 0 0\n"),
    ("wrong column count", "wc.cif", CIF + "1 C CA ALA A 0 0\n"),
    ("? as coordinate", "qm.cif", CIF + "1 C CA ALA A 0 0 0\n2 C CB ALA A ? 0 0\n"),
    ("1.234(5)", "unc.cif", CIF + "1 C CA ALA A 0 0 0\n2 C CB ALA A 1.234(5) 0 0\n"),
    ("fractional", "fr.cif", "data_a\n_cell_length_a 5\nloop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\nC1 0 0 0\n"),
    ("GRO count too large", "g1.gro", gro(2, PAIR[0])),
    ("GRO count too small", "g2.gro", gro(1, *PAIR)),
    ("GRO cut short", "g3.gro", gro(1, PAIR[0], box="")),
    ("GRO count 2^31", "g4.gro", gro(2**31, PAIR[0])),
    ("GRO count -1", "g5.gro", gro(-1, PAIR[0])),
    ("XYZ count too large", "x1.xyz", "3\n\nC 0 0 0\nC 1.5 0 0\n"),
    ("XYZ D exponents, extra columns", "x2.xyz", "2\n\nC 0.0D0 0 0 1 2\nC 1.5D+00 0 0 1 2\n"),
    ("XYZ count too small", "x3.xyz", "1\n\nC 0 0 0\nC 4 0 0\n"),
    ("PQR fields touch", "p1.pqr", PQR + "ATOM 2 C ALA A 1 -100.125-100.25 0 0.1 1.5\n"),
    ("PQR negative radius", "p2.pqr", PQR + PQR.replace(" 1.500", "-1.000").replace("  0.000   0.000   0.000", "  2.000   0.000   0.000")),
    ("PQR radius 0", "p3.pqr", PQR + PQR.replace(" 1.500", " 0.000").replace("  0.000   0.000   0.000", "  2.000   0.000   0.000")),
    ("PQR radii all 1", "p4.pqr", "".join(f"ATOM {n} C ALA A {n} {2 * n} 0 0 0.1 1.0\n" for n in (1, 2, 3))),
    ("SDF of two molecules", "l1.sdf", 2 * SDF.format(counts=COUNTS)),
    ("SDF count too large", "l2.sdf", SDF.format(counts=COUNTS.replace("2", "3"))),
    ("SDF bonds too many", "l3.sdf", SDF.format(counts=COUNTS.replace("  1 ", "  7 "))),
    ("MOL2 count too large", "l4.mol2", MOL2.format(counts="3 0", type="C.3")),
    ("MOL2 type of AMBER", "l5.mol2", MOL2.format(counts="1 0", type="CT")),
    ("MOL2 type of OPLS", "l9.mol2", MOL2.format(counts="1 0", type="opls_135")),
    ("XYZ of LAMMPS", "x4.xyz", "2\nAtoms. Timestep: 0\n1 0 0 0\n2 3 0 0\n"),
    ("PDBQT charge not a number", "l6.pdbqt", PDBQT.format(charge="0.1") + PDBQT.format(charge="0.x")),
    ("BinaryCIF cut short", "l7.bcif", b"\x83\xa7encoder\xa4test\xa7version\xa50.3.0\xaadataBlocks\x91"),
    ("text named .bcif", "l8.bcif", "This is not a molecule.\n"),
    ("CRYST1 broken", "cry.pdb", "CRYST1  abc\n" + two()),
    ("nanometres in a PDB", "nm.pdb", "".join(atom(str(n), number=f"{n:>4}", x=f"{0.15 * n:.3f}") for n in range(12))),
    ("HTML as .pdb", "h.pdb", "<!DOCTYPE html>\n<html><body>404</body></html>\n"),
    ("terminal escapes", "esc.pdb", atom(name="\x1b[2J", residue="UNL", element=" X")),
]


def said(folder, name, options):
    """Exit code, and what the program prints about the file, as one line."""
    result = subprocess.run([PROGRAM, "surface", name, *options], cwd=folder, capture_output=True, text=True, timeout=60)
    lines = [re.sub(r"^meniscus: (error: )?", "", line) for line in result.stderr.splitlines()]
    return result.returncode, " / ".join(line for line in lines if not line.startswith("surface on"))


print(f"""# Odd files: what the program says

`python3 scripts/odd_files.py PROGRAM` makes each file, reads it by `meniscus surface FILE`, and printed
this page ({datetime.date.today()}).

| file | exit | printed |
|---|---|---|""")
with tempfile.TemporaryDirectory() as folder:
    for what, name, content, *options in FILES:
        if content is not None:
            (pathlib.Path(folder) / name).write_bytes(content.encode() if isinstance(content, str) else content)
        code, text = said(folder, name, options)
        print(f"| {what} | {code} | {text.replace('|', chr(92) + '|').strip()} |")
