# SPDX-License-Identifier: BSD-3-Clause
"""Loads libmeniscus, and calls its functions; their errors become exceptions of the package, in words of Python."""
from __future__ import annotations

import _thread
import atexit
import ctypes
import functools
import os
import pathlib
import platform
import re
import sys
import threading
from typing import Any, Callable, Optional

from . import _header as header
from ._errors import (CapacityError, Error, GpuError, InputError, InternalError, NotClosedError, OutputError,
                      UsageError, also, unknown_name)

_EXCEPTIONS: dict[int, type[Error]] = {
    header.INTERNAL: InternalError, header.USAGE: UsageError, header.INPUT: InputError, header.NO_GPU: GpuError,
    header.CAPACITY: CapacityError, header.OUTPUT: OutputError, header.NOT_CLOSED: NotClosedError}

#: Words of C and of the command line in messages, and those of the package.
_WORDS = [(re.compile(words), python) for words, python in (
    (r"use the program's --force to replace it", "replace=True replaces it"),
    (r", and format is NULL; the formats are ", "; give a format: "),
    (r": meniscus_atoms\.count is 0", ""),
    (r"\bprobe_radius\b", "probe"),
    (r"\blarge_probe_radius\b", "large_probe"),
    (r"give one colour, or atom_colors", "give one colour, or colors with one for each atom"),
    (r"or the van der Waals surface", 'or kind="vdw"'),
    (r"which MENISCUS_MESH_BY_DENSITY does not keep to; leave it at \S+", "which a mesh of a density does not keep to; "
     "leave it out"),
    (r"MENISCUS_ATOM_SAS_AREAS are of MENISCUS_SES surfaces; see MENISCUS_ATOM_AREAS",
     'atom_sas_areas are of surfaces of kind "ses"; atom_areas has those of other kinds'),
    (r"gradients of MENISCUS_GRADIENT_SAS_\.\.\. are of MENISCUS_SES surfaces; see MENISCUS_GRADIENT_AREA",
     'gradients of "sas_area" and "sas_volume" are of surfaces of kind "ses"; "area" and "volume" are those of others'),
    (r"a surface of MENISCUS_SES", 'a surface of kind "ses"'),
    (r"meniscus_render_scene\(\)", "a meniscus.Scene"),
    (r"lists atoms without coordinates; add trajectory with a file that has them",
     "lists atoms without coordinates; meniscus.frames(trajectory, topology=...) reads both"),
    (r"(\.(?:xtc|trr|dcd|nc|ncdf|nctraj|h5md|lammpstrj)): is in none of the formats that are read .*",
     r"\1: is a trajectory; meniscus.frames(trajectory, topology=...) reads it"),
    (r"the program's --(\w+)", r"the program's option \1"))]

#: The ends of messages about files, and Python's exceptions for them.
_ABOUT_FILES: tuple[tuple[str, type[Exception]], ...] = (
    ("No such file or directory", FileNotFoundError), ("Permission denied", PermissionError),
    ("Operation not permitted", PermissionError), ("Read-only file system", PermissionError),
    ("Is a directory", IsADirectoryError), ("is a folder; give the name of a molecule file", IsADirectoryError),
    ("Not a directory", NotADirectoryError))


def in_words_of_python(message: str) -> str:
    """Returns a message of the library with the names that the package has."""
    for words, python in _WORDS:
        message = words.sub(python, message)
    return message


def about_file(base: type[Error], message: str, file: Optional[str] = None) -> Error:
    """Returns an error about a file, which is also Python's exception for the reason that the message ends with."""
    path = message.split(": ")[0] if file is None else file
    if ": exists already; " in message:
        return also(base, (FileExistsError,), message, path)
    kind = next((kind for end, kind in _ABOUT_FILES if message.endswith(end)), None)
    if kind is None and isinstance(base, type) and issubclass(base, OutputError) and os.path.isdir(path):
        kind = IsADirectoryError
    return base(message) if kind is None else also(base, (kind,), message, path)


def error_of(status: int, message: str) -> Error:
    """Returns the exception of a call that failed. message: that of meniscus_last_error()."""
    text = in_words_of_python(message)
    base = _EXCEPTIONS.get(status, Error)
    if base is UsageError and (text.endswith(" is not a value of a scene") or "; did you mean " in text):
        return unknown_name(text)
    return about_file(base, text) if base in (InputError, OutputError) else base(text)


def _wait_for(done: Any) -> None:
    """Waits for an interrupted function before Python ends, because the library cannot end while it computes. Another
    Ctrl-C ends the process. done: the lock that is released when the function ends."""
    try:
        done.acquire()
    except KeyboardInterrupt:
        os._exit(130)


def interruptible(function: Callable[[], Any]) -> Any:
    """Returns the result of a function, which has to end by itself.

    In the main thread another thread runs it. After Ctrl-C this function raises KeyboardInterrupt at once. The other
    thread finishes the function and drops the result. Until then it keeps the variables of all callers alive, because
    the library reads their arrays."""
    if threading.current_thread() is not threading.main_thread():
        return function()
    done = _thread.allocate_lock()
    kept: list[Any] = []
    finished = False
    result: Any = None
    error: Any = None

    def run() -> None:
        nonlocal error, finished, result
        try:
            result = function()
        except BaseException as raised:
            error = raised
        finished = True
        kept.clear()
        done.release()

    done.acquire()
    try:
        _thread.start_new_thread(run, ())
        done.acquire()
    except BaseException:
        frame: Any = sys._getframe()
        while frame is not None and not finished:
            kept.append(frame)
            frame = frame.f_back
        if not finished:  # otherwise this thread may have the lock
            atexit.register(_wait_for, done)  # called before the exit functions of the package
        raise
    if error is not None:
        raise error
    return result


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
