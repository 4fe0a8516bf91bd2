# SPDX-License-Identifier: BSD-3-Clause
"""Texts are UTF-8 everywhere, but a std::string that becomes a path by itself is read by the code page of Windows: in what
libmeniscus is made of, files are named by paths, and texts become paths by path_of_text alone. Pictures are read without
OpenImageIO's cache."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = ("core", "exporters/bindings/c", "exporters/mesh_files")
#: Not in the library for Windows, or what asks a system itself.
OF_ONE_SYSTEM = re.compile(r"core/(gpu/|base/(module_file|system_file))")

PATH = r"(?:std::filesystem|fs)::path"
# What takes a path, up to its first argument.
TAKES_PATH = re.compile(r"(?:std::[io]?fstream \w+|\bOutputFile \w+|\bOutputFolder \w+|\bfopen|" + PATH + r"(?: \w+)?|"
                        r"\b(?:std::filesystem|fs)::(?:absolute|canonical|create_director\w+|exists|file_size|is_\w+|last_write_time|"
                        r"proximate|relative|remove\w*|rename|\w*status|temp_directory_path|weakly_canonical))[({]\s*([^;]*)")
TELLS_CODE_PAGE = re.compile(r"\.string\(\)")
DECLARED = re.compile(r"\b" + PATH + r"(?:\s*&&?|\s+const)?\s+(\w+)")
#: A literal of ASCII, a path of another, or a text that was made one.
IS_PATH = re.compile(r'"|const |path_of_text\(|(?:std::filesystem|fs)::|[)}]|std::move\((\w+)\)|(\w+)')

#: It takes a file for unchanged that was written again within the same second: with its old size, or its old pixels.
CACHED_PICTURE = re.compile(r"\bImageBuf(?:\s+\w+)?[({]")


def unsafe(text, header=""):
    """Calls in a file's text whose first argument is not seen to be a path; header: what may declare more of them."""
    paths = set(DECLARED.findall(text + header))
    found = [f"{text.count(chr(10), 0, call.start()) + 1}: .string()" for call in TELLS_CODE_PAGE.finditer(text)]
    for call in TAKES_PATH.finditer(text):
        argument = IS_PATH.match(call[1])
        name = argument and (argument[1] or argument[2])
        if not argument or (name and name not in paths and not re.match(r"[\w.]+ / path_of_text\(", call[1])):
            found.append(f"{text.count(chr(10), 0, call.start()) + 1}: {call[0].splitlines()[0].strip()}")
    return found


class FileNames(unittest.TestCase):
    def test_the_library_opens_files_by_paths(self):
        sources = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8")
                   for folder in LIBRARY for ending in ("*.cpp", "*.h") for path in (ROOT / folder).rglob(ending)}
        self.assertGreater(len(sources), 300)
        found = [f"{name}:{call}" for name, text in sorted(sources.items()) if not OF_ONE_SYSTEM.match(name)
                 for call in unsafe(text, sources.get(name.replace(".cpp", ".h"), ""))]
        self.assertEqual(found, [], "name the file by path_of_text (core/base/system_file.h), tell it by text_of_path")

    def test_texts_are_found(self):
        text = "void f(const std::string& file, const std::filesystem::path& path) {\n"
        for call in ("std::ifstream stream(file, std::ios::binary);", "fs::path(folder) / name;", "fs::exists(file);", "fopen(file.c_str(), 0);",
                     "OutputFile output(file, Existing::replace);", "fs::absolute(data.path());"):
            self.assertEqual(unsafe(text + call), ["2: " + call.rstrip(";")])
        for call in ("std::ifstream stream(path);", "std::ifstream stream(path_of_text(file));", 'fs::path("..");', "fs::absolute(path);",
                     "OutputFile output(path_of_text(file), Existing::replace);"):
            self.assertEqual(unsafe(text + call), [])

    def test_no_picture_is_read_through_a_cache(self):
        self.assertTrue(CACHED_PICTURE.search("OIIO::ImageBuf picture(path);") and CACHED_PICTURE.search("ImageBuf(path)"))
        found = [str(path.relative_to(ROOT)) for folder in ("core", "exporters", "app", "scripts", "tests")
                 for path in (ROOT / folder).rglob("*") if path.suffix in (".cpp", ".h", ".py") and path != pathlib.Path(__file__).resolve()
                 and CACHED_PICTURE.search(path.read_text(encoding="utf-8"))]
        self.assertEqual(found, [], "read it by ImageInput")


if __name__ == "__main__":
    unittest.main()
