// SPDX-License-Identifier: BSD-3-Clause
// Fills the stage's text for the preview, and finds files by their paths.
#include "app/preview/server/page_files.h"

#include <algorithm>

#include "core/base/version.h"
#include "exporters/page/page_templates.h"

namespace meniscus {
namespace {

std::string stage_file(std::string_view path) { return std::string(template_text(page_templates(), path)); }

/// Returns the HTML of the page. Its policy comes with the reply, its figure through the socket.
std::string whole_page() {
  const std::string links =
      "<link rel=\"icon\" href=\"icon.svg\" type=\"image/svg+xml\">\n"
      "<link rel=\"stylesheet\" href=\"page.css\">";
  const std::string scripts =
      "<script src=\"stage.js\"></script>\n<script type=\"module\" src=\"program.js\"></script>";
  return filled(stage_file("page.html"),
                {{"POLICY", ""},
                 {"TITLE", "Meniscus"},
                 {"VERSION", MENISCUS_VERSION},
                 {"STYLE", links},
                 {"DESCRIPTION", "Molecular surface"},
                 {"STILL", ""},
                 {"LEGEND", ""},
                 {"FACTS", ""},
                 {"BYTES", "0"},
                 {"DATA", ""},
                 {"SCRIPT", std::string(template_text(page_files(), "program.html")) + scripts}});
}

}  // namespace

std::optional<std::string> served_file(std::string_view path) {
  if (path.empty()) return whole_page();
  if (path == "page.css") return stage_file(path);
  if (path == "stage.js") return stage_file("first.js") + stage_file("second.js");
  const auto file = std::ranges::find(page_files(), path, &TemplateFile::path);
  if (file == page_files().end()) return std::nullopt;
  return std::string(file->text);
}

std::string_view content_type(std::string_view path) {
  if (path.empty() || path.ends_with(".html")) return "text/html; charset=utf-8";
  if (path.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (path.ends_with(".css")) return "text/css; charset=utf-8";
  if (path.ends_with(".svg")) return "image/svg+xml";
  return "text/plain; charset=utf-8";
}

}  // namespace meniscus
