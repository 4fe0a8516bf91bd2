// SPDX-License-Identifier: BSD-3-Clause
// How far an export is, asked again and again until it is done.
#pragma once

#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/preview/window/session_link.h"

namespace meniscus {

/// Of the export that is written now; times are those of the window, in seconds.
class ExportQuestion {
 public:
  /// True if the reply is one of an export: that it has begun, or how far it is.
  bool take(const SessionReply& reply, double time);
  /// Asks if that is due; seconds until it will be, or nothing if nothing is written.
  std::optional<double> advance(SessionLink& link, double time);

  bool running() const { return running_; }
  /// The latest answer of "export_state"; null before the first.
  const nlohmann::json& told() const { return told_; }

 private:
  bool running_ = false;
  std::uint64_t number_ = 0;  // of the question that is under way; 0: none
  double due_ = 0.0;
  nlohmann::json told_;
};

}  // namespace meniscus
