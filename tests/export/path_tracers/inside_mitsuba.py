# SPDX-License-Identifier: BSD-3-Clause
"""inside_mitsuba.py PROGRAM: scenes in Mitsuba 3 itself, ray by ray beside the ray caster, and rendered; the last line
says "cases N failures M". Run by an interpreter that has mitsuba; MENISCUS_KEEP_PICTURES=FOLDER keeps pictures."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
PROGRAM = sys.argv[1]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
WIDTH, HEIGHT = 160, 120


def atom_line(number, x, y, z, chain="A"):
    return f"HETATM{number:5d}  C   UNK {chain}{number:4d}    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00           C\n"


class InMitsuba(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def scene(self, molecule, *options, name="scene"):
        folder = self.folder / name
        self.run_program("export", "mitsuba", molecule, "-o", folder, "--size", f"{WIDTH}x{HEIGHT}", "-q", *options)
        return folder / "surface.xml"

    def ours(self, molecule, *options):
        """Returns linear colours, coverage, normals and positions of the ray caster at the middle of each pixel."""
        path = self.folder / "ours.exr"
        self.run_program("render", molecule, "-o", path, "--size", f"{WIDTH}x{HEIGHT}", "-q", "--aovs", "--samples", 1,
                         "--preset", "classic", "--ambient", 1, "--specular", 0, "--force", *options)
        bitmap = mi.Bitmap(str(path))
        values = np.array(bitmap, dtype=float)
        channel = {field.name: values[:, :, n] for n, field in enumerate(bitmap.struct_())}
        normals = np.stack([channel[f"N.{axis}"] for axis in "xyz"], 2)
        positions = np.stack([channel[f"P.{axis}"] for axis in "xyz"], 2)
        return np.stack([channel[c] for c in "RGB"], 2), channel["A"] > 0.5, normals, positions

    def theirs(self, path):
        """Returns these arrays of a scene in Mitsuba, with positions relative to its origin."""
        scene = mi.load_file(str(path))
        sensor = scene.sensors()[0]
        colors, normals, positions = (np.zeros((HEIGHT, WIDTH, 3)) for _ in range(3))
        covered = np.zeros((HEIGHT, WIDTH), bool)
        for row in range(HEIGHT):
            for column in range(WIDTH):
                ray, _ = sensor.sample_ray(0, 0.5, [(column + 0.5) / WIDTH, (row + 0.5) / HEIGHT], [0.5, 0.5])
                hit = scene.ray_intersect(ray)
                if not hit.is_valid() or hit.emitter(scene) is not None:
                    continue
                covered[row, column] = True
                colors[row, column] = np.array(hit.bsdf().eval_diffuse_reflectance(hit))
                normals[row, column] = np.array(hit.sh_frame.n)
                positions[row, column] = np.array(hit.p)
        return colors, covered, normals, positions

    def keep(self, name, image):
        if "MENISCUS_KEEP_PICTURES" in os.environ:
            path = pathlib.Path(os.environ["MENISCUS_KEEP_PICTURES"]) / f"{name}.png"
            mi.util.write_bitmap(str(path), mi.TensorXf(image.astype(np.float32)), write_async=False)

    def compare(self, name, molecule, *options, tolerance=0.005, covered_limit=0.0005, color_limit=0.002):
        """Compares both pictures, with a mesh within the tolerance (Å; None: half a pixel) and the same options."""
        mesh = [] if tolerance is None else ["--tolerance", tolerance]
        ours = self.ours(molecule, *options)
        path = self.scene(molecule, *options, *mesh, name=name)
        theirs = self.theirs(path)
        self.keep(f"{name}-ours", ours[0])
        self.keep(f"{name}-mitsuba", theirs[0])
        both = ours[1] & theirs[1]
        self.assertGreater(both.mean(), 0.05)
        covered = (ours[1] != theirs[1]).mean()
        colors = (np.abs(ours[0] - theirs[0]).max(2)[both] > 0.02).mean()
        turned = np.degrees(np.arccos(np.clip((ours[2] * theirs[2]).sum(2)[both], -1, 1)))
        origin = np.median((ours[3] - theirs[3])[both], 0)
        off = np.linalg.norm(ours[3] - theirs[3] - origin, axis=2)[both]
        print(f"{name}: {covered:.3%} of pixels covered by one alone, {colors:.3%} of another colour; normals off by "
              f"{np.median(turned):.2f} (99 %: {np.percentile(turned, 99):.2f}) degrees, points by {np.median(off):.4f} "
              f"(99 %: {np.percentile(off, 99):.4f}) Å")
        self.assertLess(covered, covered_limit)
        self.assertLess(colors, color_limit)
        if tolerance is not None:
            self.assertLess(np.percentile(turned, 99), 3)
            self.assertLess(np.percentile(off, 99), 10 * tolerance)  # The view grazes the surface in places.
        return path

    def test_surface_by_perspective(self):
        self.compare("surface", UBIQUITIN, "--color", "element")

    def test_mesh_of_half_a_pixel(self):
        self.compare("half_a_pixel", UBIQUITIN, "--color", "element", tolerance=None, covered_limit=0.005, color_limit=0.015)

    def test_surface_by_orthographic_camera_in_a_tall_picture(self):
        self.compare("orthographic", UBIQUITIN, "--projection", "orthographic", "--view", "y", "--color", "residue")

    def test_sticks_spheres_and_a_tube(self):
        path = self.compare("beside", UBIQUITIN, "--hide-surface", "--sticks", "resname LYS", "--spheres", "resid 10-20",
                            "--tube", "chain A", "--color", "element", color_limit=0.01)
        self.assertIn('type="cylinder"', path.read_text())

    def test_untouched_atoms_as_spheres_with_a_mesh(self):
        path = self.folder / "apart.pdb"
        path.write_text("".join(atom_line(n, 6.5 * n, 0, 0) for n in range(4)) + atom_line(9, -1.5, 1, 1))
        scene = self.compare("apart", path)
        self.assertEqual(scene.read_text().count('type="sphere"'), 3)

    def test_copies(self):
        path = self.folder / "copies.pdb"
        rows = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)), ((0, -1, 0, 12), (1, 0, 0, 5), (0, 0, 1, 7))
        path.write_text("REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n" + "".join(
            f"REMARK 350   BIOMT{r} {n:3d} {m[0]:9.6f} {m[1]:9.6f} {m[2]:9.6f} {m[3]:14.5f}\n"
            for n, motion in enumerate(rows, 1) for r, m in enumerate(motion, 1))
            + atom_line(1, 1, 2, 3) + atom_line(2, 2.5, 2, 3) + atom_line(3, 4.5, 3.5, 3) + atom_line(4, 1, 2, 9))
        scene = self.compare("copies", path, "--assembly", 1, "--instances", "exact")
        self.assertEqual(scene.read_text().count('type="instance"'), 2)
        alpha = np.array(mi.render(mi.load_file(str(scene), spp="16")))[:, :, 3]
        np.testing.assert_allclose(alpha.mean(), self.ours(path, "--assembly", 1, "--instances", "exact")[1].mean(), atol=0.005)

    def test_cut_with_caps(self):
        self.compare("cut", UBIQUITIN, "--clip", "depth>0.5", "--cap-color", "orange", "--color", "element")

        self.compare("kinds", UBIQUITIN, "--clip", "depth>0.5", "--color", "kind")

    def test_colours_of_a_map(self):
        path = self.folder / "map.dx"
        grid = np.add.outer(np.add.outer(np.arange(12.0), np.arange(12.0)), np.zeros(12))
        path.write_text("object 1 class gridpositions counts 12 12 12\norigin 5 5 -5\ndelta 5 0 0\ndelta 0 5 0\n"
                        "delta 0 0 5\nobject 2 class gridconnections counts 12 12 12\nobject 3 class array type double "
                        f"rank 0 items {grid.size} data follows\n" + "\n".join(map(str, grid.ravel())) + "\n")
        self.compare("map", UBIQUITIN, "--color-map-file", path, "--color-range", "3:18")

    def test_pictures_of_all_materials(self):
        for material in "matte", "plastic", "glass", "wax":
            for options in [], ["--opacity", "0.5"]:
                path = self.scene(UBIQUITIN, "--material", material, "--sticks", "resid 1-5", *options,
                                  name=f"{material}{len(options)}")
                picture = np.array(mi.render(mi.load_file(str(path), spp="16", width="80", height="60")))
                self.keep(f"{material}{len(options)}", picture[:, :, :3] + 1 - picture[:, :, 3:])
                self.assertTrue(np.isfinite(picture).all())
                alpha = picture[:, :, 3]
                solid = alpha > 0.4
                self.assertGreater(solid.mean(), 0.2)
                self.assertGreater((alpha < 0.01).mean(), 0.2)
                light = picture[:, :, :3][solid].mean()
                self.assertTrue(0.05 < light < 0.9, light)


if __name__ == "__main__":
    result = unittest.main(argv=sys.argv[:1] + sys.argv[2:], exit=False).result
    print(f"cases {result.testsRun} failures {len(result.failures) + len(result.errors)}")
    sys.exit(not result.wasSuccessful())
