# SPDX-License-Identifier: BSD-3-Clause
"""The film of a preview's strip is that of `meniscus film` of the same scenes, picture by picture: argument PROGRAM."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
WIDTH, HEIGHT = 96, 72


def atoms(models=1):
    lines = []
    for model in range(models):
        lines.append("MODEL     %4d" % (model + 1))
        for n in range(12):
            place = (2.9 * (n % 4) + 0.4 * model, 2.9 * (n // 4), 1.3 * (n % 3))
            lines.append("ATOM  %5d  CA  ALA %s%4d    %8.3f%8.3f%8.3f  1.00 10.00           C" % (n + 1, "AB"[n // 6], n + 1, *place))
        lines.append("ENDMDL")
    return "\n".join(lines) + "\n"


class Films(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a.pdb").write_text(atoms())
        (self.folder / "two.pdb").write_text(atoms(2))
        frames = [f"12\n{k}\n" + "".join(f"C {2.9 * (n % 4) + 0.3 * k} {2.9 * (n // 4)} {1.3 * (n % 3)}\n" for n in range(12)) for k in range(4)]
        (self.folder / "run.xyz").write_text("".join(frames))

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def preview(self, *words, commands):
        lines = [json.dumps({"command": word, **values}) for word, values in commands] + ['{"command":"quit"}']
        (self.folder / "session.jsonl").write_text("\n".join(lines) + "\n")
        replies = self.run_program("preview", *words, "--device", "cpu", "--commands", "session.jsonl", "--no-open")
        return [json.loads(line) for line in replies.splitlines()]

    def pictures(self, film):
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], cwd=self.folder,
                             capture_output=True, check=True).stdout
        size = 3 * WIDTH * HEIGHT
        self.assertEqual(len(raw) % size, 0)
        return [raw[n:n + size] for n in range(0, len(raw), size)]

    SIZE = {"width": WIDTH, "height": HEIGHT, "samples": 2}
    EXPORT = ("export", {"format": "film", "path": "strip.mkv", **SIZE})

    def test_it_is_that_of_the_same_scenes(self):
        self.preview("a.pdb", commands=[
            ("set", {"key": "surface.color", "value": "chain"}), ("add", {"key": "surface.clip", "value": "z<2"}), ("keep_scene", {}), ("save", {"path": "one.json", **self.SIZE}),
            ("set", {"key": "surface.probe", "value": 2}), ("orbit", {"dx": 0.3, "dy": 0.1}), ("set", {"key": "image.background", "value": "#203040"}), ("keep_scene", {}),
            ("save", {"path": "two.json", **self.SIZE}), ("time_scene", {"index": 0, "hold": 0.16, "transition": 0.24}),
            ("time_scene", {"index": 1, "hold": 0.08}), self.EXPORT, ("save", {"path": "story.json", "strip": True, **self.SIZE})])
        words = ("--device", "cpu")
        self.run_program("film", "one.json", "two.json", "-o", "film.mkv", "--hold", "0.16,0.08", "--transition", "0.24", *words)
        self.run_program("film", "story.json", "-o", "story.mkv", *words)
        strip = self.pictures("strip.mkv")
        self.assertEqual(len(strip), 4 + 6 + 2)
        self.assertGreaterEqual(len(set(strip)), 1 + 6 + 1)
        self.assertEqual(strip, self.pictures("film.mkv"))
        self.assertEqual(strip, self.pictures("story.mkv"))
        self.assertEqual(len({(self.folder / name).read_bytes() for name in ("strip.mkv", "film.mkv", "story.mkv")}), 1)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         sorted(["a.pdb", "film.mkv", "one.json", "run.xyz", "session.jsonl", "story.json", "story.mkv", "strip.mkv",
                                 "two.json", "two.pdb"]), "nothing else is left")

    def test_scenes_of_other_frames(self):
        for words, frames in ((["two.pdb"], 2), (["a.pdb", "--trajectory", "run.xyz"], 4)):
            self.preview(*words, "--output-dir", ".", commands=[
                ("frame", {"index": 0}), ("keep_scene", {}), ("frame", {"index": frames - 1}), ("keep_scene", {}),
                ("time_scene", {"index": 0, "hold": 0.08, "transition": 0}), ("time_scene", {"index": 1, "hold": 0.08}),
                ("frame", {"index": 1}),
                ("export", {**self.EXPORT[1], "force": True}),
                ("export", {"format": "film", "path": "turn.mkv", "of": "turntable", "seconds": 0.2, "force": True, **self.SIZE}),
                ("export", {"format": "film", "path": "frames.mkv", "of": "frames", "force": True, **self.SIZE}),
                ("export", {"format": "png", "path": "first.png", "force": True, **self.SIZE})])
            strip = self.pictures("strip.mkv")
            self.assertEqual(len(strip), 2 + 2)
            change = [sum(abs(a - b) for a, b in zip(*pair)) / len(pair[0]) for pair in zip(strip, strip[1:])]
            self.assertLess(max(change[0], change[2]), 0.2 * change[1], (words, change))
            self.assertEqual(len(set(self.pictures("turn.mkv"))), 5, words)
            self.assertEqual(len(self.pictures("frames.mkv")), frames)

    def test_a_strip_that_was_saved_is_there_again(self):
        replies = self.preview("two.pdb", commands=[
            ("set", {"key": "surface.color", "value": "chain"}), ("keep_scene", {}), ("frame", {"index": 1}), ("set", {"key": "surface.probe", "value": 2.5}), ("keep_scene", {}),
            ("time_scene", {"index": 0, "hold": 1, "transition": 0.5}), ("save", {"path": "story.json", "strip": True, **self.SIZE}),
            ("forget_scene", {"index": 0}), ("forget_scene", {"index": 0}), ("set", {"key": "surface.probe", "value": 1}), ("open", {"path": "story.json"}),
            ("state", {}), ("strip", {"place": 1}), ("state", {}), ("save", {"path": "again.json", "strip": True, **self.SIZE})])
        first, second = replies[11], replies[13]
        self.assertEqual([(kept["frame"], kept["hold"], kept["transition"]) for kept in first["strip"]["kept"]], [(0, 1, 0.5), (1, 2, 0.5)])
        self.assertEqual((first["values"]["surface.probe"], first["values"]["surface.color"]), (1.4, ["chain"]))
        self.assertEqual((second["values"]["surface.probe"], second["frame"]), (2.5, 1))
        self.assertEqual((self.folder / "story.json").read_text(), (self.folder / "again.json").read_text())


if __name__ == "__main__":
    unittest.main()
