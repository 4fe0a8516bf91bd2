// SPDX-License-Identifier: BSD-3-Clause
// Files of radii, alone or in pairs like CHARMM's topology and parameters, divided by a line of = signs.
#include <cmath>

#include "core/base/error.h"
#include "core/structure/radii/assign_radii.h"
#include "tests/fuzz/reader_checks.h"

namespace meniscus::fuzz {
namespace {

constexpr std::string_view kCut = "\n====\n";

void run_radii(std::string_view bytes) {
  static const ScratchFile first("first.rtf"), second("second.prm");
  const std::size_t cut = bytes.find(kCut);
  std::vector<std::string> paths{first.write(bytes.substr(0, cut))};
  if (cut != std::string_view::npos) paths.push_back(second.write(bytes.substr(cut + kCut.size())));
  try {
    const std::vector<Atom> atoms = sample_atoms();
    for (const RadiiTable& table : read_radii_files(paths)) {
      require(!table.empty(), "a table that was accepted has entries");
      for (const Atom& atom : atoms) {
        for (const bool hydrogens : {false, true}) {
          const std::optional<FoundRadius> found = table.find(atom, hydrogens);
          require(!found || (found->radius >= 0.0 && found->radius <= 1000.0), "radii are between 0 and 1,000 Å");
        }
      }
    }
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

const Registration registered_radii{"radii", run_radii};

}  // namespace
}  // namespace meniscus::fuzz
