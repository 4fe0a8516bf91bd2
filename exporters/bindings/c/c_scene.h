// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a scene.
#pragma once

#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "core/scene/scene.h"
#include "core/scene/scene_values.h"
#include "exporters/bindings/c/c_calls.h"

struct meniscus_scene : meniscus::c_api::Counted {
  meniscus_scene() = default;
  explicit meniscus_scene(meniscus::Scene scene) : scene_(std::move(scene)) {}

  meniscus::Scene copy() const {
    const std::lock_guard lock(mutex_);
    return scene_;
  }
  /// change(meniscus::Scene&): as a whole, or not at all.
  template <typename Change>
  void change(const Change& change) {
    const std::lock_guard lock(mutex_);
    meniscus::Scene changed = scene_;
    change(changed);
    scene_ = std::move(changed);
  }
  /// The text as a caller may keep it: while this lives.
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

/// Sets a value; a fault of it is refused with the status, after the place where it was said.
void set_at(Scene& scene, const Property& property, const std::vector<std::string>& texts, meniscus_status status,
            const std::string& place);

/// Whether a picture of a caller's surface can have it: one of the look and of the picture itself.
bool is_of_surface(const Property& property);

/// A copy with all values that depend on each other. Refuses those that contradict each other.
Scene completed(const meniscus_scene& scene);

/// The same of a molecule from a file, which is not the standard input of the caller's process. Where this build has
/// readers.
Scene drawable(const meniscus_scene& scene);

}  // namespace meniscus::c_api
