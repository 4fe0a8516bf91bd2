# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of the package: one class for each status of meniscus.h."""
from __future__ import annotations


class Error(Exception):
    """The base class of all errors of the library. The text is the library's message.

    >>> issubclass(meniscus.InputError, meniscus.Error)
    True"""


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
