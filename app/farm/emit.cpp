// SPDX-License-Identifier: BSD-3-Clause
// The table of engines, and how their templates are filled.
#include "app/farm/emit.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "app/farm/bundle_folder.h"
#include "core/base/error.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

/// Returns three times the time that a task was measured to take, and ten minutes for a slow start. The text is empty
/// where nothing was measured, so that the site's default counts.
std::string minutes(const Bundle& bundle) {
  const Chunking& chunking = bundle.chunking;
  if (!chunking.seconds_per_frame) return {};
  const double frames = std::ceil(static_cast<double>(bundle.frames.size()) / static_cast<double>(chunking.count));
  return fmt::format("{:.0f}", std::ceil(10.0 + 3.0 * frames * *chunking.seconds_per_frame / 60.0));
}

std::vector<Filling> fillings(const Bundle& bundle, const std::string& farm_path) {
  const Chunking& chunking = bundle.chunking;
  const bool needs_gpu = std::ranges::find(bundle.device, "--require-gpu") != bundle.device.end();
  return {{"COUNT", std::to_string(chunking.count)},
          {"CORES", std::to_string(chunking.cores)},
          {"MEMORY", chunking.memory() ? std::to_string(*chunking.memory()) : ""},
          {"GPUS", needs_gpu ? "1" : ""},
          {"MINUTES", minutes(bundle)},
          {"PATH", farm_path.empty() ? "PATH_OF_THE_BUNDLE" : farm_path}};
}

std::string filled_lines(std::string_view text, const std::vector<Filling>& fillings) {
  std::string result;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n') + 1);
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
      {"make", {"Makefile"}, "make -C @DIR@ -j2"},
      {"slurm", {"submit.sh", "slurm/work.sbatch", "slurm/verify.sbatch"}, "@DIR@/submit.sh"},
      {"snakemake", {"Snakefile"}, "snakemake --cores 2 -d @DIR@ -s @DIR@/Snakefile"},
      {"openjd", {"template.json"}, "deadline bundle submit @DIR@, or openjd run @DIR@/template.json"},
      {"kubernetes",
       {"kubernetes.yaml"},
       "set image and volume in @DIR@/kubernetes.yaml; then kubectl apply -f @DIR@/kubernetes.yaml"},
      {"flamenco",
       {"meniscus_film.js", "flamenco_job.json"},
       "once: @DIR@/meniscus_film.js into the manager's scripts folder; then POST @DIR@/flamenco_job.json"},
      {"opencue", {"opencue.xml"}, "launch @DIR@/opencue.xml, by pycue's launchSpec", true},
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

void write_job_files(const Engine& engine, const Bundle& bundle, const std::string& farm_path, const fs::path& folder) {
  require_plain_path(farm_path);
  for (const char* const file : engine.files) {
    const fs::path path = folder / file;
    write_file(path, filled_lines(template_text(farm_templates(), file), fillings(bundle, farm_path)));
    constexpr auto kExecutable = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
    if (path.extension() == ".sh") fs::permissions(path, kExecutable, fs::perm_options::add);
  }
}

}  // namespace meniscus::farm
