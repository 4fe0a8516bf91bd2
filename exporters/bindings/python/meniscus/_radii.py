# SPDX-License-Identifier: BSD-3-Clause
"""Atomic numbers, and van der Waals radii by element."""
from __future__ import annotations

import ctypes
import functools
from typing import Any, Iterable, Union

import numpy as np

from . import _library as lib
from ._arguments import AnyArray, Floats, listed, whole_number
from ._errors import InputError


@functools.lru_cache(maxsize=None)
def _element(symbol: str) -> int:
    """Returns the atomic number of a symbol; 0 if no element has it."""
    number = ctypes.c_int32()
    lib.call("element_of_symbol", symbol.strip().encode(), ctypes.byref(number))
    return number.value


@functools.lru_cache(maxsize=None)
def _radius(element: int) -> float:
    radius = ctypes.c_double()
    lib.call("element_radius", element, ctypes.byref(radius), None)
    return radius.value


def atomic_numbers(elements: Any) -> AnyArray:
    """Returns the atomic numbers of symbols, or whole numbers as they are: (n,); 0 for symbols of no element."""
    values = np.asarray(elements)
    if values.dtype.kind in "iu":
        return values.astype(np.int64)
    distinct, places = np.unique(values.astype(np.str_), return_inverse=True)
    numbers = np.array([_element(str(symbol)) for symbol in distinct], dtype=np.int64)
    found: AnyArray = numbers[places.reshape(-1)] if len(numbers) else np.empty(0, np.int64)
    return found


def radii_of(elements: Iterable[Union[str, int]]) -> Floats:
    """Returns the van der Waals radii of elements in Å, (n,), by Bondi (1964, 1966) or Mantina et al. (2009); 2.0 for
    metals without a published value.

    elements: symbols or atomic numbers. Raises InputError for a symbol or number of no element.

    >>> meniscus.radii_of(["C", "Zn", 8]).tolist()
    [1.7, 1.39, 1.52]
    >>> meniscus.radii_of(["Qq"])
    Traceback (most recent call last):
        ...
    meniscus.InputError: atom 0: 'Qq' is not an element; give radii"""
    checked: list[Union[str, int]] = [
        element if isinstance(element, str) else whole_number(f"atom {n}: the element", element)
        for n, element in enumerate(listed("elements", elements, "symbols or atomic numbers"))]
    known: dict[Union[str, int], float] = {}
    for n, element in enumerate(checked):
        if element in known:
            continue
        number = _element(element) if isinstance(element, str) else element
        if number == 0:
            raise InputError(f"atom {n}: {str(element)!r} is not an element; give radii")
        known[element] = _radius(number)
    return np.array([known[element] for element in checked], dtype=np.float64)
