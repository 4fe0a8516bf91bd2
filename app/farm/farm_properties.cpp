// SPDX-License-Identifier: BSD-3-Clause
// Properties of farm bundles and of the workers that make their frames.
#include "core/properties/properties.h"

namespace meniscus::farm {
namespace {

constexpr Property kRows[] = {
    text("bundle.engine", "--engine", "WORDS",
         "Engines to write job files for, separated by commas. make, slurm, snakemake, openjd, kubernetes, flamenco, "
         "opencue, or all")
        .proposes("make|slurm|snakemake|openjd|kubernetes|flamenco|opencue|all")
        .initially("all but opencue")
        .in("Tasks"),
    number("bundle.chunk_minutes", "--chunk-minutes", "M", "Wanted minutes per task, estimated from a trial frame")
        .from(0.01, 1e4)
        .initially("5")
        .in("Tasks"),
    count("bundle.chunk_frames", "--chunk-frames", "N", "Frames per task; no trial frame is made")
        .from(1, kUnlimited)
        .in("Tasks"),
    count("bundle.task_cores", "--task-cores", "N", "Cores per task, for engines that run several tasks on a machine")
        .from(1, 4096)
        .initially("@threads@ after --, else 2")
        .in("Tasks"),
    count("bundle.task_memory", "--task-memory", "MIB", "Memory per task in MiB")
        .from(1, 1 << 30)
        .initially("1.5 times that of the trial frame, and 256")
        .in("Tasks"),
    new_file("bundle.film", "--film", "NAME.mp4", "Film that farm verify makes from the pictures, in DIR")
        .in("Options"),
    number("bundle.fps", "--fps", "N", "Frames per second of the film").from(0.1, 1000).initially("25").in("Options"),
    text("bundle.farm_path", "--farm-path", "PATH",
         "Path of DIR on the farm's machines. OpenCue needs it; for Flamenco it is a default")
        .in("Options"),
    flag("bundle.by_reference", "--by-reference",
         "Copy no input files, but name them by path and checksum. All machines need them at these paths")
        .in("Options"),
    file("bundle.addon", "--addon", "DIR", "Folder of render_mns.py of this version, for export blender").in("Options"),
    flag("bundle.force", "--force", "Replace another bundle in DIR and delete all its frames").in("Options"),
    word("verify.allow_missing", "--allow-missing", "WORD",
         "Make the film even if frames are missing or bad. hold: show the previous frame again; drop: leave them out")
        .one_of("hold|drop")
        .in("Options"),
    word("work.step", "--step", "STEP", "Do only this step: surface or render")
        .one_of("surface|render")
        .initially("all, in order")
        .in("Options"),
    text("work.frames", "--frames", "LIST", "Make only these frames of the run, such as 0-99:10,250").in("Options"),
    text("work.chunk", "--chunk", "K/N", "Make only the Kth of N nearly equal parts of the run; K counts from 1")
        .in("Options"),
    flag("work.force", "--force", "Make frames again that already exist").in("Options"),
    text("work.device", "--device", "DEVICE", "Device instead of the bundle's: auto, gpu, gpu:N, software, cpu")
        .proposes("auto|gpu|software|cpu")
        .in("Options"),
};
const PropertyTable kFarmProperties(kRows);

}  // namespace

}  // namespace meniscus::farm
