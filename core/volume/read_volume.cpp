// SPDX-License-Identifier: BSD-3-Clause
// Reads a volume map in the format that its content shows.
#include "core/volume/read_volume.h"

#include <utility>

#include "core/base/error.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

/// True if the first line that is not a comment begins as in OpenDX files.
bool is_dx(const TextFile& file) {
  LineReader lines(file.text);
  std::string_view line;
  while (lines.next(line)) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.starts_with('#')) continue;
    return text.starts_with("object");
  }
  return false;
}

/// True if the third line has at least four fields, as in cube files.
bool may_be_cube(const TextFile& file) {
  LineReader lines(file.text);
  std::string_view line;
  for (int n = 0; n < 3; ++n)
    if (!lines.next(line)) return false;
  return fields_of(line).size() >= 4;
}

}  // namespace

VolumeGrid read_volume(const std::string& path) {
  std::string bytes = read_file_bytes(path);
  if (is_ccp4(bytes)) return read_ccp4(path, bytes);
  if (bytes.find('\0') != std::string::npos)
    throw InputError(path, 0, "is binary, but has no stamp 'MAP' of a CCP4 or MRC 2014 map; convert it to one");
  const TextFile file = text_of_bytes(path, std::move(bytes));
  if (is_dx(file)) return read_dx(file);
  if (may_be_cube(file)) return read_cube(file);
  throw InputError(path, 0, "is not one of the volume maps that are read: OpenDX, Gaussian cube, CCP4/MRC");
}

}  // namespace meniscus
