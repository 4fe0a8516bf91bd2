# SPDX-License-Identifier: BSD-3-Clause
"""The types of the values of scenes (see meniscus.properties()), written by scripts/check/scene_values.py."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Literal, Optional, TypedDict, Union

Path = Union[str, "os.PathLike[str]"]
Text = Union[str, float]
Paths = Union[Path, Sequence[Path]]
Texts = Union[Text, Sequence[Text]]
#: A text, or its numbers: the width and the height of a picture, or a direction.
Numbers = Union[Text, Sequence[float]]


class SurfaceValues(TypedDict, total=False):
    """The properties of a picture of a surface: its look and its size."""
    color: Texts
    preset: Literal["publication", "cover", "flat", "soft", "classic", "ghost", "goodsell", "pocket", "ribbon"]
    light: Numbers; light_strength: float; ambient: float; roughness: float; specular: float; shininess: float
    ambient_occlusion: float; ambient_occlusion_radius: float; ambient_occlusion_rays: float; shadows: float
    shadow_softness: float; silhouettes: Text; outer_lines: Text; inner_lines: Text; part_lines: Text
    patch_lines: Text; patch_line_color: Text; depth_cue: float; linear_alpha: bool; material: Text; comments: bool
    projection: Literal["perspective", "orthographic"]; size: Numbers; width: Text; height: Text; margin: Text
    dpi: float; samples: int; background: Text; aovs: bool; cryptomatte: bool; color_space: Literal["rec709", "acescg"]
    tiff_compression: Literal["none", "lzw", "zip"]; tiff_bits: Literal["8", "16"]; extent: Text


class SceneValues(SurfaceValues, total=False):
    """The properties of a scene."""
    file: Path; add: Paths; superpose_on: Text; model: Text; altloc: Text; select: Text; keep_water: bool
    keep_ions: bool; unknown_element: Literal["halt", "guess", "skip"]; hydrogens: Literal["keep", "drop", "auto"]
    radii: Text; radii_file: Paths; radius: Texts; assembly: Text; instances: Literal["exact", "separate"]
    trajectory: Paths; trajectory_atoms: Text; trust_atom_order: bool; frames: Text; stride: int; begin: Text
    end: Text; repeat: int; interpolate: int; only: Text; select_once: bool; whole: Text; superpose: Text; center: Text
    reference: Text; smooth: int; fps: float; motion_blur: int; codec: Text; crf: int; bits: int; chroma: int
    hide_surface: bool; interface: Text; surface: Literal["ses", "sas", "vdw"]; probe: Text; show: Text; patches: Text
    min_patch: float; by: Text; cavities: Literal["keep", "drop", "only"]; device: Text; require_gpu: bool
    threads: int; verify: bool; color_by_file: Path; color_column: Text; color_map_file: Path; map_offset: float
    map: Text; map_file: Path; color_range: Text; missing_color: Text; color_title: Text; color_unit: Text
    opacity: Texts; film_opacity: bool; clip: Texts; clip_all: bool; cap_color: Text; cap_hatching: float
    sticks: Texts; balls: Texts; spheres: Texts; tube: Texts; bases: Texts; glycans: Texts; hydrogen_bonds: Texts
    distance: Texts; bare: bool; stick_radius: float; tube_radius: float; object: Texts; camera: Path; view: Text
    turn: Texts; zoom_to: Text; look_into: Text; camera_path: Path; turntable: float; follow: Text; legend: bool
    legend_file: Path; legend_title: Text; legend_size: Text; legend_name: Texts
    legend_place: Literal["auto", "right", "below"]; panel: Text; title: Text; scale_bar: Text; letter_size: Text
    font: Text; font_file: Path; label_size: Text; scale_bar_size: Text; panel_size: Text; letter_color: Text
    label: Texts; hide_lengths: bool; time_stamp: bool; curve: Path; curve_column: Text; tolerance: float
    tolerance_pixels: float; density: float; even: bool; format: Text; attributes: Text
    unit: Literal["angstrom", "nanometer"]; scale: float; output: Path


class SceneAttributes:
    """The attributes of a Scene; None for the default."""
    file: Optional[Path]; add: Optional[Paths]; superpose_on: Optional[Text]; model: Optional[Text]
    altloc: Optional[Text]; select: Optional[Text]; keep_water: Optional[bool]; keep_ions: Optional[bool]
    unknown_element: Optional[Literal["halt", "guess", "skip"]]; hydrogens: Optional[Literal["keep", "drop", "auto"]]
    radii: Optional[Text]; radii_file: Optional[Paths]; radius: Optional[Texts]; assembly: Optional[Text]
    instances: Optional[Literal["exact", "separate"]]; trajectory: Optional[Paths]; trajectory_atoms: Optional[Text]
    trust_atom_order: Optional[bool]; frames: Optional[Text]; stride: Optional[int]; begin: Optional[Text]
    end: Optional[Text]; repeat: Optional[int]; interpolate: Optional[int]; only: Optional[Text]
    select_once: Optional[bool]; whole: Optional[Text]; superpose: Optional[Text]; center: Optional[Text]
    reference: Optional[Text]; smooth: Optional[int]; fps: Optional[float]; motion_blur: Optional[int]
    codec: Optional[Text]; crf: Optional[int]; bits: Optional[int]; chroma: Optional[int]; hide_surface: Optional[bool]
    interface: Optional[Text]; surface: Optional[Literal["ses", "sas", "vdw"]]; probe: Optional[Text]
    patches: Optional[Text]; min_patch: Optional[float]; by: Optional[Text]
    cavities: Optional[Literal["keep", "drop", "only"]]; device: Optional[Text]; require_gpu: Optional[bool]
    threads: Optional[int]; verify: Optional[bool]; color: Optional[Texts]; color_by_file: Optional[Path]
    color_column: Optional[Text]; color_map_file: Optional[Path]; map_offset: Optional[float]; map: Optional[Text]
    map_file: Optional[Path]; color_range: Optional[Text]; missing_color: Optional[Text]; color_title: Optional[Text]
    color_unit: Optional[Text]; opacity: Optional[Texts]; film_opacity: Optional[bool]; clip: Optional[Texts]
    clip_all: Optional[bool]; cap_color: Optional[Text]; cap_hatching: Optional[float]; sticks: Optional[Texts]
    balls: Optional[Texts]; spheres: Optional[Texts]; tube: Optional[Texts]; bases: Optional[Texts]
    glycans: Optional[Texts]; hydrogen_bonds: Optional[Texts]; distance: Optional[Texts]; bare: Optional[bool]
    stick_radius: Optional[float]; tube_radius: Optional[float]; object: Optional[Texts]
    preset: Optional[Literal["publication", "cover", "flat", "soft", "classic", "ghost", "goodsell", "pocket", "ribbon"]]
    light: Optional[Numbers]; light_strength: Optional[float]; ambient: Optional[float]; roughness: Optional[float]
    specular: Optional[float]; shininess: Optional[float]; ambient_occlusion: Optional[float]
    ambient_occlusion_radius: Optional[float]; ambient_occlusion_rays: Optional[float]; shadows: Optional[float]
    shadow_softness: Optional[float]; silhouettes: Optional[Text]; outer_lines: Optional[Text]
    inner_lines: Optional[Text]; part_lines: Optional[Text]; patch_lines: Optional[Text]
    patch_line_color: Optional[Text]; depth_cue: Optional[float]; linear_alpha: Optional[bool]
    material: Optional[Text]; comments: Optional[bool]; camera: Optional[Path]
    projection: Optional[Literal["perspective", "orthographic"]]; view: Optional[Text]; turn: Optional[Texts]
    zoom_to: Optional[Text]; look_into: Optional[Text]; camera_path: Optional[Path]; turntable: Optional[float]
    follow: Optional[Text]; size: Optional[Numbers]; width: Optional[Text]; height: Optional[Text]
    margin: Optional[Text]; dpi: Optional[float]; samples: Optional[int]; background: Optional[Text]
    aovs: Optional[bool]; cryptomatte: Optional[bool]; color_space: Optional[Literal["rec709", "acescg"]]
    tiff_compression: Optional[Literal["none", "lzw", "zip"]]; tiff_bits: Optional[Literal["8", "16"]]
    extent: Optional[Text]; legend: Optional[bool]; legend_file: Optional[Path]; legend_title: Optional[Text]
    legend_size: Optional[Text]; legend_name: Optional[Texts]
    legend_place: Optional[Literal["auto", "right", "below"]]; panel: Optional[Text]; title: Optional[Text]
    scale_bar: Optional[Text]; letter_size: Optional[Text]; font: Optional[Text]; font_file: Optional[Path]
    label_size: Optional[Text]; scale_bar_size: Optional[Text]; panel_size: Optional[Text]
    letter_color: Optional[Text]; label: Optional[Texts]; hide_lengths: Optional[bool]; time_stamp: Optional[bool]
    curve: Optional[Path]; curve_column: Optional[Text]; tolerance: Optional[float]; tolerance_pixels: Optional[float]
    density: Optional[float]; even: Optional[bool]; format: Optional[Text]; attributes: Optional[Text]
    unit: Optional[Literal["angstrom", "nanometer"]]; scale: Optional[float]; output: Optional[Path]
