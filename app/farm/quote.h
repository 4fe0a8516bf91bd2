// SPDX-License-Identifier: BSD-3-Clause
// Quotes texts as one word of the languages of job files.
#pragma once

#include <string>
#include <string_view>

namespace meniscus::farm {

/// Character data or an attribute's value in XML.
std::string xml_text(std::string_view text);

/// A string literal of JSON, and of JavaScript of any edition: ASCII only.
std::string json_text(std::string_view text);

/// Throws RequestError, which begins with `what`, for a path with control characters or that is not UTF-8: there are
/// engines that cannot be told of it.
void require_printable_path(const std::string& what, std::string_view path);

}  // namespace meniscus::farm
