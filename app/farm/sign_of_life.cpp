// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads a worker's identity; a process is identified by its number and the time of its start.
#include "app/farm/sign_of_life.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace meniscus::farm {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kLargestLife = 4096;
constexpr const char* kWorkers = "state/workers";

/// The letters that names in a bundle have.
std::string plain_name(std::string text) {
  std::erase_if(text, [](unsigned char c) { return !std::isalnum(c) && c != '-'; });
  return text.empty() || text.front() == '-' ? "host" + text : text.substr(0, 60);
}

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return plain_name(name);
}

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// Processes are numbered within one boot of one machine, and there within one space of numbers.
std::string process_space() {
  std::error_code error;
  return first_line("/proc/sys/kernel/random/boot_id") + " " + fs::read_symlink("/proc/self/ns/pid", error).string();
}

/// When a process began, in the kernel's ticks; empty: it is gone. Numbers of processes are used again, times are not.
std::string process_start(long pid) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", pid));
  const std::size_t name_end = line.rfind(')');  // the name may hold anything
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  std::string field, state;
  fields >> state;
  constexpr int kStart = 22, kState = 3;  // proc(5)
  for (int n = kState; n < kStart; ++n) fields >> field;
  return state == "Z" || state == "X" ? std::string() : field;
}

}  // namespace

std::string new_worker_name() {
  std::random_device random;
  return fmt::format("{}-{}-{:08x}", host_name(), ::getpid(), random());
}

fs::path life_path(const std::string& worker) { return fs::path(kWorkers) / (worker + ".json"); }

std::string life_text(double lease) {
  return Json{{"host", host_name()},
              {"process", ::getpid()},
              {"space", process_space()},
              {"start", process_start(::getpid())},
              {"lease", lease}}
             .dump() +
         "\n";
}

bool lives(const fs::path& folder, const std::string& worker, const FileClock& now) {
  const fs::path file = life_path(worker);
  const std::optional<FileTime> when = modified(folder / file);
  const std::optional<std::string> text = inner_text(folder, file, kLargestLife);
  if (!when || !text) return false;
  const Json life = Json::parse(*text, nullptr, false);
  double lease = kDefaultLease;
  if (life.is_object()) {
    const auto given = life.find("lease");
    if (given != life.end() && given->is_number())
      lease = std::clamp(given->get<double>(), kShortestLease, kLongestLease);
    const auto process = life.find("process");
    const bool is_here =
        life.value("space", Json()) == process_space() && process != life.end() && process->is_number_integer();
    if (is_here && life.value("start", Json()) != process_start(process->get<long>())) return false;
  }
  return seconds_between(*when, now()) < lease;
}

std::vector<std::string> live_workers(const fs::path& folder, const FileClock& now) {
  std::vector<std::string> names;
  if (inner_entry(folder, kWorkers) != Entry::folder) return names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kWorkers, error)) {
    const std::string worker = entry.path().stem().string();
    if (entry.path().extension() == ".json" && is_inner_path(worker) && lives(folder, worker, now))
      names.push_back(worker);
  }
  std::ranges::sort(names);
  return names;
}

FileTime file_system_now(const fs::path& folder) {
  if (inner_entry(folder, kWorkers) == Entry::folder) {
    const fs::path path = folder / kWorkers / fmt::format(".{}.part", new_worker_name());
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      const std::optional<FileTime> now = modified(path);
      ::unlink(path.c_str());
      if (now) return *now;
    }
  }
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

double seconds_between(FileTime earlier, FileTime later) { return 1e-9 * static_cast<double>(later - earlier); }

}  // namespace meniscus::farm
