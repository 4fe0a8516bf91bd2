// SPDX-License-Identifier: BSD-3-Clause
// Computes digests with OpenSSL, reading files by the mebibyte.
#include "app/farm/checksum.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/base/error.h"

namespace meniscus::farm {
namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void add(std::string_view bytes) { check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1); }
  std::string hex() {
    unsigned char bytes[EVP_MAX_MD_SIZE];
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), bytes, &size) == 1);
    std::string text;
    for (unsigned n = 0; n < size; ++n) text += fmt::format("{:02x}", bytes[n]);
    return text;
  }

 private:
  static void check(bool fine) {
    if (!fine) throw std::runtime_error("OpenSSL has no SHA-256");
  }
  std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(path.string(), 0, "is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), 0, fmt::format("cannot be opened: {}", std::strerror(errno)));
  Digest digest;
  std::vector<char> part(1 << 20);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0)
    digest.add({part.data(), static_cast<std::size_t>(file.gcount())});
  if (file.bad()) throw InputError(path.string(), 0, "cannot be read to its end");
  return digest.hex();
}

}  // namespace meniscus::farm
