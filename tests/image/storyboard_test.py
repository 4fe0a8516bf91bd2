# SPDX-License-Identifier: BSD-3-Clause
"""A film of scenes begins and ends with their pictures; in between numbers are intermediate and the rest is blended."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
SIZE = ["--size", "96x72", "--samples", "4", "--device", "cpu"]


def atoms(shift=0.0, models=1):
    lines = []
    for model in range(models):
        lines.append("MODEL     %4d" % (model + 1))
        for n in range(16):
            place = (2.9 * (n % 4) + shift + 0.3 * model, 2.9 * (n // 4), 1.3 * (n % 3))
            lines.append("ATOM  %5d  CA  ALA %s%4d    %8.3f%8.3f%8.3f  1.00 10.00           C" % (n + 1, "AB"[n // 8], n + 1, *place))
        lines.append("ENDMDL")
    return "\n".join(lines) + "\n"


def pixels_of(path):
    image = OpenImageIO.ImageInput.open(str(path))
    pixels = numpy.asarray(image.read_image("uint8")).astype(int)
    image.close()
    return pixels


def linear(pixels):
    value = pixels / 255.0
    return numpy.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


class Storyboards(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a.pdb").write_text(atoms())
        (self.folder / "run.pdb").write_text(atoms(models=3))

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def scene(self, name, *words, molecule="a.pdb"):
        """Writes a scene and returns its picture."""
        output = name + "_##.png" if "--frames" in words else name + ".png"
        self.run_program("render", molecule, "-o", output, "--save-scene", name + ".json", "--background", "white", *SIZE, *words)
        return pixels_of(self.folder / output) if "##" not in output else None

    def film(self, *words, name="f_###.png"):
        self.run_program("film", *words, "-o", name, "--device", "cpu")
        return [pixels_of(path) for path in sorted(self.folder.glob("f_*.png"))]

    def test_numbers_go_over_and_the_ends_are_the_scenes(self):
        look = ["--camera", json.dumps({"position": [4.35, 4.35, 40], "target": [4.35, 4.35, 0], "up": [0, 1, 0], "projection": "orthographic",
                                        "height": 20})]
        (self.folder / "camera.json").write_text(look[1])
        look[1] = "camera.json"
        first = self.scene("one", *look, "--probe", "1", "--ambient", "0.2", "--clip", "z<6")
        last = self.scene("two", *look, "--probe", "2", "--ambient", "0.6", "--clip", "z<2")
        film = self.film("one.json", "two.png", "--hold", "0.08,0.04", "--transition", "0.12", "--ease", "even")
        self.assertEqual(len(film), 2 + 3 + 1)
        for n, whole in ((0, first), (1, first), (5, last)):
            self.assertTrue((film[n] == whole).all(), n)
        for n, probe, ambient, cut in ((2, 1.25, 0.3, 5), (3, 1.5, 0.4, 4), (4, 1.75, 0.5, 3)):
            between = self.scene(f"between{n}", *look, "--probe", f"{probe}", "--ambient", f"{ambient}", "--clip", f"z<{cut}")
            self.assertLessEqual(abs(film[n] - between).max(), 1, n)

    def test_what_is_no_number_dissolves(self):
        first = self.scene("one", "--color", "chain", "--projection", "orthographic", "--ambient", "1")
        last = self.scene("two", "--color", "red", "--sticks", "all", "--projection", "orthographic", "--ambient", "1")
        film = self.film("one.json", "two.json", "--hold", "0", "--transition", "0.12", "--ease", "even")
        self.assertEqual(len(film), 5)
        def off(n, share):
            return abs(linear(film[n]) - (1 - share) * linear(first) - share * linear(last)).max()
        self.assertLess(off(2, 0.5), 0.03)
        for n in (1, 3):
            self.assertLess(off(n, n / 4), 0.1 * off(n, 1 - n / 4), n)
        self.assertGreater(abs(linear(first) - linear(last)).max(), 0.3)

    def test_a_cut_comes_from_outside_and_the_camera_goes_along(self):
        self.scene("one", "--view", "z", "--color", "grey")
        self.scene("two", "--view", "x", "--clip", "depth>0.5", "--cap-color", "red", "--color", "grey")
        film = self.film("one.json", "two.json", "--hold", "0", "--transition", "0.4")
        red = [int(((picture[..., 0] > 120) & (picture[..., 1] < 90)).sum()) for picture in film]
        self.assertEqual(red[:3], [0, 0, 0])
        self.assertGreater(red[-1], 50)
        self.assertGreater(min(red[6:]), 0)
        steps = [abs(a - b).mean() for a, b in zip(film, film[1:])]
        self.assertLess(max(steps), 6 * numpy.median(steps), steps)

    def test_legend_and_title_appear_without_a_jump(self):
        self.scene("one", "--color", "chain", "--title", "Before")
        last = self.scene("two", "--color", "chain", "--title", "After", "--legend")
        film = self.film("one.json", "two.json", "--hold", "0", "--transition", "0.4")
        self.assertEqual({picture.shape for picture in film}, {last.shape})
        steps = [abs(a - b).mean() for a, b in zip(film, film[1:])]
        self.assertLess(max(steps), 4 * numpy.median(steps), steps)
        strip = numpy.s_[:, -20:]
        self.assertEqual(int((film[0][strip] < 200).sum()), 0)
        self.assertGreater(int((last[strip] < 200).sum()), 20)

    def test_a_storyboard_file_has_scenes_and_times(self):
        self.scene("one", "--color", "red")
        self.scene("two", "--color", "blue")
        scenes = [json.loads((self.folder / f"{name}.json").read_text()) for name in ("one", "two")]
        story = {"meniscus_storyboard": 1, "hold": [0.08, 0.12], "transition": [0.04], "scenes": scenes}
        (self.folder / "story.json").write_text(json.dumps(story))
        whole = self.film("story.json")
        self.assertEqual(len(whole), 2 + 1 + 3)
        apart = self.film("one.json", "two.json", "--hold", "0.08,0.12", "--transition", "0.04", "--force")
        self.assertTrue(all((a == b).all() for a, b in zip(whole, apart)))
        self.run_program("render", "--scene", "story.json#2", "-o", "second.png", "--device", "cpu")
        self.assertTrue((pixels_of(self.folder / "second.png") == whole[-1]).all())
        for name in self.folder.glob("f_*.png"):
            name.unlink()
        self.assertEqual(len(self.film("story.json", "--hold", "0.04", "--transition", "0")), 2)
        self.assertIn("has 2 scenes", self.run_program("render", "--scene", "story.json#3", "-o", "third.png", code=3))
        (self.folder / "story.json").write_text(json.dumps({**story, "scenes": 3}))
        self.assertIn("storyboard", self.run_program("film", "story.json", "-o", "g_##.png", code=3))

    def test_a_run_of_one_frame_is_held(self):
        self.scene("one", "--color", "red")
        self.scene("run", "--frames", "1", "--color", "red", molecule="run.pdb")
        film = self.film("one.json", "run.json", "--hold", "0.12", "--transition", "0")
        self.assertEqual(len(film), 6)
        self.assertTrue((film[3] == film[5]).all())

    def test_titles_are_not_read_over_each_other(self):
        for name, title in (("one", "HHHH"), ("two", "oooo"), ("three", "oooo")):
            self.scene(name, "--title", title, "--color", "white", "--preset", "flat", "--outer-lines", "0", "--inner-lines", "0")
        self.scene("none", "--title", " ", "--color", "white", "--preset", "flat", "--outer-lines", "0", "--inner-lines", "0")
        bare, first, second = (pixels_of(self.folder / f"{name}.png") for name in ("none", "one", "two"))
        strip = numpy.s_[:12]
        changed = [abs(picture - bare).max(axis=2)[strip] for picture in (first, second)]
        own = [(changed[0] > 60) & (changed[1] == 0), (changed[1] > 60) & (changed[0] == 0)]
        for scenes, words in ((["one.json", "two.json"], own), (["two.json", "three.json"], [own[1]])):
            film = self.film(*scenes, "--hold", "0", "--transition", "0.4", "--force")
            shown = [[abs(picture - bare).max(axis=2)[strip][pixels].mean() > 8 for pixels in words] for picture in film]
            if len(words) == 2:
                self.assertNotIn([True, True], shown)
                self.assertEqual((shown[0], shown[-1]), ([True, False], [False, True]))
            else:
                self.assertNotIn([False], shown, "a title of both stays")

    def test_a_legend_is_not_over_the_molecule(self):
        look = ["--preset", "flat", "--color", "chain", "--projection", "orthographic"]
        self.scene("one", *look)
        last = self.scene("two", *look, "--legend")
        film = self.film("one.json", "two.json", "--hold", "0", "--transition", "0.4", "--ease", "even")
        legend = numpy.nonzero((last[:, -24:] < 200).any(axis=2).any(axis=0))[0]
        self.assertGreater(len(legend), 3)
        for picture in film[:len(film) // 2]:
            self.assertEqual(int((picture[:, -6:] < 250).sum()), 0, "no legend yet")

    def test_a_scene_with_a_run_shows_its_frames(self):
        self.scene("run", "--frames", "all", "--color", "chain", molecule="run.pdb")
        last = self.scene("two", "--color", "red")
        film = self.film("run.json", "two.json", "--hold", "1", "--transition", "0.08")
        self.assertEqual(len(film), 3 + 2 + 25)
        for n in range(3):
            self.assertTrue((film[n] == pixels_of(self.folder / f"run_{n:02}.png")).all(), n)
        self.assertTrue((film[-1] == last).all())

    def test_two_runs_of_the_same_frames_dissolve_from_last_to_first(self):
        self.scene("run", "--frames", "all", "--color", "chain", molecule="run.pdb")
        film = self.film("run.json", "run.json", "--transition", "0.04", "--ease", "even")
        self.assertEqual(len(film), 3 + 1 + 3)
        mean = 0.5 * linear(film[2]) + 0.5 * linear(film[4])
        self.assertLess(abs(linear(film[3]) - mean).max(), 0.03)
        self.assertGreater(abs(linear(film[2]) - linear(film[4])).max(), 0.1)

    def test_films_have_the_pictures_that_are_told(self):
        self.scene("one", "--color", "chain")
        self.scene("two", "--color", "red")
        told = self.run_program("film", "one.png", "two.png", "-o", "f.mp4", "--fps", "10", "--hold", "0.5", "--transition", "1", "--device", "cpu")
        self.assertIn("20 pictures, 2.0 s: f.mp4", told)
        probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,r_frame_rate", "-of", "json", "f.mp4"],
                               cwd=self.folder, capture_output=True, text=True, check=True)
        stream = json.loads(probe.stdout)["streams"][0]
        self.assertEqual((stream["nb_read_frames"], stream["r_frame_rate"]), ("20", "10/1"))

    def test_what_makes_no_film_is_said(self):
        self.scene("one")
        for words, message in ((["one.json"], "a film needs two scenes or more"),
                               (["one.json", "one.json", "--hold", "1,2,3"], "there are 2 scenes"),
                               (["one.json", "one.json", "--transition", "soon"], "give seconds from 0 to 3600"),
                               (["one.json", "gone.json"], "gone.json")):
            with self.subTest(words):
                done = subprocess.run([PROGRAM, "film", *words, "-o", "f.mp4"], cwd=self.folder, capture_output=True, text=True)
                self.assertNotEqual(done.returncode, 0)
                self.assertRegex(done.stderr, re.escape(message))
                self.assertFalse((self.folder / "f.mp4").exists())
        done = subprocess.run([PROGRAM, "film", "one.json", "one.json", "-o", "f.png"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("f_#####.png", done.stderr)


if __name__ == "__main__":
    unittest.main()
