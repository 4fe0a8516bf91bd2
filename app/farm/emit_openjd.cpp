// SPDX-License-Identifier: BSD-3-Clause
// Writes a job template of Open Job Description, version 2023-09, which AWS Deadline Cloud and others run.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/farm/emit.h"

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;

// A minute to flush and go, as the worker's code 9 promises.
Json action(const std::vector<std::string>& arguments) {
  Json json;
  json["command"] = "{{Param.Meniscus}}";
  json["args"] = arguments;
  json["cancelation"] = {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 60}};
  return {{"actions", {{"onRun", json}}}};
}

Json parameters() {
  return Json::array({{{"name", "Bundle"},
                       {"type", "PATH"},
                       {"objectType", "DIRECTORY"},
                       {"dataFlow", "INOUT"},
                       {"default", "."},
                       {"description", "The folder this template lies in"}},
                      {{"name", "Meniscus"},
                       {"type", "STRING"},
                       {"default", "meniscus"},
                       {"description", "The program, or its path on the workers"}}});
}

// Memory is in MiB.
Json amounts(const Step& step, const Chunking& chunking) {
  Json json = Json::array({{{"name", "amount.worker.vcpu"}, {"min", chunking.cores}}});
  if (chunking.memory()) json.push_back({{"name", "amount.worker.memory"}, {"min", *chunking.memory()}});
  if (needs_gpu(step)) json.push_back({{"name", "amount.worker.gpu"}, {"min", 1}});
  return json;
}

// A chunk is a plain INT: the extension for chunks of tasks is not known everywhere.
Json step_json(const Step& step, const Chunking& chunking, const std::string& before) {
  const std::string count = std::to_string(chunking.count);
  Json json;
  json["name"] = step.name;
  if (!before.empty()) json["dependencies"] = Json::array({{{"dependsOn", before}}});
  json["hostRequirements"] = {{"amounts", amounts(step, chunking)}};
  json["parameterSpace"] = {
      {"taskParameterDefinitions", Json::array({{{"name", "Chunk"}, {"type", "INT"}, {"range", "1-" + count}}})}};
  json["script"] = action({"work", "{{Param.Bundle}}", "--step", step.name, "--chunk", "{{Task.Param.Chunk}}/" + count,
                           "--threads", std::to_string(chunking.cores), "--progress", "openjd"});
  return json;
}

}  // namespace

std::vector<EngineFile> emit_openjd(const Emission& emission) {
  Json json;
  json["specificationVersion"] = "jobtemplate-2023-09";
  json["name"] = "Meniscus frames";
  json["parameterDefinitions"] = parameters();
  json["steps"] = Json::array();
  std::string before;
  for (const Step& step : emission.bundle.steps) {
    json["steps"].push_back(step_json(step, emission.bundle.chunking, before));
    before = step.name;
  }
  Json verify;
  verify["name"] = "verify";
  verify["dependencies"] = Json::array({{{"dependsOn", before}}});
  verify["script"] = action({"farm", "verify", "{{Param.Bundle}}"});
  json["steps"].push_back(verify);
  return {{"template.json", json.dump(2, ' ', true) + "\n", false}};
}

}  // namespace meniscus::farm
