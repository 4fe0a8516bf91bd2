// SPDX-License-Identifier: BSD-3-Clause
// Properties of the camera, of the picture that it makes, and of runs of frames: the choice of frames, the motion of
// their atoms, and films of them.

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
         "Side that faces the viewer, such as front, top or left. front: the broad side that shows more; back, bottom, "
         "right; x, y, z: axes of the file; 1, 2, 3: axes of inertia, longest first; symmetry: along the axis of "
         "@assembly@; "
         "symmetry-side: with that axis upright; open: the best view of the atoms of @zoom-to@; "
         "channel: along a channel through them. A minus sign shows the opposite side")
        .initially("front")
        .in(kCamera, kShared | in_short_help)
        .excludes("camera.from"),
    text("camera.turn", "--turn", "AXISANGLE",
         "Turn the molecule about an axis by degrees: y90, x-30, z45. x points right, y up, z to the viewer. "
         "Repeatable, applied in this order")
        .in(kCamera, kShared | repeatable | in_short_help),
    text("camera.zoom_to", "--zoom-to", "EXPR", "Fill the picture with these atoms")
        .initially("everything shown")
        .in(kCamera, kShared | in_short_help),
    text("camera.look_into", "--look-into", "EXPR",
         "Look at these atoms from the open side, with the surface cut open. If they are at several places, the first "
         "is shown. Short for @zoom-to 'first EXPR'@ @view open@ @clip 'before first EXPR'@")
        .in(kCamera, in_bundle | in_short_help)
        .excludes("camera.from|camera.view|camera.zoom_to"),
    text("camera.named_views", "--named-view", "NAME=FILE",
         "View that readers of the page choose by name. FILE: a camera as for @camera@, or a scene or picture, "
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
    text("image.height", "--height", "LENGTH", "Height of the picture in the same units; auto: as high as the molecule")
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
         "Primaries of the colours of an .exr: rec709 (as in sRGB) or acescg")
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
         "Keep finished pictures and make the rest. Use it from the start, because pictures then state what they were "
         "made of")
        .in(kFramesOfPicture),
    flag("picture.provenance", "--provenance", "Store the command line in the picture (.png, .tif, .jpg, .exr)")
        .in(kPicture, in_bundle),
    flag("picture.no_provenance", "--no-provenance",
         "Do not store the scene and the version in the picture. The scene is all of these options, without folders")
        .in(kPicture, in_bundle),
});

constexpr std::string_view kFrames = "Frames", kMotion = "Alignment of frames", kFilm = "Film";

