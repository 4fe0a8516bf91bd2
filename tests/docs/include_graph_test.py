# SPDX-License-Identifier: BSD-3-Clause
"""include_graph_test.py [--list | --dot]: the order of folders.

No file includes one of a later folder; headers with their sources make no ring; the drawing of the manual shows the
folders as they are: `include_graph_test.py --dot | dot -Tsvg > docs/explanation/folders.svg`."""

import html

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# From what needs nothing to what needs everything. Folders of one line know nothing of each other; a file belongs to
# the longest name that its path begins with.
ORDER = [
    ["core/base", "gpu_shaders"],
    ["core/math", "core/properties"],
    ["core/volume"],
    ["core/structure"],
    ["core/structure/selection"],
    ["core/structure/radii"],
    ["core/structure/formats"],
    ["core/color", "core/trajectory", "core/shapes"],
    ["core/camera"],
    ["core/gpu", "core/image"],
    ["core/reduced_surface"],
    ["core/surface"],
    ["core/queries"],
    ["core/pockets"],
    ["core/render"],
    ["core/visible_surface", "core/mesh"],
    ["core/scene"],
    ["exporters/mesh_files"],
    ["exporters/povray", "exporters/blender", "exporters/path_tracers", "exporters/msms", "exporters/vdb",
     "exporters/page", "exporters"],
    ["exporters/mvs"],
    ["exporters/bindings/c"],
    ["exporters/bindings/cpp"],
    ["app/process"],
    ["app/film", "app/msms"],
    ["app/options"],
    ["app/reports"],
    ["app/preview"],
    ["app/preview/server"],
    ["app/farm"],
    ["app/commands"],
    ["app/bench"],
    ["app"],
]
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


def sources(root=ROOT, folders=("core", "gpu_shaders", "exporters", "app")):
    """Path of each file, and those of ours that it includes."""
    graph = {}
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".cpp", ".h", ".hpp", ".glsl", ".comp"}:
                included = [name for name in INCLUDE.findall(path.read_text()) if (root / name).is_file()]
                graph[str(path.relative_to(root))] = included
    return graph


def place(path, order):
    """The line of the table and the folder in it; None for a file of no folder there."""
    found = [(row, folder) for row, folders in enumerate(order) for folder in folders if path.startswith(folder + "/")]
    return max(found, key=lambda entry: len(entry[1]), default=None)


def arrows_back(graph, order):
    """Each include that runs to a later folder, or to another one of the same line."""
    wrong = []
    for path, included in graph.items():
        here = place(path, order)
        for name in included:
            there = place(name, order)
            if here and there and here[1] != there[1] and there[0] >= here[0]:
                wrong.append(f"{path} ({here[1]}) includes {name} ({there[1]})")
    return wrong


def units(graph):
    """The same of units: a header and the source of its name are one."""
    merged = {}
    for path, included in graph.items():
        here = path.rsplit(".", 1)[0]
        theirs = [name.rsplit(".", 1)[0] for name in included]
        merged.setdefault(here, []).extend(name for name in theirs if name != here)
    return merged


def rings(graph):
    """A path through each set of files that include each other in a ring."""
    found, state, stack = [], {}, []

    def walk(path):
        state[path] = "open"
        stack.append(path)
        for name in graph.get(path, []):
            if state.get(name) == "open":
                found.append(" -> ".join([*stack[stack.index(name):], name]))
            elif name not in state:
                walk(name)
        stack.pop()
        state[path] = "done"

    for path in graph:
        if path not in state:
            walk(path)
    return found


def room(path):
    """The folder that the drawing shows for a file: gpu_shaders is one, core, exporters and app are their folders."""
    parts = path.split("/")
    return "/".join(parts[:1] if parts[0] == "gpu_shaders" or len(parts) < 3 else parts[:2])


def needs(graph):
    """The folders that each folder includes, without those that it reaches through another (transitive reduction)."""
    direct = {room(path): set() for path in graph}
    for path, included in graph.items():
        direct[room(path)] |= {room(name) for name in included} - {room(path)}

    def reached(folder):
        return set().union(*({name} | reached(name) for name in direct[folder]))

    return {folder: names - set().union(*map(reached, names)) for folder, names in direct.items()}


def dot(graph):
    """The drawing as text for Graphviz: an arrow leads from a folder to each that it needs."""
    lines = ["digraph folders {", '  graph [rankdir=BT, nodesep=0.15, ranksep=0.3, bgcolor="white"]',
             '  node [shape=box, style="rounded,filled", fontname="sans-serif", fontsize=12, height=0.3, color="#6d88a8"]',
             '  edge [arrowsize=0.6, color="#555555"]']
    colors = {"core": "#dfe8f2", "gpu_shaders": "#cfe3cf", "exporters": "#f6dcc0", "app": "#eadff0"}
    for folder, names in sorted(needs(graph).items()):
        lines.append(f'  "{folder}" [fillcolor="{colors[folder.split("/")[0]]}"]')
        lines += [f'  "{folder}" -> "{name}"' for name in sorted(names)]
    return "\n".join([*lines, "}"])


class IncludeGraph(unittest.TestCase):
    def test_the_drawing_shows_the_folders_as_they_are(self):
        drawing = html.unescape((ROOT / "docs/explanation/folders.svg").read_text())
        shown = set(re.findall(r"<title>(\S+)->(\S+)</title>", drawing))
        self.assertGreater(len(shown), 40)
        self.assertEqual(shown, {(folder, name) for folder, names in needs(sources()).items() for name in names},
                         "draw it again: include_graph_test.py --dot | dot -Tsvg > docs/explanation/folders.svg")

    def test_every_file_has_its_place(self):
        graph = sources()
        self.assertGreater(len(graph), 300)
        self.assertEqual([path for path in graph if not place(path, ORDER)], [])

    def test_no_arrow_runs_back(self):
        self.assertEqual(arrows_back(sources(), ORDER), [])

    def test_no_files_include_each_other(self):
        self.assertEqual(rings(units(sources())), [])

    def test_what_is_wrong_is_found(self):
        order = [["a"], ["b", "c"], ["b/inner"]]
        graph = {"a/x.h": ["b/x.h"], "b/x.h": ["a/x.h", "c/x.h"], "c/x.h": [], "b/inner/x.h": ["b/x.h"]}
        self.assertEqual(arrows_back(graph, order), ["a/x.h (a) includes b/x.h (b)", "b/x.h (b) includes c/x.h (c)"])
        self.assertEqual(rings(graph), ["a/x.h -> b/x.h -> a/x.h"])
        pair = {"a/x.h": [], "a/x.cpp": ["a/x.h", "a/y.h"], "a/y.h": [], "a/y.cpp": ["a/y.h", "a/x.h"]}
        self.assertEqual(rings(pair), [])
        self.assertEqual(rings(units(pair)), ["a/x -> a/y -> a/x"])


if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print("\n".join(arrows_back(sources(), ORDER) + rings(units(sources()))))
    elif sys.argv[1:] == ["--dot"]:
        print(dot(sources()))
    else:
        unittest.main()
