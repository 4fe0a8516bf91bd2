# SPDX-License-Identifier: BSD-3-Clause
"""Views of `export mvs` as files: meshes, colours, caps, cameras, states. Arguments PROGRAM MOLECULE. How Mol* draws them:
mvs_check.py."""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy as np

PROGRAM, MOLECULE = sys.argv[1:3]


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], text=True, capture_output=True)


class Views(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        atoms = [line for line in pathlib.Path(MOLECULE).read_text().splitlines() if line.startswith("ATOM")][:120]
        cls.molecule = cls.folder / "a.pdb"
        cls.molecule.write_text("\n".join(atoms) + "\nEND\n")
        cls.centers = np.array([[float(line[n:n + 8]) for n in (30, 38, 46)] for line in atoms])
        cls.models = cls.folder / "models.pdb"
        cls.models.write_text("".join(f"MODEL     {n}\n" + "\n".join(atoms[:40]) + "\nENDMDL\n" for n in (1, 2)) + "END\n")

    def export(self, *arguments, molecule=None, name="view"):
        path = self.folder / f"{name}.mvsx"
        made = run("export", "mvs", molecule or self.molecule, "-o", path, "--force", "--tolerance", "0.05", *arguments)
        self.assertEqual(made.returncode, 0, made.stderr)
        with zipfile.ZipFile(path) as archive:
            self.assertEqual((archive.namelist(), archive.testzip()), (["index.mvsj"], None))
            return json.loads(archive.read("index.mvsj")), made

    @staticmethod
    def nodes(state, kind):
        return [node for node in state["root"]["children"] if node["kind"] == kind]

    def mesh(self, state):
        """Returns the state's only mesh: positions, triangles, the colour of each triangle."""
        (group,) = [node for node in self.nodes(state, "primitives") if node["children"][0]["params"]["kind"] == "mesh"]
        mesh = group["children"][0]["params"]
        positions, triangles = np.reshape(mesh["vertices"], (-1, 3)), np.reshape(mesh["indices"], (-1, 3))
        return positions, triangles, [mesh["group_colors"][str(n)] for n in mesh["triangle_groups"]]

    def test_mesh_is_that_of_the_surface(self):
        state, made = self.export("--color", "element")
        positions, triangles, colors = self.mesh(state)
        self.assertIn(f"{len(triangles):,} triangles within 0.05 Å", made.stderr)
        # Every point lies on some atom or outside of all, and near one.
        distances = np.linalg.norm(positions[:, None] - self.centers, axis=2).min(axis=1)
        self.assertGreater(distances.min(), 1.3)
        self.assertLess(distances.max(), 4)
        # The signed volume equals that of `surface` when triangles are closed and face outwards.
        corners = positions[triangles]
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
        exact = float(re.search(r"^volume +([\d.]+)", run("surface", self.molecule).stdout, re.M)[1])
        self.assertLess(abs(volume / exact - 1), 0.01)
        self.assertEqual(len(set(colors)), 4)  # carbon, nitrogen, oxygen and sulfur
        self.assertTrue(all(len(color) == 7 and color[0] == "#" for color in set(colors)))

    def test_cuts_have_caps(self):
        middle = self.centers[:, 0].mean()
        state, _ = self.export("--clip", f"x>{middle:.3f}", "--cap-color", "#010203")
        positions, triangles, colors = self.mesh(state)
        self.assertGreater(positions[:, 0].min(), middle - 2e-3)
        caps = triangles[[color == "#010203" for color in colors]]
        self.assertGreater(len(caps), 10)
        self.assertLess(abs(positions[caps, 0] - middle).max(), 2e-3)

    def test_camera_shows_as_much(self):
        for projection in ("perspective", "orthographic"):
            with self.subTest(projection):
                saved = self.folder / f"{projection}.json"
                state, _ = self.export("--projection", projection, "--view", "top", "--save-camera", saved)
                camera = json.loads(saved.read_text())
                (node,) = self.nodes(state, "camera")
                target, position = np.array(node["params"]["target"]), np.array(node["params"]["position"])
                np.testing.assert_allclose(target, camera["target"], atol=1e-3)
                reach = np.subtract(camera["position"], camera["target"])
                wanted = camera["height"] if projection == "orthographic" else (
                    2 * math.sin(math.radians(camera["vertical_fov"] / 2)) * np.linalg.norm(reach))
                np.testing.assert_allclose(position - target, wanted * reach / np.linalg.norm(reach), atol=3e-3)
                self.assertLess(abs(np.dot(node["params"]["up"], reach)) / np.linalg.norm(reach), 2e-3)

    def test_shapes_and_opacity(self):
        state, _ = self.export("--opacity", "0.4", "--sticks", "resid 1-2")
        groups = self.nodes(state, "primitives")
        self.assertEqual(sorted(round(group["params"]["opacity"], 3) for group in groups), [0.4, 1])
        tubes = [node["params"] for group in groups for node in group["children"] if node["params"]["kind"] == "tube"]
        self.assertGreater(len(tubes), 10)
        for tube in tubes:
            ends = np.array([tube["start"], tube["end"]])
            self.assertLess(np.linalg.norm(self.centers - ends[:, None], axis=2).min(), 1e-3)  # half of a bond

    def test_copies_stand_where_they_are(self):
        molecule = self.folder / "two.pdb"
        turn = ["REMARK 350 BIOMOLECULE: 1", "REMARK 350 APPLY THE FOLLOWING TO CHAINS: A"]
        for copy, (sign, shift) in enumerate(((1, 0), (-1, 50)), 1):
            for row, (a, b, c, t) in enumerate(((sign, 0, 0, shift), (0, sign, 0, 0), (0, 0, 1, 0)), 1):
                turn.append(f"REMARK 350   BIOMT{row} {copy:3d} {a:9.6f} {b:9.6f} {c:9.6f} {t:14.5f}")
        molecule.write_text("\n".join(turn) + "\n" + self.molecule.read_text())
        state, _ = self.export("--assembly", "1", "--instances", "exact", molecule=molecule)
        (group,) = self.nodes(state, "primitives")
        first, second = (np.reshape(matrix, (4, 4)).T for matrix in group["params"]["instances"])
        np.testing.assert_allclose(first, np.eye(4), atol=1e-9)
        np.testing.assert_allclose(second, [[-1, 0, 0, 50], [0, -1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], atol=1e-6)

    def test_frames_are_states(self):
        state, _ = self.export("--frames", "all", molecule=self.models)
        self.assertEqual(state["kind"], "multiple")
        self.assertEqual([shot["metadata"]["key"] for shot in state["snapshots"]], ["frame_1", "frame_2"])
        self.assertEqual({shot["metadata"]["linger_duration_ms"] for shot in state["snapshots"]}, {40})  # 25 a second

    def test_same_bytes_each_time(self):
        self.export(name="one")
        self.export(name="two")
        self.assertEqual((self.folder / "one.mvsx").read_bytes(), (self.folder / "two.mvsx").read_bytes())

    def test_what_cannot_be_is_refused(self):
        for arguments, said in ((["--cap-hatching", "2", "--clip", "x>1"], "--cap-hatching: MolViewSpec has no hatching"),
                                (["--material", "glass"], "--material: MolViewSpec has no materials"),
                                (["--film-opacity", "--opacity", "0.3"], "--film-opacity: MolViewSpec has no opacity by viewing angle")):
            refused = run("export", "mvs", self.molecule, "-o", self.folder / "no.mvsx", *arguments)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(said, refused.stderr)
        self.assertFalse((self.folder / "no.mvsx").exists())
        self.export(name="there")
        kept = run("export", "mvs", self.molecule, "-o", self.folder / "there.mvsx")
        self.assertEqual(kept.returncode, 6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