constexpr auto kRunTable = std::to_array<Property>({
    file("frames.trajectories", "TRAJECTORY", "", "Trajectory files, the same as @trajectory@").in(kFrames, repeatable),
    file("frames.trajectory", "--trajectory", "PATH",
         "Trajectory: coordinates of the atoms of FILE, frame by frame. Repeatable: one after the other. Without "
         "it the models of FILE are the frames; meniscus formats lists the formats")
        .in(kFrames, kShared | repeatable | in_short_help),
    text("frames.trajectory_atoms", "--trajectory-atoms", "EXPR",
         "Atoms of FILE that the trajectory contains, such as 'not water'")
        .in(kFrames, kShared),
    flag("frames.trust_atom_order", "--trust-atom-order",
         "Accept the trajectory's atom order even if bonds are too long")
        .in(kFrames, kShared),
    text("frames.frames", "--frames", "LIST",
         "Frames of the run: all, or a list such as 0-99:10,250,last. Frames count from 0; -10- means the last ten")
        .in(kFrames, kShared | in_short_help),
    count("frames.stride", "--stride", "N", "Use every Nth frame")
        .from(1, kUnlimited)
        .initially("1")
        .in(kFrames, kShared),
    text("frames.begin", "--begin", "WHEN", "First frame or time to use, such as 10, 300ps or 2.5ns")
        .in(kFrames, kShared),
    text("frames.end", "--end", "WHEN", "Last frame or time to use").in(kFrames, kShared),
    count("frames.repeat", "--repeat", "N",
          "Show each frame N times, for slow motion or a moving camera. The files of frame F are numbered F*N, F*N "
          "+ 1 and so on")
        .from(1, 1e6)
        .initially("1")
        .in(kFrames, kShared),
    count("frames.interpolate", "--interpolate", "N",
          "Insert N - 1 frames between each two. Atoms go along smooth curves; files are numbered as with @repeat@")
        .from(1, 1e6)
        .initially("1")
        .in(kFrames, kShared | in_short_help)
        .excludes("frames.repeat"),
    text("frames.only", "--only", "LIST",
         "Make only these frames of the run. Camera, colours and scene stay those of the whole run")
        .in(kFrames),
    flag("frames.select_once", "--select-once",
         "Evaluate selections in the first frame only, not in each. This matters for distances, coordinates and "
         "secondary structure")
        .in(kFrames, kShared),
    text("frames.whole", "--whole", "WORD",
         "Make molecules whole that the periodic box cuts, and gather them. bonds: by bonds of FILE and of "
         "standard residues; guess: by distance")
        .proposes("bonds|guess")
        .initially("bonds")
        .in(kMotion, kShared | value_optional),
    text("frames.superpose", "--superpose", "EXPR", "Superpose each frame on the reference frame by these atoms")
        .in(kMotion, kShared | in_short_help),
    text("frames.center", "--center", "EXPR", "Move each frame so that the centre of these atoms stays fixed")
        .in(kMotion, kShared),
    text("frames.reference", "--reference", "N", "Reference frame of @superpose@ and @center@: a number, or last")
        .initially("0")
        .in(kMotion, kShared),
    count("frames.smooth", "--smooth", "N", "Average positions over N frames around each frame; N is odd")
        .from(1, 9999)
        .initially("1")
        .in(kMotion, kShared),
    count("frames.jobs", "--jobs", "N", "Number of frames made at the same time")
        .from(1, 1024)
        .initially("as cores and memory allow")
        .in(kFrames),
    word("frames.progress", "--progress", "WORD",
         "Progress on standard error: auto, bar, plain, json, openjd or none. auto: a bar on a terminal, else "
         "plain lines; json: a line per frame")
        .one_of("auto|bar|plain|json|openjd|none")
        .initially("auto")
        .in(kFrames),

    number("frames.fps", "--fps", "N", "Frames per second of a film").from(0.1, 240).initially("25").in(kFilm, kShared),
    count("frames.motion_blur", "--motion-blur", "N",
          "Blur what moves. Each picture is the mean of N moments, over half the time from a frame to the next")
        .from(1, 256)
        .initially("1, no blur")
        .in(kFilm, kShared),
    text("frames.codec", "--codec", "WORD",
         "Codec: h264, h265, vp9, prores, prores4444, dnxhr or gif. h264 is for .mp4, .mov and .mkv, vp9 for "
         ".webm; prores4444 (.mov) keeps transparency")
        .initially("by the file's ending")
        .in(kFilm, in_scene),
    count("frames.crf", "--crf", "N", "Quality of a film (rate factor): lower is better and larger")
        .initially("h264 18, h265 20, vp9 24")
        .in(kFilm, in_scene),
    count("frames.bits", "--bits", "N", "Bits per channel of a film: 8 or 10")
        .initially("8; prores 10")
        .in(kFilm, in_scene | rare),
    count("frames.chroma", "--chroma", "N", "Chroma subsampling of a film: 420, 422 or 444")
        .initially("420; prores, dnxhr 422")
        .in(kFilm, in_scene | rare),
});

}  // namespace

std::span<const Property> picture_properties() { return kTable; }

std::span<const Property> frame_properties() { return kRunTable; }

}  // namespace meniscus
