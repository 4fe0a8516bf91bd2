// SPDX-License-Identifier: BSD-3-Clause
// A table of a run that grows frame by frame: in a file that gets its name at the end, or on standard output.
#pragma once

#include <optional>
#include <string>

#include "core/base/output_file.h"

namespace meniscus {

/// On standard output, at once. Throws OutputError.
void print_now(const std::string& text);

class GrowingTable {
 public:
  /// path: empty: it is not wanted; "-": standard output. Throws OutputError.
  GrowingTable(const std::string& path, Existing existing);

  bool is_wanted() const { return prints_ || file_; }
  /// The header goes before the first rows.
  void write(const std::string& header, const std::string& rows);
  /// Names the file, if anything was written.
  void commit();

 private:
  bool prints_, has_header_ = false;
  std::optional<OutputFile> file_;
};

}  // namespace meniscus
