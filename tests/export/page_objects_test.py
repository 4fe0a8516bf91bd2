# SPDX-License-Identifier: BSD-3-Clause
"""Objects next to a surface, in a page and by `render`: arguments PROGRAM CHROMIUM FREESASA_DATA."""

import json
import os
import subprocess
import sys
import unittest

from figure_page import PROGRAM, SIZE, UBIQUITIN, PageCase


class PageObjectsTest(PageCase):
    def object(self, selection, representation="surface", **look):
        return "--object", json.dumps({"representation": representation, "selection": selection, **look})

    async def test_objects_are_those_of_render(self):
        part = self.part_of(UBIQUITIN, 1, 24)
        async with self.browser() as page:
            # Objects stand next to an opaque surface, next to a cut one, and are transparent themselves.
            await self.compare(page, part, "--show", "resid 1-12", "--color", "residue", *self.object("resid 13-24", color="orange"),
                               *self.object("resid 1-24", representation="sticks", color="element"))
            await self.compare(page, part, "--color", "kind", "--clip", "depth>0.4", *self.object("resid 5-9", kind="vdw"),
                               *self.object("resid 20-24", representation="balls", color="teal"))
            await self.compare(page, part, "--surface", "vdw", "--color", "residue", *self.object("all", color="grey", opacity=0.4))
            await self.shoot(page, "page_objects.png")
            # Another scheme colours only objects without a colour of their own.
            await self.load(page, self.export(part, "--size", "%dx%d" % SIZE, "--color", "residue", *self.object("resid 3-9", kind="sas"),
                                              *self.object("resid 10-14", kind="sas", color="orange")))
            await page.evaluate("meniscus.set_scheme(meniscus.figure.schemes.findIndex(({ name }) => name === 'kind'))")
            self.check("by kind", await self.cast(page), self.rendered(part, "--color", "kind", *self.object("resid 3-9", kind="sas"),
                                                                       *self.object("resid 10-14", kind="sas", color="orange")))
            self.assertEqual(page.complaints, [])
        for words, options in (("only one surface that is cut or transparent", ["--opacity", "0.5", *self.object("resid 1-5", opacity=0.5)]),
                               ("surfaces of one probe", self.object("all", probe=2)), ("their own material", self.object("all", specular=0.5)),
                               ("coloured by kind of patch", self.object("all", color="kind")), ("coloured by a map", ["--color", "lipophilicity", *self.object("all")]),
                               ("transparent sticks", self.object("all", representation="sticks", opacity=0.5))):
            done = subprocess.run([PROGRAM, "export", "page", part, "-o", self.path("bad.html"), *options], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, f"error: --object: pages (show|do not show) .*{words}")
            self.assertFalse(os.path.exists(self.path("bad.html")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
