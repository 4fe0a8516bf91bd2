// SPDX-License-Identifier: BSD-3-Clause
// What a scene speaks of and its picture does not show: atoms of labels, of rules of colour and of patches.
#pragma once

#include <string>
#include <vector>

#include "core/scene/figure.h"
#include "core/scene/scene.h"

namespace meniscus {

/// The survey of a picture of the structure by this camera: marks labels of whose atoms no pixel shows any
/// (PlaceLabel::is_hidden). Copies count as one, and where something is seen through nothing is said. size: of the
/// molecule's picture. sentences: get one for each label, rule and patch of which nothing is seen, with the turn that
/// shows it; nullptr: none is made. All but the size must stay until the picture is drawn.
Survey survey_of(const Scene& scene, const Structure& structure, const Camera& camera, glm::ivec2 size,
                 Annotations& annotations, std::vector<std::string>* sentences = nullptr);

}  // namespace meniscus
