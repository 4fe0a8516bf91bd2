# SPDX-License-Identifier: BSD-3-Clause
"""Loads libmeniscus, and calls its functions; their errors become exceptions."""
from __future__ import annotations

import ctypes
import functools
import os
import pathlib
import platform
import re
import sys
from typing import Any, Callable

from . import _header as header
from ._calls import interruptible
from ._messages import error_of

#: The functions that may take longer than a tenth of a second, whatever the molecule.
_LONG = frozenset(("read", "surface_pockets", "surface_mesh", "mesh_save", "render", "render_scene", "scene_page",
                   "surface_page"))

_ELF_MACHINES = {3: "i386", 62: "x86_64", 183: "arm64"}
#: Debian packages that are not named after their library.
_PACKAGES = {"libz.so.1": "zlib1g"}
_NAMES = {"Darwin": "macOS", "AMD64": "x86_64", "aarch64": "arm64", "ARM64": "arm64"}


def _content(file: str) -> bytes:
    """Returns the bytes of a file, or none if it cannot be read."""
    try:
        with open(file, "rb") as opened:
            return opened.read()
    except OSError:
        return b""


def _made_for(content: bytes) -> str:
    """Returns the system for which a library was built, as its first bytes tell; "" if they do not."""
    if content[:4] == b"\x7fELF" and len(content) >= 20:
        number = int.from_bytes(content[18:20], "little" if content[5] == 1 else "big")
        return f"Linux on {_ELF_MACHINES.get(number, f'machine {number}')}"
    if content[:4] in (b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"):
        return "macOS"
    return "Windows" if content[:2] == b"MZ" else ""


def why_not_loaded(file: str, error: OSError) -> str:
    """Returns a sentence about why the file cannot be loaded, and what to do. error: that of the system's loader."""
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


def _place() -> str:
    """Returns the path or name of the library: MENISCUS_LIBRARY if it is set, else the file in the package's folder,
    else the library of the system."""
    named = os.environ.get("MENISCUS_LIBRARY")
    if named:
        return named
    own = {"win32": "meniscus.dll", "darwin": "libmeniscus.dylib"}.get(sys.platform, "libmeniscus.so")
    packaged = pathlib.Path(__file__).with_name(own)
    if packaged.exists():
        return str(packaged)
    if sys.platform == "linux":
        return "libmeniscus.so.0"
    import ctypes.util  # here, because this import is slow
    return ctypes.util.find_library("meniscus") or own


@functools.lru_cache(maxsize=None)
def _library() -> ctypes.CDLL:
    """Returns libmeniscus with its prototypes. The first call loads it."""
    place = _place()
    try:
        dll = ctypes.CDLL(place)
    except OSError as error:
        raise ImportError("libmeniscus cannot be loaded: " + why_not_loaded(place, error)) from None
    for name, (result, arguments) in header.FUNCTIONS.items():
        try:
            function = getattr(dll, "meniscus_" + name)
        except AttributeError:
            raise ImportError(f"{place} has no meniscus_{name}(): it is not libmeniscus, or of another version than this "
                              "package; install both of one version") from None
        function.argtypes, function.restype = arguments, result
    return dll


def call(name: str, *arguments: Any, long: bool = False) -> None:
    """Calls meniscus_NAME and raises an error if its status is not OK. Other Python threads run during the call.

    long: whether the call may take longer than a tenth of a second, so that Ctrl-C has to interrupt it."""
    dll = _library()
    function = getattr(dll, "meniscus_" + name)

    def result() -> tuple[int, bytes]:
        status = function(*arguments)
        return status, dll.meniscus_last_error() if status != header.OK else b""

    status, message = interruptible(result) if long or name in _LONG else result()
    if status != header.OK:
        raise error_of(status, message.decode("utf-8", "replace"))


def default(name: str, struct: Any) -> Any:
    """Fills a struct with the defaults of meniscus_default_NAME, and returns it."""
    struct.size = ctypes.sizeof(struct)
    call("default_" + name, ctypes.byref(struct))
    return struct


class Handle:
    """One reference to an object of the library, which is released when this object is deleted."""

    def __init__(self, kind: str, make: str, *arguments: Any, long: bool = False) -> None:
        """kind: as in meniscus_KIND_release. make: the function meniscus_MAKE that creates the object. arguments: those
        of meniscus_MAKE but for the last, which returns the object. long: see call()."""
        self.pointer: ctypes.c_void_p = ctypes.c_void_p()
        self._release: Callable[[ctypes.c_void_p], None] = getattr(_library(), f"meniscus_{kind}_release")
        call(make, *arguments, ctypes.byref(self.pointer), long=long)

    def __del__(self) -> None:
        # Uses no name of this module, because Python deletes those first when it exits.
        if self.pointer:
            self._release(self.pointer)
            self.pointer.value = None


def version() -> str:
    """Returns the version of the loaded library, which meniscus.__version__ is, too.

    >>> meniscus.version() == meniscus.__version__
    True"""
    return str(_library().meniscus_version().decode())


def library_path() -> str:
    """Returns the path or name of the loaded library.

    >>> "meniscus" in meniscus.library_path()
    True"""
    return _library()._name
