// SPDX-License-Identifier: BSD-3-Clause
// The engines that work on a bundle, and the job files for them. Each engine runs `meniscus work` and no more.
#pragma once

#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// A file of an engine in the bundle.
struct EngineFile {
  std::string path;  ///< relative to the bundle
  std::string text;
  bool executable = false;
};

/// What an emitter knows.
struct Emission {
  const Bundle& bundle;
  std::string farm_path;  ///< of the bundle as the farm's machines see it; only for engines that need it said
};

struct Engine {
  const char* name;
  std::vector<EngineFile> (*emit)(const Emission& emission);
  const char* needs_farm_path;  ///< nullptr, or why
  const char* start;            ///< for people: how to start it, with @DIR@ for the bundle
};

/// make, slurm, openjd, flamenco, opencue.
const std::vector<Engine>& engines();

std::vector<EngineFile> emit_make(const Emission& emission);      ///< Makefile
std::vector<EngineFile> emit_slurm(const Emission& emission);     ///< submit.sh and scripts of job arrays
std::vector<EngineFile> emit_openjd(const Emission& emission);    ///< template.json, of jobtemplate-2023-09
std::vector<EngineFile> emit_flamenco(const Emission& emission);  ///< a job type of Flamenco 3, and a job
std::vector<EngineFile> emit_opencue(const Emission& emission);   ///< a job specification, cjsl 1.15

/// Whether the frames of this step must be computed on a GPU.
bool needs_gpu(const Step& step);

}  // namespace meniscus::farm
