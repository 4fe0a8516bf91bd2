// SPDX-License-Identifier: BSD-3-Clause
// The keys of scene files, for people and for editors of JSON.
#pragma once

#include <string>

namespace meniscus {

/// Returns the page `meniscus help scenes`.
std::string scene_help();

/// Returns a JSON schema (draft 2020-12) of scene files, ending with a newline. docs/reference/scene.schema.json has
/// the same text.
std::string scene_schema();

}  // namespace meniscus
