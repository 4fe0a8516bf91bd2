// SPDX-License-Identifier: BSD-3-Clause
// Refuses BinaryCIF in builds without nlohmann_json, which reads MessagePack.
#include "core/base/error.h"
#include "core/structure/formats/cif_document.h"

namespace meniscus {

gemmi::cif::Document read_binary_cif(const TextFile& file) {
  throw InputError(file.path, 0,
                   "is BinaryCIF, which this build does not read: it was made without nlohmann_json; give it as mmCIF");
}

}  // namespace meniscus
