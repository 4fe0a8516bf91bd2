# SPDX-License-Identifier: BSD-3-Clause
"""words_test.py [--program PROGRAM] [--docs]: the words of messages, of help and of documents are those of the field.

Each row of WORDS has a pattern that readers stumble over, and what to write instead. Messages come from
scripts/check/list_messages.py; --program adds the help of every command and every page of help, --docs the documents."""

import ast
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/check"))

import list_messages  # noqa: E402

#: Pattern of words, and what to write instead.
WORDS = (
    (r"(?<!there )(?<!There )\b(is|are) no (?!longer|more\b|less\b|other\b|such\b|further\b)", "is not a, are not"),
    (r"\bis none of\b|\bare none of\b", "is not one of"),
    (r"\bmeant by\b", "selected by, called"),
    (r"\b(stands?|stood)\b(?! (in )?for\b)", "is, is written, goes"),
    (r"\bbehind\b(?! (the (orthographic )?camera|the (viewer|plane|image)|it or beside))", "after"),
    (r"\btold\b|\btells of\b", "shown, reported, said"),
    (r"\bwhoever\b|\bwhomever\b", "anyone who, someone who"),
    (r"\bnobody\b", "no one, or the passive"),
    (r"\bsomebody\b", "someone, a user"),
    (r"\bair\b", "depth cue"),
    (r"\bink\b", "silhouettes, lines"),
    (r"\boddit(y|ies)\b", "unusual cases, warnings"),
    (r"\b(is|are) younger\b|\bolder than an option\b", "was added later"),
    (r"\baside\b", "by one pixel, to the side"),
    (r"\bleave\b[^.;:]* away\b", "leave out"),
    (r"\bby a hair\b", "slightly"),
    (r"\b(has|have) not (the|a|an|its|their|enough)\b", "does not have"),
    (r"\bless (atoms|frames|numbers|bytes|files)\b", "fewer"),
    (r"\b(a|one) (line|row|file|process|class|frame|page|picture) (a|an) (?!time)[a-z]+", "one ... per ..."),
    (r"\banew\b", "again"),
    (r"\bshall\b", "must, will, should"),
    (r"\bfor want of\b", "without"),
    (r"\bpart(s|ed)? (them|it|the two)\b", "separate, divide"),
    (r"\bmakes? no sense\b", "is not valid"),
    (r"\bcomes? twice\b", "appears twice"),
    (r"\bcannot be had\b", "is not available"),
    (r"\bas far again\b", "times the"),
    (r", for (it|they|there|he|she) (is|are|was|were|has|have|had)\b", "because"),
    (r"\bnothing that\b", "not something that, or name what it is"),
    (r"\bin the (place|stead) of\b", "instead of"),
)

#: Texts that are right in spite of a pattern.
ALLOWED = (
    "Tools.told",  # a function
    "nothing that it computed",
)

LONGEST_SENTENCE = 75  # letters of the first sentence of an option's help, in which a reader finds what it does


def faults(text):
    """Returns the rows of WORDS that a text meets."""
    for allowed in ALLOWED:
        text = text.replace(allowed, "")
    return [f"{match.group(0)!r}: write {instead}" for pattern, instead in WORDS
            for match in re.finditer(pattern, text)]


def documents():
    """Yields Markdown for readers; CHANGELOG.md describes the past in its own words, so it is left out."""
    for folder in ("docs", "exporters", "gpu_shaders", "app"):
        yield from sorted((ROOT / folder).rglob("*.md"))
    yield from (path for path in sorted(ROOT.glob("*.md")) if path.name != "CHANGELOG.md")


def prose_of(document):
    """Yields (line, text) of a document without its blocks of code and code in the line."""
    in_code = False
    for number, line in enumerate(document.read_text(encoding="utf-8").split("\n"), 1):
        if line.lstrip().startswith("```"):
            in_code = not in_code
        elif not in_code:
            yield number, re.sub(r"`[^`]*`", "``", line)


