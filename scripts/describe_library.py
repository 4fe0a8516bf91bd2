#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells of a shared library of any system what can be told without loading it: the processor, the oldest system, the
libraries that it needs, and how many functions it gives.

describe_library.py FILE      needs lief, of PyPI. Exit code 1 if it gives other names than meniscus_*, or takes a mathematical
function from the system, whose last digit is that of the system."""

import re
import sys

import lief


#: Those that no standard rounds exactly, without the suffix of float and long double.
INEXACT = set("acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp10 exp2 expm1 hypot lgamma log log10 log1p log2 pow "
              "sin sincos sinh tan tanh tgamma".split())


def of_system(binary):
    """Mathematical functions that the library takes from elsewhere."""
    if isinstance(binary, lief.PE.Binary):
        names = {entry.name for library in binary.imports for entry in library.entries}
    else:
        names = {symbol.name for symbol in binary.imported_symbols}
    return sorted({name.lstrip("_").partition("@")[0] for name in names} & (INEXACT | {name + suffix for name in INEXACT for suffix in "fl"}))


def versions(names):
    """The highest of GLIBC_2.17 and the like."""
    numbers = [tuple(map(int, found[1].split("."))) for found in (re.match(r"GLIBC_([0-9.]+)$", n) for n in names) if found]
    return "glibc " + ".".join(map(str, max(numbers))) if numbers else "no version of glibc"


def of_elf(binary):
    needs = [version for requirement in binary.symbols_version_requirement for version in
             (auxiliary.name for auxiliary in requirement.get_auxiliary_symbols())]
    names = {symbol.name for symbol in binary.exported_symbols}
    return binary.header.machine_type.name, versions(needs), list(binary.libraries), names


def of_pe(binary):
    version = f"Windows {binary.optional_header.major_subsystem_version}.{binary.optional_header.minor_subsystem_version}"
    return (binary.header.machine.name, version, [entry.name for entry in binary.imports],
            [entry.name for entry in binary.get_export().entries])


def of_macho(binary):
    version = "macOS " + ".".join(map(str, binary.build_version.minos[:2]))
    own = binary.id_dylib.name if hasattr(binary, "id_dylib") else ""
    return (binary.header.cpu_type.name, version,
            [library.name for library in binary.libraries if library.name != own and "meniscus" not in library.name],
            [symbol.name.lstrip("_") for symbol in binary.exported_symbols])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    binary = lief.parse(sys.argv[1])
    if isinstance(binary, lief.ELF.Binary):
        facts = of_elf(binary)
    elif isinstance(binary, lief.PE.Binary):
        facts = of_pe(binary)
    elif isinstance(binary, lief.MachO.Binary):
        facts = of_macho(binary)
    else:
        sys.exit(f"{sys.argv[1]}: not a shared library of a known system")
    machine, oldest, needed, names = facts
    ours = [name for name in names if name.startswith("meniscus_")]
    taken = of_system(binary)
    foreign = sorted(name for name in set(names) - set(ours) if not re.match(r"MENISCUS_|_fini$|_init$", name))
    print(f"{machine}, {oldest}; needs {', '.join(needed)}; {len(ours)} functions" +
          (f" and {len(foreign)} foreign names, such as {foreign[0]}" if foreign else "") +
          (f"; takes {', '.join(taken)} from the system" if taken else ""))
    return 1 if foreign or taken or not ours else 0


if __name__ == "__main__":
    sys.exit(main())
