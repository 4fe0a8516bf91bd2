// SPDX-License-Identifier: BSD-3-Clause
// Properties of farm bundles and of the workers that make their frames.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr auto kTable = std::to_array<Property>({
    text("bundle.engine", "--engine", "WORDS",
         "Engines to write job files for, separated by commas: make, slurm, openjd, flamenco, opencue, all")
        .proposes("make|slurm|openjd|flamenco|opencue|all")
        .initially("all but opencue")
        .in("Options"),
    number("bundle.chunk_minutes", "--chunk-minutes", "M",
           "Minutes that a task should take, estimated from a trial frame")
        .from(0.01, 1e4)
        .initially("5")
        .in("Options"),
    count("bundle.chunk_frames", "--chunk-frames", "N", "Frames of a task; no trial frame is made")
        .from(1, kUnlimited)
        .in("Options"),
    count("bundle.task_cores", "--task-cores", "N", "Cores of a task, for engines that share a machine among tasks")
        .from(1, 4096)
        .initially("--threads after --, else 2")
        .in("Options"),
    count("bundle.task_memory", "--task-memory", "MIB", "Memory of a task in MiB")
        .from(1, 1 << 30)
        .initially("1.5 times that of the trial frame, and 256")
        .in("Options"),
    new_file("bundle.film", "--film", "NAME.mp4", "Film that farm verify makes of the pictures, in DIR").in("Options"),
    number("bundle.fps", "--fps", "N", "Frames per second of the film").from(0.1, 1000).initially("25").in("Options"),
    text("bundle.farm_path", "--farm-path", "PATH",
         "DIR as the machines of the farm see it: needed by OpenCue, and the default of Flamenco's setting")
        .in("Options"),
    flag("bundle.link", "--link", "Add inputs as hard links instead of copies").in("Options"),
    file("bundle.addon", "--addon", "DIR", "Folder of render_mns.py, of this version, to bundle with export blender")
        .in("Options"),
    flag("bundle.force", "--force", "Replace another bundle at DIR, with all its frames").in("Options"),
    flag("status.prometheus", "--prometheus", "Print gauges for Prometheus instead of a table").in("Options"),
    word("verify.allow_missing", "--allow-missing", "WORD",
         "Make the film although frames are missing or bad: hold (show the frame before again) or drop (leave "
         "them out); farm status and farm log then say so")
        .one_of("hold|drop")
        .in("Options"),
    text("work.step", "--step", "STEP", "Only this step of the work: surface or render")
        .proposes("surface|render")
        .initially("all, in order")
        .in("Options"),
    text("work.frames", "--frames", "LIST", "Only these frames of the run, such as 0-99:10,250").in("Options"),
    text("work.chunk", "--chunk", "K/N", "Only the Kth of N nearly equal shares of the run; K counts from 1")
        .in("Options"),
    flag("work.force", "--force", "Make frames again that exist").in("Options"),
    count("work.lease", "--lease", "S",
          "Seconds without a sign of life after which other workers take over this one's frames")
        .from(1, 3600)
        .initially("60")
        .in("Options"),
    text("work.device", "--device", "DEVICE",
         "Device that computes surfaces and pictures, instead of what the bundle says: auto, gpu, gpu:N, "
         "software, cpu")
        .proposes("auto|gpu|software|cpu")
        .in("Options"),
    flag("work.require_gpu", "--require-gpu", "Fail (exit code 4) where there is no hardware GPU").in("Options"),
    count("work.threads", "--threads", "N", "CPU threads of each process").from(1, 4096).initially("all").in("Options"),
});

}  // namespace

std::span<const Property> farm_properties() { return kTable; }

}  // namespace meniscus
