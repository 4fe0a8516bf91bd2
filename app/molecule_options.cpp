// SPDX-License-Identifier: BSD-3-Clause
// Declares the shared options, checks their values, and carries them out.
#include "app/molecule_options.h"

#include <cmath>
#include <iostream>
#include <map>
#include <memory>

#include <unistd.h>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus {
namespace {

/// Options added while this lives stand under a heading of their own in the help.
class Heading {
 public:
  Heading(CLI::App& command, const char* text) : command_(command) { command.option_defaults()->group(text); }
  ~Heading() { command_.option_defaults()->group("Options"); }
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;

 private:
  CLI::App& command_;
};

// Below 0.001 Å the patches between atoms are thinner than any file's coordinates are precise; above 100 Å the probe is
// larger than most molecules and every atom neighbours every other.
constexpr double kSmallestProbe = 1e-3;
constexpr double kLargestProbe = 100.0;

double parse_probe(const std::string& text) {
  double radius = 0.0;
  if (!parse_number(text, radius))
    throw CLI::ValidationError("--probe", in_quotes(text) + " is not a finite number of Å, such as 1.4");
  if (radius < 0.0)
    throw CLI::ValidationError("--probe", fmt::format("{} Å is negative; 0 gives the van der Waals surface", radius));
  if (radius > 0.0 && radius < kSmallestProbe) {
    throw CLI::ValidationError(
        "--probe",
        fmt::format("{} Å is finer than any file's coordinates; use 0 (van der Waals surface) or at least {} Å", radius,
                    kSmallestProbe));
  }
  if (radius > kLargestProbe) {
    throw CLI::ValidationError(
        "--probe", fmt::format("{} Å is larger than molecules are; use at most {} Å", radius, kLargestProbe));
  }
  return radius;
}

void parse_device(const std::string& text, ComputeOptions& options) {
  options.cpu = text == "cpu";
  if (options.cpu) return;
  const std::optional<DeviceChoice> choice = parse_device_choice(text);
  if (!choice) throw CLI::ValidationError("--device", in_quotes(text) + " is none of auto, gpu, gpu:N, software, cpu");
  options.gl = *choice;
}

void parse_color(const std::string& text, ColorScheme& color) {
  const std::optional<ColorScheme> scheme = parse_color_scheme(text);
  if (!scheme) {
    throw CLI::ValidationError("--color",
                               in_quotes(text) + " is none of element, chain, residue, bfactor, kind, atom, #rrggbb");
  }
  color.by = scheme->by;
  color.fixed = scheme->fixed;
}

}  // namespace

void add_file_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Input");
  command.add_option("FILE", options.file, "Molecule: PDB, mmCIF (.gz too) or XYZR; told apart by content")
      ->required()
      ->type_name("");
  command.add_flag("--keep-water", options.reading.keep_water, "Use water molecules too");
  command.add_flag("--keep-ions", options.reading.keep_ions, "Use free ions (lone metal and halogen atoms) too");
  const std::map<std::string, UnknownElement> words{
      {"halt", UnknownElement::halt}, {"guess", UnknownElement::guess}, {"skip", UnknownElement::skip}};
  command
      .add_option("--unknown-element", options.reading.unknown_element,
                  "Atoms of unknown element: halt (default), guess (radius 2.0 Å), skip")
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD");
  command.add_flag("-q,--quiet", options.quiet, "No notes on stderr; errors only");
}

void add_surface_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Surface");
  ComputeOptions& computing = options.computing;
  command
      .add_option_function<std::string>(
          "--probe", [&computing](const std::string& text) { computing.probe_radius = parse_probe(text); },
          "Probe radius in Å [1.4]; 0 gives the van der Waals surface")
      ->type_name("RADIUS");
  command
      .add_option_function<std::string>(
          "--device", [&computing](const std::string& text) { parse_device(text, computing); },
          "auto (default: a GPU if there is one, else cpu), gpu, gpu:N, software (GL without a GPU), cpu")
      ->type_name("DEVICE");
  command.add_flag("--verify", computing.verify, "Compute on GPU and CPU and name every difference");
  command.add_option("--threads", computing.threads, "CPU threads [all]")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
}

void add_color_options(CLI::App& command, MoleculeOptions& options) {
  const Heading heading(command, "Colour");
  ColorScheme& color = options.color;
  command
      .add_option_function<std::string>(
          "--color", [&color](const std::string& text) { parse_color(text, color); },
          "Colour by element (default), chain, residue, bfactor, kind (of patch), atom, or one #rrggbb")
      ->type_name("SCHEME");
  command
      .add_option_function<std::string>(
          "--color-range",
          [&color](const std::string& text) {
            color.range = parse_color_range(text);
            if (!color.range)
              throw CLI::ValidationError("--color-range",
                                         in_quotes(text) + " is not lo:hi with lo < hi, such as 10:60");
          },
          "B-factors at the two ends of the colour map [smallest:largest]")
      ->type_name("LO:HI");
}

void add_molecule_options(CLI::App& command, MoleculeOptions& options) {
  add_file_options(command, options);
  add_surface_options(command, options);
  add_color_options(command, options);
}

void add_output_options(CLI::App& command, OutputOptions& options, const std::string& what) {
  const Heading heading(command, "Output");
  command.add_option("-o,--output", options.path, what)->required()->type_name("PATH");
  command.add_flag("--force", options.force, "Replace what exists at the output path");
}

Structure read_molecule(const MoleculeOptions& options) {
  Structure structure = read_structure(options.file, options.reading);
  say(options, fmt::format("{}: {}", structure.file, structure.report.sentence()));
  for (const std::string& warning : structure.report.warnings) {
    say(options, fmt::format("warning: {}: {}", structure.file, warning));
  }
  return structure;
}

Molecule load_molecule(const MoleculeOptions& options) {
  Molecule molecule;
  molecule.structure = read_molecule(options);
  molecule.coloring = color_atoms(molecule.structure, options.color);
  molecule.computed = compute_surface(balls_of(molecule.structure), options.computing);
  say(options, fmt::format("surface on {} in {:.1f} ms", molecule.computed.device, total_ms(molecule.computed.stages)));
  return molecule;
}

void say(const MoleculeOptions& options, const std::string& line) {
  if (!options.quiet) std::cerr << "meniscus: " << escaped(line) << std::endl;
}

ProgressSink progress_on_stderr(const MoleculeOptions& options) {
  if (options.quiet) return {};
  auto text = std::make_shared<ProgressText>(::isatty(STDERR_FILENO) == 1,
                                             [](std::string_view part) { std::cerr << part << std::flush; });
  return [text](const ProgressReport& report) { text->report(report); };
}

}  // namespace meniscus
