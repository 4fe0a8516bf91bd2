// SPDX-License-Identifier: BSD-3-Clause
// An export that is made beside the pictures: how far it is, and its end.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

namespace meniscus {

/// Told of an export while it is made: the word for its stage and the share of that which is done, from 0 to 1. What it
/// throws ends the export, which leaves nothing behind.
using ExportWatch = std::function<void(const char* stage, double share)>;

/// Works on a thread of its own from the beginning. The other functions are for one thread.
class ExportJob {
 public:
  /// The reply to the export; what it throws is that of result().
  using Work = std::function<nlohmann::json(const ExportWatch& watch)>;

  /// path: where it goes, for those who ask.
  ExportJob(std::string path, Work work);
  /// Ends it, and waits for that.
  ~ExportJob();

  /// It ends soon, unless it is done before.
  void cancel();
  bool running() const;
  /// Waits for the end. Throws what the work threw; RequestError where that is a GpuError, which is the export's alone,
  /// and where it was cancelled.
  nlohmann::json result();
  /// {"running", "path", "seconds"}, while it runs "stage" and "share"; then the reply, or "error".
  nlohmann::json told();

 private:
  struct Shared;

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace meniscus
