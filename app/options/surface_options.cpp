// SPDX-License-Identifier: BSD-3-Clause
// Declares the options that say which surface is computed, and where.
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "app/options/frame_options.h"
#include "app/options/molecule_options.h"
#include "app/options/value_words.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/mesh/check_by_mesh.h"
#include "core/text/parse_number.h"

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
  command
      .add_option_function<std::string>(
          "--probe",
          [&surface](const std::string& text) {
            surface.probe_radius = parse_probe(text);
            surface.probe_named = true;
          },
          "Probe radius in Å [1.4]; 0 gives the van der Waals surface")
      ->type_name("RADIUS");
}

void add_device_option(CLI::App& command, SurfaceRequest& surface) {
  read_environment(surface.gl);
  command
      .add_option_function<std::string>(
          "--device", [&surface](const std::string& text) { parse_device(text, surface); },
          "auto (default: a GPU if there is one, else cpu), gpu, gpu:N (or UUID, PCI address), software (GL "
          "without a GPU), cpu")
      ->check(proposes({"auto", "gpu", "software", "cpu"}))
      ->type_name("DEVICE");
  command.add_flag_callback(
      "--require-gpu", [&surface] { require_gpu(surface); },
      "Refuse (exit code 4) to run on the CPU or on software GL where there is no hardware GPU");
}

void add_threads_option(CLI::App& command, SurfaceRequest& surface) {
  command.add_option("--threads", surface.threads, "CPU threads [all]")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
}

void add_kind_option(CLI::App& command, SurfaceRequest& surface) {
  const std::map<std::string, SurfaceKind> kinds{
      {"ses", SurfaceKind::ses}, {"sas", SurfaceKind::sas}, {"vdw", SurfaceKind::vdw}};
  command
      .add_option("--surface", surface.kind,
                  "ses: solvent-excluded (default); sas: solvent-accessible; vdw: van der Waals, without a probe")
      ->transform(one_of(kinds))
      ->type_name("KIND");
}

void add_surface_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Surface");
  SurfaceRequest& surface = options.surface;
  add_kind_option(command, surface);
  add_probe_option(command, surface);
  add_device_option(command, surface);
  surface.check = check_by_mesh;
  command.add_flag("--verify", surface.verify, "Compute on GPU and CPU, mesh, and name every difference");
  add_threads_option(command, surface);
}

void add_division_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Surface");
  Division& division = options.division;
  command
      .add_option_function<std::string>(
          "--by", [&division](const std::string& text) { parse_division(text, division); },
          "Several objects: chain, model, class (polymer, ligand, ...), residue: each a surface of its own, as if it "
          "were alone; component: each closed part of the one surface")
      ->check(proposes({"chain", "model", "class", "residue", "component"}))
      ->type_name("WORD");
  const std::map<std::string, Cavities> words{
      {"keep", Cavities::keep}, {"drop", Cavities::drop}, {"only", Cavities::only}};
  command
      .add_option("--cavities", division.cavities,
                  "keep (default); drop: only what the outside reaches; only: cavities and what lies in them")
      ->transform(one_of(words))
      ->type_name("WORD");
}

}  // namespace meniscus
