# SPDX-License-Identifier: BSD-3-Clause
"""No module of the Python package or of the Blender add-on imports itself by way of others, be it for types alone."""

import ast
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = ("exporters/bindings/python/meniscus", "exporters/blender/addon/meniscus_import")


def imports(folder):
    """Returns, by module of the package, the modules of it that it imports anywhere."""
    paths = {".".join(path.relative_to(folder).with_suffix("").parts): path for path in folder.rglob("*.py")}
    found = {}
    for module, path in paths.items():
        parents = module.split(".")[:-1]
        named = set()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.level:
                base = [*parents[:len(parents) - node.level + 1], *(node.module or "").split(".")]
                start = ".".join(filter(None, base))
                named |= {start} | {f"{start}.{name.name}".lstrip(".") for name in node.names}
        found[module] = (named & paths.keys()) - {module}
    return found


def circle(graph):
    """Returns the modules of one circle in order, or None."""
    done = set()

    def walk(module, way):
        if module in way:
            return [*way[way.index(module):], module]
        if module not in done:
            for other in sorted(graph[module]):
                if around := walk(other, [*way, module]):
                    return around
            done.add(module)
        return None

    return next(filter(None, (walk(module, []) for module in sorted(graph))), None)


class Imports(unittest.TestCase):
    def test_no_circle(self):
        for package in PACKAGES:
            with self.subTest(package):
                self.assertIsNone(circle(imports(ROOT / package)))

    def test_a_circle_is_found(self):
        self.assertEqual(circle({"a": {"b"}, "b": {"c"}, "c": {"b"}}), ["b", "c", "b"])


if __name__ == "__main__":
    unittest.main()
