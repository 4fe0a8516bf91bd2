// SPDX-License-Identifier: BSD-3-Clause
// A job type of Flamenco 3, the same for every bundle, in old-fashioned JavaScript, for its engine is small; and the
// job of this bundle.
#include <nlohmann/json.hpp>

#include "app/farm/emit.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kJobType =
    R"js(// A job type of Flamenco 3 for bundles of Meniscus. Copy it once into the manager's scripts folder and restart the
// manager; each job then names its bundle. A worker of Flamenco does one task at a time, so a task may use all of its
// machine unless "threads" says less; what memory it needs stands in the bundle's flamenco_job.json.
const JOB_TYPE = {
    label: "Meniscus Film",
    description: "Frames of a molecular surface: a bundle made by meniscus farm bundle",
    settings: [
        { key: "bundle", type: "string", subtype: "dir_path", required: true,
          description: "The bundle's folder, as the workers see it" },
        { key: "tasks", type: "int32", required: true, default: 10,
          description: "Tasks of nearly equal numbers of frames" },
        { key: "threads", type: "int32", default: 0,
          description: "Threads of a task; 0: all of the machine" },
        { key: "meniscus", type: "string", required: true, default: "meniscus",
          description: "The program, or its path on the workers" },
    ]
};

function compileJob(job) {
    const settings = job.settings;
    const verify = author.Task("verify", "misc");
    verify.addCommand(author.Command("exec", {
        exe: settings.meniscus,
        args: ["farm", "verify", settings.bundle],
    }));
    for (let k = 1; k <= settings.tasks; k++) {
        const task = author.Task("frames-" + k, "misc");
        const args = ["work", settings.bundle, "--chunk", k + "/" + settings.tasks, "--progress", "plain"];
        task.addCommand(author.Command("exec", {
            exe: settings.meniscus,
            args: settings.threads > 0 ? args.concat(["--threads", String(settings.threads)]) : args,
        }));
        verify.addDependency(task);
        job.addTask(task);
    }
    job.addTask(verify);
}
)js";

// What the manager's API takes: POST /api/v3/jobs. The type is named after the script's file.
std::string job_json(const Emission& emission) {
  const Chunking& chunking = emission.bundle.chunking;
  Json json;
  json["name"] = "Meniscus frames";
  json["type"] = "meniscus-film";
  json["priority"] = 50;
  json["submitter_platform"] = "linux";
  json["settings"] = {
      {"bundle", emission.farm_path}, {"tasks", chunking.count}, {"threads", 0}, {"meniscus", "meniscus"}};
  json["metadata"] = {{"cores", std::to_string(chunking.cores)}};
  if (chunking.memory()) json["metadata"]["memory_mib"] = std::to_string(*chunking.memory());
  return json.dump(2, ' ', true) + "\n";
}

}  // namespace

std::vector<EngineFile> emit_flamenco(const Emission& emission) {
  return {{"meniscus_film.js", kJobType, false}, {"flamenco_job.json", job_json(emission), false}};
}

}  // namespace meniscus::farm
