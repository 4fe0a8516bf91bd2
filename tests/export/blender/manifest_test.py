# SPDX-License-Identifier: BSD-3-Clause
"""The add-on's manifest keeps the limits of Blender's extensions: ADDON VERSION. Blender's own validator, which is not in Debian's,
runs in scripts/check/newer_blenders.sh."""

import os
import re
import sys
import tomllib
import unittest

ADDON, VERSION = sys.argv[1:3]
LONGEST = 64  # letters that fit into one line of Blender's list


class Manifest(unittest.TestCase):
    def test_what_blender_asks_for(self):
        with open(os.path.join(ADDON, "meniscus_import", "blender_manifest.toml"), "rb") as file:
            manifest = tomllib.load(file)
        for key in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min", "license"):
            self.assertTrue(manifest.get(key), key)
        self.assertEqual(manifest["id"], "meniscus_import")
        self.assertEqual(manifest["version"], VERSION)
        for line in (manifest["tagline"], *manifest["permissions"].values()):
            self.assertLessEqual(len(line), LONGEST, line)
            self.assertTrue(line[-1].isalnum(), line)
        for line in manifest["copyright"]:
            self.assertRegex(line, r"\A\d{4}(-\d{4})? \S")
        for name in manifest["license"]:
            self.assertTrue(re.match("SPDX:", name), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
