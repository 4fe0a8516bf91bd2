// SPDX-License-Identifier: BSD-3-Clause
// Checks paths with lstat, and opens files with O_NOFOLLOW.
#include "app/farm/inner_path.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

bool is_plain_name(const std::string& name) {
  const auto plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  };
  return !name.empty() && !name.starts_with('.') && !name.starts_with('-') && std::ranges::all_of(name, plain);
}

struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

bool is_inner_path(const std::string& text) {
  const fs::path path(text);
  return !text.empty() && path.is_relative() && !text.ends_with('/') && text.find("//") == std::string::npos &&
         std::ranges::all_of(path, [](const fs::path& part) { return is_plain_name(part.string()); });
}

bool is_plain_absolute_path(const std::string& text) { return text.starts_with('/') && is_inner_path(text.substr(1)); }

Entry inner_entry(const fs::path& folder, const fs::path& inner) {
  fs::path path = folder;
  Entry found = Entry::folder;
  for (const fs::path& part : inner) {
    path /= part;
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
      if (errno == ENOENT || errno == ENOTDIR) return Entry::nothing;
      throw InputError(path.string(), 0, fmt::format("cannot be looked at: {}", std::strerror(errno)));
    }
    if (S_ISLNK(status.st_mode))
      throw InputError(path.string(), 0, "is a symbolic link; what belongs to a bundle lies in its folder");
    if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
      throw InputError(path.string(), 0, "is neither a file nor a folder");
    found = S_ISREG(status.st_mode) ? Entry::file : Entry::folder;
  }
  return found;
}

std::optional<std::string> inner_text(const fs::path& folder, const fs::path& inner, std::size_t most) {
  const Entry entry = inner_entry(folder, inner);
  if (entry == Entry::nothing) return {};
  const fs::path path = folder / inner;
  if (entry == Entry::folder) throw InputError(path.string(), 0, "is a folder, not a file");
  const auto fail = [&] {
    throw InputError(path.string(), 0, fmt::format("cannot be read: {}", std::strerror(errno)));
  };
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
  if (file.number < 0 && errno == ENOENT) return {};
  if (file.number < 0) fail();
  std::string text;
  char part[1 << 14];
  while (true) {
    const ssize_t count = ::read(file.number, part, sizeof part);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail();
    if (count == 0) return text;
    text.append(part, static_cast<std::size_t>(count));
    if (text.size() > most)
      throw InputError(path.string(), 0, fmt::format("is longer than {} bytes", with_thousands(most)));
  }
}

std::optional<FileTime> modified(const fs::path& path) {
  // Opening asks a server again; a mere look may be answered from memory (close-to-open consistency of NFS).
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
  const std::optional<system_file::State> state = system_file::state_of(file.number);
  return state ? std::optional<FileTime>(state->modified) : std::nullopt;
}

void check_places(const fs::path& folder) {
  for (const char* place :
       {"inputs", "inputs/blender", "images", "scene", "state", "state/surface", "state/render", "state/workers"})
    if (inner_entry(folder, place) == Entry::file)
      throw InputError((folder / place).string(), 0, "is a file where a folder should be");
  // These are opened by name, by this program and by renderers.
  std::error_code none_yet;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "scene", none_yet))
    if (inner_entry(folder, fs::path("scene") / entry.path().filename()) == Entry::folder)
      throw InputError(entry.path().string(), 0, "is a folder where files should be");
}

}  // namespace meniscus::farm
