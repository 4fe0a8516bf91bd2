# SPDX-License-Identifier: BSD-3-Clause
"""The types of the values of scenes, written by scripts/check/scene_values.py from the properties of the library."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Literal, Optional, TypedDict, Union

Path = Union[str, "os.PathLike[str]"]
Text = Union[str, float]
#: A text, or its numbers: the width and the height of a picture, or a direction.
Numbers = Union[Text, Sequence[float]]


class SurfaceValues(TypedDict, total=False):
    """The properties of a picture of a surface: its look and its size."""
    #: SCHEME: Colour: a scheme, a colour (red, #rrggbb), or EXPR=COLOR. Schemes: auto (chain; along a single
    #: chain; element-cpk for small molecules), element, element-cpk (darker), chain, chain-element, chain-
    #: okabe-ito, copy (of an assembly), residue (type), secondary (helix, strand, coil), plddt (AlphaFold's
    #: confidence), snfg (sugars), bead (of Martini), kind (of patch), component; by a number: bfactor,
    #: occupancy, charge, hydrophobicity (Kyte & Doolittle 1982), lipophilicity (a potential), relative-
    #: accessibility, index, rainbow (along each chain), radial (for capsids). EXPR=COLOR colours some atoms, as
    #: in 'ligand=orange'; 'ligand=orange:ATP' names them in the legend. Repeatable; the last one counts.
    #: meniscus colors explains the schemes [auto]
    color: Union[Text, Sequence[Text]]
    #: WORD: Look by one word, such as ghost, pocket or ribbon. publication: shade, thin lines, colours as
    #: given; cover: studio light, highlights; flat: constant colours and lines; soft: matt, no lines; classic:
    #: studio light alone; ghost: the fold in a surface that is seen through; goodsell: atoms in flat colours of
    #: chains, with outlines and shadows; pocket: a ligand in its pocket, with its neighbours and hydrogen
    #: bonds; ribbon: the fold without a surface. meniscus looks FILE draws them all. Other options change
    #: single values of a look. Where colours show numbers, light changes only their lightness [publication]
    preset: Literal["publication", "cover", "flat", "soft", "classic", "ghost", "goodsell", "pocket", "ribbon"]
    #: X,Y,Z: Direction towards the lamp, as X,Y,Z: right, up, to the viewer [-0.45,0.65,0.75]
    light: Numbers
    #: F: Strength of the lamp, 0 to 10 [1]
    light_strength: float
    #: F: Share of light that comes evenly from all sides, 0 to 1. With 1, colours are exactly those given
    ambient: float
    #: F: Roughness of the material, from 0 (wax, darker at edges) to 1 (chalk)
    roughness: float
    #: F: Strength of highlights, 0 (none) to 1
    specular: float
    #: F: Specular exponent, 1 to 1000; larger gives smaller highlights
    shininess: float
    #: F: Shade in pockets and clefts, 0 (none) to 1. All that is drawn casts shade; what is seen through casts
    #: less
    ambient_occlusion: float
    #: Å: Largest distance in Å at which ambient_occlusion_rays finds shade
    ambient_occlusion_radius: float
    #: N: Rays a pixel that find shade and shadows, such as 64: exact, but slow. 0: maps of the light find them
    #: [0]
    ambient_occlusion_rays: float
    #: F: Darkness of shadows that the lamp casts, 0 (none) to 1. What is seen through casts less
    shadows: float
    #: DEGREES: Half the angle at which the lamp is seen, 0 (sharp shadows, by rays) to 45
    shadow_softness: float
    #: WIDTH: Width of black outlines: pixels, 0.5pt or 0.2mm; 0: no lines. They are drawn around whatever is in
    #: front, and between chains
    silhouettes: Text
    #: WIDTH: Width of the outline around the whole molecule [silhouettes]
    outer_lines: Text
    #: WIDTH: Width of lines where one part is in front of another [silhouettes]
    inner_lines: Text
    #: WIDTH: Width of lines where chains meet [silhouettes]
    part_lines: Text
    #: WIDTH: Width of the lines around patches; 0: no lines [2.5 pixels of a picture of 960, wider in larger
    #: ones]
    patch_lines: Text
    #: COLOR: Colour of the lines around patches [black]
    patch_line_color: Text
    #: F: Fade of the farthest atoms into the background, 0 to 1. A transparent background counts as white.
    #: Presets do not fade where the background is transparent, colours show numbers, or a surface is seen
    #: through or cut for atoms to be seen (look_into)
    depth_cue: float
    #: Make transparent edges for programs that blend in linear light. Without it .png and .tif pictures look
    #: right on a page
    linear_alpha: bool
    #: WORD: Material of the surface
    material: Text
    #: Write a comment before each patch: its kind and its atoms
    comments: bool
    #: WORD: Projection of the camera: perspective or orthographic [perspective]
    projection: Literal["perspective", "orthographic"]
    #: WxH: Size of the picture in pixels; auto: as high as the molecule [1280x960; film 1920x1080, .gif
    #: 960x540]
    size: Numbers
    #: LENGTH: Width of the picture: 85mm, 8.5cm, 3.5in or 1000px
    width: Text
    #: LENGTH: Height of the picture in the same units; auto: that of the molecule
    height: Text
    #: LENGTH: Margin around the molecule of size=auto and height=auto [2mm]
    margin: Text
    #: N: Resolution of the picture in dots per inch [300 for lengths]
    dpi: float
    #: N: Rays per pixel, for smooth edges [9]
    samples: int
    #: COLOR: Background: transparent, or a colour (white, #rrggbb) [transparent]
    background: Text
    #: Add depth, normals, positions and atoms to an .exr. Layers: Z, N, P, Nview, Pview, atom, kind and
    #: component at each pixel's centre; in frames of a run also forward, the motion to the next one
    aovs: bool
    #: Add mattes of chains, residues and atoms to an .exr (Cryptomatte). Layers: CryptoChain, CryptoResidue and
    #: CryptoAtom
    cryptomatte: bool
    #: WORD: Primaries of the colours of an .exr: rec709, those of sRGB, or acescg [rec709]
    color_space: Literal["rec709", "acescg"]
    #: WORD: Compression of a .tif: none, lzw or zip [zip]
    tiff_compression: Literal["none", "lzw", "zip"]
    #: N: Bits per channel of a .tif: 8 or 16 [16]
    tiff_bits: Literal["8", "16"]
    #: WORD: Part of the surface that the GPU computes: visible, complete or paper. visible: what this view
    #: needs, for the same picture; complete: everything, by the same method; paper: as Krone et al. 2010 select
    #: it, where deep clefts may have holes
    extent: Text


class SceneValues(SurfaceValues, total=False):
    """The properties of a scene."""
    #: Molecule
    file: Path
    #: FILE: Add the atoms of another molecule file, as model 2, 3 ... of the first. Repeatable
    add: Union[Path, Sequence[Path]]
    #: EXPR: Superpose the files of add on FILE by these atoms. 'name CA' takes alpha carbons. Chains are paired
    #: and aligned by sequence; the number of atoms and the RMSD are printed
    superpose_on: Text
    #: N|all: Model to read, from 1; all: all models as one molecule [1]
    model: Text
    #: WORD: Alternate location to keep: best, first, a letter, or all. best: that of the highest occupancy in
    #: each residue [best]
    altloc: Text
    #: EXPR: Use these atoms, such as 'chain A and resid 10-50' or all. Default: the polymers of FILE, or all of
    #: a file without one. See meniscus help selections
    select: Text
    #: Use water molecules, too
    keep_water: bool
    #: Use free ions, too: lone metal and halogen atoms
    keep_ions: bool
    #: WORD: Atoms of unknown element: halt, guess or skip. halt: stop with an error; guess: use a radius of 2.0
    #: Å; skip: leave them out [halt]
    unknown_element: Literal["halt", "guess", "skip"]
    #: WORD: Hydrogens: keep, drop or auto. auto: drop them if the radii of heavy atoms include them [auto]
    hydrogens: Literal["keep", "drop", "auto"]
    #: SET: Van der Waals radii: bondi, united, protor, martini2, martini3 or file. bondi: by element; united
    #: (Chothia 1976) and protor (Tsai et al. 1999) include hydrogens; martini2 and martini3: of beads; file:
    #: those of FILE [file if it has radii, else bondi; of Martini's beads those of its version]
    radii: Text
    #: FILE: File of radii by residue and atom, used before radii. Formats: atmtypenumbers of MSMS, FreeSASA
    #: .config, CHARMM .rtf with .prm (or .str), PDB2PQR .DAT, or lines RESIDUE ATOM RADIUS. Repeatable; the
    #: last file that has an atom counts
    radii_file: Union[Path, Sequence[Path]]
    #: EXPR=R: Radius R in Å of the atoms of EXPR, before all others. Repeatable; the last one counts
    radius: Union[Text, Sequence[Text]]
    #: ID: Build this biological assembly; list: print all of FILE and stop. Assemblies come from REMARK 350 or
    #: mmCIF
    assembly: Text
    #: WORD: Compute one copy of an assembly and draw it many times. exact: refuse if a probe can touch two
    #: copies at once; separate: give each copy a surface as if it were alone
    instances: Literal["exact", "separate"]
    #: PATH: Trajectory: coordinates of the atoms of FILE, frame by frame. Repeatable: one after the other.
    #: Without it the models of FILE are the frames; meniscus formats lists the formats
    trajectory: Union[Path, Sequence[Path]]
    #: EXPR: Atoms of FILE that the trajectory contains, such as 'not water'
    trajectory_atoms: Text
    #: Accept the trajectory's atom order even if bonds are too long
    trust_atom_order: bool
    #: LIST: Frames of the run: all, or a list such as 0-99:10,250,last. Frames count from 0; -10- means the
    #: last ten
    frames: Text
    #: N: Use every Nth frame [1]
    stride: int
    #: WHEN: First frame or time to use, such as 10, 300ps or 2.5ns
    begin: Text
    #: WHEN: Last frame or time to use
    end: Text
    #: N: Show each frame N times, for slow motion or a moving camera. The files of frame F are numbered F*N,
    #: F*N + 1 and so on [1]
    repeat: int
    #: N: Make N frames of each: itself, and N - 1 on the way to the next. Atoms go along smooth curves; the
    #: files are numbered as with repeat [1]
    interpolate: int
    #: LIST: Make only these frames, as one part of the whole run. Camera, colours and scene stay those of the
    #: whole run
    only: Text
    #: Evaluate selections in the first frame only, not in each. This matters for distances, coordinates and
    #: secondary structure
    select_once: bool
    #: WORD: Make molecules whole that the periodic box cuts, and gather them. bonds: by those of FILE and of
    #: standard residues; guess: by distance [bonds]
    whole: Text
    #: EXPR: Superpose each frame on the reference frame by these atoms
    superpose: Text
    #: EXPR: Move each frame so that the centre of these atoms stays fixed
    center: Text
    #: N: Reference frame of superpose and center: a number, or last [0]
    reference: Text
    #: N: Average positions over N frames around each frame; N is odd [1]
    smooth: int
    #: N: Frames per second of a film [25]
    fps: float
    #: N: Blur what moves. Each picture is the mean of N moments, over half the time from a frame to the next
    #: [1, no blur]
    motion_blur: int
    #: WORD: Codec: h264, h265, vp9, prores, prores4444, dnxhr or gif. h264 is for .mp4, .mov and .mkv, vp9 for
    #: .webm; prores4444 (.mov) keeps transparency [by the file's ending]
    codec: Text
    #: N: Quality of a film (rate factor): lower is better and larger [h264 18, h265 20, vp9 24]
    crf: int
    #: N: Bits per channel of a film: 8 or 10 [8; prores 10]
    bits: int
    #: N: Chroma subsampling of a film: 420, 422 or 444 [420; prores, dnxhr 422]
    chroma: int
    #: Hide the surface; show only what is beside it
    hide_surface: bool
    #: A:B: Open the contact of two groups like a book: A:B, A,C:B or EXPR:EXPR. Both sides face the viewer and
    #: are coloured by buried area
    interface: Text
    #: KIND: Kind of surface: ses, sas or vdw. ses: solvent-excluded; sas: solvent-accessible; vdw: van der
    #: Waals, without a probe [ses]
    surface: Literal["ses", "sas", "vdw"]
    #: RADIUS: Radius of the probe in Å; 0 gives the van der Waals surface [1.4]
    probe: Text
    #: EXPR: Show only the surface of these atoms. It is still computed with all atoms
    show: Text
    #: EXPR: Contiguous areas of these atoms, as a table or outlined in pictures. Such as 'hydrophobicity > 1.5'
    #: or 'charge < -0.3'
    patches: Text
    #: Å²: Smallest area of a patch that is listed or outlined [10]
    min_patch: float
    #: WORD: Split into objects: by chain, model, class, residue or component. chain, model, class (polymer,
    #: ligand, ...), residue: each has a surface as if it were alone; component: each closed part of the one
    #: surface
    by: Text
    #: WORD: Cavities: keep, drop or only. drop: leave out what cannot be reached from outside; only: cavities
    #: and what lies in them [keep]
    cavities: Literal["keep", "drop", "only"]
    #: DEVICE: Device: auto, gpu, gpu:N, software or cpu. auto: a GPU if there is one, else cpu; N: a number,
    #: UUID or PCI address; software: OpenGL without a GPU [auto]
    device: Text
    #: Fail with exit code 4 if there is no hardware GPU. Without it the CPU or software OpenGL is used
    require_gpu: bool
    #: N: Number of CPU threads [all]
    threads: int
    #: Compute on GPU and CPU, and report every difference
    verify: bool
    #: NUMBERS: Colour by numbers from a file. One number per atom of FILE or per atom used; lines of chain,
    #: residue and number; or a table with a header, such as the program's --csv-residues of meniscus surface
    #: writes, or resid,score for one chain. Commas, semicolons, tabs or blanks; nan, ? and - mean missing.
    #: Grades from 1 to 9: color=conservation
    color_by_file: Path
    #: NAME: Column of the table of color_by_file
    color_column: Text
    #: FILE: Colour by a volume map, such as a potential from APBS. Formats: OpenDX (.dx), Gaussian cube,
    #: CCP4/MRC. Needs color_range; the default map is red-white-blue
    color_map_file: Path
    #: Å: Distance outside the surface at which the map is sampled, in Å. Centres of solvent molecules lie at
    #: 1.4 [0]
    map_offset: float
    #: MAP: Colour map for numbers, such as viridis or blue-white-red. Others: cividis, magma, red-white-blue
    #: (default for charge: negative is red), blues and ylorrd (light), consurf (grades 1 to 9), rainbow, pastel
    #: (rainbow in light tones), categorical (each number has its own colour). blue-white-red is the default for
    #: hydrophobicity [viridis]
    map: Text
    #: FILE: File of a colour map: one colour per line, or a position and a colour. A JSON list of them is read,
    #: too
    map_file: Path
    #: LO:HI: Numbers at the ends of the colour map, or auto. auto: the smallest and the largest; for charge
    #: symmetric about 0, for hydrophobicity -4.5:4.5 [auto]
    color_range: Text
    #: COLOR: Colour of atoms without a number and points outside the map [#808080; cividis #cc79a7; consurf
    #: #ffff96]
    missing_color: Text
    #: TEXT: Title of the colour scale in the legend
    color_title: Text
    #: TEXT: Unit of the colour scale, such as kT/e
    color_unit: Text
    #: EXPR=N: Opacity from 0 (hidden) to 1: a number, or EXPR=0.4 for some atoms. Repeatable; the last one
    #: counts
    opacity: Union[Text, Sequence[Text]]
    #: Make transparent surfaces denser at grazing angles, like a thin film
    film_opacity: bool
    #: PLANE: Cut by a plane with exact caps: x<20, 1,1,0>35 or depth>0.5. The part where this holds is kept.
    #: depth runs along the line of sight from 0 (nearest) to 1 (farthest). 'through EXPR' goes through the
    #: middle of these atoms, 'before EXPR' is as deep as it must be for them to be seen. Repeatable; all apply
    clip: Union[Text, Sequence[Text]]
    #: Cut sticks, balls, tubes and all else beside the surface by clip, too
    clip_all: bool
    #: COLOR: Colour of caps: atom (that of the nearest) or a colour (red, #rrggbb) [atom]
    cap_color: Text
    #: Å: Distance of dark lines on caps, in Å; 0: no lines [0]
    cap_hatching: float
    #: EXPR: Draw these atoms as sticks, also outside select. Repeatable
    sticks: Union[Text, Sequence[Text]]
    #: EXPR: Draw these atoms as balls and sticks
    balls: Union[Text, Sequence[Text]]
    #: EXPR: Draw these atoms as spheres of their van der Waals radii
    spheres: Union[Text, Sequence[Text]]
    #: EXPR: Draw the backbone of these atoms as a cartoon: tubes, ribbons, arrows. Helices are ribbons, strands
    #: are arrows, nucleic acids are bands with filled bases
    tube: Union[Text, Sequence[Text]]
    #: EXPR: Draw the bases of these nucleotides as filled rings. Rungs lead to the tube
    bases: Union[Text, Sequence[Text]]
    #: EXPR: Draw these sugars as solid symbols (3D-SNFG). Such as spheres, cubes, cones; their colours:
    #: color=snfg
    glycans: Union[Text, Sequence[Text]]
    #: EXPR: Draw hydrogen bonds of these atoms as dashed lines, with lengths. 'EXPR to EXPR': only those
    #: between two sets. Water counts where it is drawn or selected
    hydrogen_bonds: Union[Text, Sequence[Text]]
    #: EXPR to EXPR: Draw the smallest distance of two sets of atoms as a dashed line
    distance: Union[Text, Sequence[Text]]
    #: Draw no ligands and ions beside the surface of a polymer. Objects that are named stay
    bare: bool
    #: Å: Radius of sticks in Å, also of bases and between glycans [0.25; 0.15 between balls]
    stick_radius: float
    #: Å: Radius of tubes in Å. Ribbons and arrows scale with it [0.45]
    tube_radius: float
    #: JSON: Draw one more object with its own look, as JSON of a scene file. Such as '{"representation":
    #: "surface", "selection": "chain B", "color": "red"}'. Repeatable
    object: Union[Text, Sequence[Text]]
    #: FILE: Camera as JSON, or as PyMOL or ChimeraX print it. A file, or the text itself: JSON, get_view or
    #: view matrix [shows everything]
    camera: Path
    #: SIDE: Side that faces the viewer, such as front, top or left. front: the broad side that shows more;
    #: back, bottom, right; x, y, z: axes of the file; 1, 2, 3: axes of inertia, longest first; symmetry: along
    #: the axis of assembly; symmetry-side: with that axis upright; open: from where the atoms of zoom_to are
    #: hidden least; channel: along a channel through them. A minus sign before it shows the opposite side
    #: [front]
    view: Text
    #: AXISANGLE: Turn the molecule about an axis by degrees: y90, x-30, z45. x points right, y up, z to the
    #: viewer. Repeatable, applied in this order
    turn: Union[Text, Sequence[Text]]
    #: EXPR: Fill the picture with these atoms [all that show leaves]
    zoom_to: Text
    #: EXPR: Look at these atoms from the open side, with the surface cut before them. Of several places the
    #: first is shown. Short for zoom_to='first EXPR' view=open clip='before first EXPR'
    look_into: Text
    #: FILE: JSON file of key frames (frame, camera) of a moving camera
    camera_path: Path
    #: TURNS: Turns of the camera around the molecule over the run. Negative numbers turn the other way
    turntable: float
    #: EXPR: Move the camera with the centre of these atoms
    follow: Text
    #: Show a legend of the colours, at the right or, in tall pictures, below
    legend: bool
    #: FILE: Write the legend as a separate picture
    legend_file: Path
    #: TEXT: Title of the legend; '' for none [by the colours]
    legend_title: Text
    #: SIZE: Height of the letters: pixels, 8pt or 3mm [that of letter_size, or a thirtieth of the shorter side]
    legend_size: Text
    #: ENTRY=TEXT: Write TEXT instead of an entry of the legend, as in 'A=Alpha' for chain A. Repeatable
    legend_name: Union[Text, Sequence[Text]]
    #: WORD: Place of the legend: auto, right or below [auto]
    legend_place: Literal["auto", "right", "below"]
    #: TEXT: Letter of the panel, such as a, at the top left
    panel: Text
    #: TEXT: Title of the picture, at the top
    title: Text
    #: Å: Draw a scale bar of this length, or of a round one (auto). With a perspective camera it is true at the
    #: camera's target [auto]
    scale_bar: Text
    #: SIZE: Height of all letters that have no size of their own: pixels, 8pt or 3mm [by the size of the
    #: picture]
    letter_size: Text
    #: NAME: Font of all letters: an installed family, such as DejaVu Sans [Liberation Sans, else DejaVu Sans]
    font: Text
    #: FILE: Font of all letters: a .ttf or .otf file
    font_file: Path
    #: SIZE: Height of the letters of labels [that of letter_size]
    label_size: Text
    #: SIZE: Height of the letters of the scale bar [that of letter_size]
    scale_bar_size: Text
    #: SIZE: Height of the letter of the panel [1.5 times letter_size]
    panel_size: Text
    #: COLOR: Colour of letters, lines and bars: auto, or a colour. auto: dark or light, as background needs;
    #: dark if it is transparent [auto]
    letter_color: Text
    #: EXPR=TEXT: Write TEXT at these atoms, with a line to their centre. Repeatable
    label: Union[Text, Sequence[Text]]
    #: Write no lengths next to dashed lines
    hide_lengths: bool
    #: Write the time of each frame in ps, ns or µs, or else its number
    time_stamp: bool
    #: FILE.csv: Draw a curve of the run from a CSV table, with a mark at each frame. Such tables are written by
    #: the program's --csv-series of meniscus surface
    curve: Path
    #: NAME: Column of the table to draw [the first after the time]
    curve_column: Text
    #: Å: Largest distance between mesh and surface, in Å
    tolerance: float
    #: PIXELS: Largest distance between mesh and surface, in pixels, such as 0.25
    tolerance_pixels: float
    #: NUMBER: Vertices per Å², instead of a tolerance. 0.02 gives about one triangle per atom; triangles are
    #: even
    density: float
    #: Make nearly equilateral triangles. They cross the borders of patches
    even: bool
    #: WORD: Format of the file, if its ending does not tell
    format: Text
    #: NAMES: Numbers of vertices to write in PLY, VTP, GLB and USD, separated by commas [usual]
    attributes: Text
    #: UNIT: Unit of the file: angstrom or nanometer [angstrom]
    unit: Literal["angstrom", "nanometer"]
    #: LENGTH: Length of 1 Å in the file. The unit of 3MF is the millimetre, that of GLB and USD the metre;
    #: others have none [1]
    scale: float
    #: PATH: Output file or folder
    output: Path


class SceneAttributes:
    """The attributes of a Scene; None for the default."""
    file: Optional[Path]; add: Optional[Union[Path, Sequence[Path]]]; superpose_on: Optional[Text]
    model: Optional[Text]; altloc: Optional[Text]; select: Optional[Text]; keep_water: Optional[bool]
    keep_ions: Optional[bool]; unknown_element: Optional[Literal["halt", "guess", "skip"]]
    hydrogens: Optional[Literal["keep", "drop", "auto"]]; radii: Optional[Text]
    radii_file: Optional[Union[Path, Sequence[Path]]]; radius: Optional[Union[Text, Sequence[Text]]]
    assembly: Optional[Text]; instances: Optional[Literal["exact", "separate"]]
    trajectory: Optional[Union[Path, Sequence[Path]]]; trajectory_atoms: Optional[Text]
    trust_atom_order: Optional[bool]; frames: Optional[Text]; stride: Optional[int]; begin: Optional[Text]
    end: Optional[Text]; repeat: Optional[int]; interpolate: Optional[int]; only: Optional[Text]
    select_once: Optional[bool]; whole: Optional[Text]; superpose: Optional[Text]; center: Optional[Text]
    reference: Optional[Text]; smooth: Optional[int]; fps: Optional[float]; motion_blur: Optional[int]
    codec: Optional[Text]; crf: Optional[int]; bits: Optional[int]; chroma: Optional[int]; hide_surface: Optional[bool]
    interface: Optional[Text]; surface: Optional[Literal["ses", "sas", "vdw"]]; probe: Optional[Text]
    patches: Optional[Text]; min_patch: Optional[float]; by: Optional[Text]
    cavities: Optional[Literal["keep", "drop", "only"]]; device: Optional[Text]; require_gpu: Optional[bool]
    threads: Optional[int]; verify: Optional[bool]; color: Optional[Union[Text, Sequence[Text]]]
    color_by_file: Optional[Path]; color_column: Optional[Text]; color_map_file: Optional[Path]
    map_offset: Optional[float]; map: Optional[Text]; map_file: Optional[Path]; color_range: Optional[Text]
    missing_color: Optional[Text]; color_title: Optional[Text]; color_unit: Optional[Text]
    opacity: Optional[Union[Text, Sequence[Text]]]; film_opacity: Optional[bool]
    clip: Optional[Union[Text, Sequence[Text]]]; clip_all: Optional[bool]; cap_color: Optional[Text]
    cap_hatching: Optional[float]; sticks: Optional[Union[Text, Sequence[Text]]]
    balls: Optional[Union[Text, Sequence[Text]]]; spheres: Optional[Union[Text, Sequence[Text]]]
    tube: Optional[Union[Text, Sequence[Text]]]; bases: Optional[Union[Text, Sequence[Text]]]
    glycans: Optional[Union[Text, Sequence[Text]]]; hydrogen_bonds: Optional[Union[Text, Sequence[Text]]]
    distance: Optional[Union[Text, Sequence[Text]]]; bare: Optional[bool]; stick_radius: Optional[float]
    tube_radius: Optional[float]; object: Optional[Union[Text, Sequence[Text]]]
    preset: Optional[Literal["publication", "cover", "flat", "soft", "classic", "ghost", "goodsell", "pocket", "ribbon"]]
    light: Optional[Numbers]; light_strength: Optional[float]; ambient: Optional[float]; roughness: Optional[float]
    specular: Optional[float]; shininess: Optional[float]; ambient_occlusion: Optional[float]
    ambient_occlusion_radius: Optional[float]; ambient_occlusion_rays: Optional[float]; shadows: Optional[float]
    shadow_softness: Optional[float]; silhouettes: Optional[Text]; outer_lines: Optional[Text]
    inner_lines: Optional[Text]; part_lines: Optional[Text]; patch_lines: Optional[Text]
    patch_line_color: Optional[Text]; depth_cue: Optional[float]; linear_alpha: Optional[bool]
    material: Optional[Text]; comments: Optional[bool]; camera: Optional[Path]
    projection: Optional[Literal["perspective", "orthographic"]]; view: Optional[Text]
    turn: Optional[Union[Text, Sequence[Text]]]; zoom_to: Optional[Text]; look_into: Optional[Text]
    camera_path: Optional[Path]; turntable: Optional[float]; follow: Optional[Text]; size: Optional[Numbers]
    width: Optional[Text]; height: Optional[Text]; margin: Optional[Text]; dpi: Optional[float]; samples: Optional[int]
    background: Optional[Text]; aovs: Optional[bool]; cryptomatte: Optional[bool]
    color_space: Optional[Literal["rec709", "acescg"]]; tiff_compression: Optional[Literal["none", "lzw", "zip"]]
    tiff_bits: Optional[Literal["8", "16"]]; extent: Optional[Text]; legend: Optional[bool]
    legend_file: Optional[Path]; legend_title: Optional[Text]; legend_size: Optional[Text]
    legend_name: Optional[Union[Text, Sequence[Text]]]; legend_place: Optional[Literal["auto", "right", "below"]]
    panel: Optional[Text]; title: Optional[Text]; scale_bar: Optional[Text]; letter_size: Optional[Text]
    font: Optional[Text]; font_file: Optional[Path]; label_size: Optional[Text]; scale_bar_size: Optional[Text]
    panel_size: Optional[Text]; letter_color: Optional[Text]; label: Optional[Union[Text, Sequence[Text]]]
    hide_lengths: Optional[bool]; time_stamp: Optional[bool]; curve: Optional[Path]; curve_column: Optional[Text]
    tolerance: Optional[float]; tolerance_pixels: Optional[float]; density: Optional[float]; even: Optional[bool]
    format: Optional[Text]; attributes: Optional[Text]; unit: Optional[Literal["angstrom", "nanometer"]]
    scale: Optional[float]; output: Optional[Path]
