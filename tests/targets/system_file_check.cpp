// SPDX-License-Identifier: BSD-3-Clause
// Makes, reads, replaces and removes files of names that are not ASCII by system_file_*.cpp; its folder keeps one for
// other programs. The exit code is the line of a failure.
#include "core/base/system_file.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>

#include "core/base/output_file.h"

using namespace meniscus;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::array<std::byte, 64> bytes{};
  const int file = system_file::open_to_read(path);
  if (file < 0) return "cannot be opened";
  const std::ptrdiff_t count = system_file::read(file, bytes.data(), bytes.size());
  return system_file::close(file) ? std::string(reinterpret_cast<const char*>(bytes.data()), count)
                                  : "cannot be closed";
}

void write(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path, Existing::replace);
  file.write(text);
  file.commit();
}

}  // namespace

#define EXPECT(what) \
  if (!(what)) return __LINE__

int main(int argc, char**) {
  const std::string name = "Größe Å 分子 🧬.txt";
  const std::filesystem::path path = path_of_text(name), other = path_of_text("прежний.txt");
  EXPECT(text_of_path(path) == name && path != other);
  EXPECT(argc == 1 || std::filesystem::path(name) == path);  // With an argument texts are UTF-8 for the system, too.
  EXPECT(text_of_path(path_of_text("Ordner/ü") / path_of_text("é")).ends_with("é"));

  for (const auto& old : {path, other}) system_file::remove(old);
  EXPECT(bytes_of(path) == "cannot be opened" && errno == ENOENT && !system_file::state_of(path));
  write(path, "first\r\n");
  EXPECT(bytes_of(path) == "first\r\n");
  write(path, "second\n");  // The new file replaces the old one.
  EXPECT(bytes_of(path) == "second\n");
  const auto state = system_file::state_of(path);
  EXPECT(state && state->kind == system_file::State::Kind::file && state->size == 7);
  std::FILE* const stream = system_file::open_plain(path);
  EXPECT(stream && std::fgetc(stream) == 's' && std::fclose(stream) == 0 && !system_file::open_plain("."));

  write(other, "third");
  EXPECT(!system_file::rename_to_free(other, path) && errno == EEXIST);
  EXPECT(bytes_of(path) == "second\n");
  EXPECT(system_file::rename_over(other, path) && bytes_of(path) == "third");
  EXPECT(!system_file::state_of(other));
  EXPECT(system_file::rename_to_free(path, other) && system_file::sync(other) && bytes_of(other) == "third");
  system_file::remove(other);
  EXPECT(!system_file::state_of_entry(other));
  write(path, "kept");

  EXPECT(system_file::program_path().stem() == "system_file_check" &&
         system_file::state_of(system_file::program_path()));
  return 0;
}
