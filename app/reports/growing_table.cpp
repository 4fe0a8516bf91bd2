// SPDX-License-Identifier: BSD-3-Clause
// Writes rows as they come.
#include "app/reports/growing_table.h"

#include <iostream>

#include "core/base/error.h"

namespace meniscus {

void print_now(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) throw OutputError("standard output", "cannot be written");
}

GrowingTable::GrowingTable(const std::string& path, Existing existing) : prints_(path == "-") {
  if (!path.empty() && !prints_) file_.emplace(path, existing);
}

void GrowingTable::write(const std::string& header, const std::string& rows) {
  if (!is_wanted()) return;
  const std::string text = has_header_ ? rows : header + rows;
  has_header_ = true;
  if (file_)
    file_->write(text);
  else
    print_now(text);
}

void GrowingTable::commit() {
  if (file_ && has_header_) file_->commit();
}

}  // namespace meniscus
