# SPDX-License-Identifier: BSD-3-Clause
"""The installed manual pages: one for each command and topic, without warnings, with every option of the help."""

import gzip
import re
import shutil
import unittest

from installation import Installation


OTHER_PROGRAMS = {f"meniscus-{name}.1.gz" for name in ("msms", "nanoshaper", "pdb_to_xyzr", "pdb_to_xyzrn")}


class Manual(Installation):
    def pages(self, section):
        pages = sorted((self.prefix / f"share/man/man{section}").glob(f"*.{section}.gz"))
        self.assertTrue(pages)
        return pages

    def test_every_command_has_its_page(self):
        names = {"-".join(["meniscus", *words]) + ".1.gz" for words in self.commands()}
        self.assertEqual(names | OTHER_PROGRAMS, {page.name for page in self.pages(1)})

    def test_every_topic_has_its_page(self):
        names = ("selections", "scenes", "assemblies", "frames", "exit-codes")
        self.assertEqual({f"meniscus-{name}.7.gz" for name in names}, {page.name for page in self.pages(7)})
        for name in names:
            page = gzip.decompress((self.prefix / f"share/man/man7/meniscus-{name}.7.gz").read_bytes()).decode().replace("\\-", "-")
            last = self.good(self.program, "help", name).stdout.split()[-1]
            self.assertIn(last, page, name)

    def test_exit_codes_are_those_of_the_manual(self):
        page = gzip.decompress((self.prefix / "share/man/man1/meniscus-render.1.gz").read_bytes()).decode()
        self.assertEqual(re.findall(r"^  (\d)  ", page, re.M), list("0123456789"))

    def test_every_option_of_msms_is_in_its_page(self):
        told = self.good(self.prefix / "bin/meniscus-msms", "-h").stderr
        text = gzip.decompress((self.prefix / "share/man/man1/meniscus-msms.1.gz").read_bytes()).decode().replace("\\-", "-")
        options = re.findall(r"^  (-\w+)", told, re.M)
        self.assertGreater(len(options), 10)
        for name in options:
            self.assertIn(f"\\fB{name}\\fR", text)

    def test_every_option_of_the_help_is_in_the_page(self):
        for words in self.commands():
            page = self.prefix / "share/man/man1" / ("-".join(["meniscus", *words]) + ".1.gz")
            text = gzip.decompress(page.read_bytes()).decode().replace("\\-", "-")
            options = self.options(words)
            self.assertIn("--help", options)
            for name in options:
                self.assertIn(f"\\fB{name}\\fR", text, page.name)

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_man_has_no_warning(self):
        for page in self.pages(1) + self.pages(7):
            done = self.good("man", "--warnings", "-E", "UTF-8", "-Tutf8", "-Z", "-l", page,
                             env={"LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80", "PATH": "/usr/bin:/bin"})
            self.assertEqual(done.stderr, "", page.name)

    @unittest.skipUnless(shutil.which("mandoc"), "mandoc is not installed")
    def test_mandoc_has_no_warning(self):
        for page in self.pages(1) + self.pages(7):
            plain = self.folder / page.stem
            plain.write_bytes(gzip.decompress(page.read_bytes()))
            self.assertEqual(self.good("mandoc", "-Tlint", "-Wwarning", plain).stdout, "", page.name)


if __name__ == "__main__":
    unittest.main()
