# SPDX-License-Identifier: BSD-3-Clause
"""A look by one word gives the picture of its options through each interface, and the user's options change it."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
import OpenImageIO

PROGRAM = sys.argv.pop(1)
PROTEASE = "/usr/share/pymol/data/tut/1hpv.pdb"
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
SMALL = ["--size", "80x60", "--samples", "1", "--device", "cpu", "--force"]
LIGHTS = ["publication", "cover", "flat", "soft", "classic"]
PLACE = "first (ligand and not glycan)"


def neighbours(place):
    return json.dumps({"representation": "sticks", "selection": f"byres (within 3.6 of ({place})) and noh", "color": "chain-element",
                       "radius": 0.12})


def pocket(place=PLACE):
    return ["--color", "#c4ccd6", "--color", f"{place}=element-cpk", "--color", f"element C and ({place})=#45a878:ligand", "--opacity", "0.3",
            "--film-opacity", "--clip", f"before {place}", "--sticks", place, "--hydrogen-bonds", f"({place}) to polymer", "--object", neighbours(place), "--view", "open", "--zoom-to", place]


WRITTEN_OUT = {
    "ghost": ["--opacity", "0.15", "--film-opacity", "--tube", "polymer"],
    "goodsell": ["--preset", "flat", "--surface", "vdw", "--color", "chain",
                 "--color", "resname ASP GLU and name OD1 OD2 OE1 OE2=#d4735e:acids",
                 "--color", "resname LYS ARG and name NZ NH1 NH2=#5f7fc4:bases",
                 "--color", "nucleic and name P OP1 OP2 OP3 O1P O2P=#dd8452:phosphates", "--shadows", "0.4", "--shadow-softness", "8"],
    "pocket": pocket(),
    "ribbon": ["--hide-surface", "--tube", "polymer"],
}


def pixels_of(path):
    image = OpenImageIO.ImageInput.open(str(path))
    pixels = numpy.asarray(image.read_image("uint8"))
    image.close()
    return pixels


class Looks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for path in (PROTEASE, UBIQUITIN):
            (self.folder / pathlib.Path(path).name).write_bytes(pathlib.Path(path).read_bytes())

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def render(self, *words, molecule="1hpv.pdb"):
        self.run_program("render", molecule, *SMALL, "-o", "a.png", *words)
        return pixels_of(self.folder / "a.png")

    def assert_same(self, one, other):
        self.assertEqual(one.shape, other.shape)
        self.assertTrue((one == other).all(), f"{(one != other).any(axis=2).sum()} pixels differ")

    def test_each_is_its_options(self):
        for word, options in WRITTEN_OUT.items():
            with self.subTest(word):
                self.assert_same(self.render("--preset", word), self.render(*options))

    def test_words_differ(self):
        pictures = [self.render("--preset", word).tobytes() for word in [*LIGHTS, *WRITTEN_OUT]]
        self.assertEqual(len(set(pictures)), len(pictures))
        self.assertNotIn("selects none", self.run_program("render", "1ubq.pdb", *SMALL, "-o", "a.png", "--preset", "goodsell"))

    def test_options_change_single_values(self):
        ghost = WRITTEN_OUT["ghost"]
        for more in (["--opacity", "0.6"], ["--color", "red"], ["--color", "chain A=red"], ["--tube-radius", "0.8"], ["--sticks", "ligand"],
                     ["--shadows", "0"], ["--surface", "sas"]):
            with self.subTest(more):
                self.assert_same(self.render("--preset", "ghost", *more), self.render(*ghost, *more))
                self.assert_same(self.render(*more, "--preset", "ghost"), self.render(*ghost, *more))
        more = ["--surface", "ses", "--color", "bfactor"]
        self.assert_same(self.render("--preset", "goodsell", *more), self.render(*WRITTEN_OUT["goodsell"], *more))

    def test_pocket_follows_the_place(self):
        place = "resid 25 and chain A"
        self.assert_same(self.render("--preset", "pocket", "--zoom-to", place), self.render(*pocket(place)))
        self.assert_same(self.render("--preset", "pocket", "--look-into", place), self.render(*pocket(f"first ({place})")))
        said = self.run_program("render", "1hpv.pdb", *SMALL, "-o", "a.png", "--preset", "pocket")
        self.assertIn("--preset pocket looks at the first of 'ligand and not glycan'; --zoom-to EXPR names other atoms", said)
        self.run_program("render", "1hpv.pdb", *SMALL, "-o", "a.png", "--save-camera", "camera.json")
        aimed = pocket()[:-4]
        self.assert_same(self.render("--preset", "pocket", "--camera", "camera.json"), self.render(*aimed, "--camera", "camera.json"))
        cut = self.render("--preset", "pocket", "--clip", "depth>0.2")
        options = pocket()
        options[options.index("--clip") + 1] = "depth>0.2"
        self.assert_same(cut, self.render(*options))

    def test_a_place_with_quotes(self):
        self.assert_same(self.render("--preset", "pocket", "--zoom-to", 'name "C1"'), self.render(*pocket('name "C1"')))

    def test_scenes_keep_them(self):
        for word in WRITTEN_OUT:
            with self.subTest(word):
                self.run_program("render", "1hpv.pdb", *SMALL, "-o", "b.png", "--preset", word, "--save-scene", "b.json")
                first = pixels_of(self.folder / "b.png")
                for scene in ("b.json", "b.png"):
                    self.run_program("render", "--scene", scene, "--device", "cpu", "--force", "-o", "c.png")
                    self.assert_same(pixels_of(self.folder / "c.png"), first)
                (self.folder / "d.json").write_text(json.dumps(
                    {"meniscus_scene": 1, "molecule": {"file": "1hpv.pdb"}, "look": {"preset": word}, "image": {"size": "80x60", "samples": 1}}))
                self.run_program("render", "--scene", "d.json", "--device", "cpu", "--force", "-o", "d.png")
                self.assert_same(pixels_of(self.folder / "d.png"), first)
                self.run_program("panels", "d.json", "-o", "p.png", "--size", "80x60", "--letters", "none", "--device", "cpu", "--force")
                self.assert_same(pixels_of(self.folder / "p.png"), first)

    def test_films_and_bundles(self):
        self.run_program("render", "1hpv.pdb", "--frames", "0", "--preset", "ghost", *SMALL, "-o", "f_#.png")
        frame = pixels_of(self.folder / "f_0.png")
        self.run_program("render", "1hpv.pdb", "--frames", "0", *WRITTEN_OUT["ghost"], *SMALL, "-o", "g_#.png")
        self.assert_same(frame, pixels_of(self.folder / "g_0.png"))
        self.run_program("farm", "bundle", "b", "--", "render", "1hpv.pdb", "--frames", "0", "--preset", "ghost", *SMALL[:-1])
        self.run_program("work", "b")
        self.assert_same(pixels_of(next((self.folder / "b").rglob("frame*.png"))), frame)

    def test_the_preview_has_them(self):
        words = [*LIGHTS, *WRITTEN_OUT]
        commands = [{"command": "choices"}]
        for word in [*WRITTEN_OUT, "soft"]:
            commands += [{"command": "set", "key": "look.preset", "value": word}, {"command": "state"}, {"command": "render_command", "samples": 1}]
        commands += [{"command": "set", "key": "look.preset", "value": "pretty"}, {"command": "quit"}]
        (self.folder / "c.jsonl").write_text("".join(json.dumps(line) + "\n" for line in commands[:-2]) + '{"command": "quit"}\n')
        done = subprocess.run([PROGRAM, "preview", "1hpv.pdb", "--serve", "--commands", "c.jsonl", "--size", "80x60", "--device", "cpu"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        replies = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
        self.assertEqual(next(one["words"] for one in replies[0]["properties"] if one["key"] == "look.preset"), words)
        for n, word in enumerate(WRITTEN_OUT):
            with self.subTest(word):
                self.assertEqual(replies[3 * n + 2]["values"]["look.preset"], word)
                shown = replies[3 * n + 3]["words"]
                self.run_program(*shown[1:], "-o", "v.png", "--force", "--device", "cpu")
                if word == "pocket":
                    continue  # Its camera is written in other digits.
                camera = shown[shown.index("--camera") + 1]
                self.assert_same(pixels_of(self.folder / "v.png"),
                                 self.render("--preset", word, "--camera", camera, "--background", "white"))
        after = " ".join(replies[-2]["words"])
        self.assertNotIn("--tube", after)
        self.assertIn("--preset soft", after)

    def test_one_page_shows_them_all(self):
        said = self.run_program("looks", "1hpv.pdb", "--samples", "1", "--device", "cpu", "--size", "240x180")
        self.assertNotIn("left out:", said.replace("water left out", ""))
        self.assertEqual(pixels_of(self.folder / "1hpv_looks.png").shape[:2], (180, 240))
        self.assertIn("9 panels", said)
        said = self.run_program("looks", "1ubq.pdb", "--samples", "1", "--device", "cpu", "-o", "page.png", "--background", "white")
        self.assertIn("pocket is left out: no atom is 'ligand and not glycan'", said)
        self.assertIn("8 panels", said)
        self.run_program("looks", "1ubq.pdb", "--samples", "1", "--device", "cpu", "--zoom-to", "resid 48", "-o", "place.png", "--size", "240x180")
        self.assertIn("exists", self.run_program("looks", "1ubq.pdb", "-o", "page.png", code=6))
        self.assertIn("standard input", self.run_program("looks", "-", code=2))

    def test_wrong_words(self):
        said = self.run_program("render", "1ubq.pdb", "-o", "a.png", "--preset", "gost", code=2)
        for word in [*LIGHTS, *WRITTEN_OUT]:
            self.assertIn(word, said)
        said = self.run_program("render", "1ubq.pdb", "-o", "a.png", "--preset", "pocket", code=3)
        self.assertIn("has no 'ligand and not glycan', which --preset pocket shows; --zoom-to EXPR names other atoms", said)
        self.assertFalse((self.folder / "a.png").exists())


if __name__ == "__main__":
    unittest.main()
