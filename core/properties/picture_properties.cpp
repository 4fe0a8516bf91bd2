// SPDX-License-Identifier: BSD-3-Clause
// Properties of the camera and of the picture that it makes.
#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kCamera = "Camera", kPicture = "Picture", kFramesOfPicture = "Frames";

constexpr auto kTable = std::to_array<Property>({
    camera("camera.from", "--camera", "FILE",
           "Camera as JSON, or as PyMOL or ChimeraX print it. A file, or the text itself: JSON, get_view or view "
           "matrix")
        .initially("shows everything")
        .in(kCamera, kShared | in_short_help),
    word("camera.projection", "--projection", "WORD", "Projection of the camera: perspective or orthographic")
        .one_of("perspective|orthographic")
        .initially("perspective")
        .in(kCamera, kShared | live)
        .excludes("camera.from"),
    text("camera.view", "--view", "SIDE",
         "Side that faces the viewer, such as front, top or left. front: the broad side; back, bottom, right; x, "
         "y, z: axes of the file; 1, 2, 3: axes of inertia, longest first; symmetry: along the axis of @assembly@; "
         "symmetry-side: with that axis upright; open: from where the atoms of @zoom-to@ are hidden least; "
         "channel: along a channel through them. A minus sign before it shows the opposite side")
        .initially("front")
        .in(kCamera, kShared | in_short_help)
        .excludes("camera.from"),
    text("camera.turn", "--turn", "AXISANGLE",
         "Turn the molecule about an axis by degrees: y90, x-30, z45. x points right, y up, z to the viewer. "
         "Repeatable, applied in this order")
        .in(kCamera, kShared | repeatable | in_short_help),
    text("camera.zoom_to", "--zoom-to", "EXPR", "Fill the picture with these atoms")
        .initially("all that @show@ leaves")
        .in(kCamera, kShared | in_short_help),
    text("camera.look_into", "--look-into", "EXPR",
         "Look at these atoms from the open side, with the surface cut before them. Of several places the first is "
         "shown. Short for @zoom-to 'first EXPR'@ @view open@ @clip 'before first EXPR'@")
        .in(kCamera, in_bundle | in_short_help)
        .excludes("camera.from|camera.view|camera.zoom_to"),
    text("camera.named_views", "--named-view", "NAME=FILE",
         "View that readers of the page choose by its name. FILE: a camera as for @camera@, or a scene or picture, "
         "with its cuts and opacity. Repeatable")
        .in(kCamera, repeatable),
    file("camera.path", "--camera-path", "FILE", "JSON file of key frames (frame, camera) of a moving camera")
        .in(kCamera, kShared)
        .excludes("camera.from|camera.view|camera.turn|camera.zoom_to"),
    number("camera.turntable", "--turntable", "TURNS",
           "Turns of the camera around the molecule over the run. Negative numbers turn the other way")
        .in(kCamera, kShared | in_short_help),
    text("camera.follow", "--follow", "EXPR", "Move the camera with the centre of these atoms").in(kCamera, kShared),
    new_file("camera.save", "--save-camera", "FILE",
             "Save the camera as JSON for @camera@, or its path for @camera-path@")
        .in(kCamera),

    text("image.size", "--size", "WxH", "Size of the picture in pixels; auto: as high as the molecule")
        .initially("1280x960; film 1920x1080, .gif 960x540")
        .in(kPicture, kShared | live | in_short_help),
    text("image.width", "--width", "LENGTH", "Width of the picture: 85mm, 8.5cm, 3.5in or 1000px")
        .in(kPicture, kShared | live | in_short_help)
        .excludes("image.size"),
    text("image.height", "--height", "LENGTH", "Height of the picture in the same units; auto: that of the molecule")
        .in(kPicture, kShared | live)
        .excludes("image.size"),
    text("image.margin", "--margin", "LENGTH", "Margin around the molecule of @size auto@ and @height auto@")
        .from(0, 10000)
        .initially("2mm")
        .in(kPicture, kShared),
    number("image.dpi", "--dpi", "N", "Resolution of the picture in dots per inch")
        .from(1, 1e5)
        .initially("300 for lengths")
        .with<&Property::label>("Dots per inch")
        .in(kPicture, kShared | live),
    count("image.samples", "--samples", "N", "Rays per pixel, for smooth edges")
        .from(1, 1024)
        .initially("9")
        .with<&Property::label>("Rays per pixel")
        .in(kPicture, kShared | live | in_short_help),
    text("image.background", "--background", "COLOR", "Background: transparent, or a colour (white, #rrggbb)")
        .proposes("transparent|white|black")
        .initially("transparent")
        .in(kPicture, kShared | live | in_short_help),
    flag("image.aovs", "--aovs",
         "Add depth, normals, positions and atoms to an .exr. Layers: Z, N, P, Nview, Pview, atom, kind and "
         "component at each pixel's centre; in frames of a run also forward, the motion to the next one")
        .in(kPicture, kShared),
    flag("image.cryptomatte", "--cryptomatte",
         "Add mattes of chains, residues and atoms to an .exr (Cryptomatte). "
         "Layers: CryptoChain, CryptoResidue and CryptoAtom")
        .in(kPicture, kShared),
    word("image.color_space", "--color-space", "WORD",
         "Primaries of the colours of an .exr: rec709, those of sRGB, or acescg")
        .one_of("rec709|acescg")
        .initially("rec709")
        .in(kPicture, kShared),
    word("image.tiff_compression", "--tiff-compression", "WORD", "Compression of a .tif: none, lzw or zip")
        .one_of("none|lzw|zip")
        .initially("zip")
        .in(kPicture, kShared | rare),
    word("image.tiff_bits", "--tiff-bits", "N", "Bits per channel of a .tif: 8 or 16")
        .one_of("8|16")
        .initially("16")
        .in(kPicture, kShared | rare),
    text("image.extent", "--extent", "WORD",
         "Part of the surface that the GPU computes: visible, complete or paper. visible: what this view needs, "
         "for the same picture; complete: everything, by the same method; paper: as Krone et al. 2010 select it, "
         "where deep clefts may have holes")
        .proposes("visible|complete|paper")
        .in(kPicture, kShared),
    flag("picture.stats", "--stats", "With @extent@: print counts and times of each group of stages")
        .in(kPicture, rare),
    flag("picture.draft", "--draft",
         "Draw a draft in a fraction of the time. It has half the width and height, and one ray per pixel")
        .in(kPicture, in_short_help),
    flag("picture.any_cost", "--any-cost", "Make a picture of more than 10^10 rays, too, which takes hours")
        .in(kPicture, in_bundle | rare),
    flag("picture.resume", "--resume",
         "Keep the picture, or those of a run, if they are there, and make the rest. Give it from the start: "
         "pictures then say of what they were made")
        .in(kFramesOfPicture),
    flag("picture.provenance", "--provenance", "Store the command line in the picture (.png, .tif, .jpg, .exr)")
        .in(kPicture, in_bundle),
    flag("picture.no_provenance", "--no-provenance",
         "Do not store the scene and the version in the picture. The scene is all of these options, without folders")
        .in(kPicture, in_bundle),
});

}  // namespace

std::span<const Property> picture_properties() { return kTable; }

}  // namespace meniscus
