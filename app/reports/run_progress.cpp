// SPDX-License-Identifier: BSD-3-Clause
// Writes progress in the requested style.
#include "app/reports/run_progress.h"

#include <iostream>
#include <map>

#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include "core/base/text.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

void write_line(const Json& json) {
  std::cerr << json.dump(-1, ' ', true, Json::error_handler_t::replace) << std::endl;
}

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

RunProgress::RunProgress(ProgressStyle style, bool quiet, std::uint64_t frames, std::size_t at_once, const char* word)
    : style_(style), word_(word), total_(frames), begin_(std::chrono::steady_clock::now()) {
  if (style_ == ProgressStyle::automatic)
    style_ = quiet ? ProgressStyle::none : ::isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::plain;
  if (style_ == ProgressStyle::json) write_line({{"event", "start"}, {word_ + "s", total_}, {"at_once", at_once}});
}

void RunProgress::done(std::uint64_t frame, const std::vector<std::string>& files, double milliseconds, bool empty) {
  if (style_ == ProgressStyle::json) {
    Json line{{"event", word_}, {word_, frame}, {"state", "done"}, {"files", files}, {"ms", milliseconds}};
    if (empty) line["empty"] = true;
    write_line(line);
  }
  advance();
}

void RunProgress::failed(std::uint64_t frame, int exit_code, const std::string& message) {
  ++failed_;
  if (style_ == ProgressStyle::json) {
    write_line({{"event", word_}, {word_, frame}, {"state", "failed"}, {"exit", exit_code}, {"error", message}});
  } else {
    if (style_ == ProgressStyle::bar) std::cerr << "\r\033[K";
    std::cerr << "meniscus: " << word_ << " " << frame << " failed: " << escaped(message) << std::endl;
  }
  advance();
}

void RunProgress::tell(const std::string& line) const {
  if (style_ == ProgressStyle::json) return write_line({{"event", "note"}, {"text", line}});
  if (style_ == ProgressStyle::bar) std::cerr << "\r\033[K";
  std::cerr << "meniscus: " << line << std::endl;
}

void RunProgress::advance() {
  ++done_;
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  const double each = elapsed.count() / static_cast<double>(done_);
  const std::string rest = done_ < total_ ? ", " + duration(each * static_cast<double>(total_ - done_)) + " left" : "";
  const std::string rate = fmt::format("{} of {} {}s, {:.2f} s each{}", done_, total_, word_, each, rest);
  if (style_ == ProgressStyle::bar) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(kWidth * share);
    fmt::print(std::cerr, "\r\033[K[{:#<{}}{:.<{}}] {}", "", filled, "", kWidth - filled, rate);
    std::cerr.flush();
  } else if (style_ == ProgressStyle::plain) {
    const int tenth = static_cast<int>(10.0 * share);
    if (tenth != last_tenth_) std::cerr << "meniscus: " << rate << std::endl;
    last_tenth_ = tenth;
  } else if (style_ == ProgressStyle::openjd) {
    std::cout << fmt::format("openjd_progress: {:.1f}\nopenjd_status: {}", 100.0 * share, rate) << std::endl;
  }
}

void RunProgress::end() {
  if (style_ == ProgressStyle::bar && done_ > 0) std::cerr << std::endl;
  if (style_ == ProgressStyle::json) write_line({{"event", "end"}, {"done", done_ - failed_}, {"failed", failed_}});
}

}  // namespace meniscus
