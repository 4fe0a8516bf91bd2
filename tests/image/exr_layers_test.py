# SPDX-License-Identifier: BSD-3-Clause
"""EXR files for compositors: layers and header, Cryptomatte decoded by its specification, motion, colour spaces."""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
PLAIN = ["--device", "cpu", "-q", "--force", "--preset", "flat", "--silhouettes", "0", "--depth-cue", "0", "--ambient-occlusion", "0"]
PERSPECTIVE = {"position": [4, 3, 40], "target": [3, 0, 0], "up": [0.2, 1, 0], "projection": "perspective", "vertical_fov": 30}
ORTHOGRAPHIC = {"position": [4, 3, 40], "target": [3, 0, 0], "up": [0.2, 1, 0], "projection": "orthographic", "height": 20}


def atom(serial, name, residue, chain, number, place, element="C"):
    return "ATOM  %5d %-4s %3s %s%4d    %8.3f%8.3f%8.3f  1.00 10.00          %2s\n" % (serial, " " + name, residue, chain, number, *place, element)


#: Two chains that overlap in the picture, and two atoms of one name.
PAIR = (atom(1, "CA", "LYS", "A", 15, (0, 0, 0)) + atom(2, "CB", "LYS", "A", 15, (1.5, 0, 0)) + atom(3, "CA", "GLY", "A", 16, (3, 0.5, 0.5))
        + atom(4, "CA", "ALA", "B", 1, (7, 1, -3)) + atom(5, "CA", "ALA", "B", 1, (8.5, 1, -3)))


