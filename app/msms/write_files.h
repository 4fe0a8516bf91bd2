// SPDX-License-Identifier: BSD-3-Clause
// The files of a run: all of them appear when it ends well, none if it does not.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/base/output_file.h"

namespace meniscus::msms {

class OutputFiles {
 public:
  /// Begins a file, which replaces one of that name in the end. Throws OutputError: also where its folder is missing.
  void begin(const std::string& path);
  /// Writes all of a file; begins it if it has not begun.
  void write(const std::string& path, const std::string& text);
  /// Gives all files their names.
  void commit();

 private:
  std::map<std::string, std::unique_ptr<OutputFolder>> folders_;
  std::map<std::string, OutputFile*> files_;
};

}  // namespace meniscus::msms
