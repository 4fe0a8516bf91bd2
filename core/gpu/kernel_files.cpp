// SPDX-License-Identifier: BSD-3-Clause
// Stores program binaries (OpenGL 4.5, section 7.5) after the text that they were compiled from, with a checksum.
#include "core/gpu/kernel_files.h"

#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace meniscus {
namespace {

thread_local KernelFiles* current_files = nullptr;

/// Computes the 64-bit hash FNV-1a of Fowler, Noll and Vo. It finds names and damage; texts are compared as a whole.
std::uint64_t hash(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return h;
}

std::string gl_words() {
  std::string words;
  for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION}) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    words += fmt::format("{}\n", text ? text : "");
  }
  return words;
}

template <typename Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

/// Returns the file's head before the binary: the driver and the text that it was compiled from.
std::string head_of(const std::string& driver, std::string_view text) {
  return fmt::format("meniscus kernel 1\n{}{}\n{}", driver, text.size(), text);
}

std::optional<std::string> read_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

KernelFiles::KernelFiles(std::filesystem::path folder) : folder_(std::move(folder)), driver_(gl_words()) {
  GLint formats = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
  offered_ = formats > 0;
  current_files = this;
}

KernelFiles::~KernelFiles() {
  if (current_files == this) current_files = nullptr;
}

KernelFiles* KernelFiles::current() { return current_files; }

void KernelFiles::make_current(KernelFiles* files) { current_files = files; }

std::filesystem::path KernelFiles::path_of(const std::string& name) const {
  return folder_ / fmt::format("{:016x}.kernel", hash(driver_ + name));
}

bool KernelFiles::load(std::uint32_t program, const std::string& name, std::string_view text) const {
  if (!offered_) return false;
  const std::optional<std::string> content = read_whole(path_of(name));
  const std::string head = head_of(driver_, text);
  GLenum format = 0;
  std::uint64_t sum = 0;
  if (!content || content->size() < head.size() + sizeof format + sizeof sum || !content->starts_with(head))
    return false;
  const std::string_view all_but_sum = std::string_view(*content).substr(0, content->size() - sizeof sum);
  std::memcpy(&sum, all_but_sum.data() + all_but_sum.size(), sizeof sum);
  if (sum != hash(all_but_sum)) return false;
  std::memcpy(&format, content->data() + head.size(), sizeof format);
  const std::string_view binary = all_but_sum.substr(head.size() + sizeof format);
  glProgramBinary(program, format, binary.data(), static_cast<GLsizei>(binary.size()));
  const bool taken = glGetError() == GL_NO_ERROR;
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  return taken && linked == GL_TRUE;
}

void KernelFiles::save(std::uint32_t program, const std::string& name, std::string_view text) const {
  GLint length = 0;
  if (offered_) glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0) return;
  std::string binary(static_cast<std::size_t>(length), '\0');
  GLenum format = 0;
  GLsizei written = 0;
  glGetProgramBinary(program, length, &written, &format, binary.data());
  if (glGetError() != GL_NO_ERROR || written <= 0) return;
  binary.resize(static_cast<std::size_t>(written));
  std::string content = head_of(driver_, text) + bytes_of(format) + binary;
  content += bytes_of(hash(content));

  static std::atomic<unsigned> count = 0;
  const std::filesystem::path path = path_of(name);
  const std::filesystem::path beside = folder_ / fmt::format(".{}.{}.{}", path.filename().string(), getpid(), count++);
  std::error_code ignored, failed;
  std::filesystem::create_directories(folder_, ignored);
  {
    std::ofstream file(beside, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    if (!file.flush()) failed = std::make_error_code(std::errc::io_error);
  }
  // Not synced: damage by a crash of the machine is found by the checksum.
  if (!failed) std::filesystem::rename(beside, path, failed);
  if (failed) std::filesystem::remove(beside, ignored);
}

}  // namespace meniscus
