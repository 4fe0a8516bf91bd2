# SPDX-License-Identifier: BSD-3-Clause
"""Explains in one sentence why a library cannot be loaded, and what to do."""
from __future__ import annotations

import platform
import re

_ELF_MACHINES = {3: "i386", 62: "x86_64", 183: "arm64"}
_PACKAGES = {"libz.so.1": "zlib1g"}  # that are not named after their library
_NAMES = {"Darwin": "macOS", "AMD64": "x86_64", "aarch64": "arm64", "ARM64": "arm64"}


def _content(file: str) -> bytes:
    try:
        with open(file, "rb") as opened:
            return opened.read()
    except OSError:
        return b""


def _made_for(content: bytes) -> str:
    """The system that the first bytes of a file name; "" if they name none."""
    if content[:4] == b"\x7fELF" and len(content) >= 20:
        number = int.from_bytes(content[18:20], "little" if content[5] == 1 else "big")
        return f"Linux on {_ELF_MACHINES.get(number, f'machine {number}')}"
    if content[:4] in (b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"):
        return "macOS"
    return "Windows" if content[:2] == b"MZ" else ""


def why_not_loaded(file: str, error: OSError) -> str:
    """In place of the loader's own words, which leave out what to do."""
    system, machine = (_NAMES.get(name, name) for name in (platform.system(), platform.machine()))
    content = _content(file)
    made_for, here = _made_for(content), f"{system} on {machine}"
    if made_for and not here.startswith(made_for):
        return f"{file} is for {made_for}, and this is {here}: install the package for this system"
    if system == "Linux" and b"GLIBC_2." in content and platform.libc_ver()[0] != "glibc":
        return (f"{file} is for Linux with glibc, and this one has another C library, as Alpine has musl: build it here, "
                "or use a system with glibc")
    text = str(error)
    version = re.search(r"version `([A-Z]+)_([\d.]+)' not found", text)
    if version and version[1] == "GLIBC":
        return (f"{file} needs glibc {version[2]}, and this system has {platform.libc_ver()[1]}: install a package that "
                "was made for this system, or build it here")
    if version:
        return f"{file} needs a newer libstdc++, with {version[1]}_{version[2]}: install that, or build it here"
    missing = re.match(r"(lib[^/:]+): cannot open shared object file", text)
    if missing and missing[1] != file:
        package = _PACKAGES.get(missing[1], missing[1].replace(".so.", ""))
        return f"{file} needs {missing[1]}, which is not installed: apt-get install {package}, on Debian and Ubuntu"
    if re.search("file too short|invalid ELF header", text):
        return f"{file} is damaged, or not a library: install it again"
    return f"{text}; install it, or set MENISCUS_LIBRARY to its file"
