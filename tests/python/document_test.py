# SPDX-License-Identifier: BSD-3-Clause
"""document_test.py FILE: what the document shows is true: its Python runs, one block after the other, and each line with
"# 12.3" at its end gives that number, or that text."""
import os
import pathlib
import re
import sys

sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

document = pathlib.Path(sys.argv[1]).read_text()
names = {"__name__": "document"}
checked = 0
for block in re.findall(r"```python\n(.*?)```", document, re.S):
    exec(compile(block, sys.argv[1], "exec"), names)
    for line in block.splitlines():
        shown = re.fullmatch(r"(\S.*?) +# +([-0-9][-0-9., ]*)", line)
        if not shown or "=" in shown[1].split("(")[0]:
            continue
        value = eval(shown[1], names)
        told = [float(part) for part in shown[2].replace(",", " ").split()]
        found = np.ravel(np.asarray(value, dtype=float))
        assert found.shape == (len(told),) and np.allclose(found, told, atol=0.006), f"{line}: it is {value}"
        checked += 1
print(f"{checked} values")
sys.exit(0 if checked >= 5 else 1)