def murmur(name):
    """Returns MurmurHash3_x86_32 by its author's description: by 4 bytes, then the rest."""
    key, mask = name.encode(), 0xffffffff
    def mixed(k):
        k = k * 0xcc9e2d51 & mask
        return (k << 15 | k >> 17) * 0x1b873593 & mask
    h = 0
    for n in range(0, len(key) // 4 * 4, 4):
        h ^= mixed(int.from_bytes(key[n:n + 4], "little"))
        h = ((h << 13 | h >> 19) & mask) * 5 + 0xe6546b64 & mask
    h ^= mixed(int.from_bytes(key[len(key) // 4 * 4:], "little")) ^ len(key)
    h = (h ^ h >> 16) * 0x85ebca6b & mask
    h = (h ^ h >> 13) * 0xc2b2ae35 & mask
    return h ^ h >> 16


def float_id(name):
    bits = murmur(name)
    if bits >> 23 & 255 in (0, 255):
        bits ^= 1 << 23
    return bits


class Exr:
    def __init__(self, path):
        image = OpenImageIO.ImageInput.open(str(path))
        self.spec = image.spec()
        self.names = list(self.spec.channelnames)
        self.pixels = numpy.asarray(image.read_image("float"), numpy.float32)
        image.close()

    def __getitem__(self, names):
        return self.pixels[:, :, [self.names.index(name) for name in names.split()]].squeeze()

    def text(self, name):
        return self.spec.get_string_attribute(name)

    def matrix(self, name):
        return numpy.array(self.spec.getattribute(name), float).reshape(4, 4)

    def mattes(self, layer):
        """Returns the manifest, and a function from a name to its coverage of each pixel."""
        key = f"cryptomatte/{float_id(layer):08x}"[:-1]
        assert self.text(key + "/name") == layer, key
        assert (self.text(key + "/hash"), self.text(key + "/conversion")) == ("MurmurHash3_32", "uint32_to_float32")
        ranks = [self.names.index(f"{layer}{level:02}.{pair}") for level in range(3) for pair in "RGBA"]
        ids = numpy.ascontiguousarray(self.pixels[:, :, ranks[::2]]).view(numpy.uint32)
        shares = self.pixels[:, :, ranks[1::2]]
        return json.loads(self.text(key + "/manifest")), lambda name: numpy.where(ids == float_id(name), shares, 0).sum(2), shares


class ExrLayers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "pair.pdb").write_text(PAIR)

    def run_program(self, *words, code=0, **environment):
        done = subprocess.run([PROGRAM, "render", *words], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def render(self, *words, camera=PERSPECTIVE, molecule="pair.pdb", size="80x60", **environment):
        self.run_program(molecule, *PLAIN, "--camera", json.dumps(camera), "--size", size, *words, "-o", "a.exr", **environment)
        return Exr(self.folder / "a.exr")

    def projected(self, image, points):
        """Projects points by the header, into pixels from the upper left corner."""
        shape = points.shape[:-1]
        rows = numpy.c_[points.reshape(-1, 3), numpy.ones(len(points.reshape(-1, 3)))] @ image.matrix("worldToNDC")
        return (rows[:, :2] / rows[:, 3:] * [image.spec.width, image.spec.height]).reshape(*shape, 2)

    def test_the_header_leads_from_points_to_their_pixels(self):
        for camera in (PERSPECTIVE, ORTHOGRAPHIC):
            for more in ([], ["--legend", "--color", "chain", "--title", "Pair"]):
                image = self.render("--aovs", "--samples", "1", *more, camera=camera, size="160x120")
                hit = image["atom"] >= 0
                self.assertGreater(hit.sum(), 200)
                places = self.projected(image, image["P.x P.y P.z"][hit])
                rows, columns = numpy.nonzero(hit)
                self.assertLess(abs(places - numpy.c_[columns + 0.5, rows + 0.5]).max(), 2e-3, (camera["projection"], more))
                points = numpy.c_[image["P.x P.y P.z"][hit], numpy.ones(hit.sum())]
                flip = [1, 1, -1]  # The standard's z runs along the view, the layers' z towards the viewer.
                self.assertLess(abs((points @ image.matrix("worldToCamera"))[:, :3] * flip - image["Pview.x Pview.y Pview.z"][hit]).max(), 2e-4)
                turned = image["N.x N.y N.z"][hit] @ image.matrix("worldToCamera")[:3, :3] * flip
                self.assertLess(abs(turned - image["Nview.x Nview.y Nview.z"][hit]).max(), 1e-5)
                self.assertTrue((image["Pview.z"][hit] < 0).all())
                self.assertTrue((image["Nview.x Nview.y Nview.z Pview.x Pview.y Pview.z"][~hit] == 0).all())

    def test_no_date_is_made_up(self):
        for name in ("a.exr", "a.tif"):
            self.run_program("pair.pdb", "--size", "8x6", "-q", "--force", "-o", name)
            self.assertEqual(Exr(self.folder / name).text("DateTime"), "", name)
            self.run_program("pair.pdb", "--size", "8x6", "-q", "--force", "-o", name, SOURCE_DATE_EPOCH="1700000000")
            self.assertEqual(Exr(self.folder / name).text("DateTime"), "2023:11:14 22:13:20", name)

    def test_mattes_are_what_the_rays_met(self):
        image = self.render("--cryptomatte", "--samples", "16")
        alpha = image["A"]
        self.assertGreater(((alpha > 0) & (alpha < 1)).sum(), 50)
        for layer, names in (("CryptoChain", {"A", "B"}), ("CryptoResidue", {"A/LYS 15", "A/GLY 16", "B/ALA 1"}),
                             ("CryptoAtom", {"A/LYS 15/CA", "A/LYS 15/CB", "A/GLY 16/CA", "B/ALA 1/CA", "B/ALA 1/CA#4"})):
            manifest, matte, shares = image.mattes(layer)
            self.assertEqual(set(manifest), names)
            self.assertEqual(manifest, {name: f"{float_id(name):08x}" for name in names})
            self.assertTrue((numpy.diff(shares, axis=2) <= 0).all(), "ranks fall")
            self.assertLess(abs(shares.sum(2) - alpha).max(), 1e-6, layer)  # The sum is never more than 1.
            self.assertLess(abs(sum(matte(name) for name in names) - alpha).max(), 1e-6, layer)

    def test_the_matte_of_a_chain_is_the_picture_of_that_chain(self):
        """The chains are far apart, so each has the surface that it has alone, and A is before B."""
        (self.folder / "apart.pdb").write_text("".join(PAIR.splitlines(True)[:3]) + atom(4, "CA", "ALA", "B", 1, (4, 0, -12))
                                               + atom(5, "CB", "ALA", "B", 1, (6, 1, -12)))
        image = self.render("--cryptomatte", "--samples", "16", molecule="apart.pdb")
        _, matte, _ = image.mattes("CryptoChain")
        in_front = self.render("--select", "chain A", "--samples", "16", molecule="apart.pdb")["A"]
        self.assertGreater(in_front.sum(), 100)
        self.assertLess(abs(matte("A") - in_front).max(), 1e-6)
        behind = self.render("--select", "chain B", "--samples", "16", molecule="apart.pdb")["A"]
        self.assertGreater(numpy.minimum(behind, in_front).sum(), 5)
        self.assertTrue((matte("B") <= behind + 1e-6).all())
        self.assertTrue((matte("B") >= behind - in_front - 1e-6).all())

    def test_mattes_of_what_stands_beside_the_surface_and_of_cuts(self):
        image = self.render("--cryptomatte", "--samples", "4", "--select", "chain A", "--sticks", "chain B", "--clip", "z>0", "--legend", "--color", "chain")
        manifest, matte, shares = image.mattes("CryptoChain")
        self.assertEqual(set(manifest), {"A", "B"})
        self.assertGreater(matte("A").sum(), 100)
        self.assertGreater(matte("B").sum(), 3)
        self.assertTrue((shares.sum(2) <= image["A"] + 1e-6).all())

    def test_mattes_of_the_copies_of_an_assembly(self):
        matrices = "".join("REMARK 350   BIOMT%d%4d%10.6f%10.6f%10.6f%15.5f\n" % (row + 1, copy + 1, *(1.0 if row == n else 0.0 for n in range(3)),
                                                                                  (0.0, 30.0 * copy, 0.0)[row]) for copy in range(2) for row in range(3))
        (self.folder / "copies.pdb").write_text("REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A, B\n" + matrices + PAIR)
        image = self.render("--cryptomatte", "--samples", "4", "--assembly", "1", molecule="copies.pdb", camera={**PERSPECTIVE, "position": [4, 15, 90], "target": [4, 15, 0]})
        manifest, matte, _ = image.mattes("CryptoChain")
        self.assertEqual(set(manifest), {"A", "B", "A-2", "B-2"})
        self.assertTrue(all(matte(name).sum() > 5 for name in manifest))

    def test_names_cannot_break_the_manifest(self):
        (self.folder / "odd.pdb").write_text(PAIR.replace(" CA  LYS A", ' C"\\ LYS A').replace("GLY A", "GLY  "))
        manifest, matte, _ = self.render("--cryptomatte", molecule="odd.pdb").mattes("CryptoAtom")
        self.assertIn('A/LYS 15/C"\\', manifest)
        self.assertIn("-/GLY 16/CA", manifest)
        self.assertTrue(all(matte(name).sum() > 0 for name in ('A/LYS 15/C"\\', "-/GLY 16/CA")))

    def test_colours_are_the_same_with_mattes(self):
        for more in ([], ["--preset", "publication"]):
            plain, with_mattes = (self.render("--samples", "5", *more, *words) for words in ([], ["--cryptomatte", "--aovs"]))
            self.assertLess(abs(plain["R G B A"] - with_mattes["R G B A"]).max(), 1e-6)

    def test_acescg_is_another_basis_of_the_same_light(self):
        plain, aces = (self.render("--color", "chain", "--background", background, "--color-space", space)
                       for background in ("transparent",) for space in ("rec709", "acescg"))
        self.assertEqual(plain.text("colorInteropID"), "lin_rec709_scene")
        self.assertEqual(aces.text("colorInteropID"), "lin_ap1_scene")

        def to_xyz(image):
            """Converts by the header's chromaticities, in the white that Bradford's adaptation leads to D50."""
            x = numpy.array(image.spec.getattribute("chromaticities"), float).reshape(4, 2)
            xyz = numpy.array([[a / b, 1, (1 - a - b) / b] for a, b in x]).T
            basis = xyz[:, :3] * numpy.linalg.solve(xyz[:, :3], xyz[:, 3])
            bradford = numpy.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
            gain = bradford @ [0.9642, 1, 0.8249] / (bradford @ xyz[:, 3])
            return image["R G B"] @ (numpy.linalg.inv(bradford) @ numpy.diag(gain) @ bradford @ basis).T
        self.assertLess(abs(to_xyz(plain) - to_xyz(aces)).max(), 1e-5)
        self.assertGreater(abs(plain["R G B"] - aces["R G B"]).max(), 0.05)
        self.assertTrue((plain["A"] == aces["A"]).all())
        for name in ("a.png", "a.jpg", "a.tif"):
            self.assertIn("--color-space acescg needs an .exr", self.run_program("pair.pdb", "--color-space", "acescg", "-o", name, code=2))
        self.assertIn("--cryptomatte needs an .exr", self.run_program("pair.pdb", "--cryptomatte", "-o", "a.png", code=2))

    def run_of(self, places, *words, camera=ORTHOGRAPHIC):
        """Returns the frames of one atom at these places."""
        models = "".join(f"MODEL     {n + 1:4}\n{atom(1, 'CA', 'ALA', 'A', 1, place)}ENDMDL\n" for n, place in enumerate(places))
        (self.folder / "run.pdb").write_text(models)
        if camera:
            words += ("--camera", json.dumps(camera))
        self.run_program("run.pdb", "--frames", "all", *PLAIN, "--size", "160x120", "--samples", "1", "--aovs", *words, "-o", "f_#.exr")
        return [Exr(self.folder / f"f_{n}.exr") for n in range(len(places))]

    def test_motion_leads_to_the_same_point_of_the_next_picture(self):
        straight = {**ORTHOGRAPHIC, "position": [3, 0, 40], "up": [0, 1, 0]}
        # At 6 pixels an ångström the atom moves 12 to the right and 6 upwards, then 6 to the left.
        first, second, last = self.run_of([(0, 0, 0), (2, 1, 0), (1, 1, 5)], camera=straight)
        hit = first["atom"] >= 0
        self.assertGreater(hit.sum(), 200)
        self.assertLess(abs(first["forward.u forward.v"][hit] - [12, 6]).max(), 1e-3)
        self.assertTrue((first["forward.u forward.v"][~hit] == 0).all())
        self.assertTrue((first["forward.a"] == hit).all())
        moved = numpy.roll(hit, (-6, 12), (0, 1))
        self.assertTrue((moved == (second["atom"] >= 0)).all())
        self.assertLess(abs(second["forward.u forward.v"][second["atom"] >= 0] - [-6, 0]).max(), 1e-3)
        self.assertTrue((last["forward.u forward.v"] == 0).all(), "nothing is behind the last frame")

    def test_motion_of_a_camera_and_in_perspective(self):
        for words, camera, places in ((["--turntable", "1"], None, [(0, 0, 0)] * 8 + [(0, 0, 0.1)]),
                                      ([], PERSPECTIVE, [(0, 0, 0), (2, 1, 8), (5, 2, -3)])):
            frames = self.run_of(places, *words, camera=camera)
            for n, (now, then) in enumerate(zip(frames, frames[1:])):
                hit = now["atom"] >= 0
                points = now["P.x P.y P.z"][hit] + (numpy.array(places[n + 1]) - places[n])
                change = (self.projected(then, points) - self.projected(now, now["P.x P.y P.z"][hit])) * [1, -1]
                self.assertLess(abs(change - now["forward.u forward.v"][hit]).max(), 0.01, n)
                self.assertGreater(abs(now["forward.u forward.v"][hit]).max(), 0.5, n)

    def test_motion_of_a_surface_that_turns(self):
        """A rigid motion's normal part is the solid's; the next picture shows the surface in the predicted place."""
        angle = 0.02
        turn = numpy.array([[numpy.cos(angle), -numpy.sin(angle), 0], [numpy.sin(angle), numpy.cos(angle), 0], [0, 0, 1]])
        places = numpy.array([(0, 0, 0), (2.5, 0, 0), (1.2, 2.4, 0.5), (3.5, 2.0, 1)])
        models = "".join(f"MODEL     {n + 1:4}\n" + "".join(atom(m + 1, "CA", "ALA", "A", m + 1, place) for m, place in enumerate(at)) + "ENDMDL\n"
                         for n, at in enumerate((places, places @ turn.T)))
        (self.folder / "turn.pdb").write_text(models)
        camera = {**ORTHOGRAPHIC, "position": [1.5, 1, 40], "target": [1.5, 1, 0], "up": [0, 1, 0], "height": 12}
        self.run_program("turn.pdb", "--frames", "all", *PLAIN, "--size", "160x120", "--samples", "1", "--aovs", "--camera", json.dumps(camera), "-o", "t_#.exr")
        now = Exr(self.folder / "t_0.exr")
        hit = now["atom"] >= 0
        points = now["P.x P.y P.z"][hit]
        normals = now["N.x N.y N.z"][hit][:, :2]
        solid = ((points @ turn.T) - points)[:, :2] * 10  # pixels an ångström
        along = (now["forward.u forward.v"][hit] * normals).sum(1) - (solid * normals).sum(1)
        self.assertEqual(set(now["kind"][hit]), {0.0, 1.0, 2.0})
        self.assertLess(abs(along).max(), 0.02)  # Motion reaches 1.2; atoms were rounded to 0.001 Å.
        self.assertGreater(abs(solid).max(), 0.4)

    def test_single_pictures_have_no_motion(self):
        self.assertNotIn("forward.u", self.render("--aovs").names)

    def test_the_standard_library_reads_the_same(self):
        # OpenEXR of PyPI has File from 3.3 on; Debian's has none.
        OpenEXR = importlib.import_module("OpenEXR") if importlib.util.find_spec("OpenEXR") else None
        if not hasattr(OpenEXR, "File"):
            self.skipTest("OpenEXR of PyPI is not there")
        image = self.render("--aovs", "--cryptomatte", "--color-space", "acescg")
        read = OpenEXR.File(str(self.folder / "a.exr"), separate_channels=True)
        self.assertEqual(set(read.channels()), set(image.names))
        for name in image.names:
            self.assertEqual(read.channels()[name].pixels.tobytes(), numpy.ascontiguousarray(image[name]).tobytes(), name)
        header = read.header()
        self.assertTrue(numpy.allclose(header["worldToCamera"], image.matrix("worldToCamera")))
        self.assertNotIn("capDate", header)
        self.assertEqual(tuple(numpy.float32(header["chromaticities"])), tuple(numpy.float32(image.spec.getattribute("chromaticities"))))


if __name__ == "__main__":
    unittest.main(verbosity=2)
