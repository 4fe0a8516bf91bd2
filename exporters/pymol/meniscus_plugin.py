# SPDX-License-Identifier: BSD-3-Clause
"""Adds exact molecular surfaces to PyMOL: the commands meniscus, meniscus_area and meniscus_pockets.

Load it with `run meniscus_plugin.py` or install it by the Plugin Manager. It needs the package meniscus in PyMOL's
Python (docs/how-to/pymol.md).
"""
import contextlib
import itertools
import sys
import warnings
from typing import NamedTuple

import numpy as np
from pymol import CmdException, cmd, util
from pymol.cgo import BEGIN, COLOR, END, NORMAL, TRIANGLES, VERTEX

# The selections of atoms that PyMOL's own surface shows, by its setting surface_mode.
SURFACE_MODES = ("not flag 25", "all", "not hydro", "visible", "visible and not hydro")

completed = cmd.extendaa(cmd.auto_arg[0]["zoom"])  # a command whose first word is completed as a selection


def load_library():
    """Returns the package meniscus. Raises CmdException with a sentence that says how to install it."""
    try:
        import meniscus
    except ImportError as error:
        raise CmdException(f"Meniscus is not in PyMOL's Python ({error}); install its wheel there: "
                           f"{sys.executable} -m pip install meniscus_ses-VERSION-py3-none-SYSTEM.whl") from error
    return meniscus


class Atoms(NamedTuple):
    """The atoms of one state that make up a surface, with one entry per atom."""
    keys: list  #: (object, index) in the notation of PyMOL's iterate
    positions: np.ndarray  #: (n, 3) Å
    radii: np.ndarray  #: (n,) Å, PyMOL's vdw
    selected: np.ndarray  #: (n,) True if the atom is in the selection, False if it is in its surroundings only


def atoms_of(selection, context, state):
    """Returns the Atoms of a state (-1: the current one), which may be none. Raises CmdException if no state has any.
    """
    if context not in ("all", "selection"):
        raise CmdException(f"context={context} is neither all nor selection")
    mode = SURFACE_MODES[cmd.get_setting_int("surface_mode")]
    rows, chosen = [], set()
    cmd.iterate(f"({selection}) and {mode}", "chosen.add((model, index))", space={"chosen": chosen})
    if not chosen:
        raise CmdException(f"'{selection}' selects no atoms" if cmd.count_atoms(selection) == 0 else
                           f"PyMOL's surfaces leave out all atoms of '{selection}', as they do with hetero atoms; "
                           f"take them in by: flag ignore, {selection}, clear")
    around = f"byobject ({selection})" if context == "all" else selection
    cmd.iterate_state(state, f"({around}) and {mode}", "rows.append((model, index, x, y, z, vdw))",
                      space={"rows": rows})
    keys = [row[:2] for row in rows]
    numbers = np.array([row[2:] for row in rows], dtype=float).reshape(-1, 4)
    return Atoms(keys, numbers[:, :3], numbers[:, 3], np.array([key in chosen for key in keys], dtype=bool))


@contextlib.contextmanager
def library_errors():
    """Turns errors of the library into CmdException, so that PyMOL shows their sentence without a traceback."""
    try:
        yield
    except load_library().Error as error:
        raise CmdException(str(error)) from error


def surface_of(atoms, probe, kind="ses"):
    """Returns the exact surface of the atoms. Raises CmdException if none is selected or the library refuses them."""
    if not atoms.selected.any():
        raise CmdException("the selection has no atoms in this state")
    with library_errors():
        return load_library().surface(atoms.positions, atoms.radii, probe, kind=kind if probe else "vdw")


def probe_of(probe):
    """Returns the radius of the probe in Å, which is PyMOL's setting solvent_radius unless given."""
    return float(probe) if probe != "" else cmd.get_setting_float("solvent_radius")


def free_name(name):
    """Returns the legal name for a new object, and deletes graphics of this name. Raises CmdException if a molecule or
    a map has it."""
    name = cmd.get_legal_name(name)
    if name in cmd.get_names("objects"):
        if cmd.get_type(name) not in ("object:cgo", "object:group"):
            raise CmdException(f"{name} is a {cmd.get_type(name)} already; give another name")
        cmd.delete(name)
    return name


def element_colors(elements):
    """Returns PyMOL's own color of each element by coloring pseudoatoms of a temporary object."""
    passing, colors = cmd.get_unused_name("_elements"), {}
    for element in elements:
        cmd.pseudoatom(passing, elem=element)
    cmd.color("atomic", passing)
    cmd.iterate(passing, "colors[elem] = color", space={"colors": colors})
    cmd.delete(passing)
    return colors


