// SPDX-License-Identifier: BSD-3-Clause
// Recognizes H5MD, and loads what reads it with the first file: the HDF5 library brings thirty others, which took more
// of a short run than all the rest.
#include "core/base/module_file.h"
#include "core/trajectory/formats/formats.h"
#include "core/trajectory/formats/read_h5md.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

bool recognizes(std::string_view start) { return start.starts_with("\x89HDF\r\n\x1a\n"); }

OpenH5md* load() {
  constexpr ModuleFile kModule{MENISCUS_HDF5_MODULE_NAME, MENISCUS_HDF5_MODULE, "H5MD files", std::size_t{96} << 20};
  using Give = OpenH5md*(const char* version, std::size_t frame_size);
  void* const give = load_from_module(kModule, "meniscus_open_h5md");
  if (OpenH5md* const open = reinterpret_cast<Give*>(give)(MENISCUS_VERSION, sizeof(Frame))) return open;
  refuse_module(kModule);
}

std::unique_ptr<Trajectory> open(const std::string& path, const TrajectoryOptions&) {
  static OpenH5md* const open_h5md = load();
  return open_h5md(path);
}

}  // namespace

const TrajectoryFormat kH5mdFormat{
    {"H5MD", ".h5md .h5", "trajectories in HDF5, as MDAnalysis, LAMMPS and ESPResSo write them, and MDTraj's own",
     "P. de Buyl, P. H. Colberg and F. Höfling, Comput. Phys. Commun. 185, 1546 (2014)",
     "positions of the first group of particles, with their unit; boxes (edges or vectors), steps and times"},
    recognizes,
    open};

}  // namespace meniscus
