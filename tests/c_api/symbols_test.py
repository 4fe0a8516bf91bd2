# SPDX-License-Identifier: BSD-3-Clause
"""symbols_test.py LIBRARY HEADER: the shared library exports exactly what the header declares, and needs few other
symbols."""
import pathlib
import re
import subprocess
import sys

library, header = sys.argv[1:]
declared = set(re.findall(r"^MENISCUS_API [^;(]*?\b(meniscus_\w+)\(", pathlib.Path(header).read_text(), re.M))
assert len(declared) > 20, declared
listed = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
defined = {line.split()[-1].split("@")[0] for line in listed.splitlines()}
defined.discard("MENISCUS_0")  # the version's own name
assert defined == declared, f"only in the library: {defined - declared}; only in the header: {declared - defined}"

dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
assert "Library soname: [libmeniscus.so.0]" in dynamic, dynamic
assert "RPATH" not in dynamic and "RUNPATH" not in dynamic, dynamic
needed = set(re.findall(r"NEEDED.*\[(\w+)", dynamic))
allowed = {"libtbb", "libfmt", "libepoxy", "libfreetype", "libz", "libstdc", "libm", "libgcc_s", "libc", "ld"}
assert needed <= allowed, f"needs {needed - allowed}, too"
print(f"{len(defined)} functions; needs {', '.join(sorted(needed))}")
