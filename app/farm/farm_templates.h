// SPDX-License-Identifier: BSD-3-Clause
// The templates of job files: the files of app/farm/templates.
#pragma once

#include <span>
#include <string_view>

#include "core/base/text.h"

namespace meniscus {

std::span<const TemplateFile> farm_templates();

namespace farm {

/// The text of one of them.
inline std::string_view farm_template(std::string_view path) { return template_text(farm_templates(), path); }

}  // namespace farm
}  // namespace meniscus
