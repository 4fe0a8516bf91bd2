# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of the package: one class for each status of meniscus.h, which may have an exception of Python as a
second base."""
from __future__ import annotations

import errno
import functools
import sys
import warnings
from typing import Any


class Error(Exception):
    """The base class of all errors of the library. The text is the library's message. Errors of files, types and names
    are also instances of Python's own exceptions, such as FileNotFoundError, TypeError and KeyError.

    >>> issubclass(meniscus.InputError, meniscus.Error)
    True
    >>> try:
    ...     meniscus.read("none.pdb")
    ... except FileNotFoundError as error:
    ...     isinstance(error, meniscus.InputError), error.filename
    (True, 'none.pdb')"""

    def __str__(self) -> str:  # KeyError would quote the message
        return str(self.args[0]) if self.args else ""


class InternalError(Error):
    """A bug in the library. Please report it.

    >>> issubclass(meniscus.InternalError, meniscus.Error)
    True"""


class UsageError(Error, ValueError):
    """A call that is invalid for every molecule, such as an unknown option.

    >>> meniscus.surface([[0, 0, 0]], 1.7, kind="lee")
    Traceback (most recent call last):
        ...
    meniscus.UsageError: kind is 'lee', none of ses, sas, vdw"""


class InputError(Error, ValueError):
    """An impossible position, radius, colour or camera, or a file that cannot be read. The text has the index and the
    value.

    >>> meniscus.surface([[0, 0, float("nan")]], 1.7)
    Traceback (most recent call last):
        ...
    meniscus.InputError: z of atom 0 is nan, not a finite number"""


class GpuError(Error, RuntimeError):
    """There is no usable GL or GPU, or it dropped work.

    >>> issubclass(meniscus.GpuError, RuntimeError)
    True"""


class CapacityError(Error, MemoryError):
    """There is not enough memory or threads, or there are more items than an index can count.

    >>> issubclass(meniscus.CapacityError, MemoryError)
    True"""


class OutputError(Error, OSError):
    """A file cannot be written, or it exists already.

    >>> meniscus.surface([[0, 0, 0]], 1.7).mesh(0.5).save("no/folder.stl")
    Traceback (most recent call last):
        ...
    meniscus.OutputError: no/folder.stl: cannot be written in no: No such file or directory"""


class NotClosedError(Error):
    """The surface or mesh would not be closed, so it is not returned.

    >>> issubclass(meniscus.NotClosedError, meniscus.Error)
    True"""


for _class in (Error, *Error.__subclasses__()):
    _class.__module__ = "meniscus"  # tracebacks print the public name


#: The error numbers of Python's exceptions about files.
_NUMBERS: dict[type[Exception], int] = {
    FileNotFoundError: errno.ENOENT, PermissionError: errno.EACCES, IsADirectoryError: errno.EISDIR,
    NotADirectoryError: errno.ENOTDIR, FileExistsError: errno.EEXIST}


@functools.lru_cache(maxsize=None)
def _both(base: Any, kinds: tuple[type[Exception], ...]) -> Any:
    """Returns a class with the name of `base` that has other exceptions as bases, too."""
    def reduced(self: Any) -> tuple[Any, ...]:
        return also, (base, kinds, str(self), getattr(self, "filename", None))

    names = {"__module__": "meniscus", "__doc__": base.__doc__, "__reduce__": reduced}
    return type(base.__name__, (base, *kinds), names)


def also(base: type[Error], kinds: tuple[type[Exception], ...], message: str, file: Any = None) -> Error:
    """Returns an error of class `base` that is caught as one of `kinds`, too. file: the path of an error about a file,
    which becomes its `filename`."""
    both: Any = base  # mypy does not know that it is hashable
    error: Error = _both(both, kinds)(message)
    number = next((_NUMBERS[kind] for kind in kinds if kind in _NUMBERS), None)
    if number is not None and isinstance(error, OSError):
        error.errno, error.filename = number, file
    return error


def wrong_type(message: str) -> Error:
    """Returns an InputError that is a TypeError, too."""
    return also(InputError, (TypeError,), message)


def unknown_name(message: str) -> Error:
    """Returns a UsageError about a name that does not exist, which is a KeyError and an AttributeError, too."""
    return also(UsageError, (KeyError, AttributeError), message)


def warn(message: str, category: type[Warning] = UserWarning) -> None:
    """Warns of something in the code that called the package."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("meniscus."):
        level, frame = level + 1, frame.f_back
    warnings.warn(message, category, stacklevel=level)
