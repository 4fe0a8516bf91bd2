#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Describes shared libraries and programs of any system without running them: the processor, the oldest system, the libraries that
they need, and the number of functions of a library.

describe_library.py FILE...     needs lief from PyPI. The exit code is 1 if a file needs a library that is not part of its system,
if it uses a mathematical function of the system, whose last digit depends on the system, or if a library exports other names than
meniscus_*."""

import os
import re
import sys

import lief


#: Mathematical functions whose rounding no standard defines, without the suffix for float and long double.
INEXACT = set("acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp10 exp2 expm1 hypot lgamma log log10 log1p log2 pow "
              "sin sincos sinh tan tanh tgamma".split())


def of_system(binary):
    """Returns the mathematical functions that a file imports."""
    if isinstance(binary, lief.PE.Binary):
        names = {entry.name for library in binary.imports for entry in library.entries}
    else:
        names = {symbol.name for symbol in binary.imported_symbols}
    return sorted({name.lstrip("_").partition("@")[0] for name in names} & (INEXACT | {name + suffix for name in INEXACT for suffix in "fl"}))


#: The libraries that are part of glibc, Windows and macOS.
OF_SYSTEMS = re.compile(r"lib(c|dl|m|pthread|rt)\.so\.\d$|ld-linux-.*|api-ms-win-crt-.*|(kernel32|shell32|ws2_32|mswsock|advapi32)\.dll$|"
                        r"/usr/lib/libSystem\.B\.dylib$", re.IGNORECASE)


def versions(names):
    """Returns the highest version in names such as GLIBC_2.17."""
    numbers = [tuple(map(int, found[1].split("."))) for found in (re.match(r"GLIBC_([0-9.]+)$", n) for n in names) if found]
    return "glibc " + ".".join(map(str, max(numbers))) if numbers else "no version of glibc"


def of_elf(binary):
    """Returns the processor, the oldest system, the libraries and the exported names of an ELF file; None for the names of a program.

    of_pe() and of_macho() do the same for files of Windows and macOS."""
    needs = [version for requirement in binary.symbols_version_requirement for version in
             (auxiliary.name for auxiliary in requirement.get_auxiliary_symbols())]
    names = {symbol.name for symbol in binary.exported_symbols}
    return binary.header.machine_type.name, versions(needs), list(binary.libraries), None if binary.has_interpreter else names


def of_pe(binary):
    version = f"Windows {binary.optional_header.major_subsystem_version}.{binary.optional_header.minor_subsystem_version}"
    return (binary.header.machine.name, version, [entry.name for entry in binary.imports],
            [entry.name for entry in binary.get_export().entries] if binary.has_exports else None)


def of_macho(binary):
    version = "macOS " + ".".join(map(str, binary.build_version.minos[:2]))
    own = binary.id_dylib.name if hasattr(binary, "id_dylib") else ""
    return (binary.header.cpu_type.name, version,
            [library.name for library in binary.libraries if library.name != own and "meniscus" not in library.name],
            [symbol.name.lstrip("_") for symbol in binary.exported_symbols] if hasattr(binary, "id_dylib") else None)


def describe(path):
    """Returns a line about a file, and whether the file is correct."""
    binary = lief.parse(path)
    if isinstance(binary, lief.ELF.Binary):
        facts = of_elf(binary)
    elif isinstance(binary, lief.PE.Binary):
        facts = of_pe(binary)
    elif isinstance(binary, lief.MachO.Binary):
        facts = of_macho(binary)
    else:
        sys.exit(f"{path}: not of a known system")
    machine, oldest, needed, names = facts
    line = f"{machine}, {oldest}; needs {', '.join(needed)}"
    strange = [name for name in needed if not OF_SYSTEMS.match(name)]
    if strange:
        line += f", of which no system brings {', '.join(strange)}"
    taken = of_system(binary)
    if taken:
        line += f"; takes {', '.join(taken)} from the system"
    if names is None:
        return line, not (strange or taken)
    ours = [name for name in names if name.startswith("meniscus_")]
    foreign = sorted(name for name in set(names) - set(ours) if not re.match(r"MENISCUS_|_fini$|_init$", name))
    line += f"; {len(ours)} functions" + (f" and {len(foreign)} foreign names, such as {foreign[0]}" if foreign else "")
    return line, not (strange or taken or foreign) and bool(ours)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    fine = True
    for path in sys.argv[1:]:
        line, well = describe(path)
        print(f"{os.path.basename(path):25} {os.path.getsize(path):9} bytes  {line}")
        fine = fine and well
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
