// SPDX-License-Identifier: BSD-3-Clause
// The table of engines, and how their templates are filled.
#include "app/farm/emit.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus::farm {
namespace {

// Three times what was measured, and ten minutes for a slow start; a site's default where nothing was measured.
std::string minutes(const Bundle& bundle) {
  const Chunking& chunking = bundle.chunking;
  if (!chunking.seconds_per_frame) return {};
  const double frames = std::ceil(static_cast<double>(bundle.frames.size()) / static_cast<double>(chunking.count));
  return fmt::format("{:.0f}", std::ceil(10.0 + 3.0 * frames * *chunking.seconds_per_frame / 60.0));
}

std::vector<Filling> fillings(const Bundle& bundle, const std::string& farm_path) {
  const Chunking& chunking = bundle.chunking;
  const bool needs_gpu = std::ranges::find(bundle.device, "--require-gpu") != bundle.device.end();
  const std::string memory = chunking.memory() ? std::to_string(*chunking.memory()) : "";
  return {{"COUNT", std::to_string(chunking.count)},
          {"CORES", std::to_string(chunking.cores)},
          {"MEMORY", memory},
          {"GPUS", needs_gpu ? "1" : ""},
          {"MINUTES", minutes(bundle)},
          {"PATH", farm_path.empty() ? "PATH_OF_THE_BUNDLE" : farm_path}};
}

std::string filled_lines(std::string_view text, const std::vector<Filling>& fillings) {
  std::string result;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    const auto is_unknown = [&](const Filling& filling) {
      return filling.text.empty() && line.find("@" + filling.name + "@") != std::string_view::npos;
    };
    if (std::ranges::none_of(fillings, is_unknown)) result += filled(line, fillings);
    text.remove_prefix(line.size());
  }
  return result;
}

}  // namespace

const std::vector<Engine>& engines() {
  static const std::vector<Engine> table{
      {"make", {"Makefile"}, nullptr, "make -C @DIR@ -j2"},
      {"slurm", {"submit.sh", "slurm/work.sbatch", "slurm/verify.sbatch"}, nullptr, "@DIR@/submit.sh"},
      {"snakemake", {"Snakefile"}, nullptr, "snakemake --cores 2 -d @DIR@ -s @DIR@/Snakefile"},
      {"openjd", {"template.json"}, nullptr, "deadline bundle submit @DIR@, or openjd run @DIR@/template.json"},
      {"kubernetes",
       {"kubernetes.yaml"},
       nullptr,
       "set image and volume in @DIR@/kubernetes.yaml; then kubectl apply -f @DIR@/kubernetes.yaml"},
      {"flamenco",
       {"meniscus_film.js", "flamenco_job.json"},
       nullptr,
       "once: @DIR@/meniscus_film.js into the manager's scripts folder; then POST @DIR@/flamenco_job.json"},
      {"opencue",
       {"opencue.xml"},
       "its commands have no working directory",
       "launch @DIR@/opencue.xml, by pycue's launchSpec"},
  };
  return table;
}

void require_plain_path(const std::string& farm_path) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/";
  if (farm_path.find_first_not_of(kPlain) != std::string::npos || farm_path.starts_with('-'))
    throw RequestError(
        fmt::format("--farm-path {}: has other characters than letters, digits and ._-/, which some "
                    "engine would read as more than a path; choose another path",
                    in_quotes(farm_path)));
}

std::vector<EngineFile> emit(const Engine& engine, const Bundle& bundle, const std::string& farm_path) {
  require_plain_path(farm_path);
  const std::vector<Filling> values = fillings(bundle, farm_path);
  std::vector<EngineFile> files;
  for (const char* const path : engine.files)
    files.push_back(
        {path, filled_lines(template_text(farm_templates(), path), values), std::string_view(path).ends_with(".sh")});
  return files;
}

}  // namespace meniscus::farm
