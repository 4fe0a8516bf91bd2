// SPDX-License-Identifier: BSD-3-Clause
// One value of a scene, or of an object in it, as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/properties/properties.h"

namespace meniscus {

/// The value as set_value() takes it; empty: it says nothing. Throws RequestError that says what the JSON is not.
std::vector<std::string> texts_of_json(const Property& property, const nlohmann::ordered_json& value);

/// JSON that texts_of_json() reads as these texts. Paths are as seen from the folder; of an empty one they are names.
nlohmann::ordered_json json_of_texts(const Property& property, const std::vector<std::string>& texts,
                                     const std::string& folder);

}  // namespace meniscus
