// SPDX-License-Identifier: BSD-3-Clause
// Writes a job specification of OpenCue, after its DTD cjsl 1.15.
#include <fmt/format.h>

#include "app/farm/emit.h"
#include "app/farm/farm_templates.h"
#include "app/farm/quote.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

struct Layer {
  std::string name, type, command, range, resources;
};

std::string layer_xml(const Layer& layer) {
  return fmt::format(
      "      <layer name=\"{}\" type=\"{}\">\n        <cmd>{}</cmd>\n        <range>{}</range>\n"
      "        <chunk>1</chunk>\n{}        <env/>\n        <services>\n          <service>shell</service>\n"
      "        </services>\n      </layer>\n",
      xml_text(layer.name), layer.type, xml_text(layer.command), layer.range, layer.resources);
}

// In the order of the DTD; without them Cuebot gives a frame one core and its own idea of memory.
std::string resources_xml(const Step& step, const Chunking& chunking) {
  std::string text = fmt::format("        <cores>{}</cores>\n        <threadable>True</threadable>\n", chunking.cores);
  if (chunking.memory()) text += fmt::format("        <memory>{}m</memory>\n", *chunking.memory());
  if (needs_gpu(step)) text += "        <gpus>1</gpus>\n";
  return text;
}

std::string depend_xml(const char* type, const std::string& layer, const std::string& on) {
  return fmt::format(
      "    <depend type=\"{}\" anyframe=\"False\">\n      <depjob>frames</depjob>\n      <deplayer>{}</deplayer>\n"
      "      <onjob>frames</onjob>\n      <onlayer>{}</onlayer>\n    </depend>\n",
      type, layer, on);
}

}  // namespace

std::vector<EngineFile> emit_opencue(const Emission& emission) {
  // Cuebot replaces #IFRAME# and the like anywhere in a command.
  if (emission.farm_path.find('#') != std::string::npos)
    throw RequestError(fmt::format("--farm-path {}: OpenCue reads # as the start of a token; choose another path",
                                   in_quotes(emission.farm_path)));
  const Bundle& bundle = emission.bundle;
  const std::string path = shell_word(emission.farm_path), count = std::to_string(bundle.chunking.count);
  std::string layers, depends, before;
  for (const Step& step : bundle.steps) {
    layers += layer_xml({step.name, "Render",
                         fmt::format("meniscus work {} --step {} --chunk #IFRAME#/{} --threads {} --progress plain",
                                     path, step.name, count, bundle.chunking.cores),
                         "1-" + count, resources_xml(step, bundle.chunking)});
    if (!before.empty()) depends += depend_xml("FRAME_BY_FRAME", step.name, before);
    before = step.name;
  }
  layers += layer_xml({"verify", "Util", fmt::format("meniscus farm verify {}", path), "1-1", ""});
  depends += depend_xml("LAYER_ON_LAYER", "verify", before);
  return {{"opencue.xml", filled(farm_template("opencue.xml"), {{"LAYERS", layers}, {"DEPENDS", depends}}), false}};
}

}  // namespace meniscus::farm
