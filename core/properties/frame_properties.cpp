// SPDX-License-Identifier: BSD-3-Clause
// Properties of a run of frames: which frames, how their atoms are moved, and films of them.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kFrames = "Frames", kMotion = "Alignment of frames", kFilm = "Film";

constexpr auto kTable = of_commands(
    kForRuns,
    std::to_array<Property>({
        file("frames.trajectories", "TRAJECTORY", "", "Trajectories: the same as --trajectory").in(kFrames, repeatable),
        file("frames.trajectory", "--trajectory", "PATH",
             "Coordinates of the atoms of FILE, frame by frame (meniscus formats lists the formats). Repeatable: one "
             "after the other. Without it the models of FILE are the frames")
            .in(kFrames, kShared | repeatable)
            .in_short_help(),
        text("frames.trajectory_atoms", "--trajectory-atoms", "EXPR",
             "The atoms of FILE that the trajectory has, such as 'not water'; all others are left out first")
            .in(kFrames, kShared),
        flag("frames.trust_atom_order", "--trust-atom-order",
             "Assume that the trajectory has the atoms of FILE in its order, even where bonds come out too long")
            .in(kFrames, kShared),
        text("frames.frames", "--frames", "LIST",
             "Frames of the run: all, or a list such as 0-99:10,250,last; frames count from 0, -10- are the last ten")
            .in(kFrames, kShared)
            .in_short_help(),
        count("frames.stride", "--stride", "N", "Use every Nth of them")
            .from(1, kUnlimited)
            .initially("1")
            .in(kFrames, kShared),
        text("frames.begin", "--begin", "WHEN", "Leave out what comes before this frame or time: 300ps, 2.5ns")
            .in(kFrames, kShared),
        text("frames.end", "--end", "WHEN", "Leave out what comes after this frame or time").in(kFrames, kShared),
        count("frames.repeat", "--repeat", "N",
              "Show each frame N times in a row, for slow motion or a camera that moves around a molecule at rest; "
              "files of frame F are then numbered F*N, F*N + 1 and so on")
            .from(1, 1e6)
            .initially("1")
            .in(kFrames, kShared),
        text("frames.only", "--only", "LIST",
             "Make only these frames of the run, as one of many chunks; camera, colours and scene stay those of the "
             "whole run")
            .in(kFrames)
            .of(kForRuns & ~for_preview),
        flag("frames.select_once", "--select-once",
             "Evaluate selections by distance, coordinates or secondary structure in the first frame only; without "
             "it, in each frame anew")
            .in(kFrames, kShared),
        text("frames.whole", "--whole", "WORD",
             "Make molecules whole that the periodic box cuts, and gather them: by bonds (of FILE and of standard "
             "residues), or guess bonds by distance")
            .proposes("bonds|guess")
            .initially("bonds")
            .in(kMotion, kShared | value_optional),
        text("frames.superpose", "--superpose", "EXPR",
             "Rotate and move each frame so that these atoms fit the reference frame best")
            .in(kMotion, kShared)
            .in_short_help(),
        text("frames.center", "--center", "EXPR", "Move each frame so that the centre of these atoms stays in place")
            .in(kMotion, kShared),
        text("frames.reference", "--reference", "N", "Reference frame of --superpose and --center: a number, or last")
            .initially("0")
            .in(kMotion, kShared),
        count("frames.smooth", "--smooth", "N",
              "Average positions over N frames of the trajectory around each frame; an odd number")
            .from(1, 9999)
            .initially("1")
            .in(kMotion, kShared),
        count("frames.jobs", "--jobs", "N", "Number of frames made at the same time; every output has them in order")
            .from(1, 1024)
            .initially("as cores and memory allow")
            .in(kFrames),
        word("frames.progress", "--progress", "WORD",
             "Progress of the frames: auto (a bar on a terminal, else plain lines), bar, plain, json (a line a frame "
             "on standard error), openjd, or none")
            .one_of("auto|bar|plain|json|openjd|none")
            .initially("auto")
            .in(kFrames)
            .of(kForRuns & ~for_preview),

        number("frames.fps", "--fps", "N", "Frames per second of a film")
            .from(0.1, 240)
            .initially("25")
            .in(kFilm, kShared)
            .of(for_render | for_blender),
        text("frames.codec", "--codec", "WORD",
             "Codec of a film: h264 (.mp4, .mov, .mkv), h265, vp9 (.webm), prores, prores4444 (.mov, keeps "
             "transparency), dnxhr, gif")
            .initially("by the file's ending")
            .in(kFilm, in_scene)
            .of(for_render),
        count("frames.crf", "--crf", "N", "Rate factor of a film: lower is better and larger")
            .initially("h264 18, h265 20, vp9 24")
            .in(kFilm, in_scene)
            .of(for_render),
        count("frames.bits", "--bits", "N", "Bits of each channel of a film: 8 or 10")
            .initially("8; prores 10")
            .in(kFilm, in_scene | rare)
            .of(for_render),
        count("frames.chroma", "--chroma", "N", "Chroma subsampling of a film: 420, 422 or 444")
            .initially("420; prores, dnxhr 422")
            .in(kFilm, in_scene | rare)
            .of(for_render),
    }));

}  // namespace

std::span<const Property> frame_properties() { return kTable; }

}  // namespace meniscus
