# SPDX-License-Identifier: BSD-3-Clause
"""The errors of the library as exceptions, one class for each status."""
from __future__ import annotations


class Error(Exception):
    """What the library refused or could not do, of which all others are kinds; its text is the library's own.

    >>> issubclass(meniscus.InputError, meniscus.Error)
    True"""


class InternalError(Error):
    """A fault of the library: please report it.

    >>> issubclass(meniscus.InternalError, meniscus.Error)
    True"""


class UsageError(Error, ValueError):
    """A call that is not valid for any molecule.

    >>> meniscus.surface([[0, 0, 0]], 1.7, kind="lee")
    Traceback (most recent call last):
        ...
    meniscus.UsageError: kind is 'lee', none of ses, sas, vdw"""


class InputError(Error, ValueError):
    """A position, radius, colour or camera that cannot be; the text has its index and value.

    >>> meniscus.surface([[0, 0, float("nan")]], 1.7)
    Traceback (most recent call last):
        ...
    meniscus.InputError: z of atom 0 is nan, not a finite number"""


class GpuError(Error, RuntimeError):
    """No usable GL or GPU, or one that left work undone.

    >>> issubclass(meniscus.GpuError, RuntimeError)
    True"""


class CapacityError(Error, MemoryError):
    """Out of memory or threads, or more than indices can count.

    >>> issubclass(meniscus.CapacityError, MemoryError)
    True"""


class OutputError(Error, OSError):
    """A file cannot be written, or is there already.

    >>> meniscus.surface([[0, 0, 0]], 1.7).mesh(0.5).save("no/folder.stl")
    Traceback (most recent call last):
        ...
    meniscus.OutputError: no/folder.stl: cannot be written in no: No such file or directory"""


class NotClosedError(Error):
    """The surface or mesh is not closed, so there is none.

    >>> issubclass(meniscus.NotClosedError, meniscus.Error)
    True"""


for _class in (Error, *Error.__subclasses__()):
    _class.__module__ = "meniscus"  # as programs and tracebacks name them
