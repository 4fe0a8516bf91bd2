// SPDX-License-Identifier: BSD-3-Clause
// A file in memory that libraries open by a name.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/uninterrupted.h"

namespace meniscus {

/// Nobody else sees it, and it is gone with this object. A limit on the size of files (RLIMIT_FSIZE) holds for it too.
/// Throws CapacityError where the system gives none.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("meniscus", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw CapacityError(std::string("no file in memory: ") + std::strerror(errno));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  /// All that was written to it, piece by piece: take(span of bytes).
  void read(const auto& take) const {
    constexpr std::size_t kPiece = 1 << 20;
    struct stat status {};
    ::fstat(descriptor_, &status);
    std::vector<std::byte> piece(kPiece);
    for (off_t taken = 0; taken < status.st_size;) {
      const ssize_t count = uninterrupted([&] { return ::pread(descriptor_, piece.data(), piece.size(), taken); });
      if (count <= 0) throw CapacityError(std::string("a file in memory cannot be read: ") + std::strerror(errno));
      take(std::span<const std::byte>(piece).first(static_cast<std::size_t>(count)));
      taken += count;
    }
  }

 private:
  int descriptor_;
};

}  // namespace meniscus