def colors_of(keys, selection, color):
    """Returns (n, 3) red, green and blue from 0 to 1 per atom: its own color, the color of its chain or element, or one
    color for all atoms."""
    rows = {}
    cmd.iterate(f"byobject ({selection})", "rows[model, index] = (color, chain, elem)", space={"rows": rows})
    if color == "atom":
        indices = {key: row[0] for key, row in rows.items()}
    elif color == "chain":
        chains = sorted({row[1] for row in rows.values()})
        of_chain = dict(zip(chains, itertools.cycle(util._color_cycle)))  # the colors of util.cbc
        indices = {key: of_chain[row[1]] for key, row in rows.items()}
    elif color == "element":
        of_element = element_colors({row[2] for row in rows.values()})
        indices = {key: of_element[row[2]] for key, row in rows.items()}
    else:
        index = cmd.get_color_index(color)
        if index == -1:
            raise CmdException(f"color={color} is neither atom, chain nor element, nor a color of PyMOL")
        indices = dict.fromkeys(rows, index)
    tuples = {index: cmd.get_color_tuple(index) or (1, 1, 1) for index in set(indices.values())}
    return np.array([tuples[indices[key]] for key in keys])


def cgo_of(mesh, colors, shown=None):
    """Returns a compiled graphics object. Each triangle has the color of its atom, so that colors meet exactly where
    patches do, and normals at cusps are exact on both sides. shown: True for each atom whose triangles are kept."""
    normals = mesh.normals[mesh.triangles].reshape(-1, 3)
    normals[mesh.sharp_corners] = mesh.sharp_normals
    rows = np.empty((len(mesh.triangles), 28), dtype=np.float32)
    rows[:, 0], rows[:, 1:4] = COLOR, colors[mesh.triangle_atoms]
    corners = rows[:, 4:].reshape(-1, 3, 8)
    corners[:, :, 0], corners[:, :, 1:4] = NORMAL, normals.reshape(-1, 3, 3)
    corners[:, :, 4], corners[:, :, 5:] = VERTEX, mesh.vertices[mesh.triangles]
    if shown is not None:
        rows = rows[shown[mesh.triangle_atoms]]
    return [BEGIN, TRIANGLES, *rows.ravel().tolist(), END]


def load_states(states, name):
    """Loads CGOs into an object by the numbers of their states. Missing states between them become empty states,
    because PyMOL 2.5 crashes without them."""
    for number in range(1, max(states) + 1):
        cmd.load_cgo(states.get(number, []), name, number, zoom=0)


@completed
def meniscus(selection="all", probe="", color="atom", context="all", name="meniscus", state=0, tolerance=0.1, quiet=1):
    """
DESCRIPTION

    Shows the exact solvent-excluded surface of a selection, one CGO a state.

USAGE

    meniscus [ selection [, probe [, color [, context [, name [, state [, tolerance ]]]]]]]

ARGUMENTS

    probe = float: radius in Angstrom {default: setting solvent_radius, 1.4}
    color = atom, chain, element or a color: of the surface {default: atom, the atoms' own colors}
    context = all: the part of the whole object's surface that the selection has, as "show surface" has it;
              selection: the closed surface of the selection alone {default: all}
    name = of the new object; one of that name is replaced {default: meniscus}
    state = 0: all states, -1: the current one, N: that one {default: 0}
    tolerance = float: no point of a triangle is farther from the surface, Angstrom {default: 0.1}

NOTES

    Radii are the atoms' vdw. Atoms that PyMOL's surfaces leave out (flag ignore, surface_mode) are left out.

EXAMPLES

    meniscus 1tii, color=chain
    meniscus chain A, probe=1.2, context=selection, name=alone
    set cgo_transparency, 0.4, meniscus
    """
    state, probe = int(state), probe_of(probe)
    states = {}
    for number in range(1, max(cmd.count_states(selection), 1) + 1) if state == 0 else [state]:
        atoms = atoms_of(selection, context, number)
        if state != 0 or atoms.selected.any():
            surface = surface_of(atoms, probe)
            with library_errors():
                mesh = surface.mesh(float(tolerance))
            place = number if number > 0 else cmd.get_state()
            states[place] = cgo_of(mesh, colors_of(atoms.keys, selection, color), atoms.selected)
    name = free_name(name)
    load_states(states, name)
    if not int(quiet):
        print(f" meniscus: {name} shows {len(states)} state{'s' * (len(states) > 1)}")


