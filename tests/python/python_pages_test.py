# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the Python package for scenes and surfaces, in files, frames and notebooks; MENISCUS_PROGRAM is the program
that makes equal ones."""

import html.parser
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import meniscus
import numpy as np

UBIQUITIN = pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb")
PROGRAM = os.environ.get("MENISCUS_PROGRAM")
STILL = re.compile(r'<img id="still"[^>]*>')


class Frames(html.parser.HTMLParser):
    """The attributes of each iframe of a text, read like in a browser."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "iframe":
            self.found.append(dict(attributes))


def frame_of(text):
    (frame,) = Frames(text).found
    return frame


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        # The molecule has few residues, a name, and a residue name that would be markup.
        lines = UBIQUITIN.read_text().splitlines()
        atoms = [line for line in lines if line.startswith("ATOM")][:60]
        cls.molecule = cls.folder / 'a<b>&".pdb'
        cls.molecule.write_text("\n".join(atoms).replace("MET A", '<b" A') + "\nEND\n")
        cls.scene = meniscus.Scene(cls.molecule, color="residue", size="64x48")
        cls.page = cls.scene.show(frame_height=321)

    def test_of_a_scene_is_what_the_program_makes(self):
        if not PROGRAM:
            self.skipTest("MENISCUS_PROGRAM is not set")
        written = self.folder / "program.html"
        subprocess.run([PROGRAM, "export", "page", str(self.molecule), "-o", str(written), "-q", "--color", "residue",
                        "--size", "64x48", "--device", "cpu"], check=True, capture_output=True)
        theirs = written.read_text()
        self.assertEqual(STILL.sub("", self.page.html), STILL.sub("", theirs))
        self.assertEqual(len(STILL.findall(theirs)), 1)
        self.assertIn('src="data:image/png;base64,', STILL.findall(self.page.html)[0])

    def test_texts_of_files_are_no_markup(self):
        self.assertEqual(self.page.title, 'a&lt;b&gt;&amp;&quot;.pdb')
        self.assertNotIn("a<b>", self.page.html)
        self.assertEqual(frame_of(self.page._repr_html_())["title"], 'a<b>&".pdb')

    def test_frame_holds_all_of_it(self):
        frame = frame_of(self.page._repr_html_())
        self.assertEqual(frame["srcdoc"], self.page.html)
        self.assertEqual((frame["width"], frame["height"]), ("100%", "321"))
        self.assertEqual(frame["sandbox"], "allow-scripts allow-downloads")  # The frame does not have the notebook's origin.
        self.assertEqual(frame_of(self.scene._repr_html_())["height"], "480")
        self.assertIsNone(meniscus.Scene()._repr_html_())

    def test_is_saved_whole(self):
        path = self.folder / "saved.html"
        self.page.save(path)
        self.assertEqual(path.read_text(encoding="utf-8"), self.page.html)
        with self.assertRaisesRegex(meniscus.OutputError, "saved.html: exists already"):
            self.page.save(path)
        path.write_text("other")
        self.page.save(path, replace=True)
        self.assertEqual(path.read_text(encoding="utf-8"), self.page.html)
        with self.assertRaisesRegex(meniscus.OutputError, "cannot be written"):
            self.page.save(self.folder / "no" / "folder.html")
        self.assertEqual([entry.name for entry in self.folder.iterdir() if entry.name.endswith(".part")], [])

    def test_frame_of_a_file(self):
        path = self.folder / "x&y.html"
        frame = frame_of(meniscus.page(self.page, path, height=200))
        self.assertEqual((frame["src"], frame["height"]), (str(path), "200"))
        self.assertNotIn("srcdoc", frame)
        self.assertEqual(path.read_text(encoding="utf-8"), self.page.html)
        frame = frame_of(meniscus.page(self.scene, path, src="../x.html", replace=True))
        self.assertEqual(frame["src"], "../x.html")
        with self.assertRaisesRegex(meniscus.InputError, "path is missing"):
            meniscus.page(self.page, src="x.html")
        with self.assertRaisesRegex(meniscus.InputError, "neither a Page nor a Scene"):
            meniscus.page("1ubq.pdb")

    def test_what_cannot_be_shown_is_refused(self):
        nine = meniscus.Scene(self.molecule, clip=[f"x>{-200 - n}" for n in range(9)], size="32x24")
        with self.assertRaisesRegex(meniscus.UsageError, "^clip: pages show at most 8 planes, and there are 9"):
            nine.show()
        with self.assertRaisesRegex(meniscus.UsageError, "no molecule"):
            meniscus.Scene().show()
        with self.assertRaisesRegex(meniscus.UsageError, "frame_height is 0"):
            self.scene.show(frame_height=0)
        # A notebook then shows the picture.
        self.assertIsNone(nine._repr_html_())
        self.assertTrue(nine._repr_png_().startswith(b"\x89PNG"))

    def test_of_a_surface(self):
        structure = meniscus.read(self.molecule)
        surface = meniscus.surface(structure)
        plain = surface.show(color="teal")
        self.assertEqual(plain.title, f"Surface of {len(structure)} atoms")
        named = surface.show(structure=structure, colors=structure.colors("residue"), frame_height=99)
        self.assertEqual((named.title, named.height), ('a&lt;b&gt;&amp;&quot;.pdb', 99))
        self.assertNotEqual(named.html, surface.show(structure=structure, color="teal").html)
        with self.assertRaisesRegex(meniscus.UsageError, f"structure has {len(structure)} atoms, and the surface is of 1"):
            meniscus.surface([[0, 0, 0]], 1.7).show(structure=structure)
        with self.assertRaisesRegex(meniscus.InputError, "colors has the shape"):
            surface.show(colors=np.zeros((3, 3)))
        with self.assertRaisesRegex(meniscus.UsageError, "^label"):
            surface.show(label="1")


if __name__ == "__main__":
    unittest.main()
