// SPDX-License-Identifier: BSD-3-Clause
// Properties of a run of frames: the choice of frames, the motion of their atoms, and films of them.
#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kFrames = "Frames", kMotion = "Alignment of frames", kFilm = "Film";

constexpr auto kTable = std::to_array<Property>({
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
          "Make N frames of each: itself, and N - 1 on the way to the next. Atoms go along smooth curves; the "
          "files are numbered as with @repeat@")
        .from(1, 1e6)
        .initially("1")
        .in(kFrames, kShared | in_short_help)
        .excludes("frames.repeat"),
    text("frames.only", "--only", "LIST",
         "Make only these frames, as one part of the whole run. Camera, colours and scene stay those of the whole "
         "run")
        .in(kFrames),
    flag("frames.select_once", "--select-once",
         "Evaluate selections in the first frame only, not in each. This matters for distances, coordinates and "
         "secondary structure")
        .in(kFrames, kShared),
    text("frames.whole", "--whole", "WORD",
         "Make molecules whole that the periodic box cuts, and gather them. bonds: by those of FILE and of "
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

std::span<const Property> frame_properties() { return kTable; }

}  // namespace meniscus
