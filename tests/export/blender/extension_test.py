# SPDX-License-Identifier: BSD-3-Clause
"""The zips of the Blender extension, made of stand-ins for wheels: SCRIPT (scripts/extension.sh) ADDON. Blender's own
validator and installer, which are not in Debian's, run in scripts/check/newer_blenders.sh."""

import os
import subprocess
import sys
import tempfile
import tomllib
import unittest
import zipfile

SCRIPT, ADDON = sys.argv[1:3]
SOURCE = os.path.join(ADDON, "meniscus_import")
WHEELS = {"linux-x64": "manylinux_2_28_x86_64", "linux-arm64": "manylinux_2_28_aarch64", "windows-x64": "win_amd64",
          "macos-arm64": "macosx_11_0_arm64", "macos-x64": "macosx_11_0_x86_64"}


class Extension(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.wheels, self.out = (os.path.join(folder.name, name) for name in ("wheels", "out"))
        os.mkdir(self.wheels)
        with open(os.path.join(SOURCE, "blender_manifest.toml"), "rb") as file:
            self.manifest = tomllib.load(file)
        for tag in WHEELS.values():
            self.wheel(tag)

    def wheel(self, tag, version=None, license="licenses/LICENSE"):
        """Writes a wheel and returns its path; a second call writes the same bytes."""
        path = os.path.join(self.wheels, f"meniscus_ses-{version or self.manifest['version']}-py3-none-{tag}.whl")
        with zipfile.ZipFile(path, "w") as file:
            file.writestr(zipfile.ZipInfo(f"meniscus.dist-info/{license}"), tag)  # ZipInfo dates it 1980.
        return path

    def make(self, *platforms):
        return subprocess.run([SCRIPT, self.wheels, self.out, *platforms], capture_output=True, text=True)

    def made(self):
        """Returns the bytes of each platform's zip."""
        said = self.make()
        self.assertEqual(said.returncode, 0, said.stderr)
        paths = {platform: os.path.join(self.out, f"meniscus_import-{self.manifest['version']}-{platform.replace('-', '_')}.zip") for platform in WHEELS}
        self.assertEqual(said.stdout.split(), list(paths.values()))
        contents = {}
        for platform, path in paths.items():
            with open(path, "rb") as file:
                contents[platform] = file.read()
        return contents

    def test_each_platform_has_the_add_on_and_its_wheel(self):
        self.made()
        sources = {os.path.relpath(os.path.join(folder, name), SOURCE) for folder, _, names in os.walk(SOURCE) for name in names
                   if not name.endswith(".pyc")}
        for name in sorted(os.listdir(self.out)):
            with zipfile.ZipFile(os.path.join(self.out, name)) as file:
                manifest = tomllib.loads(file.read("blender_manifest.toml").decode())
                (platform,), (wheel,) = manifest.pop("platforms"), manifest.pop("wheels")
                self.assertTrue(name.endswith(f"-{platform.replace('-', '_')}.zip"))
                self.assertEqual(wheel, f"./wheels/{os.path.basename(self.wheel(WHEELS[platform]))}")
                self.assertEqual(set(file.namelist()), sources | {wheel[2:]})
                with open(self.wheel(WHEELS[platform]), "rb") as given:
                    self.assertEqual(file.read(wheel[2:]), given.read())
                for source in sources - {"blender_manifest.toml"}:
                    with open(os.path.join(SOURCE, source), "rb") as given:
                        self.assertEqual(file.read(source), given.read(), source)
            self.assertEqual(manifest.pop("license"), ["SPDX:GPL-3.0-or-later", "SPDX:BSD-3-Clause"])
            self.assertEqual(manifest, {key: value for key, value in self.manifest.items() if key != "license"})

    def test_the_same_files_give_the_same_bytes(self):
        before = self.made()
        for folder, _, names in os.walk(self.wheels):
            for name in names:
                os.utime(os.path.join(folder, name), (1, 1))
        self.assertEqual(self.made(), before)

    def test_a_part_of_them_can_be_made_of_wheels_for_both_macs(self):
        for tag in WHEELS.values():
            os.remove(self.wheel(tag))
        self.wheel("macosx_11_0_universal2")
        self.assertEqual(self.make("macos-x64", "macos-arm64").returncode, 0)
        self.assertEqual(len(os.listdir(self.out)), 2)

    def test_what_cannot_be_made_is_said_in_a_sentence_and_nothing_is_written(self):
        lost = self.wheel(WHEELS["macos-x64"])
        os.remove(lost)
        self.refused(f"{self.wheels}: there is no wheel of meniscus for macos-x64")
        other = self.wheel(WHEELS["macos-x64"], "9.9.9")
        self.refused(f"{other}: the add-on is of version {self.manifest['version']}")
        self.wheel(WHEELS["macos-x64"])
        self.refused("there is more than one wheel of meniscus for macos-x64")
        os.remove(other)
        bare = self.wheel(WHEELS["macos-x64"], license="RECORD")
        self.refused(f"{bare}: it has no file LICENSE")
        with open(bare, "w", encoding="ascii") as file:
            file.write("none")
        self.refused(f"{bare}: it is not a wheel")
        self.refused("amiga is not one of linux-x64", "amiga")
        self.wheels += "x"
        self.refused(f"{self.wheels}: No such file or directory")

    def refused(self, words, *platforms):
        said = self.make(*platforms)
        self.assertEqual(said.returncode, 1, said.stdout)
        self.assertIn(words, said.stderr)
        self.assertEqual(said.stderr.count("\n"), 1, said.stderr)
        self.assertFalse(os.path.exists(self.out))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
