# SPDX-License-Identifier: BSD-3-Clause
"""A page in a notebook that Python goes on talking to: its camera, what readers pick, and colours by numbers."""
from __future__ import annotations

import importlib
import math
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np

from ._arrays import atom_colors, real_array
from ._errors import InputError
from ._page import Page, page_of
from ._picture import Camera

# The page in a frame, from which nothing gets out but what messages.js of exporters/page tells.
_SCRIPT = """
const kEvery = 100;  // ms between what Python is told of a motion

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
  const camera = () => { const asked = model.get("camera"); return asked && JSON.stringify(asked) !== heard ? { camera: asked } : {}; };
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
    """What a reader clicked at. atom: its index; of a Scene among the atoms that are used or shown. name: "A LYS 48 NZ".
    point: Å, on the surface.

    >>> meniscus.Picked(3, "A LYS 48 NZ", (1.0, 2.0, 3.0)).atom
    3"""
    atom: int
    name: str
    point: tuple[float, float, float]


def _model(shown: Page) -> Any:
    """What a notebook synchronises with its views."""
    try:
        anywidget, traitlets = importlib.import_module("anywidget"), importlib.import_module("traitlets")
    except ImportError as error:
        raise ImportError("meniscus.widget() needs anywidget: python -m pip install anywidget") from error

    def shared(trait: Any) -> Any:
        return trait.tag(sync=True)

    traits = {
        "_esm": _SCRIPT,
        "html": shared(traitlets.Unicode(shown.html)),
        "title": shared(traitlets.Unicode(shown.title)),
        "height": shared(traitlets.Int(shown.height)),
        "atoms": shared(traitlets.Int(0)),
        "camera": shared(traitlets.Dict(default_value=None, allow_none=True)),
        "picked": shared(traitlets.Dict(default_value=None, allow_none=True)),
        "colors": shared(traitlets.Bytes(b"")),
        "label": shared(traitlets.Unicode("")),
    }
    return type("MeniscusWidget", (anywidget.AnyWidget,), traits)()


def _camera_of(told: dict[str, Any]) -> Camera:
    def point(key: str) -> tuple[float, float, float]:
        x, y, z = told[key]
        return x, y, z

    return Camera(point("position"), point("target"), point("up"), told["projection"], told["vertical_fov"], told["height"])


class Widget:
    """What widget() gives; a notebook shows it. Python sees the camera that readers turn and the atoms that they click,
    and changes the camera and the colours of what is already there.

    model: the anywidget itself, for layouts of ipywidgets.

    >>> import anywidget
    >>> w = meniscus.widget(meniscus.Scene("helix.pdb", color="chain"))
    >>> w
    <meniscus.Widget of helix.pdb>"""

    def __init__(self, shown: Page) -> None:
        self.model: Any = _model(shown)

    @property
    def camera(self) -> Optional[Camera]:
        """Where readers look from, Å; None before the page was shown. It can be set: what is shown then moves there.

        >>> import anywidget
        >>> w.camera = meniscus.Camera((0, 0, 50), (0, 0, 0), (0, 1, 0))
        >>> w.camera.position
        (0.0, 0.0, 50.0)"""
        told = self.model.camera
        return None if told is None else _camera_of(told)

    @camera.setter
    def camera(self, camera: Camera) -> None:
        if not isinstance(camera, Camera):
            raise InputError(f"camera is a {type(camera).__name__}, not a meniscus.Camera")
        given = camera._struct()  # numbers of any kind are plain ones here
        self.model.camera = {"position": list(given.position), "target": list(given.target), "up": list(given.up),
                             "projection": camera.projection, "vertical_fov": given.vertical_fov,
                             "height": given.height}

    @property
    def picked(self) -> Optional[Picked]:
        """What was clicked at last; None: nothing yet, or the background.

        >>> import anywidget
        >>> w.picked is None
        True"""
        return _picked_of(self.model.picked)

    def on_pick(self, call: Callable[[Optional[Picked]], Any]) -> None:
        """Calls with each new `picked`.

        >>> import anywidget
        >>> w.on_pick(lambda picked: print(picked.name))
        >>> w.model.picked = {"atom": 3, "name": "A ALA 1 CB", "point": [0, 0, 0]}
        A ALA 1 CB"""
        self.model.observe(lambda change: call(_picked_of(change["new"])), "picked")

    def on_camera(self, call: Callable[[Camera], Any]) -> None:
        """Calls with each new `camera`, at most ten times a second while it moves.

        >>> import anywidget
        >>> w.on_camera(lambda camera: print(camera.target))
        >>> w.camera = meniscus.Camera((0, 0, 50), (0, 0, 1), (0, 1, 0))
        (0.0, 0.0, 1.0)"""
        self.model.observe(lambda change: call(_camera_of(change["new"])), "camera")

    def color_by(self, values: Any, *, low: Optional[float] = None, high: Optional[float] = None,
                 ramp: Any = ((0.23, 0.30, 0.75), (0.87, 0.87, 0.87), (0.71, 0.02, 0.15)), label: str = "") -> None:
        """Colours what is shown by an array: (n,) numbers, one an atom, or (n, 3) sRGB in [0, 1]. Numbers run along `ramp`,
        (m, 3) colours at even steps from `low` to `high`; None: the least and the greatest of them. NaN is grey. label: what
        the page writes where the legend was. InputError where there is not one for each atom of a page that is shown.

        >>> import anywidget
        >>> w.color_by([0.0, 5.0, 10.0], ramp=[(0, 0, 0), (1, 1, 1)], label="charge")
        >>> w.model.label, list(w.model.colors)
        ('charge: 0 to 10', [0, 0, 0, 128, 128, 128, 255, 255, 255])"""
        given = real_array(values, "values")
        if given.ndim == 1:
            colors, label = _ramped(given, low, high, ramp, label)
        else:
            colors = atom_colors(given, len(given))
        atoms = self.model.atoms
        if atoms and len(colors) != atoms:
            raise InputError(f"values has {len(colors)} rows; the page has {atoms} atoms")
        with self.model.hold_sync():
            self.model.label = label or "given"
            self.model.colors = np.rint(255 * np.clip(colors, 0, 1)).astype(np.uint8).tobytes()

    def reset_colors(self) -> None:
        """Back to the colours that the page came with.

        >>> import anywidget
        >>> w.reset_colors()
        >>> w.model.colors
        b''"""
        self.model.colors = b""

    def _repr_mimebundle_(self, **asked: Any) -> Any:
        return self.model._repr_mimebundle_(**asked)

    def __repr__(self) -> str:
        return f"<meniscus.Widget of {self.model.title}>"


def _picked_of(told: Optional[dict[str, Any]]) -> Optional[Picked]:
    if told is None:
        return None
    x, y, z = told["point"]
    return Picked(int(told["atom"]), str(told["name"]), (x, y, z))


def _ramped(values: Any, low: Optional[float], high: Optional[float], ramp: Any, label: str) -> tuple[Any, str]:
    """Colours of numbers, and the label with their range."""
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
    """A scene, a surface or a page in a notebook, as Scene.show() has it, that Python goes on talking to: see Widget. It
    needs the package anywidget, and a running kernel. height: CSS pixels. Errors are those of show().

    >>> import anywidget
    >>> w = meniscus.widget(meniscus.Scene("helix.pdb"), height=300)
    >>> w.color_by(meniscus.read("helix.pdb").b_factors, label="B-factor")"""
    whole = page_of(shown)
    return Widget(whole if height is None else Page(whole.html, height))
