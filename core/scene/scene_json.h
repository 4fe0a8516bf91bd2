// SPDX-License-Identifier: BSD-3-Clause
// Scenes, their objects and their values as JSON, both ways, and the files that a scene may name, since it may come
// from anyone.
#pragma once

#include <nlohmann/json.hpp>

#include "core/properties/properties.h"
#include "core/scene/figure_object.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The files that the user of a scene allows it to name. Unless the scene is trusted as a whole, it names no files
/// outside of its folder and the working folder except files that are typed or named before, and it writes only to new
/// files next to itself.
struct SceneTrust {
  std::string file{};                ///< the scene's file
  std::vector<std::string> typed{};  ///< words of the command line
  std::vector<std::string> named{};  ///< words of an earlier command line
  bool is_whole = false;             ///< --trust-scene
  bool replaces = false;             ///< --force
  std::string advice{};              ///< end of a sentence about how to allow a file outside of the folder

  /// Returns a path of the scene relative to the working folder. A path to read is searched in the scene's folder, then
  /// in the working folder, then among the words of the earlier command line. place: the place of the path in the
  /// scene. Throws InputError for a path that the scene may not name.
  std::string path(const Property& property, const std::string& text, const std::string& place) const;

 private:
  bool has(const std::string& path) const;
};

/// Returns a sentence about a value that is not UTF-8, such as a file name, because the text of the scene would change
/// it; empty if there is none.
std::string scene_fault(const Scene& scene);

/// Returns the value in the form of set_value(); empty if the JSON gives no value. Throws RequestError that says what
/// is wrong with the JSON.
std::vector<std::string> texts_of_json(const Property& property, const nlohmann::ordered_json& value);

/// Returns JSON from which texts_of_json() reads these texts. Paths are relative to the folder; if it is empty, only
/// the names of files are written.
nlohmann::ordered_json json_of_texts(const Property& property, const std::vector<std::string>& texts,
                                     const std::string& folder);

/// A key of an object of a scene, in addition to "representation" and "selection".
struct ObjectKey {
  std::string_view name;
  const Property* property;  ///< defines its meaning and its values
  bool of_surfaces, of_shapes;
};

const std::vector<ObjectKey>& object_keys();

/// Reads {"representation": "surface" | "sticks" | "balls" | "spheres" | "tube", "selection": EXPR, ...};
/// docs/how-to/scenes.md has all keys. Throws RequestError that names the key, SelectionError.
FigureObjectRequest parse_figure_object(std::string_view json);

/// Returns JSON from which parse_figure_object() reads exactly this object. Default values are left out.
nlohmann::ordered_json figure_object_json(const FigureObjectRequest& object);

/// A value that a scene file sets.
struct SceneSetting {
  const Property* property = nullptr;
  std::vector<std::string> texts;  ///< the form is that of set_value(); paths as in the file
  std::string place;               ///< place in the file, for messages: "objects[0].clip"
};

/// Returns the settings of a scene, in the order of the table of properties. file: name of the file, for messages.
/// Throws InputError for text that is not a scene, for unknown keys, and for values of another type; the meaning of
/// values is checked when they are set.
std::vector<SceneSetting> parse_scene(std::string_view json, const std::string& file);

/// Returns the text of a scene file with all values that differ from Scene{}, ending with a newline. folder: paths are
/// relative to it; empty: only the names of files are written, and no output. added: the files that were superposed
/// when the scene was drawn; they are written with atoms and RMSD as "superposed", which parse_scene() ignores.
std::string scene_text(const Scene& scene, const std::string& folder, std::span<const AddedFile> added = {});

}  // namespace meniscus
