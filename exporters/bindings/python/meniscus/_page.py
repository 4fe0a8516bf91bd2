# SPDX-License-Identifier: BSD-3-Clause
"""Web pages of one file, in which readers can rotate the exact surface, and their frames in other pages."""
from __future__ import annotations

import ctypes
import os
import re
from typing import Any, Optional, Protocol, Union

from . import _library as lib
from ._arguments import Path, positive
from ._errors import InputError
from ._written import save_bytes

#: The permissions of a page in a frame: to run its script, and to save a PNG file. It cannot access the outer page.
_MAY = "allow-scripts allow-downloads"


class Page:
    """A web page, which Scene.show() and Surface.show() return. A notebook shows it in a frame of `height` CSS pixels.

    The page loads nothing and needs no kernel, so it also works in a saved notebook, which contains all of it.

    >>> page = meniscus.Scene("helix.pdb", color="chain").show()
    >>> page.height, page.title
    (480, 'helix.pdb')"""

    __slots__ = ("_height", "_html")

    def __init__(self, html: str, height: int = 480) -> None:
        self._html = html
        self._height = positive("height", height)

    @property
    def html(self) -> str:
        """The text of the file.

        >>> page.html.startswith("<!DOCTYPE html>")
        True"""
        return self._html

    @property
    def height(self) -> int:
        """The height of the frame in CSS pixels.

        >>> page.height
        480"""
        return self._height

    @property
    def title(self) -> str:
        """The title of the page, escaped for HTML.

        >>> page.title
        'helix.pdb'"""
        found = re.search(r"<title>(.*?)</title>", self._html, re.DOTALL)
        return found[1] if found else ""

    def save(self, path: Path, *, replace: bool = False) -> None:
        """Writes the page to a file, completely or not at all. replace: whether an existing file is replaced. Raises
        OutputError if the file cannot be written, or exists and is not replaced.

        >>> page.save("helix.html", replace=True)"""
        save_bytes(self._html.encode("utf-8"), path, replace)

    def frame(self, src: Optional[str] = None, *, height: Optional[int] = None) -> str:
        """Returns an <iframe> with this page for another page.

        src: the address of the saved page, relative to the other page; None: the frame contains the whole page. height:
        CSS pixels; None for that of the page. The frame is as wide as the other page allows.

        >>> page.frame("helix.html", height=300)
        '<iframe title="helix.pdb" width="100%" height="300" frameborder="0" loading="lazy" \
sandbox="allow-scripts allow-downloads" allowfullscreen src="helix.html"></iframe>'"""
        tall = self._height if height is None else positive("height", height)
        shown = f'srcdoc="{_quoted(self._html)}"' if src is None else f'src="{_quoted(src)}"'
        title = self.title.replace('"', "&quot;")
        return (f'<iframe title="{title}" width="100%" height="{tall}" frameborder="0" loading="lazy" sandbox="{_MAY}" '
                f"allowfullscreen {shown}></iframe>")

    def _repr_html_(self) -> str:
        return self.frame()

    def __repr__(self) -> str:
        return f"<meniscus.Page of {self.title}: {len(self._html):,} bytes>"


class Shown(Protocol):
    """An object that can make a page: a Scene or a Surface."""

    def show(self) -> Page: ...


def _quoted(text: str) -> str:
    """Returns a text as the value of an HTML attribute in double quotes."""
    return text.replace("&", "&amp;").replace('"', "&quot;")


def made(make: str, *arguments: Any, height: int) -> Page:
    """Returns the page that meniscus_MAKE makes. arguments: those of meniscus_MAKE without the last. height: CSS
    pixels."""
    positive("frame_height", height)
    handle = lib.Handle("page", make, *arguments)
    html, size = ctypes.c_char_p(), ctypes.c_size_t()
    lib.call("page_html", handle.pointer, ctypes.byref(html), ctypes.byref(size))
    return Page((html.value or b"").decode("utf-8", "replace"), height)


def page_of(shown: Any) -> Page:
    """Returns the page of a scene or a surface, or the page itself. Raises InputError for other objects."""
    show = getattr(shown, "show", None)
    whole = shown if isinstance(shown, Page) else show() if show else None
    if not isinstance(whole, Page):
        raise InputError(f"shown is a {type(shown).__name__}, neither a Page nor a Scene nor a Surface")
    return whole


def page(shown: Union[Page, Shown], path: Optional[Path] = None, *, src: Optional[str] = None,
         height: Optional[int] = None, replace: bool = False) -> str:
    """Returns an <iframe> of a scene, a surface or a page, for raw HTML in Quarto, Sphinx and static sites.

    path: the file to which the page is saved; None: the frame contains the whole page. src: the address of the file in
    the frame; None for the path. height: the height of the frame in CSS pixels. replace: whether an existing file is
    replaced. Raises the errors of show() and Page.save().

    >>> scene = meniscus.Scene("helix.pdb")
    >>> meniscus.page(scene, "helix.html", height=300, replace=True).startswith("<iframe ")
    True
    >>> "srcdoc" in meniscus.page(scene)
    True"""
    whole = page_of(shown)
    if path is None:
        if src is not None:
            raise InputError(f"src is {src!r}, and path is missing: there is no file for this address")
        return whole.frame(height=height)
    whole.save(path, replace=replace)
    return whole.frame(os.fsdecode(path).replace(os.sep, "/") if src is None else src, height=height)
