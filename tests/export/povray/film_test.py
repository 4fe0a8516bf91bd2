# SPDX-License-Identifier: BSD-3-Clause
"""A storyboard is the same film from POV-Ray as from the ray caster, picture by picture: PROGRAM POVRAY."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

PROGRAM, POVRAY = sys.argv[1:3]
MOLECULES = pathlib.Path("/usr/share/freesasa/test-data")
UBIQUITIN, ENSEMBLE = "1ubq.pdb", "1d3z.pdb"  # the second has ten models, which are frames
#: Largest difference of a channel, of 255, between equal pixels.
LIMIT = 8
# Light, which POV-Ray computes in another way, is left out, and a ray goes through each pixel.
LOOK = ["--size", "240x180", "--preset", "classic", "--ambient", "1", "--specular", "0", "--samples", "1", "--background", "white", "-q",
        "--device", "cpu", "--select", "resi 1-30"]
FILM = ["--fps", "4", "--ease", "even", "--device", "cpu"]


def pixels(path):
    """Returns 8-bit sRGB, (rows, columns, 3)."""
    image = OpenImageIO.ImageInput.open(str(path))
    values = np.asarray(image.read_image("uint8")).astype(int)[:, :, :3]
    image.close()
    return values


def share_of_differing(one, other):
    return float((np.abs(one - other).max(axis=2) > LIMIT).mean())


class PovrayFilm(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        for molecule in UBIQUITIN, ENSEMBLE:
            shutil.copy(MOLECULES / molecule, self.folder)

    def run_program(self, *command, cwd=None, code=0):
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, cwd=cwd or self.folder)
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr[-2000:])
        return done

    def scene(self, name, *options, molecule=UBIQUITIN):
        output = f"{name}_#.png" if "--frames" in options else f"{name}.png"
        self.run_program(PROGRAM, "render", molecule, "-o", output, "--save-scene", f"{name}.json", *LOOK, *options)
        return f"{name}.json"

    def written(self, *words):
        """Exports a film and returns the scene's folder and the messages."""
        done = self.run_program(PROGRAM, "film", *words, *FILM, "--to", "povray", "-o", "story")
        self.assertEqual(done.stdout, "cd 'story' && povray surface.ini && povray surface_story.ini\n")
        return self.folder / "story", done.stderr

    def films(self, *words):
        """Returns the pictures of the ray caster and of POV-Ray."""
        self.run_program(PROGRAM, "film", *words, *FILM, "-o", "ours_##.png")
        folder, _ = self.written(*words)
        for ini in ("surface.ini", "surface_story.ini"):
            self.run_program(POVRAY, f"{ini}[flat]", "Antialias=Off", cwd=folder)
        films = [[pixels(path) for path in sorted(place.glob(names))]
                 for place, names in ((self.folder, "ours_*.png"), (folder, "surface_flat_story_*.png"))]
        self.assertEqual(len(films[0]), len(films[1]))
        return films

    def check(self, name, ours, theirs):
        for n, (one, other) in enumerate(zip(ours, theirs)):
            share = share_of_differing(one, other)
            aside = share_of_differing(one, np.roll(other, 1, axis=1))
            print(f"{name}, picture {n}: {100 * share:.3f} % differ; one pixel aside {100 * aside:.1f} %")
            self.assertLess(share, 0.002)
            self.assertGreater(aside, max(0.003, 10 * share))

    def test_every_picture_is_that_of_the_film(self):
        words = [self.scene("one", "--color", "element"),
                 self.scene("two", "--color", "residue", "--view", "x", "--clip", "depth>0.5", "--probe", "2", "--sticks", "resi 5-20",
                            "--background", "#406080"),
                 self.scene("three", "--hide-surface", "--tube", "all", "--projection", "orthographic", "--object",
                            '{"selection": "resi 1-10", "color": "#30a030", "opacity": 0.5}')]
        ours, theirs = self.films(*words, "--hold", "0.5", "--transition", "0.75")
        self.assertEqual(len(ours), 3 * 2 + 2 * 3)
        self.check("dissolving", ours, theirs)
        self.assertGreater(share_of_differing(theirs[2], theirs[3]), 0.1)
        self.assertGreater(share_of_differing(theirs[7], theirs[8]), 0.1)

    def test_a_run_shows_its_frames(self):
        words = [self.scene("run", "--frames", "1-3", "--color", "residue", "--opacity", "resi 10-30=0.6", molecule=ENSEMBLE),
                 self.scene("still", "--color", "element", "--opacity", "resi 5-10=0.5")]
        ours, theirs = self.films(*words, "--hold", "0.25", "--transition", "0.25")
        self.assertEqual(len(ours), 3 + 1 + 1)
        self.check("run", ours, theirs)

    def test_maps(self):
        """Each scene has a map of its own, and each frame of a run a potential of its own."""
        for name, values in ("one", "1 2 3 4 5 6 7 8"), ("two", "8 6 4 2 1 3 5 7"):
            (self.folder / f"{name}.cube").write_text(f"a map\nof two steps\n0 -20 -20 -20\n2 80 0 0\n2 0 80 0\n2 0 0 80\n{values}\n")
        words = [self.scene(f"map{name}", "--color-map-file", f"{name}.cube", "--color-range", "0:9") for name in ("one", "two")]
        words.append(self.scene("run", "--frames", "1-2", "--color", "lipophilicity", molecule=ENSEMBLE))
        ours, theirs = self.films(*words, "--hold", "0.25", "--transition", "0.5,0")
        self.assertEqual(len(ours), 1 + 2 + 1 + 2)
        self.check("maps", ours, theirs)
        self.assertGreater(share_of_differing(theirs[0], theirs[3]), 0.1)

    def test_only_what_differs_is_rendered(self):
        """Where nothing dissolves, a picture of the film is one of POV-Ray's, and a held scene is rendered once."""
        words = [self.scene("one", "--color", "element"), self.scene("two", "--color", "element", "--view", "x", "--probe", "1.8")]
        folder, _ = self.written(*words, "--hold", "2", "--transition", "1")
        self.assertEqual(len(list(folder.glob("surface_geometry_*.inc"))), 1 + 4 + 1)
        story = (folder / "surface_story.pov").read_text()
        lists = {name: values for name, values in re.findall(r"Meniscus_(First|Second|Share) = array\[20\] {([^}]*)}", story)}
        self.assertEqual(lists["First"].replace("\n", "").split(","), ["1"] * 8 + ["2", "3", "4", "5"] + ["6"] * 8)
        self.assertEqual(set(lists["Second"].replace("\n", "").split(",")), {"0"})

    def test_what_does_not_go_over_is_said(self):
        first, other = self.scene("one", "--title", "One", "--legend", "--color", "chain"), self.scene("two", "--ambient", "0.4", "--shadows", "0.5")
        _, said = self.written(first, other, "--transition", "0")
        self.assertIn("titles, labels and legends are left out", said)
        self.assertIn("these differences between the scenes have no effect: --ambient\n", said)
        (self.folder / "story").rename(self.folder / "kept")
        _, said = self.written(other, other, "--transition", "0")
        self.assertNotIn("note:", said)
        done = self.run_program(PROGRAM, "film", other, other, *FILM, "--to", "povray", "-o", "story.mp4", code=2)
        self.assertIn("--to povray writes a folder", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
