# SPDX-License-Identifier: BSD-3-Clause
"""The errors of the library as exceptions, a class a status."""
from __future__ import annotations


class Error(Exception):
    """What the library refused or could not do; its text is the library's own."""


class InternalError(Error):
    """A fault of the library: please report it."""


class UsageError(Error, ValueError):
    """A call that makes no sense."""


class InputError(Error, ValueError):
    """A position, radius, colour or camera that cannot be; the text has its index and value."""


class GpuError(Error, RuntimeError):
    """No usable GL or GPU, or one that left work undone."""


class CapacityError(Error, MemoryError):
    """Out of memory or threads, or more than indices can count."""


class OutputError(Error, OSError):
    """A file cannot be written, or is there already."""


class NotClosedError(Error):
    """The surface or mesh is not closed, so there is none."""
