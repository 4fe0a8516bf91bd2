# SPDX-License-Identifier: BSD-3-Clause
"""include_graph_test.py [--list | --dot]: the order of folders.

No file includes one of a later folder; headers with their sources make no ring; each file includes what it names of the
standard library, because other systems' headers bring along less. The drawing of the manual shows the folders as they
are: `include_graph_test.py --dot | dot -Tsvg > docs/explanation/folders.svg`."""

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
# For each header of the standard library, names that nearly always come from it.
STANDARD = {
    "algorithm": "sort|stable_sort|find_if|any_of|all_of|none_of|copy_if|clamp|lower_bound|upper_bound|ranges::(?:sort|find|find_if|any_of|"
                 "all_of|none_of|copy|transform|count|max|min|fill|lower_bound|upper_bound|equal|for_each)",
    "array": "array", "atomic": r"atomic\w*", "bit": "bit_cast|popcount|countr_zero|countl_zero|bit_width|bit_ceil|rotl|endian",
    "charconv": "from_chars|to_chars", "chrono": r"chrono::\w+", "condition_variable": r"condition_variable\w*",
    "cmath": "sqrt|fabs|sin|cos|acos|asin|atan2|pow|exp|log|floor|ceil|round|lround|hypot|isfinite|isnan|ldexp|nextafter|cbrt",
    "concepts": "same_as|integral|floating_point|invocable",
    "cstdio": "snprintf|printf|fprintf|fopen|fclose|fread|fwrite|fputs|fflush|remove", "cstdlib": "getenv|exit|_Exit|quick_exit|strtod|strtol|abort",
    "cstring": "memcpy|memcmp|strlen|strerror|memset", "deque": "deque",
    "exception": "exception_ptr|current_exception|rethrow_exception", "filesystem": r"filesystem::\w+",
    "fstream": "fstream|ifstream|ofstream", "functional": "function|greater|plus|reference_wrapper|ref", "future": "future|async|promise",
    "iomanip": "setw|setprecision", "iostream": "cout|cerr|cin", "iterator": "back_inserter|next|prev|distance|istreambuf_iterator|ssize",
    "limits": "numeric_limits", "list": "list", "map": "map|multimap", "memory": "unique_ptr|shared_ptr|make_unique|make_shared",
    "mutex": "mutex|lock_guard|scoped_lock|unique_lock|once_flag|call_once",
    "numbers": r"numbers::\w+", "numeric": "accumulate|iota|reduce|inner_product|partial_sum|exclusive_scan|gcd|lcm|midpoint",
    "optional": "optional|nullopt", "queue": "priority_queue|queue", "random": r"mt19937\w*|\w+_distribution", "ranges": r"views::\w+|ranges::subrange",
    "regex": r"regex\w*", "set": "set|multiset", "span": "span|as_bytes", "sstream": "stringstream|istringstream|ostringstream",
    "stdexcept": "runtime_error|invalid_argument|out_of_range|logic_error", "string": "string|to_string", "string_view": "string_view",
    "thread": "thread|jthread", "tuple": "tuple|tie|make_tuple|apply", "type_traits": r"is_\w+_v|conditional_t|decay_t|remove_\w+_t",
    "unordered_map": "unordered_map", "unordered_set": "unordered_set", "utility": "pair|move|swap|exchange|forward",
    "variant": "variant|visit|holds_alternative|get_if|monostate", "vector": "vector",
}
STANDARD = {header: re.compile(rf"std::(?:{names})\b") for header, names in STANDARD.items()}
STANDARD_INCLUDE = re.compile(r"^\s*#\s*include\s*<([a-z_]+)>", re.M)
FOLDERS = ("core", "gpu_shaders", "exporters", "app")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)


def sources(root=ROOT, folders=FOLDERS):
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


def missing_headers(graph, read):
    """Each standard header that a file should include, itself or through other files of ours."""
    texts = {path: re.sub(r"//.*", "", read(path)) for path in graph}

    def reached(path, seen):
        seen.add(path)
        return set(STANDARD_INCLUDE.findall(texts[path])).union(
            *(reached(name, seen) for name in graph[path] if name in graph and name not in seen))

    missing = []
    for path, text in texts.items():
        headers = reached(path, set())
        missing += [f"{path}: #include <{header}>" for header, names in STANDARD.items() if header not in headers and names.search(text)]
    return missing


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

    def test_every_file_includes_what_it_names(self):
        self.assertEqual(missing_headers(sources(folders=(*FOLDERS, "tests")), lambda path: (ROOT / path).read_text()), [])

    def test_what_is_wrong_is_found(self):
        order = [["a"], ["b", "c"], ["b/inner"]]
        graph = {"a/x.h": ["b/x.h"], "b/x.h": ["a/x.h", "c/x.h"], "c/x.h": [], "b/inner/x.h": ["b/x.h"]}
        self.assertEqual(arrows_back(graph, order), ["a/x.h (a) includes b/x.h (b)", "b/x.h (b) includes c/x.h (c)"])
        self.assertEqual(rings(graph), ["a/x.h -> b/x.h -> a/x.h"])
        pair = {"a/x.h": [], "a/x.cpp": ["a/x.h", "a/y.h"], "a/y.h": [], "a/y.cpp": ["a/y.h", "a/x.h"]}
        self.assertEqual(rings(pair), [])
        self.assertEqual(rings(units(pair)), ["a/x -> a/y -> a/x"])
        texts = {"a/x.h": "#include <vector>\n// std::map\nstd::vector<int> x;", "a/x.cpp": "std::vector<int> y; std::numbers::pi;"}
        self.assertEqual(missing_headers({"a/x.h": [], "a/x.cpp": ["a/x.h"]}, texts.get), ["a/x.cpp: #include <numbers>"])


if __name__ == "__main__":
    if sys.argv[1:] == ["--list"]:
        print("\n".join(arrows_back(sources(), ORDER) + rings(units(sources()))))
    elif sys.argv[1:] == ["--dot"]:
        print(dot(sources()))
    else:
        unittest.main()
