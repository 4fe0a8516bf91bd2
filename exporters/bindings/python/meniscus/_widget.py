# SPDX-License-Identifier: BSD-3-Clause
"""A page in a notebook that is connected to Python: its camera, the atoms that readers pick, and colours by numbers."""
from __future__ import annotations

import importlib
import math
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np

from ._arrays import real_array
from ._errors import InputError
from ._page import Page, page_of
from ._picture import Camera, atom_colors

#: Shows the page in a frame. The frame isolates it, except for the messages of messages.js in exporters/page.
_SCRIPT = """
const kEvery = 100;  // ms between messages to Python while the camera moves

function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.setAttribute("sandbox", "allow-scripts allow-downloads");
  frame.setAttribute("allowfullscreen", "");
  Object.assign(frame, { title: model.get("title"), width: "100%", height: model.get("height"), srcdoc: model.get("html") });
  frame.style.border = "0";
  el.append(frame);
  let ready = false, heard = "", waiting = 0;
  const say = (what) => frame.contentWindow?.postMessage({ meniscus: what }, "*");
  const colors = () => {
    const view = model.get("colors");
    return view.byteLength ? { colors: new Uint8Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength)), label: model.get("label") }
      : { scheme: 0 };
  };
  const camera = () => { const value = model.get("camera"); return value && JSON.stringify(value) !== heard ? { camera: value } : {}; };
  const show_camera = () => { if (ready) say(camera()); };
  const show_colors = () => { if (ready) say(colors()); };
  const hear = ({ source, data }) => {
    if (source !== frame.contentWindow || !data?.meniscus) return;
    const { atoms, camera: seen, picked } = data.meniscus;
    if (atoms !== undefined && !ready) {
      ready = true;
      clearInterval(calling);
      model.set("atoms", atoms);
    }
    if (picked !== undefined) model.set("picked", picked);
    if (seen) {
      heard = JSON.stringify(seen);
      model.set("camera", seen);
    }
    waiting ||= setTimeout(() => { waiting = 0; model.save_changes(); }, kEvery);
  };
  window.addEventListener("message", hear);
  const calling = setInterval(() => say({ hello: true, ...camera(), ...(model.get("colors").byteLength ? colors() : {}) }), kEvery);
  model.on("change:camera", show_camera);
  model.on("change:colors", show_colors);
  return () => {
    window.removeEventListener("message", hear);
    clearInterval(calling);
    clearTimeout(waiting);
    model.off("change:camera", show_camera);
    model.off("change:colors", show_colors);
  };
}

export default { render };
"""


class Picked(NamedTuple):
    """An atom that a reader clicked. atom: its index; for a Scene, among the atoms that are used or shown. name: such
    as "A LYS 48 NZ". point: the point of the surface in Å.

    >>> meniscus.Picked(3, "A LYS 48 NZ", (1.0, 2.0, 3.0)).atom
    3"""
    atom: int
    name: str
    point: tuple[float, float, float]


def _model(shown: Page) -> Any:
    """Returns the anywidget, whose traits the notebook synchronises with its views. Raises ImportError without
    anywidget."""
    try:
        anywidget, traitlets = importlib.import_module("anywidget"), importlib.import_module("traitlets")
    except ImportError as error:
        raise ImportError("meniscus.widget() needs anywidget: python -m pip install anywidget") from error

    def shared(trait: Any) -> Any:
        return trait.tag(sync=True)

    traits = {
        "_esm": _SCRIPT, "html": shared(traitlets.Unicode(shown.html)), "title": shared(traitlets.Unicode(shown.title)),
        "height": shared(traitlets.Int(shown.height)), "atoms": shared(traitlets.Int(0)),
        "camera": shared(traitlets.Dict(default_value=None, allow_none=True)),
        "picked": shared(traitlets.Dict(default_value=None, allow_none=True)), "colors": shared(traitlets.Bytes(b"")),
        "label": shared(traitlets.Unicode(""))}
    return type("MeniscusWidget", (anywidget.AnyWidget,), traits)()


def _camera_of(trait: dict[str, Any]) -> Camera:
    def point(key: str) -> tuple[float, float, float]:
        x, y, z = trait[key]
        return x, y, z

    return Camera(point("position"), point("target"), point("up"), trait["projection"], trait["vertical_fov"],
                  trait["height"])


