// SPDX-License-Identifier: BSD-3-Clause
// The sections of an Amber prmtop: %FLAG with a name, %FORMAT with the columns, and lines of fields of one width.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text_file.h"

namespace meniscus {

/// Fields of a section are asked for by its name and their number; each of these functions throws InputError with file
/// and line: no such section, columns that nobody understands, fewer or more fields, a field that is no number.
class PrmtopSections {
 public:
  /// The file must outlive this object. Throws InputError where there is no section at all.
  explicit PrmtopSections(const TextFile& file);

  bool has(std::string_view name) const { return sections_.find(name) != sections_.end(); }

  std::vector<std::string> texts(std::string_view name, std::size_t count) const;  ///< without blanks at both ends
  std::vector<double> numbers(std::string_view name, std::size_t count) const;     ///< finite
  /// `least`, `most`: what they may be.
  std::vector<std::int64_t> whole_numbers(std::string_view name, std::size_t count, std::int64_t least,
                                          std::int64_t most) const;
  /// The first `count` whole numbers, and how many more there are does not matter.
  std::vector<std::int64_t> first_whole_numbers(std::string_view name, std::size_t count) const;

 private:
  struct Section {
    std::size_t line = 0;                 ///< of %FLAG
    std::size_t first_line = 0;           ///< of the fields
    std::size_t per_line = 0, width = 0;  ///< 0: unknown
    std::string_view text;
  };
  using Take = std::function<void(std::string_view field, std::size_t line)>;

  const Section& find(std::string_view name) const;
  enum class Fields { texts, numbers, first_numbers };
  void each_field(std::string_view name, std::size_t count, Fields kind, const Take& take) const;
  void take_number(std::string_view name, std::string_view field, std::size_t line,
                   std::vector<std::int64_t>& numbers) const;

  const TextFile& file_;
  std::map<std::string, Section, std::less<>> sections_;
};

}  // namespace meniscus
