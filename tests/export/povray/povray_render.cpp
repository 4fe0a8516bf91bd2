// SPDX-License-Identifier: BSD-3-Clause
// POV-Ray as a child process, its statistics, and its 16-bit images.
#include "tests/export/povray/povray_render.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <OpenImageIO/imageio.h>

#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

std::size_t statistic(const std::string& log, const std::string& label) {
  std::smatch match;
  if (!std::regex_search(log, match, std::regex(label + ":\\s+([0-9]+)"))) return 0;
  return std::stoul(match[1]);
}

// Reads "#declare NAME = <x,y,z>;" or "#declare NAME = x;" from a scene text.
glm::dvec3 declared(const std::string& text, const std::string& name) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("#declare " + name + " = <?([^,>;]+),?([^,>;]*),?([^,>;]*)>?;")))
    throw std::runtime_error(name + " is not declared");
  const auto number = [&](int n) { return match[n].length() ? std::stod(match[n]) : std::stod(match[1]); };
  return {number(1), number(2), number(3)};
}

}  // namespace

PovrayRun run_povray(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"-C", folder.string(), POVRAY_PROGRAM};
  all.insert(all.end(), arguments.begin(), arguments.end());
  all.insert(all.end(), {"-D", "-V"});
  const test::ProgramResult result = test::run_program("/usr/bin/env", all, 300);
  PovrayRun run;
  run.exit_code = result.exit_code;
  run.log = result.out + result.err;
  run.finite_objects = statistic(run.log, "Finite Objects");
  run.infinite_objects = statistic(run.log, "Infinite Objects");
  std::istringstream lines(run.log);
  for (std::string line; std::getline(lines, line);)
    if (line.find("arning") != std::string::npos && line.find("Warning Stream") == std::string::npos)
      run.warnings.push_back(line);
  return run;
}

std::vector<glm::dvec3> read_rgb(const std::filesystem::path& file, std::vector<double>* alpha) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) throw std::runtime_error("cannot read " + file.string());
  const OIIO::ImageSpec& spec = input->spec();
  const int channels = spec.nchannels;
  std::vector<float> values(static_cast<std::size_t>(spec.width) * spec.height * channels);
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
    throw std::runtime_error(input->geterror());
  std::vector<glm::dvec3> rgb(values.size() / channels);
  if (alpha) alpha->assign(rgb.size(), 1.0);
  for (std::size_t n = 0; n < rgb.size(); ++n) {
    const float* const v = &values[n * channels];
    rgb[n] = channels >= 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(v[0]);
    if (alpha && (channels == 4 || channels == 2)) (*alpha)[n] = v[channels - 1];
  }
  return rgb;
}

Buffers render_buffers(const std::filesystem::path& folder, const std::string& name, int width, int height,
                       PovrayRun* run) {
  // The frame number chooses the buffer, so that one process (its start takes longest) renders all four.
  write_text(folder / "check.pov",
             "#version 3.7;\n#declare Meniscus_Buffer = frame_number;\n#include \"" + name + ".pov\"\n");
  const PovrayRun done = run_povray(folder, {"+Icheck.pov", "+Ocheck.png", "+KFI1", "+KFF4", "+FN16", "File_Gamma=1.0",
                                             "+UA", "-A", "+W" + std::to_string(width), "+H" + std::to_string(height)});
  if (run) *run = done;
  if (done.exit_code != 0) throw std::runtime_error("POV-Ray failed:\n" + done.log);
  const std::string text = test::read_bytes(folder / (name + "_aov.inc"));
  const glm::dvec3 low = declared(text, "Meniscus_Low"), extent = declared(text, "Meniscus_Extent");

  Buffers b;
  b.width = width;
  b.height = height;
  std::vector<double> alpha;
  for (const glm::dvec3& v : read_rgb(folder / "check1.png", &alpha)) b.position.push_back(low + v * extent);
  for (const double a : alpha) b.hit.push_back(a > 0.5);
  for (const glm::dvec3& v : read_rgb(folder / "check2.png"))
    b.normal.push_back({std::sin(std::numbers::pi * (v.x - 0.5)), std::sin(std::numbers::pi * (v.y - 0.5)),
                        std::sin(std::numbers::pi * (v.z - 0.5))});
  for (const glm::dvec3& v : read_rgb(folder / "check3.png")) {
    b.kind.push_back(static_cast<int>(std::lround(v.x * 4.0)) - 1);
    b.color.push_back(static_cast<int>(std::lround(v.y * 255.0) + 256 * std::lround(v.z * 255.0)));
  }
  for (const glm::dvec3& v : read_rgb(folder / "check4.png"))
    b.layers.push_back(v.x > 0.0 ? static_cast<int>(std::lround(std::log(v.x) / std::log(63.0 / 64.0))) : kMostLayers);
  return b;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace meniscus::testing
