# SPDX-License-Identifier: BSD-3-Clause
"""The structs and constants that are written a second time are those of the header."""
import ctypes
import pathlib
import re
import unittest

from package_case import HEADER
from meniscus import _library


@unittest.skipUnless(HEADER, "MENISCUS_HEADER is not set")
class Header(unittest.TestCase):
    """The structs and constants that are written a second time are those of the header."""

    def setUp(self):
        self.text = re.sub(r"/\*.*?\*/", "", pathlib.Path(HEADER).read_text(), flags=re.S)

    def test_constants(self):
        names = {name: int(value) for name, value in re.findall(r"\bMENISCUS_(\w+) = (\d+)", self.text)}
        checked = 0
        for name, value in names.items():
            if hasattr(_library, name):
                checked += 1
                self.assertEqual(getattr(_library, name), value, name)
        self.assertGreaterEqual(checked, 40)

    def test_structs(self):
        c_names = {"double": ctypes.c_double, "float": ctypes.c_float, "size_t": ctypes.c_size_t,
                   "int32_t": ctypes.c_int32, "uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64,
                   "uint8_t": ctypes.c_uint8}
        found = re.findall(r"typedef struct meniscus_\w+ \{(.*?)\} meniscus_(\w+);", self.text, re.S)
        self.assertGreaterEqual(len(found), 15)
        words = re.findall(r"typedef enum (\w+) MENISCUS_WORDS", self.text)
        self.assertGreaterEqual(len(words), 14)
        for body, name in found:
            python = {"mesh_options": "MeshOptions", "mesh_file": "MeshFile", "camera": "CameraStruct", "pocket": "PocketRow",
                      "pocket_options": "PocketOptions", "read_options": "ReadOptions", "read_report": "ReadReport"}.get(name, name.capitalize())
            fields = []
            for kind, members in re.findall(r"((?:const )?\w+(?:\* const)?\*?) ([^;]+);", body):
                kind = "int32_t" if kind in words else kind
                self.assertTrue(kind in c_names or "*" in kind, f"{name}: {kind}")
                for member in members.split(","):
                    field, size = re.match(r"\s*(\w+)(?:\[(\d+)\])?", member).groups()
                    wanted = c_names.get(kind)
                    fields.append((field, wanted * int(size) if size else wanted))
            mine = getattr(_library, python)._fields_
            self.assertEqual([f for f, _ in fields], [f for f, _ in mine], name)
            for (field, wanted), (_, kind) in zip(fields, mine):
                if wanted:
                    self.assertEqual(ctypes.sizeof(kind), ctypes.sizeof(wanted), f"{name}.{field}")
                    self.assertIs(kind, wanted, f"{name}.{field}")
