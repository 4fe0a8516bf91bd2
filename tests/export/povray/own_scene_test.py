# SPDX-License-Identifier: BSD-3-Clause
"""A surface in a user's own scene: its place, earlier declarations and the effect of CSG: PROGRAM POVRAY."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

PROGRAM, POVRAY = sys.argv[1:3]
WIDTH, HEIGHT = 120, 60  # pixels of a picture of 12 by 6 Å
RADIUS, APART, SHIFT = 1.7, 1.5, 3.0  # Two balls along z make a surface of more than one primitive.
HEAD = """#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0, 0, 1> }
camera { orthographic location <0, 0, 50> look_at 0 right -12*x up 6*y }
light_source { <0, 0, 1000> rgb 1 parallel point_at 0 }
"""
INCLUDE = '#include "surface.inc"\n'
MESSAGES = re.compile(r"Warning: said: (.*\S)")


class OwnScene(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)
        self.balls = os.path.join(self.holder.name, "balls.xyzr")
        with open(self.balls, "w", encoding="ascii") as file:
            file.write(f"0 0 {APART} {RADIUS}\n0 0 {-APART} {RADIUS}\n")

    def export(self, *options, molecule=None):
        folder = os.path.join(self.holder.name, f"scene{len(os.listdir(self.holder.name))}")
        words = [PROGRAM, "export", "povray", molecule or self.balls, "-o", folder, "-q", "--device", "cpu", "--color", "#ff0000", *options]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def render(self, folder, text):
        """Returns the picture of a scene of ours that looks along -z, (rows, columns, 3), and its messages."""
        with open(os.path.join(folder, "own.pov"), "w", encoding="ascii") as file:
            file.write(HEAD + text)
        done = subprocess.run([POVRAY, "+Iown.pov", "+Oown.png", f"+W{WIDTH}", f"+H{HEIGHT}", "-D", "-A", "File_Gamma=1.0"],
                              capture_output=True, text=True, check=False, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        image = OpenImageIO.ImageInput.open(os.path.join(folder, "own.png"))
        return np.asarray(image.read_image(OpenImageIO.FLOAT))[:, :, :3], MESSAGES.findall(done.stderr)

    def picture(self, placed, *options):
        return self.render(self.export(*options), INCLUDE + placed)[0]

    def lying(self, placed, before=""):
        """Returns the picture of the two balls next to each other, at z = 0."""
        return self.render(self.export(), before + INCLUDE + placed.replace("SURFACE", "object { Meniscus_Surface rotate 90*y }"))[0]

    def disc(self, x, radius):
        """Returns the pixels whose middle lies within a radius of a place, in Å."""
        across, up = (np.arange(WIDTH) + 0.5) / 10 - 6, (np.arange(HEIGHT) + 0.5) / 10 - 3
        return np.hypot(*np.meshgrid(across - x, up)) < radius

    def test_it_stands_where_it_is_put_and_nowhere_else(self):
        nothing = self.picture("")
        np.testing.assert_allclose(nothing, np.broadcast_to([0.0, 0.0, 1.0], nothing.shape), atol=1e-3)
        found = self.picture(f"object {{ Meniscus_Surface translate {SHIFT}*x }}\n"
                             f"object {{ Meniscus_Surface scale 0.5 translate -{SHIFT}*x }}")
        solid = self.disc(SHIFT, RADIUS) | self.disc(-SHIFT, RADIUS / 2)
        self.assertLess((solid != (found[:, :, 2] < 0.5)).mean(), 0.01)
        self.assertGreater(found[self.disc(SHIFT, 0.5)][:, 0].min(), 0.3)

    def test_what_is_beside_the_surface_is_placed_apart(self):
        folder = self.export("--spheres", "index 0", "--object", '{"selection": "index 1", "color": "#00ff00"}')
        for name, place, channel in (("Shapes", SHIFT, 0), ("Object_1", -SHIFT, 1)):
            found, _ = self.render(folder, INCLUDE + f"object {{ Meniscus_{name} translate {place}*x }}")
            self.assertLess(((found[:, :, 2] < 0.5) & ~self.disc(place, RADIUS + 0.1)).sum(), 1, name)
            self.assertGreater(found[self.disc(place, 0.5)][:, channel].min(), 0.3, name)

    def test_settings_are_what_was_declared_before_and_no_other_name_is_left(self):
        """The test finds the names in all files that an export may have; the scene's own names keep their values."""
        ensemble = "/usr/share/freesasa/test-data/1d3z.pdb"
        few = ["--select", "resi 1-5", "--clip", "depth>0.3", "--sticks", "resi 1-3", "--film-opacity", "--opacity", "resi 4=0.5"]
        cases = ((None, ["--clip", "z<1.5"]), (ensemble, few), (ensemble, [*few, "--frames", "1,3", "--color", "radial"]),
                 (ensemble, ["--select", "resi 1-5", "--turntable", "1", "--frames", "1-3"]))
        for molecule, options in cases:
            with self.subTest(options):
                folder = self.export(*options, molecule=molecule)
                names = set()
                for file in os.listdir(folder):
                    if file.endswith((".inc", ".pov")):
                        with open(os.path.join(folder, file), encoding="utf-8") as text:
                            names |= set(re.findall(r"#(?:declare|local|macro|for \() ?(\w+)", text.read()))
                self.assertGreater(len(names), 70)
                own = "#declare Tinted = 7; #declare Light = 8; #declare I = 9; #declare object_1 = 10;\n#declare Meniscus_Tint = 0.25;\n"
                frame = "#declare Meniscus_Frame = 3;\n" if "--frames" in options else ""
                left = "".join(f'#ifdef ({name}) #warning "said: {name}\\n" #end\n' for name in sorted(names))
                kept = '#warning concat("said: ", str(Tinted + Light + I + object_1 + Meniscus_Tint, 0, 2), "\\n")\n'
                said = self.render(folder, own + frame + INCLUDE + left + kept + INCLUDE + kept)[1]
                expected = {"Tinted", "Light", "I", "Meniscus_Tint", "Meniscus_Surface"} & names
                expected |= {"Meniscus_Shapes"} if "--sticks" in options else set()
                expected |= {"Meniscus_Frame"} if frame else set()
                self.assertEqual(set(said), expected | {"34.25"})
                self.assertEqual(said.count("34.25"), 2)

    def test_two_surfaces_of_other_settings_stand_in_one_scene(self):
        placed = "object { Meniscus_Surface translate SHIFT*x }\n"
        before = "#declare Meniscus_Material = 4;\n" + INCLUDE + placed.replace("SHIFT", f"{SHIFT}") + "#undef Meniscus_Material\n"
        found = self.lying(placed.replace("SHIFT", f"-{SHIFT}"), before)
        flat, lit = found[self.disc(SHIFT, 0.9 * RADIUS)], found[self.disc(-SHIFT, 0.9 * RADIUS)]
        self.assertLess(np.ptp(flat, axis=0).max(), 0.01)
        self.assertGreater(np.ptp(lit[:, 0]), 0.2)

    def test_a_texture_is_a_setting_and_an_interior_is_given_to_the_object(self):
        green = "texture { pigment { rgb y } finish { ambient 1 diffuse 0 } }"
        middle = self.disc(0, 0.5)
        self.assertGreater(self.lying(f"object {{ SURFACE {green} }}")[middle][:, 0].min(), 0.3)  # The pieces keep their own texture.
        found = self.lying("SURFACE", f"#declare Meniscus_Texture = {green}\n")
        np.testing.assert_allclose(found[middle], np.broadcast_to([0.0, 1.0, 0.0], found[middle].shape), atol=0.01)
        board = "plane { z, -4 pigment { checker rgb 0 rgb 1 scale 0.3 } finish { ambient 1 diffuse 0 } }"
        clear = "#declare Meniscus_Transmit = 1;\n"
        straight, bent = (self.lying(f"object {{ SURFACE {interior} }} {board}", clear) for interior in ("", "interior { ior 1.5 }"))
        self.assertGreater(np.abs(straight - bent)[self.disc(APART, 0.9 * RADIUS)].mean(), 0.1)
        self.assertLess(np.abs(straight - bent)[:10].max(), 0.01)

    def test_a_cut_is_closed_by_clip_and_not_by_difference(self):
        """From the side of the removed part one sees half a ball whose plane is lit."""
        cut = self.picture(f"object {{ Meniscus_Surface translate {SHIFT}*x }}", "--clip", f"z<{APART}")
        cap = cut[self.disc(SHIFT, 0.9 * RADIUS)]
        self.assertGreater(cap[:, 0].min(), 0.3)
        self.assertLess(np.ptp(cap, axis=0).max(), 0.02)  # The cap is flat.
        # The README explains it: patches are open, so that their difference is a shell, black inside.
        shell = self.picture(f"difference {{ object {{ Meniscus_Surface }} plane {{ -z, {-APART} }} translate {SHIFT}*x }}")
        self.assertLess(shell[self.disc(SHIFT, 0.9 * RADIUS)].max(), 0.05)

    def test_clipped_by_opens_it_and_the_inside_is_lit(self):
        open_ = self.lying("object { SURFACE clipped_by { plane { z, 0 } } }")
        self.assertGreater(open_[self.disc(APART, 0.9 * RADIUS)][:, 0].min(), 0.1)
        whole = self.lying("SURFACE")
        self.assertLess(((open_[:, :, 2] < 0.5) != (whole[:, :, 2] < 0.5)).mean(), 0.01)

    def test_a_union_hides_what_lies_within_and_a_trace_finds_the_surface(self):
        ball = "sphere { <APART, 0, 0>, 1 pigment { rgb y } }".replace("APART", f"{APART}")
        np.testing.assert_array_equal(self.lying("union { SURFACE " + ball + " }"), self.lying("SURFACE"))
        _, said = self.render(self.export(), INCLUDE + """#declare Side = <0, 0, 0>;
#declare Found = trace(Meniscus_Surface, <9, 0, APART>, -x, Side);
#warning concat("said: ", vstr(3, Found, " ", 0, 4), "\\n")
#warning concat("said: ", vstr(3, Side, " ", 0, 4), "\\n")
#warning concat("said: ", vstr(3, max_extent(Meniscus_Surface), " ", 0, 4), "\\n")
""".replace("APART", f"{APART}"))
        self.assertEqual(said, [f"{RADIUS:.4f} 0.0000 {APART:.4f}", "1.0000 0.0000 0.0000", f"{RADIUS:.4f} {RADIUS:.4f} {APART + RADIUS:.4f}"])

    def test_the_inside_is_not_known_between_atoms(self):
        ask = "".join(f'#warning concat("said: ", str(inside(Meniscus_Surface, <0, 0, {z}>), 0, 0), "\\n")\n' for z in (APART, 0, 9))
        self.assertEqual(self.render(self.export(), INCLUDE + ask)[1], ["1", "0", "0"])  # The second point is within the solid, too.
        # A body from which the surface is subtracted disappears entirely.
        body = "sphere { 0, 2.9 pigment { rgb y } finish { ambient 1 } }"
        self.assertGreater(self.lying(f"{body}")[self.disc(0, 2.5)][:, 1].min(), 0.9)
        self.assertLess(self.lying(f"difference {{ {body} SURFACE }}")[self.disc(0, 2.5)][:, 1].max(), 0.05)
        # An intersection between the atoms is empty, although the ball is within the solid.
        small = body.replace("2.9", "0.3")
        self.assertLess(self.lying(f"intersection {{ {small} SURFACE }}")[self.disc(0, 0.2)][:, 1].max(), 0.05)
        # A merge keeps walls between the atoms: its layers differ from those of merged balls.
        clear = "#declare Meniscus_Texture = texture { pigment { rgbt <0, 0, 0, 0.5> } finish { ambient 0 diffuse 0 } }\n"
        merged = self.lying("merge { object { SURFACE translate -y } object { SURFACE translate y } }", clear)
        layers = np.log2(np.maximum(merged[:, :, 2], 1e-3))
        self.assertLess(np.abs(layers[self.disc(APART, 0.4)] + 2).max(), 0.1)
        self.assertGreater(np.abs(layers[self.disc(0, 0.4)] + 2).max(), 0.5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
