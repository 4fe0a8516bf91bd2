// SPDX-License-Identifier: BSD-3-Clause
// One object of a figure as JSON, for --object and for the list in a scene file.
#pragma once

#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/properties/properties.h"
#include "core/scene/figure_object.h"

namespace meniscus {

/// A key of such an object, besides "representation" and "selection".
struct ObjectKey {
  std::string_view name;
  const Property* property;  ///< that says what it means and which values it takes
  bool of_surfaces, of_shapes;
};

/// In the order of their table.
const std::vector<ObjectKey>& object_keys();

/// Reads {"representation": "surface" | "sticks" | "balls" | "spheres" | "tube", "selection": EXPR, ...};
/// docs/how-to/scenes.md has all keys. Throws RequestError that names the key, SelectionError.
FigureObjectRequest parse_figure_object(std::string_view json);

/// What parse_figure_object reads as this object, exactly; what is as usual is left out.
nlohmann::ordered_json figure_object_json(const FigureObjectRequest& object);

}  // namespace meniscus
