# SPDX-License-Identifier: BSD-3-Clause
"""document_test.py FILE...: what the documents show is true: their Python runs, one block after the other, beside files
1ubq.pdb and 1tii.pdb; and each line with "# 12.3" at its end gives that number, or those numbers."""
import os
import pathlib
import re
import shutil
import sys
import tempfile

sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

MOLECULES = [pathlib.Path("/usr/share/freesasa/test-data/1ubq.pdb"), pathlib.Path("/usr/share/pymol/data/demo/1tii.pdb")]
for molecule in MOLECULES:
    if not molecule.exists():
        print(f"skipped: there is no {molecule}; Debian's freesasa and pymol-data have these")
        sys.exit(77)


def checked_in(document):
    """Returns how many numbers a document shows; all must be right."""
    names = {"__name__": "document"}
    checked = 0
    for block in re.findall(r"```python\n(.*?)```", document.read_text(), re.S):
        exec(compile(block, str(document), "exec"), names)
        for line in block.splitlines():
            shown = re.fullmatch(r"(\S.*?) +# +([-0-9][-0-9., ]*)", line)
            if not shown or "=" in shown[1].split("(")[0]:
                continue
            value = eval(shown[1], names)
            written = [float(part) for part in shown[2].replace(",", " ").split()]
            found = np.ravel(np.asarray(value, dtype=float))
            assert found.shape == (len(written),) and np.allclose(found, written, atol=0.006), f"{document}: {line}: it is {value}"
            checked += 1
    print(f"{document.name}: {checked} values")
    return checked


documents = [pathlib.Path(name).resolve() for name in sys.argv[1:]]
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for molecule in MOLECULES:
        shutil.copy(molecule, folder)
    checked = sum(checked_in(document) for document in documents)
    os.chdir("/")
sys.exit(0 if checked >= 5 * len(documents) else 1)
