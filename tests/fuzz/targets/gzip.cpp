// SPDX-License-Identifier: BSD-3-Clause
// Text files, plain and packed with gzip, within a bound on the unpacked size.
#include "core/base/error.h"
#include "core/base/text_file.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void run_gzip(std::string_view bytes) {
  constexpr std::size_t kLargest = std::size_t{1} << 20;
  static const ScratchFile scratch("input.gz");
  try {
    const TextFile file = read_text_file(scratch.write(bytes), kLargest);
    require(!file.text.empty() && file.text.size() <= kLargest, "a text is neither empty nor above the bound");
    require(file.text.find('\0') == std::string::npos, "a text holds no zero bytes");
    require(file.text.find('\r') == std::string::npos, "lines end in LF");
    const bool as_it_is = file.text[0] != '\xef' && file.text[0] != '\x1f';  // no mark, not packed again
    if (as_it_is)
      require(read_text_file(scratch.write(file.text), kLargest).text == file.text, "a text is read as it was given");
  } catch (const InputError& error) {
    require_clear(error);
  } catch (const CapacityError& error) {
    require_clear(error);
  }
}

const Registration registered_gzip{"gzip", run_gzip};

}  // namespace
}  // namespace meniscus::fuzz
