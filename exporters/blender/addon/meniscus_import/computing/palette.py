# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of a file's atoms by what they are or by a number they have, with the tables of the program."""

import numpy as np

from .. import mns_reader

#: Of Okabe and Ito; classes beyond seven have them paler, then darker.
OKABE_ITO = ("56b4e9", "e69f00", "009e73", "cc79a7", "f0e442", "0072b2", "d55e00")
#: Convex, toroidal and concave patches.
KINDS = ("009e73", "56b4e9", "d55e00")
MISSING = "808080"
#: By atomic number; 0: unknown.
ELEMENTS = {0: "c4c4c4", 1: "f2f2f2", 6: "9a9a9a", 7: "4666d8", 8: "dd4437", 9: "9fd356", 11: "8e5bd1", 12: "5d9c3a", 15: "f08a24",
            16: "e8c93a", 17: "3fae49", 19: "7d3fb0", 20: "6fa35f", 25: "9c7ac7", 26: "c86a2f", 27: "db8aa0", 28: "5fb08c",
            29: "c58032", 30: "7d80b0", 34: "d99a1e", 35: "9b3b2a", 53: "7a2a8c"}
OTHER_ELEMENT, PALER = "d070b0", 0.456  # so much white makes #c8c8c8 of carbon
RESIDUES = {"ASP GLU ASH GLH": "d55e00", "ARG LYS HIS HID HIE HIP HSD HSE HSP LYN": "0072b2", "ASN GLN SER THR": "56b4e9",
            "ALA VAL LEU ILE": "cccccc", "PHE TYR TRP": "009e73", "CYS CYX CYM MET MSE": "f0e442", "GLY PRO": "cc79a7",
            "A DA ADE RA": "d55e00", "C DC CYT RC": "0072b2", "G DG GUA RG": "009e73", "U DT T THY URA RU": "e69f00"}
OTHER_RESIDUE = "a0734a"
#: Of amino acids (Kyte & Doolittle 1982).
HYDROPATHY = {"ILE": 4.5, "VAL": 4.2, "LEU": 3.8, "PHE": 2.8, "CYS CYX CYM": 2.5, "MET MSE": 1.9, "ALA": 1.8, "GLY": -0.4, "THR": -0.7,
              "SER": -0.8, "TRP": -0.9, "TYR": -1.3, "PRO": -1.6, "HIS HID HIE HIP HSD HSE HSP": -3.2, "GLU GLH": -3.5, "GLN": -3.5,
              "ASP ASH": -3.5, "ASN": -3.5, "LYS LYN": -3.9, "ARG": -4.5}
BLUE_WHITE_RED = ("2a4fd7", "ffffff", "d2322a")
#: Every fifth colour of the 256.
VIRIDIS = """440154 46085c 471063 481769 481d6f 482475 472a7a 46307e 453781 433d84 414287 3f4889 3d4e8a 3a538b 38598c 355e8d 33638d
31688e 2e6d8e 2c718e 2a768e 297b8e 27808e 25848e 23898e 218e8d 20928c 1f978b 1e9c89 1fa188 21a585 24aa83 28ae80 2eb37c 35b779 3dbc74
46c06f 50c46a 5ac864 65cb5e 70cf57 7cd250 89d548 95d840 a2da37 b0dd2f bddf26 cae11f d8e219 e5e419 f1e51d fde725""".split()
#: Colours by a number, and what the number is called.
NUMBERS = {"bfactor": "B-factors", "occupancy": "occupancies", "charge": "partial charges", "hydrophobicity": "amino acids",
           "radial": "positions"}


def colors_of(structure, scheme):
    """(n, 3) sRGB of the atoms of a meniscus.Structure; scheme: a word of --color that the panel offers. Raises MnsError where it
    is a number that no atom has."""
    if scheme in NUMBERS:
        return _by_number(structure, scheme)
    if scheme == "chain":
        return _classes(in_order(structure.chains)[1])
    if scheme == "residue":
        return _rgb(_by_name(RESIDUES, structure.residue_names, OTHER_RESIDUE))
    if scheme == "kind":
        return _rgb([MISSING] * len(structure))
    colors = _rgb([ELEMENTS.get(number, OTHER_ELEMENT) for number in range(256)])[structure.elements]
    return colors if scheme == "element-cpk" else np.float32(1.0 - PALER) * colors + np.float32(PALER)


def kind_colors(scheme):
    """sRGB of the kinds of patches where they are coloured by that, else None."""
    return _rgb(KINDS).tolist() if scheme == "kind" else None


def hydropathy(residue_names):
    """Of each name; not a number of what is no amino acid."""
    return _by_name(HYDROPATHY, residue_names, np.nan)


def in_order(names):
    """The names, each once, in the order in which they come; and the place of each among them."""
    found, first, place = np.unique(names, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(order), dtype=np.int32)
    rank[order] = np.arange(len(order))
    return [str(name) for name in found[order]], rank[place]


def _by_number(structure, scheme):
    values = {"bfactor": lambda: structure.b_factors, "occupancy": lambda: structure.occupancies, "charge": lambda: structure.charges,
              "hydrophobicity": lambda: hydropathy(structure.residue_names),
              "radial": lambda: np.linalg.norm(structure.positions - structure.positions.mean(axis=0), axis=1)}[scheme]().astype(np.float64)
    known = values[~np.isnan(values)]
    if not len(known):
        raise mns_reader.MnsError(f"{structure.file}: has no {NUMBERS[scheme]} to colour by; choose another Colour")
    low, high, stops = known.min(), known.max(), VIRIDIS
    if scheme == "hydrophobicity":
        low, high, stops = -4.5, 4.5, BLUE_WHITE_RED
    elif scheme == "charge":
        high = max(abs(low), abs(high))
        low, stops = -high, BLUE_WHITE_RED[::-1]
    share = (values - low) / (high - low) if high > low else np.full(len(values), 0.5)
    return np.where(np.isnan(values)[:, None], _rgb([MISSING]), _on_map(_rgb(stops), np.nan_to_num(share)))


def _on_map(stops, share):
    place = np.clip(share, 0.0, 1.0) * (len(stops) - 1)
    below = np.minimum(place.astype(int), len(stops) - 2)
    fraction = (place - below).astype(np.float32)[:, None]
    return (1.0 - fraction) * stops[below] + fraction * stops[below + 1]


def _classes(numbers):
    hues, turn = _rgb(OKABE_ITO)[numbers % len(OKABE_ITO)], (numbers // len(OKABE_ITO) % 3)[:, None]
    return np.choose(turn, (hues, np.float32(0.5) * hues + np.float32(0.5), np.float32(0.6) * hues))


def _by_name(table, names, otherwise):
    known = {name: value for words, value in table.items() for name in words.split()}
    found, place = np.unique(names, return_inverse=True)
    return np.array([known.get(str(name), otherwise) for name in found])[place]


def _rgb(colors):
    """(n, 3) in [0, 1] of words such as "9a9a9a"."""
    return np.array([[int(color[place:place + 2], 16) for place in (0, 2, 4)] for color in colors], dtype=np.float32) / np.float32(255.0)
