// SPDX-License-Identifier: BSD-3-Clause
// Unpacks a gzip file in memory, up to a limit of size.
#include "core/base/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus {

/// zlib checks length and CRC of each member (RFC 1952). Zeros after the last member are accepted, because tapes add
/// them.
std::string unpack_gzip(const std::string& path, const std::string& packed, std::size_t largest) {
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
  std::string text;
  std::string chunk(std::size_t{1} << 18, '\0');
  std::size_t next = 0;
  int state = Z_OK;
  while (true) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + next));
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size() - next, std::size_t{1} << 30));
    const uInt given = stream.avail_in;
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    state = inflate(&stream, Z_NO_FLUSH);
    next += given - stream.avail_in;
    text.append(chunk, 0, chunk.size() - stream.avail_out);
    if (text.size() > largest) refuse_too_large(path, largest);
    if (state == Z_STREAM_END) {
      next = std::min(packed.find_first_not_of('\0', next), packed.size());
      if (next == packed.size()) return text;
      if (packed.compare(next, 2, "\x1f\x8b") != 0)
        throw InputError(path, 0, "has foreign bytes after its gzip data; unpack it by hand");
      inflateReset(&stream);
    } else if (state == Z_BUF_ERROR || (state == Z_OK && next == packed.size() && stream.avail_out > 0)) {
      throw InputError(path, 0, "is cut short: its gzip data ends too early; fetch it again");
    } else if (state != Z_OK) {
      throw InputError(
          path, 0, fmt::format("is damaged: gzip says '{}'; fetch it again", stream.msg ? stream.msg : "wrong data"));
    }
  }
}

}  // namespace meniscus
