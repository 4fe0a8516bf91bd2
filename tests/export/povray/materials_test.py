# SPDX-License-Identifier: BSD-3-Clause
"""Glass, wax, highlights and layers of POV-Ray's pictures against optics and the ray caster: PROGRAM POVRAY."""

import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import OpenImageIO

PROGRAM, POVRAY = sys.argv[1:3]
UBIQUITIN = "/usr/share/freesasa/test-data/1ubq.pdb"
RADIUS, IOR = 2.0, 1.45
WIDTH, HEIGHT = 240, 180


def linear_pixels(path):
    """Returns linear colours of a picture of 16 bits, (rows, columns, 3)."""
    image = OpenImageIO.ImageInput.open(path)
    values = np.asarray(image.read_image("uint16")).astype(float)[:, :, :3] / 65535
    image.close()
    return values


class Materials(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.addCleanup(self.holder.cleanup)
        self.folder = os.path.join(self.holder.name, "scene")

    def run_program(self, *command, cwd=None):
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])

    def export(self, atoms, *options):
        """Exports a scene of balls (x, y, z, radius)."""
        path = os.path.join(self.holder.name, "balls.xyzr")
        with open(path, "w", encoding="ascii") as file:
            file.writelines(" ".join(map(str, atom)) + "\n" for atom in atoms)
        self.run_program(PROGRAM, "export", "povray", path, "-o", self.folder, "-q", "--size", f"{WIDTH}x{HEIGHT}",
                         "--projection", "orthographic", *options)

    def render(self, declared, *options):
        """Returns the scene's linear picture with declarations in front of it."""
        with open(os.path.join(self.folder, "own.pov"), "w", encoding="ascii") as file:
            file.write(f'#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level 30 }}\n'
                       f'#declare Meniscus_Custom_Settings = 1;\n{declared}\n#include "surface.pov"\n')
        self.run_program(POVRAY, "surface.ini", "Input_File_Name=own.pov", "Output_File_Name=own.png", "Antialias=Off",
                         "Bits_Per_Color=16", "File_Gamma=1.0", *options, cwd=self.folder)
        return linear_pixels(os.path.join(self.folder, "own.png"))

    def middle_row(self, picture):
        """Returns distances of the middle row's pixels from the middle in Å, and their values."""
        with open(os.path.join(self.folder, "surface.pov"), encoding="utf-8") as file:
            width = float(re.search(r"Meniscus_Picture_Width = ([0-9.e+-]+);", file.read()).group(1))
        places = ((np.arange(WIDTH) + 0.5) / WIDTH - 0.5) * width
        return places, 0.5 * (picture[HEIGHT // 2 - 1] + picture[HEIGHT // 2])

    def test_glass_bends_light_as_snell_says(self):
        """Each ray leaves a ball in another direction, which the sky's colour shows."""
        self.export([(0, 0, 0, RADIUS)])
        sky = ("#declare Meniscus_Material = 2; #declare Meniscus_Finish = finish { ambient 0 diffuse 0 }\n"
               "#declare Meniscus_Absorbs = rgb 0; #declare Meniscus_Tint = 0; #declare Meniscus_Background = rgb 0;\n"
               "#include \"axes.inc\"\n"
               "#declare Meniscus_Sky = sky_sphere { pigment { gradient Axis color_map { [0 rgb 0] [1 rgb 1] }\n"
               "  scale 2 translate -Axis } }")
        with open(os.path.join(self.folder, "surface.pov"), encoding="utf-8") as file:
            right = re.search(r"Meniscus_Right = (<[^>]+>);", file.read()).group(1)
        with open(os.path.join(self.folder, "axes.inc"), "w", encoding="ascii") as file:
            file.write(f"#declare Axis = {right};\n")
        places, values = self.middle_row(self.render(sky))
        inside = np.abs(places) < 0.9 * RADIUS
        self.assertGreater(inside.sum(), 60)
        sines = places[inside] / RADIUS
        turned = 2 * (np.arcsin(sines) - np.arcsin(sines / IOR))
        expected = 0.5 - 0.5 * np.sin(turned)
        self.assertLess(np.abs(values[inside, 0] - expected).max(), 0.004)
        self.assertGreater(np.ptp(expected), 0.5)  # Without refraction all values would be 1/2.
        self.assertTrue(np.allclose(values[np.abs(places) > 1.05 * RADIUS, 0], 0.5, atol=1e-3))

    def test_glass_reflects_by_fresnel_and_absorbs_by_lambert(self):
        self.export([(0, 0, 0, RADIUS)])
        dark = "#declare Meniscus_Material = 2; #declare Meniscus_Sky = sky_sphere { pigment { rgbt 1 } }\n" \
               "#declare Meniscus_Tint = 0; #declare Meniscus_Custom_Lights = 1; #declare Meniscus_Absorption_Length = 5;\n"
        _, values = self.middle_row(self.render(dark + "#declare Meniscus_Background = rgb 1;\n"
                                                "#declare Meniscus_Absorbs = rgb <1, 0.5, 0>;"))
        mirrored = ((IOR - 1) / (IOR + 1)) ** 2
        # The mirror image shows the same white; the rest of the light goes through the ball.
        for channel, absorbs in enumerate((1, 0.5, 0)):
            expected = mirrored + (1 - mirrored) * math.exp(-absorbs * 2 * RADIUS / 5)
            self.assertAlmostEqual(values[WIDTH // 2, channel], expected, delta=0.004)
        # White lies behind the viewer alone, so that only the mirror image shows, brighter where the view grazes.
        with open(os.path.join(self.folder, "surface.pov"), encoding="utf-8") as file:
            forward = re.search(r"Meniscus_Forward = (<[^>]+>);", file.read()).group(1)
        behind = (dark.replace("pigment { rgbt 1 }", f"pigment {{ gradient {forward} color_map {{ [0 rgb 1] [0.5 rgb 1] "
                               f"[0.5 rgb 0] [1 rgb 0] }} scale 2 translate -{forward} }}")
                  + "#declare Meniscus_Background = rgb 0; #declare Meniscus_Absorbs = rgb 100;")
        places, values = self.middle_row(self.render(behind))
        for share in (0.0, 0.3, 0.6):  # Up to 45 degrees the mirror image is behind the viewer.
            n = int(np.argmin(np.abs(places - share * RADIUS)))
            angle = math.asin(abs(places[n]) / RADIUS)
            within = math.asin(math.sin(angle) / IOR)
            across = (math.cos(angle) - IOR * math.cos(within)) / (math.cos(angle) + IOR * math.cos(within))
            along = (math.cos(within) - IOR * math.cos(angle)) / (math.cos(within) + IOR * math.cos(angle))
            self.assertAlmostEqual(values[n, 0], (across ** 2 + along ** 2) / 2, delta=0.002)

    def test_wax_is_lighter_where_it_turns_away(self):
        self.export([(0, 0, 0, RADIUS)], "--color", "#804020")
        places, values = self.middle_row(self.render(
            "#declare Meniscus_Material = 3;\n#declare Meniscus_Finish = finish { emission 1 ambient 0 diffuse 0 }\n"
            "#declare Meniscus_Edge = 0.4;"))
        color = np.array([((c / 255 + 0.055) / 1.055) ** 2.4 for c in (0x80, 0x40, 0x20)])
        tinted = 0.9 * color + 0.1
        self.assertLess(np.abs(values[WIDTH // 2] - tinted).max(), 0.003)
        rim = values[np.abs(places) < 0.999 * RADIUS][0]
        self.assertTrue(np.all(rim > tinted ** 0.75), f"{rim} of {tinted}")
        self.assertTrue(np.all(rim < tinted ** 0.6 + 0.003), f"{rim} of {tinted}")

    def test_layers_are_counted_beyond_fifteen(self):
        for count in 20, 100:
            self.export([(10.0 * n, 0, 0, RADIUS) for n in range(count)], "--force")
            with open(os.path.join(self.folder, "own.pov"), "w", encoding="ascii") as file:
                file.write("#version 3.7;\n#declare Meniscus_Buffer = 4; #declare Meniscus_Custom_Camera = 1;\n"
                           "camera { orthographic location <-1000, 0, 0> direction x right 8*z up 6*y }\n"
                           '#include "surface.pov"\n')
            self.run_program(POVRAY, "surface.ini[layers]", "Input_File_Name=own.pov", cwd=self.folder)
            picture = linear_pixels(os.path.join(self.folder, "surface_layers.png"))
            layers = math.log(picture[HEIGHT // 2, WIDTH // 2, 0]) / math.log(63 / 64)
            self.assertAlmostEqual(layers, 2 * count, delta=0.1)
            self.assertEqual(picture[0, 0, 0], 1.0)

    def test_highlights_are_those_of_the_view(self):
        """A black molecule shows no light but its highlights."""
        ours, camera = (os.path.join(self.holder.name, name) for name in ("ours.png", "camera.json"))
        common = ["--color", "black", "--size", "320x240", "-q"]
        self.run_program(PROGRAM, "render", UBIQUITIN, "-o", ours, *common, "--preset", "classic", "--samples", "1",
                         "--background", "black", "--save-camera", camera)
        self.run_program(PROGRAM, "export", "povray", UBIQUITIN, "-o", self.folder, *common, "--camera", camera)
        with open(os.path.join(self.folder, "own.pov"), "w", encoding="ascii") as file:
            file.write("#version 3.7;\n#declare Meniscus_Background = rgb 0;\n#include \"surface.pov\"\n")
        self.run_program(POVRAY, "surface.ini", "Input_File_Name=own.pov", "Antialias=Off", cwd=self.folder)
        pictures = []
        for path in ours, os.path.join(self.folder, "surface.png"):
            image = OpenImageIO.ImageInput.open(path)
            pictures.append(np.asarray(image.read_image("uint8")).astype(int)[:, :, :3])
            image.close()
        bright = pictures[0].max(axis=2) > 40
        self.assertGreater(bright.sum(), 500)
        shares = [float((np.abs(pictures[0] - other).max(axis=2) > 8)[bright].mean())
                  for other in (pictures[1], np.roll(pictures[1], 1, axis=1))]
        print(f"highlights: {bright.sum()} pixels, {100 * shares[0]:.3f} % differ; one pixel aside {100 * shares[1]:.1f} %")
        self.assertLess(shares[0], 0.01)
        self.assertGreater(shares[1], 0.05)


unittest.main(argv=["materials_test"])
