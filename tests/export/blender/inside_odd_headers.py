# SPDX-License-Identifier: BSD-3-Clause
"""Files whose checksum is right and whose header has an odd value: Blender imports them, or one sentence names file and value."""

import os
import sys
import unittest

import addon_utils
import bpy

FOLDER, ADDON, HERE, BLENDER, PROGRAM = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, HERE)
import samples  # noqa: E402

from meniscus_import import build, mns_reader  # noqa: E402


class OddHeaders(unittest.TestCase):
    def test_every_value_replaced_by_every_odd_one(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon_utils.enable("meniscus_import")
        path, stores = os.path.join(FOLDER, "odd.mns"), (bpy.data.objects, bpy.data.meshes, bpy.data.cameras, bpy.data.collections)
        cases = read = 0
        for data in (samples.small_surface(False), samples.small_surface(True)):
            for words, odd in samples.odd_headers(data):
                cases += 1
                with open(path, "wb") as file:
                    file.write(odd)
                with self.subTest(words):
                    try:
                        build.import_file(path, parts=cases % 2 == 0, center=cases % 4 == 0)
                        read += 1
                    except mns_reader.MnsError as error:
                        self.assertIn(path, str(error))
                        self.assertEqual(len(str(error).splitlines()), 1)
                for store in stores:
                    for item in list(store):
                        store.remove(item)
        print(f"{cases} headers, {read} of them imported")
        self.assertGreater(read, 100)

    def test_the_value_is_named(self):
        path = os.path.join(FOLDER, "odd.mns")
        for key, value, words in (("area", "much", "area is 'much', not a number"), ("probe_radius", 10**400, "probe_radius is 1"),
                                  ("volume", float("nan"), "volume is nan, not a number")):
            data = samples.small_surface(False)
            header, _ = samples.header_of(data)
            header["objects"][0][key] = value
            with open(path, "wb") as file:
                file.write(samples.with_header(data, header))
            with self.assertRaises(RuntimeError) as caught:
                bpy.ops.import_scene.meniscus(filepath=path)
            self.assertIn(f"{path}: {words}", str(caught.exception))


if not unittest.main(argv=["inside_odd_headers"], exit=False).result.wasSuccessful():
    sys.exit(1)
