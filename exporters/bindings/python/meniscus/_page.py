# SPDX-License-Identifier: BSD-3-Clause
"""Web pages of one file in which readers turn the exact surface, and their frames in other pages."""
from __future__ import annotations

import ctypes
import os
import re
import tempfile
from typing import Any, Optional, Protocol, Union

from . import _library as lib
from ._arguments import flag, positive
from ._errors import InputError, OutputError
from ._types import Path

#: What a page may do in a frame: run its script, and save a PNG. It does not get at the page around it.
_MAY = "allow-scripts allow-downloads"


class Page:
    """What Scene.show() and Surface.show() give: a notebook shows it in a frame of `height` CSS pixels, in which it turns.
    It fetches nothing and needs no kernel, so it still turns in a notebook that was saved; the notebook holds all of it.

    >>> page = meniscus.Scene("helix.pdb", color="chain").show()
    >>> page.height, page.title
    (480, 'helix.pdb')"""

    __slots__ = ("_height", "_html")

    def __init__(self, html: str, height: int = 480) -> None:
        self._html = html
        self._height = positive("height", height)

    @property
    def html(self) -> str:
        """The text of its file.

        >>> page.html.startswith("<!DOCTYPE html>")
        True"""
        return self._html

    @property
    def height(self) -> int:
        """CSS pixels of its frame.

        >>> page.height
        480"""
        return self._height

    @property
    def title(self) -> str:
        """As its file has it, escaped.

        >>> page.title
        'helix.pdb'"""
        found = re.search(r"<title>(.*?)</title>", self._html, re.DOTALL)
        return found[1] if found else ""

    def save(self, path: Path, *, replace: bool = False) -> None:
        """Writes its file, completely or not at all. replace: an existing file, else OutputError.

        >>> page.save("helix.html", replace=True)"""
        target = os.fsdecode(path)
        if not flag("replace", replace) and os.path.lexists(target):
            raise OutputError(f"{target}: exists already; replace=True replaces it")
        try:
            handle, beside = tempfile.mkstemp(suffix=".part", dir=os.path.dirname(target) or ".")
            try:
                with open(handle, "w", encoding="utf-8", newline="\n") as file:
                    file.write(self._html)
                os.chmod(beside, 0o666 & ~_umask())
                os.replace(beside, target)
            except BaseException:
                os.unlink(beside)
                raise
        except OSError as error:
            raise OutputError(f"{target}: cannot be written: {error.strerror}") from None

    def frame(self, src: Optional[str] = None, *, height: Optional[int] = None) -> str:
        """The <iframe> of another page, as wide as there is room, in which this one turns. src: the address of its saved
        file as that page sees it; None: all of it is in the frame's text.

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
    """Has a page of its own: a Scene or a Surface."""

    def show(self) -> Page: ...


def _quoted(text: str) -> str:
    """As the value of an attribute between double quotes."""
    return text.replace("&", "&amp;").replace('"', "&quot;")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def made(make: str, *arguments: Any, height: int) -> Page:
    """The page that meniscus_MAKE makes."""
    positive("frame_height", height)
    handle = lib.Handle("page", make, *arguments)
    html, size = ctypes.c_char_p(), ctypes.c_size_t()
    lib.call("page_html", handle.pointer, ctypes.byref(html), ctypes.byref(size))
    return Page((html.value or b"").decode("utf-8", "replace"), height)


def page_of(shown: Any) -> Page:
    """Of a scene or a surface; a page is one."""
    show = getattr(shown, "show", None)
    whole = shown if isinstance(shown, Page) else show() if show else None
    if not isinstance(whole, Page):
        raise InputError(f"shown is a {type(shown).__name__}, neither a Page nor a Scene nor a Surface")
    return whole


def page(shown: Union[Page, Shown], path: Optional[Path] = None, *, src: Optional[str] = None,
         height: Optional[int] = None, replace: bool = False) -> str:
    """The <iframe> of a scene, a surface or a page for Quarto, Sphinx and static sites: what a cell or a directive of raw
    HTML puts into their pages. path: where the page is saved, which is its address in the frame, too, unless `src` is;
    None: all of it is in the frame's text. height: of the frame, CSS pixels. Errors are those of show() and Page.save().

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
