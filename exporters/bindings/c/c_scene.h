// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a scene.
#pragma once

#include <set>

#include "core/scene/scene.h"
#include "core/scene/scene_values.h"
#include "exporters/bindings/c/c_calls.h"

/// The object behind the handle of a scene.
struct meniscus_scene : meniscus::c_api::Counted {
  meniscus_scene() = default;
  explicit meniscus_scene(meniscus::Scene scene) : scene_(std::move(scene)) {}

  meniscus::Scene copy() const {
    const std::lock_guard lock(mutex_);
    return scene_;
  }
  /// Calls change(meniscus::Scene&). The scene is unchanged if it throws.
  template <typename Change>
  void change(const Change& change) {
    const std::lock_guard lock(mutex_);
    meniscus::Scene changed = scene_;
    change(changed);
    scene_ = std::move(changed);
  }
  /// Stores a text, and returns a pointer that is valid as long as this object.
  const char* keep(std::string text) const {
    const std::lock_guard lock(mutex_);
    return texts_.insert(std::move(text)).first->c_str();
  }

 private:
  mutable std::mutex mutex_;
  meniscus::Scene scene_;
  mutable std::set<std::string> texts_;
};

namespace meniscus::c_api {

/// Sets the values of a property. Refuses an invalid value with the status; the message begins with the place.
void set_at(Scene& scene, const Property& property, const std::vector<std::string>& texts, meniscus_status status,
            const std::string& place);

/// Returns true if a picture of a computed surface has the property.
bool is_of_surface(const Property& property);

/// Returns a copy in which dependent values are completed. Refuses values that contradict each other.
Scene completed(const meniscus_scene& scene);

/// Returns a completed copy for drawing. Refuses a scene without a molecule. Defined in builds with scene files only.
Scene drawable(const meniscus_scene& scene);

}  // namespace meniscus::c_api
