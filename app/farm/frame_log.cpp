// SPDX-License-Identifier: BSD-3-Clause
// Keeps the first and the last part of a long output.
#include "app/farm/frame_log.h"

#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/bundle.h"
#include "app/farm/inner_path.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEndBytes = std::size_t{32} << 10;
constexpr std::size_t kLargestLog = 4 * kEndBytes;

fs::path log_path(const std::string& step, std::uint64_t frame) {
  return fs::path("state") / step / fmt::format("frame_{}.log", frame_digits(frame));
}

/// Of a line that a program wrote over itself, as a counter does, what it wrote last.
std::string last_written(const std::string& line) {
  const std::size_t end = line.find_last_not_of('\r');
  if (end == std::string::npos) return {};
  const std::size_t before = line.rfind('\r', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return line.substr(begin, end + 1 - begin);
}

}  // namespace

void FrameLog::add(const std::string& line) {
  const std::string whole = last_written(line).substr(0, kEndBytes - 1) + "\n";
  if (end_.empty() && begin_.size() + whole.size() <= kEndBytes) {
    begin_ += whole;
    return;
  }
  end_bytes_ += whole.size();
  end_.push_back(whole);
  for (; end_bytes_ > kEndBytes; ++left_out_) {
    end_bytes_ -= end_.front().size();
    end_.pop_front();
  }
}

std::string FrameLog::take() {
  std::string text = std::exchange(begin_, {});
  if (left_out_ > 0) text += fmt::format("-- {} lines left out --\n", std::exchange(left_out_, 0));
  for (const std::string& line : std::exchange(end_, {})) text += line;
  end_bytes_ = 0;
  return text;
}

void write_frame_log(const fs::path& folder, const std::string& step, std::uint64_t frame, const std::string& text) {
  const fs::path path = folder / log_path(step, frame);
  if (text.empty()) {
    ::unlink(path.c_str());
    return;
  }
  make_folders_of(path);
  OutputFile file(path, Existing::replace);
  file.write(text);
  file.commit();
}

std::string read_frame_log(const fs::path& folder, const std::string& step, std::uint64_t frame) {
  return inner_text(folder, log_path(step, frame), kLargestLog).value_or("");
}

}  // namespace meniscus::farm
