// SPDX-License-Identifier: BSD-3-Clause
// Finds the line that gives the reason in the output of a failed program.
#pragma once

#include <string>
#include <string_view>

namespace meniscus::farm {

/// The first line that speaks of an error, else the last that says anything.
class ErrorLine {
 public:
  void add(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" =-\t\r");
    if (begin == std::string::npos || names_error_) return;
    names_error_ = line.find("rror") != std::string::npos;
    words_ = line.substr(begin);
    // It comes after words of this program's own.
    constexpr std::string_view kOurs = "meniscus: error: ";
    if (words_.starts_with(kOurs)) words_.erase(0, kOurs.size());
  }
  const std::string& words() const { return words_; }

 private:
  std::string words_;
  bool names_error_ = false;
};

}  // namespace meniscus::farm