def help_of(program, *command):
    return subprocess.run([program, *command, "--help-all"], capture_output=True, text=True, check=True).stdout


def commands_of(program):
    found = []
    for command in re.findall(r"^  ([a-z]+) ", re.split(r"\nCommands:\n", help_of(program))[1], re.M):
        inner = re.split(r"\n(?:Commands|Formats):\n", help_of(program, command))[1:]
        names = [name for text in inner for name in re.findall(r"^  ([a-z]+) ", text, re.M)]
        found += [[command, name] for name in names] + [[command]]
    return found


class Messages(unittest.TestCase):
    def test_have_plain_words(self):
        found = list(list_messages.messages())
        self.assertGreater(len(found), 1000)
        for name, line, text in found:
            for fault in faults(text):
                with self.subTest(place=f"{name}:{line}"):
                    self.fail(f"{fault}, in: {text}")

    def test_are_found_in_both_languages(self):
        texts = {text for _, _, text in list_messages.messages(["app/film", "exporters/blender/addon"])}
        self.assertTrue(any("ffmpeg failed with exit code {}" in text for text in texts))
        self.assertTrue(any("checksum {} instead of {}" in text for text in texts))


#: Patterns of comments that have to be read twice, and what to write instead.
TELEGRAMS = (
    (r"^Likewise\b", "a sentence that names its subject"),
    (r"^(Of|What|Whether|Those|That of|Which)\b", "a sentence that begins with its subject: Returns, True if, The"),
    (r"\?$", "a statement: True if"),
    (r"(?<!\bare )(?<!\bequals )(?<!\bequal )(?<!\bthan )(?<!\bfrom )(?<!\blike )\bthose of\b", "the noun"),
    (r"\bwhose\b.*\bwhose\b", "two sentences"),
    (r"\bbeside\b", "in addition to, next to"),
    (r"\basked( for)?\b", "requested, given, set"),
    (r"\btold\b", "shown, reported, given"),
    (r"\b(nobody|somebody)\b", "no one, or the passive"),
    (r"\bwhom?ever\b", "anyone who"),
    (r"\b(stands|stood)\b(?! for\b)", "is, is written"),
)

SOURCE_KINDS = {".cpp", ".h", ".hpp", ".glsl", ".comp", ".frag", ".vert", ".py", ".js", ".sh", ".cmake"}


def comments(path):
    """Yields (line, text) of each comment of a source file: adjacent lines are one text."""
    mark = "#" if path.suffix in {".py", ".sh", ".cmake"} else "//"
    start, block = 0, []
    for number, line in enumerate([*path.read_text(encoding="utf-8").splitlines(), ""], 1):
        own = re.match(rf"\s*{mark}+<?!?(?: (.*)|$)", line)
        if own:
            start = start if block else number
            block.append(own[1] or "")
            continue
        if block:
            yield start, " ".join(block)
            block = []
        after = re.search(r"\S.*?\s//+<? (.*)", line) if mark == "//" else None
        if after:
            yield number, after[1]


def telegrams(text):
    """Returns the rows of TELEGRAMS that a comment meets, sentence by sentence. Quoted words and code do not count."""
    text = re.sub(r"`[^`]*`|\"[^\"]*\"", "x", text)
    return [f"{sentence[:60]!r}: write {instead}" for sentence in re.split(r"(?<=[.;:?!])\s+", text)
            for pattern, instead in TELEGRAMS if re.search(pattern, sentence.strip())]


class Sources(unittest.TestCase):
    def test_have_comments_that_are_sentences(self):
        checked = 0
        for folder in ("app", "core", "exporters", "gpu_shaders", "scripts"):
            for path in sorted((ROOT / folder).rglob("*.*")):
                if path.suffix not in SOURCE_KINDS:
                    continue
                checked += 1
                for line, text in comments(path):
                    for fault in telegrams(text):
                        with self.subTest(place=f"{path.relative_to(ROOT)}:{line}"):
                            self.fail(fault)
        self.assertGreater(checked, 400)

    def test_telegrams_are_found(self):
        for text in ("Of a run: must be one.", "Likewise.", "The atoms asked for.", "Is it closed?",
                     "A loop whose arcs lie on circles whose centres are equal."):
            self.assertTrue(telegrams(text), text)
        self.assertEqual(telegrams("Returns the frames of the run in order."), [])


