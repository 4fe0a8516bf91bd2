# SPDX-License-Identifier: BSD-3-Clause
"""Targets of documents and comments exist: links, kernels, theorems, tests."""
import ast
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCE_FOLDERS = ("app", "core", "exporters", "gpu_shaders", "tests")


def sources():
    for folder in SOURCE_FOLDERS:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in {".cpp", ".h", ".glsl", ".comp"}:
                yield path


def documents():
    yield from ROOT.glob("*.md")
    for folder in (*SOURCE_FOLDERS, "docs"):
        yield from (ROOT / folder).rglob("*.md")


class Documents(unittest.TestCase):
    def test_links_lead_to_files(self):
        checked = 0
        for document in documents():
            for target in re.findall(r"\]\(([^)#\s]+)", document.read_text()):
                if "://" in target or target.startswith("mailto:"):
                    continue
                checked += 1
                self.assertTrue((document.parent / target).exists(), f"{document.relative_to(ROOT)} links to {target}")
        self.assertGreater(checked, 40)

    def test_the_front_page_of_the_manual_leads_to_every_page(self):
        index = ROOT / "docs/index.md"
        linked = set(re.findall(r"\]\(([^)#]+\.md)", index.read_text()))
        pages = {str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").glob("*/*.md")}
        self.assertGreater(len(pages), 40)
        self.assertEqual(pages - linked, set())

    def test_the_list_of_dependencies_has_every_package(self):
        page = (ROOT / "docs/reference/dependencies.md").read_text()
        named = set(re.findall(r"`([\w+-]+)`", page))
        script = (ROOT / "scripts/packages.sh").read_text()
        packages = " ".join(re.search(rf"^{name}=\((.*?)\)", script, re.M | re.S)[1] for name in ("build_packages", "film_packages"))
        self.assertGreater(len(packages.split()), 20)
        self.assertEqual(set(packages.split()) - named - {"povray-includes"}, set())

    def test_pages_of_the_manual_are_found_by_one_word(self):
        """`meniscus help NAME` takes the stem of a page."""
        stems = [path.stem for path in (ROOT / "docs").glob("*/*.md")]
        self.assertEqual(sorted(set(stems)), sorted(stems))

    def test_files_that_comments_name_are_there(self):
        generated = {"windows.h", "first.js", "second.js", "stage.js", "P.vert", "P_k.vert"}  # by others or by programs
        known = generated | {path.name for folder in (*SOURCE_FOLDERS, "scripts", "docs") for path in (ROOT / folder).rglob("*.*")}
        names = [(path, name) for path in sources() for comment in re.findall(r"(?<!:)//.*", path.read_text())
                 for name in re.findall(r"[\w/]+\.(?:h|cpp|glsl|comp|frag|vert|js|py)\b", comment)]
        self.assertGreater(len(names), 100)
        missing = {f"{path.relative_to(ROOT)} names {name}" for path, name in names if name.split("/")[-1] not in known}
        self.assertEqual(missing, set())

    def test_theorems_that_are_cited_are_there(self):
        theory = (ROOT / "docs/explanation/theory.md").read_text()
        parts = {}
        for number, body in re.findall(r"^## Theorem (\d+):.*?\n(.*?)(?=^## |\Z)", theory, re.M | re.S):
            parts[number] = set(re.findall(r"^(\d+)\. ", body, re.M))
        self.assertEqual(set(parts), {"1", "2", "3", "4"})
        cited = 0
        for source in sources():
            for number, part in re.findall(r"[Tt]heorem (\d+)(?:\.(\d+))?", source.read_text()):
                cited += 1
                self.assertIn(number, parts, f"{source.relative_to(ROOT)} cites theorem {number}")
                if part:
                    self.assertIn(part, parts[number], f"{source.relative_to(ROOT)} cites theorem {number}.{part}")
        self.assertGreater(cited, 15)

    def test_the_table_of_kernels_is_complete(self):
        listed = set(re.findall(r"\]\(([a-z_]+/[a-z_]+\.comp)\)", (ROOT / "gpu_shaders/README.md").read_text()))
        there = {str(path.relative_to(ROOT / "gpu_shaders")) for path in (ROOT / "gpu_shaders").rglob("*.comp")}
        self.assertEqual(listed, there)

    def test_each_row_of_the_contract_of_msms_names_tests_that_are_there(self):
        """A row names CLASS, CLASS.test_name and its continuation in the row, or a name cut off by an ellipsis."""
        places = {}
        for path in (ROOT / "tests/msms").glob("*_test.py"):
            for node in ast.parse(path.read_text()).body:
                if isinstance(node, ast.ClassDef):
                    places[path.name, node.name] = [item.name for item in node.body
                                                    if isinstance(item, ast.FunctionDef) and item.name.startswith("test_")]
        text = (ROOT / "docs/reference/msms-contract.md").read_text()
        (contract,) = re.findall(r"^## Promises$(.*?)(?=^## )", text, re.M | re.S)
        rows = [line.strip("|").replace(r"\|", "/").split("|") for line in contract.splitlines() if line.startswith("|")][2:]
        self.assertGreater(len(rows), 25)
        for row in rows:
            self.assertEqual(len(row), 3, row)
            cited = row[2].strip()
            if cited == "every test":
                continue
            file, _, names = cited.rpartition(": ")
            of_file = {group: tests for (place, group), tests in places.items() if place == (file or "contract_test.py")}
            tests = []
            for name in names.split(", "):
                group, _, test = name.rpartition(".") if "." in name else ("", "", name)
                if not test.startswith("test_"):
                    group, test = test, ""
                tests = of_file.get(group, tests) if group else tests
                self.assertTrue(tests, f"{row[0].strip()}: there is no {name}")
                fits = [there for there in tests if there == test or (test.endswith("…") and there.startswith(test[:-1]))]
                self.assertTrue(not test or fits, f"{row[0].strip()}: there is no {name}")

    def test_nobody_cites_what_is_not_in_the_tree(self):
        for source in sources():
            self.assertNotRegex(source.read_text(), r"design notes|design/geometry", str(source.relative_to(ROOT)))


if __name__ == "__main__":
    unittest.main()
