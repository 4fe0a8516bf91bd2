// SPDX-License-Identifier: BSD-3-Clause
// Refuses gzip data in builds without zlib.
#include "core/base/error.h"
#include "core/base/gzip.h"

namespace meniscus {

std::string unpack_gzip(const std::string& path, const std::string&, std::size_t) {
  throw InputError(path, 0, "is packed with gzip, and this build was made without zlib; unpack it first");
}

}  // namespace meniscus