@completed
def meniscus_area(selection="all", probe="", context="all", state=-1, b="", q="", quiet=1):
    """
DESCRIPTION

    Prints areas and volumes of a selection's solvent-excluded (SES) and solvent-accessible (SAS) surface, in closed
    form, and writes the areas of its atoms into b or q.

USAGE

    meniscus_area [ selection [, probe [, context [, state [, b [, q ]]]]]]

ARGUMENTS

    probe, context = as for meniscus; with context=all areas are what the selection has of the whole object's
    state = -1: the current one, N: that one {default: -1}
    b, q = ses or sas: the areas of atoms to write there, Angstrom^2 {default: neither}

EXAMPLES

    meniscus_area 1tii, b=sas
    spectrum b, white_red, 1tii
    """
    for word in (b, q):
        if word not in ("", "ses", "sas"):
            raise CmdException(f"{word} is neither ses nor sas")
    atoms, probe = atoms_of(selection, context, int(state) or -1), probe_of(probe)
    ses, sas = surface_of(atoms, probe), surface_of(atoms, probe, "sas")
    areas = {"ses": ses.atom_areas, "sas": sas.atom_areas}
    of_selection = {kind: float(values[atoms.selected].sum()) for kind, values in areas.items()}
    for column, kind in (("b", b), ("q", q)):
        if kind:
            of_atom = dict(zip(atoms.keys, areas[kind].tolist()))
            cmd.alter(selection, f"{column} = area.get((model, index), 0.0)", space={"area": of_atom})
    if not int(quiet):
        print(f" meniscus_area: {len(atoms.keys)} atoms, probe {probe:g} A")
        print(f" SES {ses.area:.2f} A^2, {ses.volume:.2f} A^3; SAS {sas.area:.2f} A^2, {sas.volume:.2f} A^3")
        if not atoms.selected.all():
            print(f" of these the {atoms.selected.sum()} atoms of the selection: SES {of_selection['ses']:.2f} A^2, "
                  f"SAS {of_selection['sas']:.2f} A^2")
    return of_selection


@completed
def meniscus_pockets(selection="all", probe="", large_probe=4.0, min_volume=30.0, context="all", name="pocket",
                     state=-1, quiet=1):
    """
DESCRIPTION

    Finds pockets, tunnels and cavities, prints area, volume and depth of each, and shows each as a CGO: the balls of
    the probe at rest in it.

USAGE

    meniscus_pockets [ selection [, probe [, large_probe [, min_volume [, context [, name [, state ]]]]]]]

ARGUMENTS

    large_probe = float: radius of the probe that cannot enter a pocket, Angstrom {default: 4}
    min_volume = float: smaller pockets are left out, Angstrom^3 {default: 30}
    probe, context = as for meniscus; with context=all the pockets of the whole object that the selection lines
    name = of the group; its members are name_1, name_2, ..., the largest first {default: pocket}

EXAMPLES

    meniscus_pockets polymer
    meniscus_pockets polymer, min_volume=100, name=site
    """
    number = int(state) if int(state) > 0 else cmd.get_state()
    atoms, probe = atoms_of(selection, context, int(state) or -1), probe_of(probe)
    surface = surface_of(atoms, probe)
    with library_errors():
        found = surface.pockets(float(large_probe), min_volume=float(min_volume))
    found = [pocket for pocket in found if atoms.selected[pocket.atoms].any()]
    name = free_name(name)
    for place, (pocket, color) in enumerate(zip(found, itertools.cycle(util._color_cycle)), 1):
        with warnings.catch_warnings():  # the library warns about probes, which lie closer together than atoms
            warnings.simplefilter("ignore")
            balls = load_library().surface(pocket.probes, probe, kind="vdw").mesh(0.1)
        colors = np.tile(cmd.get_color_tuple(color), (len(pocket.probes), 1))
        load_states({number: cgo_of(balls, colors)}, f"{name}_{place}")
        cmd.group(name, f"{name}_{place}")
        if not int(quiet):
            mouths = "".join(f", mouth {area:.1f} A^2" for area in pocket.mouth_areas)
            print(f" {name}_{place}: {pocket.kind}, {pocket.volume:.1f} A^3, {pocket.area:.1f} A^2, "
                  f"depth {pocket.depth:.1f} A{mouths}")
    if not int(quiet):
        print(f" meniscus_pockets: {len(found)} in {name}")
    return found


def __init_plugin__(app=None):
    """Called by the Plugin Manager. It does nothing, because importing this module has defined the commands."""
