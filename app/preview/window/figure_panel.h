// SPDX-License-Identifier: BSD-3-Clause
// The part of the panel for the figure: a selection of atoms, and a row for each thing shown.
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "app/preview/window/session_link.h"

namespace meniscus {

/// draw() belongs into the panel.
class FigurePanel {
 public:
  explicit FigurePanel(SessionLink& link) : link_(link) {}

  void draw();

 private:
  void atoms();
  void rows();
  void objects();
  void cuts();
  void caps();
  void legend();
  void views();
  /// A row with a button that removes it; true if that was clicked.
  bool removed(const std::string& text, const char* of, int index);

  SessionLink& link_;
  std::string selection_, view_name_, legend_title_;
  glm::vec3 paint_{230.0f / 255.0f, 159.0f / 255.0f, 0.0f};
};

}  // namespace meniscus
