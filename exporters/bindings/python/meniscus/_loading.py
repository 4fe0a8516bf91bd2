# SPDX-License-Identifier: BSD-3-Clause
"""Why a library cannot be loaded, and what to do about it, in one sentence."""
from __future__ import annotations

import platform
import re

_ELF_MACHINES = {3: "i386", 62: "x86_64", 183: "arm64"}
_NAMES = {"Darwin": "macOS", "AMD64": "x86_64", "aarch64": "arm64", "ARM64": "arm64"}


def _made_for(file: str) -> str:
    """The system that the first bytes of a file name; "" if they name none."""
    try:
        with open(file, "rb") as opened:
            head = opened.read(20)
    except OSError:
        return ""
    if head[:4] == b"\x7fELF" and len(head) == 20:
        number = int.from_bytes(head[18:20], "little" if head[5] == 1 else "big")
        return f"Linux on {_ELF_MACHINES.get(number, f'machine {number}')}"
    if head[:4] in (b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"):
        return "macOS"
    return "Windows" if head[:2] == b"MZ" else ""


def why_not_loaded(file: str, error: OSError) -> str:
    """In place of the loader's own words, which leave out what to do."""
    system, machine = (_NAMES.get(name, name) for name in (platform.system(), platform.machine()))
    made_for, here = _made_for(file), f"{system} on {machine}"
    if made_for and not here.startswith(made_for):
        return f"{file} is for {made_for}, and this is {here}: install the package for this system"
    text = str(error)
    version = re.search(r"version `([A-Z]+)_([\d.]+)' not found", text)
    if version and version[1] == "GLIBC":
        return (f"{file} needs glibc {version[2]}, and this system has {platform.libc_ver()[1]}: install a package that "
                "was made for this system, or build it here")
    if version:
        return f"{file} needs a newer libstdc++, with {version[1]}_{version[2]}: install that, or build it here"
    missing = re.match(r"(lib[^/:]+): cannot open shared object file", text)
    if missing and missing[1] != file:
        package = missing[1].replace(".so.", "")
        return f"{file} needs {missing[1]}, which is not installed: apt-get install {package}, on Debian and Ubuntu"
    if re.search("file too short|invalid ELF header", text):
        return f"{file} is damaged, or not a library: install it again"
    return text