def docstrings():
    """Yields (place, text) of the bindings' public text: docstrings of Python, comments of the headers for C and
    C++."""
    for path in sorted((ROOT / "exporters").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node):
                yield f"{path.relative_to(ROOT)}:{getattr(node, 'lineno', 1)}", ast.get_docstring(node)
    for path in sorted((ROOT / "exporters/bindings").rglob("meniscus/*.h*")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            comment = re.search(r"(?://+|/\*|^ \*)(.*)", line)
            if comment:
                yield f"{path.relative_to(ROOT)}:{number}", comment[1]


class Docstrings(unittest.TestCase):
    def test_have_plain_words(self):
        found = list(docstrings())
        self.assertGreater(len(found), 900)
        for place, text in found:
            for fault in faults(text):
                with self.subTest(place=place):
                    self.fail(fault)


class Patterns(unittest.TestCase):
    def test_meet_what_they_are_for_and_nothing_else(self):
        for text in ("it is no file", "leave --by away", "a line a frame", "bytes behind it", "what shall it be"):
            self.assertEqual(len(faults(text)), 1, text)
        for text in ("there is no file", "it is no longer there", "behind the camera", "stands for a value",
                     "one frame at a time", "leave it out"):
            self.assertEqual(faults(text), [], text)


class Properties(unittest.TestCase):
    def test_help_begins_with_a_short_sentence(self):
        """The rule holds for each option in the table of properties."""
        checked = 0
        for path in sorted((ROOT / "core/properties").glob("*_properties.cpp")):
            for line, text, before in list_messages.texts_of_cpp(path.read_text(encoding="utf-8")):
                if not re.search(r"\b(flag|number|count|word|text|file|new_file|camera) \( [, ]*$", before + " "):
                    continue
                if not list_messages.is_sentence(text):
                    continue
                checked += 1
                with self.subTest(place=f"{path.name}:{line}"):
                    self.assertLessEqual(len(re.split(r"\. (?=\S)", text)[0]), LONGEST_SENTENCE, text)
        self.assertGreater(checked, 150)


class Help(unittest.TestCase):
    program = None

    def test_has_plain_words(self):
        if not self.program:
            self.skipTest("no --program")
        for command in commands_of(self.program):
            for fault in faults(re.sub(r"\s+", " ", help_of(self.program, *command))):
                with self.subTest(command=command):
                    self.fail(fault)

    def test_pages_have_plain_words(self):
        if not self.program:
            self.skipTest("no --program")
        for topic in ("selections", "assemblies", "frames", "scenes", "exit-codes"):
            page = subprocess.run([self.program, "help", topic], capture_output=True, text=True, check=True).stdout
            for fault in faults(re.sub(r"\s+", " ", page)):
                with self.subTest(topic=topic):
                    self.fail(fault)


class Documents(unittest.TestCase):
    asked = False

    def test_have_plain_words(self):
        if not self.asked:
            self.skipTest("no --docs")
        for document in documents():
            for number, line in prose_of(document):
                for fault in faults(line):
                    with self.subTest(place=f"{document.relative_to(ROOT)}:{number}"):
                        self.fail(fault)


if __name__ == "__main__":
    arguments = sys.argv[1:]
    if "--docs" in arguments:
        Documents.asked = True
        arguments.remove("--docs")
    if "--program" in arguments:
        place = arguments.index("--program")
        Help.program = arguments[place + 1]
        del arguments[place:place + 2]
    unittest.main(argv=[sys.argv[0], *arguments])
