// SPDX-License-Identifier: BSD-3-Clause
// Adds the options that say which surface is computed, of which parts, and on which device.
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "app/options/frame_options.h"
#include "app/options/molecule_options.h"
#include "app/options/property_options.h"
#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/mesh/check_by_mesh.h"
#include "core/mesh/compare_mesh.h"

namespace meniscus {
namespace {

double parse_probe(const std::string& text) {
  double radius = 0.0;
  if (!parse_number(text, radius))
    throw CLI::ValidationError("--probe", in_quotes(text) + " is not a finite number of Å, such as 1.4");
  const std::string fault = probe_fault(radius);
  if (!fault.empty()) throw CLI::ValidationError("--probe", fault);
  return radius;
}

void parse_device(const std::string& text, SurfaceRequest& options) {
  options.cpu = text == "cpu";
  const std::optional<DeviceChoice> choice = parse_device_choice(options.cpu ? "auto" : text);
  if (!choice) {
    throw CLI::ValidationError(
        "--device", in_quotes(text) + " is none of auto, gpu, gpu:N, gpu:UUID, gpu:PCI-ADDRESS, software, cpu");
  }
  options.gl.kind = choice->kind;
  options.gl.index = choice->index;
  options.gl.name = choice->name;
}

/// "auto" becomes any hardware GPU and nothing else. Runs after --device, whatever their order.
void require_gpu(SurfaceRequest& options) {
  if (options.cpu || options.gl.kind == DeviceChoice::Kind::software)
    throw GpuError(fmt::format("--require-gpu refuses --device {}; leave one of them away",
                               options.cpu ? "cpu" : to_string(options.gl)));
  if (options.gl.kind == DeviceChoice::Kind::automatic) options.gl.kind = DeviceChoice::Kind::gpu;
}

/// Which GPUs this process is meant to see, which of several it takes, and where their kernels are kept.
void read_environment(DeviceChoice& choice) {
  const char* const kept = std::getenv(kKernelVariable);
  if (const std::string cache = cache_folder(); !cache.empty() && !(kept && std::string_view(kept) == "off"))
    choice.kernel_folder = cache + "/kernels";
  if (const char* const visible = std::getenv("CUDA_VISIBLE_DEVICES")) choice.cuda_visible = visible;
  for (const char* const variable : {"SLURM_LOCALID", kWorkerVariable}) {
    const char* const text = std::getenv(variable);
    int number = -1;
    if (text && std::from_chars(text, text + std::strlen(text), number).ec == std::errc() && number >= 0)
      choice.worker = number;
  }
}

void parse_division(const std::string& text, Division& division) {
  const std::map<std::string, Grouping> words{{"chain", Grouping::chain},
                                              {"model", Grouping::model},
                                              {"class", Grouping::atom_class},
                                              {"residue", Grouping::residue}};
  division.groups.reset();
  division.components = text == "component";
  if (division.components) return;
  const auto word = words.find(text);
  if (word == words.end())
    throw CLI::ValidationError("--by", in_quotes(text) + " is none of chain, model, class, residue, component");
  division.groups = word->second;
}

}  // namespace

void add_probe_option(CLI::App& command, SurfaceRequest& surface) {
  PropertyOptions(command).add_parsed("surface.probe", [&surface](const std::string& text) {
    surface.probe_radius = parse_probe(text);
    surface.probe_named = true;
  });
}

void add_device_option(CLI::App& command, SurfaceRequest& surface) {
  read_environment(surface.gl);
  PropertyOptions options(command);
  options.add_parsed("surface.device", [&surface](const std::string& text) { parse_device(text, surface); });
  options.add_switch("surface.require_gpu", [&surface] { require_gpu(surface); });
}

void add_threads_option(CLI::App& command, SurfaceRequest& surface) {
  PropertyOptions(command).add("surface.threads", surface.threads);
}

void add_kind_option(CLI::App& command, SurfaceRequest& surface) {
  PropertyOptions(command).add_word("surface.kind", surface.kind,
                                    {SurfaceKind::ses, SurfaceKind::sas, SurfaceKind::vdw});
}

void add_surface_options(CLI::App& command, MoleculeOptions& molecule) {
  SurfaceRequest& surface = molecule.surface;
  add_kind_option(command, surface);
  add_probe_option(command, surface);
  add_device_option(command, surface);
  surface.check = check_by_mesh;
  PropertyOptions(command).add("surface.verify", surface.verify);
  add_threads_option(command, surface);
}

void add_division_options(CLI::App& command, MoleculeOptions& molecule) {
  Division& division = molecule.division;
  PropertyOptions options(command);
  options.add_parsed("surface.by", [&division](const std::string& text) { parse_division(text, division); });
  options.add_word("surface.cavities", division.cavities, {Cavities::keep, Cavities::drop, Cavities::only});
}

}  // namespace meniscus
