// SPDX-License-Identifier: BSD-3-Clause
// Scenes, their objects and their values as JSON, both ways.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/properties/properties.h"
#include "core/scene/figure_object.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The value as set_value() takes it; empty: it says nothing. Throws RequestError that says what the JSON is not.
std::vector<std::string> texts_of_json(const Property& property, const nlohmann::ordered_json& value);

/// JSON that texts_of_json() reads as these texts. Paths are as seen from the folder; of an empty one they are names.
nlohmann::ordered_json json_of_texts(const Property& property, const std::vector<std::string>& texts,
                                     const std::string& folder);

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

/// A value that a scene file sets.
struct SceneSetting {
  const Property* property = nullptr;
  std::vector<std::string> texts;  ///< as set_value takes them; paths as the file has them
  std::string place;               ///< in the file, for messages: "objects[0].clip"
};

/// The settings of a scene, in the order of the table of properties. file: its name, for messages. Throws InputError
/// for what is not a scene, has no such key, or has values of another type; what values mean is looked at when they are
/// set.
std::vector<SceneSetting> parse_scene(std::string_view json, const std::string& file);

/// The scene as a file has it, ending with a newline: what differs from Scene{}. folder: from which paths are seen;
/// empty: files by their names alone, and no output. added: the files that were superposed when the scene was drawn,
/// with atoms and RMSD as "superposed", which parse_scene passes over.
std::string scene_text(const Scene& scene, const std::string& folder, std::span<const AddedFile> added = {});

}  // namespace meniscus
