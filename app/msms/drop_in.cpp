// SPDX-License-Identifier: BSD-3-Clause
// Reads spheres of xyzr files or of molecules, and writes all files of a run or none.
#include "app/msms/drop_in.h"

#include <system_error>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/formats/structure_formats.h"

namespace meniscus::msms {
namespace {

constexpr double kHydrogenRadius = 1.2, kSameRadius = 1e-6;  // Å

bool within_limits(const Ball& ball) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(ball.center[axis]) <= kLargestCoordinate)) return false;
  return ball.radius >= 0 && ball.radius <= kLargestRadius;
}

}  // namespace

Spheres spheres_of(std::vector<Ball> balls, std::vector<std::string> names, const std::string& file) {
  Spheres spheres;
  spheres.rows.file = escaped(file);
  spheres.rows.count = balls.size();
  for (std::uint32_t n = 0; n < balls.size(); ++n) {
    if (!within_limits(balls[n]))
      throw InputError(file, 0,
                       "sphere {} is {} {} {} {}; coordinates of at most {} Å and a radius from 0 to {} Å "
                       "are read",
                       n + 1, balls[n].center.x, balls[n].center.y, balls[n].center.z, balls[n].radius,
                       kLargestCoordinate, kLargestRadius);
    if (balls[n].radius == 0) continue;
    spheres.balls.push_back(balls[n]);
    spheres.rows.of_atom.push_back(n);
  }
  if (spheres.balls.empty())
    throw InputError(file, 0, "holds no sphere with a radius above 0, of {}; there is no surface", balls.size());
  const auto [smallest, largest] =
      std::minmax_element(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.radius < b.radius; });
  spheres.smallest_radius = smallest->radius;
  spheres.largest_radius = largest->radius;
  // A column that is missing in some rows would shift the columns after it.
  const auto named = std::ranges::count_if(names, [](const std::string& name) { return !name.empty(); });
  if (named > 0) {
    for (std::string& name : names)
      if (name.empty()) name = "?";
    spheres.rows.names = std::move(names);
  }
  return spheres;
}

void leave_out_hydrogens(Spheres& spheres) {
  std::size_t kept = 0;
  for (std::size_t a = 0; a < spheres.balls.size(); ++a) {
    if (std::abs(spheres.balls[a].radius - kHydrogenRadius) < kSameRadius) continue;
    spheres.balls[kept] = spheres.balls[a];
    spheres.rows.of_atom[kept++] = spheres.rows.of_atom[a];
  }
  spheres.balls.resize(kept);
  spheres.rows.of_atom.resize(kept);
  if (kept == 0)
    throw InputError(spheres.rows.file, 0, "holds no sphere but those of radius {} Å, which -noh leaves out",
                     kHydrogenRadius);
}

Spheres read_spheres(const std::string& file) {
  const TextFile text = read_text_file(file);
  for (const Reader* reader : readers())
    if (!kXyzrReader.recognizes(text.text) && reader->recognizes(text.text))
      throw InputError(text.path, 0, "is {}, not a list of spheres; convert it: meniscus-pdb_to_xyzr {} > balls.xyzr",
                       reader->metadata.name, shell_word(text.path));
  FileContents contents = kXyzrReader.read(text, {});
  std::vector<Ball> balls;
  std::vector<std::string> names;
  for (Atom& atom : contents.atoms) {
    balls.push_back({atom.position, atom.radius});
    names.push_back(std::move(atom.name));
  }
  return spheres_of(std::move(balls), std::move(names), text.path);
}

void OutputFiles::begin(const std::string& path) {
  if (files_.contains(path)) return;
  namespace fs = std::filesystem;
  const fs::path target = path_of_text(path), parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code none;
  if (!fs::is_directory(parent, none)) throw OutputError(path, "its folder does not exist; make it first");
  std::unique_ptr<OutputFolder>& folder = folders_[text_of_path(parent)];
  if (!folder) folder = std::make_unique<OutputFolder>(parent, Existing::replace);
  files_[path] = &folder->file(text_of_path(target.filename()));
}

void OutputFiles::write(const std::string& path, const std::string& text) {
  begin(path);
  files_.at(path)->write(text);
}

void OutputFiles::commit() {
  for (auto& [name, folder] : folders_) folder->commit();
}

}  // namespace meniscus::msms
