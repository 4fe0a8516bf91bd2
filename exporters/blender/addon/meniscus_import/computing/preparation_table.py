# SPDX-License-Identifier: GPL-3.0-or-later
"""The fields of the panel about molecules and runs. scripts/check/scene_values.py writes this file from Meniscus' table of
properties."""

import collections

#: A field. key: key in scene files. type: flag, count, word or text. words: all values of a word, or some usual values of
#: a text. initial: the default. lowest, highest: range of a count.
Row = collections.namedtuple("Row", "key type words initial lowest highest help")

ROWS = (
    Row('molecule.model', 'text', (), '1', 0, 0,
        'Model to read, from 1; all: all models as one molecule'),
    Row('molecule.altloc', 'text', ('best', 'first', 'all'), 'best', 0, 0,
        'Alternate location to keep: best, first, a letter, or all. best: the one of highest occupancy in each residue'),
    Row('molecule.assembly', 'text', (), '', 0, 0,
        'Build this biological assembly; list: print all of FILE and stop. Assemblies come from REMARK 350 or mmCIF'),
    Row('molecule.hydrogens', 'word', ('keep', 'drop', 'auto'), 'auto', 0, 0,
        'Hydrogens: keep, drop or auto. auto: drop them if the radii of heavy atoms include them'),
    Row('molecule.radii', 'text', (), "file if it has radii, else bondi; for Martini's beads by its version", 0, 0,
        'Van der Waals radii: bondi, united, protor, martini2, martini3 or file. bondi: by element; united (Chothia 1976) and protor (Tsai et al. 1999) include hydrogens; martini2 and martini3: for beads; file: those in FILE'),
    Row('molecule.keep_water', 'flag', (), '', 0, 0,
        'Use water molecules, too'),
    Row('molecule.keep_ions', 'flag', (), '', 0, 0,
        'Use free ions, too: lone metal and halogen atoms'),
    Row('frames.superpose', 'text', (), '', 0, 0,
        'Superpose each frame on the reference frame by these atoms'),
    Row('frames.whole', 'text', ('bonds', 'guess'), 'bonds', 0, 0,
        'Make molecules whole that the periodic box cuts, and gather them. bonds: by bonds of FILE and of standard residues; guess: by distance'),
    Row('frames.smooth', 'count', (), '1', 1, 9999,
        'Average positions over N frames around each frame; N is odd'),
)

#: Colour schemes, and True for those that need more than the atoms of a file.
SCHEMES = (
    ('auto', False), ('element', False), ('chain', False), ('copy', False), ('model', False), ('residue', False), ('kind', True),
    ('component', True), ('bfactor', False), ('occupancy', False), ('charge', False), ('hydrophobicity', False), ('element-cpk', False),
    ('index', False), ('chain-element', False), ('chain-okabe-ito', False), ('radial', False), ('secondary', False), ('rainbow', False),
    ('plddt', False), ('snfg', False), ('bead', False), ('buried', True), ('lipophilicity', True), ('relative-accessibility', True),
    ('rmsf', True), ('file', True), ('conservation', True))
