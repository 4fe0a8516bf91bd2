// SPDX-License-Identifier: BSD-3-Clause
// A job type of Flamenco 3: old-fashioned JavaScript, for its engine is small.
#include <fmt/format.h>

#include "app/farm/emit.h"
#include "app/farm/quote.h"

namespace meniscus::farm {
namespace {

constexpr const char* kTemplate =
    R"js(// A job type of Flamenco 3 for one Meniscus bundle. Copy it into the manager's scripts folder and restart the manager.
const JOB_TYPE = {
    label: "Meniscus frames",
    settings: [
        { key: "bundle", type: "string", required: true, default: @PATH@,
          description: "The bundle's folder, as the workers see it" },
        { key: "meniscus", type: "string", required: true, default: "meniscus",
          description: "The program, or its path on the workers" },
        { key: "frames", type: "string", required: true, default: @FRAMES@,
          description: "Frames of the bundle's run" },
        { key: "chunk_size", type: "int32", default: @CHUNK@,
          description: "Frames a task" },
    ]
};

const STEPS = @STEPS@;

function compileJob(job) {
    const settings = job.settings;
    const chunks = frameChunker(settings.frames, settings.chunk_size);
    let before = [];
    for (const step of STEPS) {
        const tasks = [];
        for (let n = 0; n < chunks.length; n++) {
            const task = author.Task(step.name + "-" + chunks[n], step.type);
            task.addCommand(author.Command("exec", {
                exe: settings.meniscus,
                args: ["work", settings.bundle, "--step", step.name, "--frames", chunks[n], "--progress", "plain"],
            }));
            if (before.length > 0) {
                task.addDependency(before[n]);
            }
            job.addTask(task);
            tasks.push(task);
        }
        before = tasks;
    }
    const verify = author.Task("verify", "misc");
    verify.addCommand(author.Command("exec", {
        exe: settings.meniscus,
        args: ["farm", "verify", settings.bundle],
    }));
    for (const task of before) {
        verify.addDependency(task);
    }
    job.addTask(verify);
}
)js";

// Flamenco's frame ranges have no steps, so of a run with gaps every frame is listed.
std::string plain_ranges(const std::vector<std::uint64_t>& frames) {
  std::string text;
  for (std::size_t n = 0; n < frames.size();) {
    std::size_t last = n;
    while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", frames[n]);
    if (last > n) text += fmt::format("-{}", frames[last]);
    n = last + 1;
  }
  return text;
}

}  // namespace

std::vector<EngineFile> emit_flamenco(const Emission& emission) {
  const Bundle& bundle = emission.bundle;
  std::string steps;
  for (const Step& step : bundle.steps) {
    steps += fmt::format("{}{{ name: {}, type: {} }}", steps.empty() ? "" : ", ", json_text(step.name),
                         json_text(step.maker == Maker::blender ? "blender" : "misc"));
  }
  const std::uint64_t chunk = (bundle.frames.size() + bundle.chunking.count - 1) / bundle.chunking.count;
  const std::string text = filled(kTemplate, {{"PATH", json_text(emission.farm_path)},
                                              {"FRAMES", json_text(plain_ranges(bundle.frames))},
                                              {"CHUNK", std::to_string(chunk)},
                                              {"STEPS", "[" + steps + "]"}});
  return {{"meniscus_film.js", text, false}};
}

}  // namespace meniscus::farm
