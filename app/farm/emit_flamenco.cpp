// SPDX-License-Identifier: BSD-3-Clause
// Writes a job type of Flamenco 3, the same for every bundle, in old-fashioned JavaScript, because its engine is small;
// and the job of this bundle.
#include <nlohmann/json.hpp>

#include "app/farm/emit.h"
#include "app/farm/farm_templates.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

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
  return {{"meniscus_film.js", std::string(farm_template("meniscus_film.js")), false},
          {"flamenco_job.json", job_json(emission), false}};
}

}  // namespace meniscus::farm
