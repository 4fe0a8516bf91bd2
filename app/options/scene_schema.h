// SPDX-License-Identifier: BSD-3-Clause
// The keys of scene files, for people and for editors of JSON.
#pragma once

#include <string>

namespace meniscus {

/// The page `meniscus help scenes`.
std::string scene_help();

/// A JSON schema (draft 2020-12) of scene files; ends with a newline. docs/reference/scene.schema.json is the same.
std::string scene_schema();

}  // namespace meniscus
