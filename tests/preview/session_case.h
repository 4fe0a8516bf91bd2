// SPDX-License-Identifier: BSD-3-Clause
// A session of the preview that draws on the CPU, and ways to talk to it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/preview/session.h"
#include "tests/support/run_program.h"

namespace meniscus::test {

using Json = nlohmann::json;

class SessionCase : public ::testing::Test {
 protected:
  /// Pictures have 80 x 60 pixels.
  void begin(Structure structure, const SessionContext& context = {}, PreviewState view = {}) {
    view.size = {80, 60};
    session_ = std::make_unique<PreviewSession>(make_cpu_preview_renderer(), std::move(structure), view, std::nullopt,
                                                folder_.path(), std::nullopt, context);
  }

  Json apply(const std::string& command) { return session_->apply(Json::parse(command)); }
  Json state() { return apply(R"({"command":"state"})"); }
  void expect_ok(const std::string& command) {
    const Json reply = apply(command);
    EXPECT_TRUE(reply["ok"]) << command << " -> " << reply;
  }
  std::vector<std::uint8_t> picture() {
    session_->render(Quality::full);
    return session_->rgba();
  }

  TemporaryFolder folder_;
  std::unique_ptr<PreviewSession> session_;
};

}  // namespace meniscus::test
