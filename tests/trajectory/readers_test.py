# SPDX-License-Identifier: BSD-3-Clause
"""Files that MDAnalysis and MDTraj write give the same frames here, in any order: readers_test.py FRAME_DUMP PDB."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import h5py
import numpy as np

warnings.filterwarnings("ignore")
import MDAnalysis  # noqa: E402
import MDAnalysis.coordinates.LAMMPS  # noqa: E402
import MDAnalysis.coordinates.TRJ  # noqa: E402
import mdtraj.formats  # noqa: E402
from parmed.amber import AmberAsciiRestart, AmberMdcrd  # noqa: E402
from MDAnalysis.lib.mdamath import triclinic_box  # noqa: E402

FRAMES = 6
ORDER = [4, 0, 5, 2, 2, 1, 3]
dump_program = structure_file = None


def dump(path, numbers=(), atoms=None):
    """Returns the frames of a file as frame_dump prints them: a dictionary of number, text, positions, cell, time each.
    atoms: their number in a frame, for formats that lack it."""
    arguments = [dump_program, str(path), *(["--atoms", str(atoms)] if atoms else []), *map(str, numbers)]
    text = subprocess.run(arguments, check=True, capture_output=True, text=True).stdout
    frames = []
    for part in text.split("frame ")[1:]:
        lines = part.splitlines()
        words = lines[0].split()
        cell = None
        if lines[1].startswith("cell"):
            cell = np.array(lines.pop(1).split()[1:], float).reshape(3, 3)
        positions = np.array([line.split() for line in lines[1:]], float)
        time = float(words[words.index("time") + 1]) if "time" in words else None
        frames.append({"number": int(words[0]), "text": part, "positions": positions, "cell": cell, "time": time})
    return frames


class Readers(unittest.TestCase):
    """Each test writes one file with one program and compares it with what both programs read from it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.universe = MDAnalysis.Universe(structure_file)
        cls.atoms = cls.universe.atoms
        start = cls.atoms.positions - cls.atoms.center_of_geometry()
        rng = np.random.default_rng(20)
        cls.motion = [start * (1 + 0.02 * n) + [7 * n, -3, 40] + rng.normal(0, 0.2, start.shape) for n in range(FRAMES)]
        cls.boxes = [np.array([60 + n, 65, 70 - n, 90 - 2 * n, 80, 100 + n], np.float32) for n in range(FRAMES)]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def path(self, name):
        return pathlib.Path(self.folder.name) / name

    def write(self, name, universe=None, **options):
        """Lets MDAnalysis write the motion."""
        path = self.path(name)
        atoms = (universe or self.universe).atoms
        step = atoms.universe.trajectory.ts
        with MDAnalysis.Writer(str(path), n_atoms=len(atoms), **options) as writer:
            for n in range(FRAMES):
                atoms.positions = self.motion[n][: len(atoms)]
                step.dimensions, step.time, step.frame, step.data["step"] = self.boxes[n], 2.5 * n, n, 10 * n
                writer.write(atoms)
        return path

    def compare(self, frames, positions, boxes=None, times=None):
        """Checks equality but for the rounding of single precision, in which the other programs compute."""
        self.assertEqual(len(frames), len(positions))
        for n, frame in enumerate(frames):
            self.assertEqual(frame["positions"].shape, positions[n].shape)
            rounding = 2 * np.spacing(np.float32(np.abs(positions[n]).max()))
            self.assertLessEqual(np.abs(frame["positions"] - positions[n]).max(), rounding, n)
            if boxes is not None:
                np.testing.assert_allclose(triclinic_box(*frame["cell"]), boxes[n], rtol=0, atol=1e-4)
            if times is not None:
                self.assertAlmostEqual(frame["time"], times[n], places=4)

    def check(self, path, boxes=True, times=True, **options):
        """Compares with MDAnalysis, and reading in any order with the order of the file."""
        frames = dump(path)
        other = MDAnalysis.coordinates.core.reader(str(path), **options)
        read = [(step.positions.copy(), np.copy(step.dimensions), step.time) for step in other]
        self.compare(frames, [each[0] for each in read], [each[1] for each in read] if boxes else None,
                     [each[2] for each in read] if times else None)
        for frame in dump(path, ORDER):
            self.assertEqual(frame["text"].splitlines(), frames[frame["number"]]["text"].splitlines())
        return frames

    def test_xtc(self):
        for digits in range(1, 7):
            path = self.write(f"{digits}.xtc", precision=digits)
            frames = self.check(path)
            with mdtraj.formats.XTCTrajectoryFile(str(path)) as file:
                positions, times, _, _ = file.read()
            self.compare(frames, 10 * positions.astype(float), times=times)
            rounding = 0.6 * 10 ** (1 - digits) + 1e-4
            self.assertLess(np.abs(frames[3]["positions"] - self.motion[3]).max(), rounding)

    def test_xtc_of_few_and_of_far_atoms(self):
        for count in (1, 9, 10):
            few = MDAnalysis.Universe.empty(count, trajectory=True)
            self.check(self.write(f"few{count}.xtc", few))
        far = MDAnalysis.Universe.empty(len(self.atoms), trajectory=True)
        path = self.path("far.xtc")
        rng = np.random.default_rng(5)
        with MDAnalysis.Writer(str(path), n_atoms=len(far.atoms), precision=4) as writer:
            for scale in (0.01, 1, 100, 10000, 90000):
                far.atoms.positions = rng.uniform(-scale, scale, self.motion[0].shape)
                far.trajectory.ts.dimensions = self.boxes[0]
                writer.write(far.atoms)
        other = [step.positions.copy() for step in MDAnalysis.coordinates.core.reader(str(path))]
        if np.abs(other[-1]).max() > 90000:
            self.skipTest("this MDAnalysis breaks the positions of far atoms when it writes them")  # 2.9.0, in Debian 13
        self.compare(dump(path), other)

    def test_xtc_of_small_differences_of_every_size(self):
        rng = np.random.default_rng(7)
        walker = MDAnalysis.Universe.empty(200, trajectory=True)
        path = self.path("walk.xtc")
        with MDAnalysis.Writer(str(path), n_atoms=200, precision=6) as writer:
            for size in range(9, 73):  # The table of sizes grows by the cube root of 2.
                step = 1e-5 * 2 ** (size / 3) / 2
                walker.atoms.positions = np.cumsum(rng.uniform(-step, step, (200, 3)), axis=0)
                writer.write(walker.atoms)
        other = MDAnalysis.coordinates.core.reader(str(path))
        self.compare(dump(path), [step.positions.copy() for step in other])

    def test_trr(self):
        frames = self.check(self.write("a.trr"))
        with mdtraj.formats.TRRTrajectoryFile(str(self.path("a.trr"))) as file:
            positions, times, _, _, _ = file.read()
        self.compare(frames, 10 * positions.astype(float), times=times)

    def test_dcd(self):
        frames = self.check(self.write("a.dcd", dt=2.5))
        with mdtraj.formats.DCDTrajectoryFile(str(self.path("a.dcd"))) as file:
            positions, lengths, angles = file.read()
        self.compare(frames, positions, np.hstack([lengths, angles]))

    def test_amber_netcdf(self):
        frames = self.check(self.write("a.ncdf"))
        with mdtraj.formats.NetCDFTrajectoryFile(str(self.path("a.ncdf"))) as file:
            positions, times, lengths, angles = file.read()
        self.compare(frames, positions, np.hstack([lengths, angles]), times)

    def test_what_mdtraj_writes(self):
        positions = np.array(self.motion, np.float32)
        lengths, angles = np.array(self.boxes)[:, :3], np.array(self.boxes)[:, 3:]
        times = np.arange(FRAMES, dtype=np.float32)
        vectors = np.array([mdtraj.utils.lengths_and_angles_to_box_vectors(*box[:3] / 10, *box[3:]) for box in self.boxes])
        vectors = vectors.astype(np.float32)
        with mdtraj.formats.DCDTrajectoryFile(str(self.path("m.dcd")), "w") as file:
            file.write(positions, lengths, angles)
        with mdtraj.formats.NetCDFTrajectoryFile(str(self.path("m.nc")), "w") as file:
            file.write(positions, times, lengths, angles)
        with mdtraj.formats.XTCTrajectoryFile(str(self.path("m.xtc")), "w") as file:
            file.write(positions / 10, times, np.arange(FRAMES), vectors)
        with mdtraj.formats.TRRTrajectoryFile(str(self.path("m.trr")), "w") as file:
            file.write(positions / 10, times, np.arange(FRAMES), vectors)
        self.check(self.path("m.dcd"), times=False)
        for name in ("m.nc", "m.xtc", "m.trr"):
            self.check(self.path(name))

    def test_hdf5_of_mdtraj(self):
        positions = np.array(self.motion, np.float32) / 10
        lengths, angles = np.array(self.boxes)[:, :3] / 10, np.array(self.boxes)[:, 3:]
        times = np.arange(FRAMES, dtype=np.float32)
        path = self.path("m.h5")
        with mdtraj.formats.HDF5TrajectoryFile(str(path), "w") as file:
            file.write(positions, time=times, cell_lengths=lengths.astype(np.float32), cell_angles=angles.astype(np.float32))
        self.compare(dump(path), 10 * positions.astype(float), np.hstack([10 * lengths, angles]), times)
        with h5py.File(path, "r+") as file:
            file["coordinates"].attrs["units"] = "feet"
        said = subprocess.run([dump_program, str(path)], capture_output=True, text=True).stderr
        self.assertIn("names 'feet' as a unit where MDTraj writes nanometers", said)

    def test_mdcrd(self):
        """MDTraj and ParmEd write files with a box and without, also with numbers of atoms whose lines are all full."""
        for count, box in ((len(self.atoms), True), (len(self.atoms), False), (10, False), (20, True), (1, False)):
            positions = np.array(self.motion, np.float32)[:, :count]
            lengths = np.array(self.boxes)[:, :3]
            path = self.path(f"m{count}{box}.mdcrd")
            with mdtraj.formats.MDCRDTrajectoryFile(str(path), mode="w", force_overwrite=True) as file:
                file.write(positions, lengths if box else None)
            frames = dump(path, atoms=count)
            self.assertLess(np.abs(frames[3]["positions"] - self.motion[3][:count]).max(), 6e-4)  # The format has three decimals.
            with mdtraj.formats.MDCRDTrajectoryFile(str(path), n_atoms=count, has_box=box) as file:
                self.compare(frames, file.read()[0])
            for frame, edges in zip(frames, lengths):
                self.assertEqual(frame["cell"] is not None, box)
                if box:
                    np.testing.assert_allclose(frame["cell"], np.diag(edges), rtol=0, atol=6e-4)
            for frame in dump(path, ORDER, atoms=count):
                self.assertEqual(frame["text"].splitlines(), frames[frame["number"]]["text"].splitlines())
            by_parmed = AmberMdcrd(str(self.path(f"p{count}{box}.mdcrd")), count, box, "w")
            for place in range(FRAMES):
                by_parmed.add_coordinates(positions[place].ravel())
                if box:
                    by_parmed.add_box(lengths[place])
            by_parmed.close()
            again = dump(self.path(f"p{count}{box}.mdcrd"), atoms=count)
            # MDAnalysis reads boxes of eight columns, and not those with blanks between that MDTraj writes.
            other = MDAnalysis.coordinates.TRJ.TRJReader(str(self.path(f"p{count}{box}.mdcrd")), n_atoms=count)
            self.compare(again, [step.positions.copy() for step in other])
            self.assertEqual([frame["text"] for frame in again], [frame["text"] for frame in frames])

    def one_frame(self, path):
        (frame,) = dump(path)
        other = MDAnalysis.coordinates.core.reader(str(path))
        self.compare([frame], [other.ts.positions.copy()])
        return frame

    def test_amber_restart(self):
        """ParmEd writes files with and without velocities and a box, and leap wrote crambin of bio3d."""
        for count in (len(self.atoms), 10, 1):
            for velocities in (False, True):
                for box in (False, True):
                    path = self.path(f"r{count}{velocities}{box}.inpcrd")
                    file = AmberAsciiRestart(str(path), "w", natom=count, title="of a test", time=7.25)
                    file.coordinates = self.motion[2][:count]
                    if velocities:
                        file.velocities = self.motion[3][:count]
                    if box:
                        file.box = self.boxes[1]
                    file.close()
                    frame = self.one_frame(path)
                    np.testing.assert_allclose(frame["positions"], self.motion[2][:count], rtol=0, atol=1e-7)
                    self.assertEqual(frame["cell"] is not None, box)
                    if box:
                        np.testing.assert_allclose(triclinic_box(*frame["cell"]), self.boxes[1], rtol=0, atol=1e-4)
                    self.assertEqual(frame["time"], 7.25)
        self.one_frame("/usr/lib/R/site-library/bio3d/examples/crambin.inpcrd")

    def test_namd_coordinates(self):
        self.atoms.positions = self.motion[4]
        self.atoms.write(str(self.path("a.coor")))
        self.one_frame(self.path("a.coor"))

    def test_charmm_coordinates(self):
        self.atoms.positions = self.motion[5]
        for extended in (False, True):
            path = self.path(f"{extended}.crd")
            self.atoms.write(str(path), extended=extended)
            self.assertEqual("EXT" in path.read_text()[:200], extended)
            self.one_frame(path)

    def lammps_dump(self, name, columns, low=(0, 0, 0), vectors=None, head=lambda n: ""):
        """Writes a dump like LAMMPS, atoms in another order in each frame: the positions in it, with `low` as the
        corner of the box whose vectors (rows, a along x) are given."""
        inside = np.array(self.motion) + 200
        vectors = np.diag([400.0, 410.0, 420.0]) if vectors is None else np.array(vectors, float)
        (xy, xz, yz), edges = (vectors[1][0], vectors[2][0], vectors[2][1]), np.diag(vectors)
        below = np.array([min(0, xy, xz, xy + xz), min(0, yz), 0])
        above = np.array([max(0, xy, xz, xy + xz), max(0, yz), 0])
        inclined = any((xy, xz, yz))
        positions, text = inside + np.array(low), []
        rng = np.random.default_rng(3)
        for n in range(FRAMES):
            text.append(f"{head(n)}ITEM: TIMESTEP\n{100 * n}\nITEM: NUMBER OF ATOMS\n{len(self.atoms)}\nITEM: BOX BOUNDS "
                        f"{'xy xz yz ' if inclined else ''}pp pp pp\n")
            for axis, tilt in enumerate((xy, xz, yz)):
                text.append(f"{low[axis] + below[axis]:.16e} {low[axis] + edges[axis] + above[axis]:.16e}"
                            + (f" {tilt:.16e}" if inclined else "") + "\n")
            text.append(f"ITEM: ATOMS {columns}\n")
            scaled = inside[n] @ np.linalg.inv(vectors)
            for k in rng.permutation(len(self.atoms)):
                number = {"id": k + 1, "type": 1, "element": "C", "ix": 0}
                number.update({axis + kind: f"{positions[n][k][at]:.9g}" for kind in ("", "u")
                               for at, axis in enumerate("xyz")})
                number.update({axis + kind: f"{scaled[k][at]:.12g}" for kind in ("s", "su") for at, axis in enumerate("xyz")})
                text.append(" ".join(str(number[word]) for word in columns.split()) + "\n")
        path = self.path(name)
        path.write_text("".join(text))
        return path, positions, vectors

    def test_lammps_dump(self):
        """Every kind of columns and boxes agrees with the written numbers, MDAnalysis and MDTraj."""
        inclined = [[400, 0, 0], [60, 410, 0], [-70, 50, 420]]
        for columns in ("id type x y z", "xu element yu zu id", "id xs ys zs ix", "type xsu ysu zsu id", "id x y z xu yu zu"):
            for low in ((0, 0, 0), (-30, 7, 11)):
                for vectors in (None, inclined):
                    path, positions, box = self.lammps_dump("a.lammpstrj", columns, low, vectors)
                    frames = dump(path)
                    for frame, expected in zip(frames, positions):
                        np.testing.assert_allclose(frame["positions"], expected, rtol=0, atol=1e-5)
                        np.testing.assert_allclose(frame["cell"], box, rtol=0, atol=1e-9)
                        self.assertIsNone(frame["time"])
                        self.assertIn(f"step {100 * frame['number']}", frame["text"])
                    for frame in dump(path, ORDER):
                        self.assertEqual(frame["text"].splitlines(), frames[frame["number"]]["text"].splitlines())
                    if columns.startswith("id type x"):
                        other = MDAnalysis.coordinates.LAMMPS.DumpReader(str(path))
                        # MDAnalysis counts from the corner of the box.
                        self.compare(frames, [step.positions + np.array(low, np.float32) for step in other])
                        with mdtraj.formats.LAMMPSTrajectoryFile(str(path)) as file:
                            self.compare(frames, file.read()[0])

    def test_lammps_names_its_units(self):
        def head(n):
            return ("ITEM: UNITS\nnano\n" if n == 0 else "") + f"ITEM: TIME\n{0.5 * n}\n"

        path, positions, box = self.lammps_dump("n.dump", "id x y z", head=head)
        for frame, expected in zip(dump(path, reversed(range(FRAMES))), positions[::-1]):
            np.testing.assert_allclose(frame["positions"], 10 * expected, rtol=0, atol=1e-4)
            np.testing.assert_allclose(frame["cell"], 10 * box)
            self.assertAlmostEqual(frame["time"], 500.0 * frame["number"])

    def test_h5md(self):
        for unit in ("nm", "Angstrom"):
            path = self.write(f"{unit}.h5md", positions=True, velocities=False, forces=False, convert_units=False,
                              lengthunit=unit, timeunit="ps", n_frames=FRAMES)
            self.check(path)

    def test_h5md_has_no_other_file_read(self):
        """Links, raw data and views that lead to other files lead nowhere."""
        whole = self.write("whole.h5md", positions=True, velocities=False, forces=False, convert_units=False,
                           n_frames=FRAMES)
        with h5py.File(whole) as file:
            shape, dtype = file["particles/trajectory/position/value"].shape, "f4"
        self.path("raw").write_bytes(b"\0" * (4 * int(np.prod(shape))))

        def particles(file):
            file["particles"] = h5py.ExternalLink(str(whole), "/particles")

        def value(file):
            file["particles/trajectory/position/value"] = h5py.ExternalLink(
                str(whole), "/particles/trajectory/position/value")

        def raw(file):
            file.create_dataset("particles/trajectory/position/value", shape, dtype,
                                external=[(str(self.path("raw")), 0, h5py.h5f.UNLIMITED)])

        def view(file):
            layout = h5py.VirtualLayout(shape, dtype)
            layout[:] = h5py.VirtualSource(str(whole), "particles/trajectory/position/value", shape)
            file.create_virtual_dataset("particles/trajectory/position/value", layout)

        for write in (particles, value, raw, view):
            path = self.path(f"{write.__name__}.h5md")
            with h5py.File(path, "w") as file:
                file.attrs["fill"] = np.zeros(4 * int(np.prod(shape)) // 1000, "u1")  # The file gets a plausible size.
                write(file)
            self.assertNotEqual(subprocess.run([dump_program, str(path)], capture_output=True).returncode, 0, path)

    def test_damaged_h5md_is_one_line(self):
        """The library must not report damage at the end of the process."""
        kept = pathlib.Path(__file__).parent.parent / "fuzz" / "crashes" / "h5md"
        for path in sorted(kept.iterdir()):
            said = subprocess.run([dump_program, str(path)], capture_output=True, text=True).stderr
            self.assertLessEqual(said.count("\n"), 1, f"{path}: {said}")

    def test_models_of_text(self):
        self.check(self.write("a.pdb", multiframe=True), boxes=False, times=False)
        self.check(self.write("a.xyz"), boxes=False, times=False)

    def test_gro(self):
        parts = []
        for n in range(FRAMES):
            self.atoms.positions = self.motion[n]
            self.universe.trajectory.ts.dimensions = self.boxes[n]
            self.atoms.write(str(self.path("one.gro")))
            parts.append(self.path("one.gro").read_text())
        self.path("a.gro").write_text("".join(parts))
        frames = dump(self.path("a.gro"))
        positions, boxes = [], []
        for part in parts:
            self.path("one.gro").write_text(part)
            step = MDAnalysis.coordinates.core.reader(str(self.path("one.gro"))).ts
            positions.append(step.positions.copy())
            boxes.append(step.dimensions)
        self.compare(frames, positions)
        for frame, box in zip(frames, boxes):  # GRO rounds its box to 1e-4 Å.
            np.testing.assert_allclose(triclinic_box(*frame["cell"]), box, rtol=0, atol=1e-3)
        for frame in dump(self.path("a.gro"), ORDER):
            self.assertEqual(frame["text"].splitlines(), frames[frame["number"]]["text"].splitlines())


if __name__ == "__main__":
    dump_program, structure_file = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1])
