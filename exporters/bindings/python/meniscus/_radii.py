# SPDX-License-Identifier: BSD-3-Clause
"""Van der Waals radii by element, from the library's own table."""
from __future__ import annotations

from collections.abc import Iterable
from ctypes import byref, c_double, c_int32
from typing import Union

import numpy as np

from ._errors import InputError
from ._library import call, listed, whole_number
from ._types import Floats


def _element(symbol: str) -> int:
    number = c_int32()
    call("element_of_symbol", symbol.strip().encode(), byref(number))
    return number.value


def _radius(element: int) -> float:
    radius = c_double()
    call("element_radius", element, byref(radius), None)
    return radius.value


def radii_of(elements: Iterable[Union[str, int]]) -> Floats:
    """Å, one per symbol or atomic number: Bondi (1964, 1966), then Mantina et al. (2009), 2.0 for metals that neither
    has. InputError where a symbol is not an element's.

    >>> meniscus.radii_of(["C", "Zn", 8]).tolist()
    [1.7, 1.39, 1.52]
    >>> meniscus.radii_of(["Qq"])
    Traceback (most recent call last):
        ...
    meniscus.InputError: atom 0: 'Qq' is not an element; give radii"""
    given = listed("elements", elements, "symbols or atomic numbers")
    given = [element if isinstance(element, str) else whole_number(f"atom {n}: the element", element)
             for n, element in enumerate(given)]
    known: dict[Union[str, int], float] = {}
    for n, element in enumerate(given):
        if element in known:
            continue
        number = _element(element) if isinstance(element, str) else element
        if number == 0:
            raise InputError(f"atom {n}: {str(element)!r} is not an element; give radii")
        known[element] = _radius(number)
    return np.array([known[element] for element in given], dtype=np.float64)