class Widget:
    """A page that is connected to Python, which widget() returns. A notebook shows it. Python can read the camera and
    the atoms that readers click, and can change the camera and the colours.

    model: the anywidget, for layouts of ipywidgets.

    >>> import anywidget
    >>> w = meniscus.widget(meniscus.Scene("helix.pdb", color="chain"))
    >>> w
    <meniscus.Widget of helix.pdb>"""

    def __init__(self, shown: Page) -> None:
        self.model: Any = _model(shown)

    @property
    def camera(self) -> Optional[Camera]:
        """The camera of the page, in Å; None before the page is shown. Setting it moves the camera of the page. Raises
        InputError if it is set to anything but a possible Camera.

        >>> import anywidget
        >>> w.camera = meniscus.Camera((0, 0, 50), (0, 0, 0), (0, 1, 0))
        >>> w.camera.position
        (0.0, 0.0, 50.0)"""
        trait = self.model.camera
        return None if trait is None else _camera_of(trait)

    @camera.setter
    def camera(self, camera: Camera) -> None:
        if not isinstance(camera, Camera):
            raise InputError(f"camera is a {type(camera).__name__}, not a meniscus.Camera")
        plain = camera._struct()  # checks and converts all numbers
        self.model.camera = {"position": list(plain.position), "target": list(plain.target), "up": list(plain.up),
                             "projection": camera.projection, "vertical_fov": plain.vertical_fov,
                             "height": plain.height}

    @property
    def picked(self) -> Optional[Picked]:
        """The atom that was clicked last; None before the first click and after a click on the background.

        >>> import anywidget
        >>> w.picked is None
        True"""
        return _picked_of(self.model.picked)

    def on_pick(self, call: Callable[[Optional[Picked]], Any]) -> None:
        """Calls a function with each new value of `picked`.

        >>> import anywidget
        >>> w.on_pick(lambda picked: print(picked.name))
        >>> w.model.picked = {"atom": 3, "name": "A ALA 1 CB", "point": [0, 0, 0]}
        A ALA 1 CB"""
        self.model.observe(lambda change: call(_picked_of(change["new"])), "picked")

    def on_camera(self, call: Callable[[Camera], Any]) -> None:
        """Calls a function with each new value of `camera`, at most ten times a second.

        >>> import anywidget
        >>> w.on_camera(lambda camera: print(camera.target))
        >>> w.camera = meniscus.Camera((0, 0, 50), (0, 0, 1), (0, 1, 0))
        (0.0, 0.0, 1.0)"""
        self.model.observe(lambda change: call(_camera_of(change["new"])), "camera")

    def color_by(self, values: Any, *, low: Optional[float] = None, high: Optional[float] = None,
                 ramp: Any = ((0.23, 0.30, 0.75), (0.87, 0.87, 0.87), (0.71, 0.02, 0.15)), label: str = "") -> None:
        """Colours the surface by an array with a row per atom.

        values: numbers, (n,), or colours, (n, 3), sRGB in [0, 1]. low, high: the numbers at the ends of the ramp; None
        for the lowest and the highest number. ramp: colours at equal distances between low and high, (m, 3). NaN is
        grey. label: the text in place of the legend. Raises InputError if the page is shown and has another number of
        atoms.

        >>> import anywidget
        >>> w.color_by([0.0, 5.0, 10.0], ramp=[(0, 0, 0), (1, 1, 1)], label="charge")
        >>> w.model.label, list(w.model.colors)
        ('charge: 0 to 10', [0, 0, 0, 128, 128, 128, 255, 255, 255])"""
        array = real_array(values, "values")
        if array.ndim == 1:
            colors, label = _ramped(array, low, high, ramp, label)
        else:
            colors = atom_colors(array, len(array))
        atoms = self.model.atoms
        if atoms and len(colors) != atoms:
            raise InputError(f"values has {len(colors)} rows; the page has {atoms} atoms")
        with self.model.hold_sync():
            self.model.label = label or "given"
            self.model.colors = np.rint(255 * np.clip(colors, 0, 1)).astype(np.uint8).tobytes()

    def reset_colors(self) -> None:
        """Restores the original colours of the page.

        >>> import anywidget
        >>> w.reset_colors()
        >>> w.model.colors
        b''"""
        self.model.colors = b""

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return self.model._repr_mimebundle_(**options)

    def __repr__(self) -> str:
        return f"<meniscus.Widget of {self.model.title}>"


def _picked_of(trait: Optional[dict[str, Any]]) -> Optional[Picked]:
    if trait is None:
        return None
    x, y, z = trait["point"]
    return Picked(int(trait["atom"]), str(trait["name"]), (x, y, z))


def _ramped(values: Any, low: Optional[float], high: Optional[float], ramp: Any, label: str) -> tuple[Any, str]:
    """Returns the colours of numbers, (n, 3), and the label with their range."""
    known = values[np.isfinite(values)].astype(np.float64)
    if low is None:
        low = float(known.min()) if len(known) else 0.0
    if high is None:
        high = float(known.max()) if len(known) else 1.0
    if not (math.isfinite(low) and math.isfinite(high) and low <= high):
        raise InputError(f"low is {low} and high is {high}; give numbers, the lower one first")
    stops = real_array(ramp, "ramp").astype(np.float64)
    if stops.ndim != 2 or stops.shape[1] != 3 or len(stops) < 2:
        raise InputError(f"ramp has the shape {stops.shape}; it has to be (m, 3), of two colours or more")
    places = np.clip((values.astype(np.float64) - low) / ((high - low) or 1.0), 0, 1) * (len(stops) - 1)
    colors = np.stack([np.interp(places, np.arange(len(stops)), stops[:, n]) for n in range(3)], axis=1)
    colors[~np.isfinite(values)] = 0.5
    return colors, f"{label}{': ' if label else ''}{low:.4g} to {high:.4g}"


def widget(shown: Union[Page, Any], *, height: Optional[int] = None) -> Widget:
    """Returns a Widget of a scene, a surface or a page: a page in a notebook that is connected to Python. It needs the
    package anywidget and a running kernel.

    height: the height of the page in CSS pixels; None for that of show(). Raises the errors of show(), and ImportError
    without anywidget.

    >>> import anywidget
    >>> w = meniscus.widget(meniscus.Scene("helix.pdb"), height=300)
    >>> w.color_by(meniscus.read("helix.pdb").b_factors, label="B-factor")"""
    whole = page_of(shown)
    return Widget(whole if height is None else Page(whole.html, height))
