// SPDX-License-Identifier: BSD-3-Clause
// The values of a scene by the keys of their properties, as text: what command lines, scene files and previews set.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/properties/properties.h"
#include "core/scene/scene.h"

namespace meniscus {

/// A value that a property cannot have, or that contradicts another one. Says what is wrong, not where it was said:
/// the command line adds the option, a scene file the place.
class ValueError : public RequestError {
 public:
  ValueError(std::string_view property_key, const std::string& what) : RequestError(what), key_(property_key) {}
  std::string_view key() const { return key_; }

 private:
  std::string key_;
};

/// Whether a scene has a value of this property.
bool is_scene_value(const Property& property);

/// What programs call a property: its option without the dashes in front, and with "_" for those within: "depth_cue".
std::string value_name(const Property& property);
/// The property of a scene that has this name or key, "depth_cue" or "look.depth_cue". Throws RequestError, with
/// the nearest name.
const Property& scene_property(std::string_view name);

/// Sets a value. texts: one; of repeatable properties any number, which are added to those that the scene has. A flag
/// is "true" or "false"; a value that was left out is "". Throws ValueError, SelectionError.
void set_value(Scene& scene, const Property& property, std::span<const std::string> texts);

/// What set_value() reads as the scene's value, to the last bit; empty where it is that of Scene{}.
std::vector<std::string> value_texts(const Scene& scene, const Property& property);

/// Completes a scene once all values are set: lengths on paper become pixels, numbers of a file colour all atoms where
/// no other colour was named, the sides of an interface are coloured by what they bury and face the viewer. Doing it
/// again changes nothing. Throws ValueError for values that contradict each other.
void complete(Scene& scene);

/// The scene as it is read and computed: its molecule also has the atoms that are drawn beside the surface, and of an
/// interface only the atoms of both sides. Not to be saved. Throws RequestError.
Scene readied(Scene scene);

}  // namespace meniscus
