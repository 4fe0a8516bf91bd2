// SPDX-License-Identifier: BSD-3-Clause
// What a surface is made of, for light.
#pragma once

#include <optional>

namespace meniscus {

/// How a surface answers the light. With ambient 1 and specular 0 a pixel is exactly of the colour given.
struct Material {
  float ambient = 0.0f;     ///< share in [0, 1] of light that comes evenly from everywhere, so that nothing is modelled
  float roughness = 0.0f;   ///< in [0, 1]: from light that falls off early, as on wax, to an even one, as on chalk
  float specular = 0.10f;   ///< strength of the highlight, 0 to 1
  float shininess = 40.0f;  ///< how small it is: the exponent of Blinn and Phong, 1 to 1000
};

/// What differs from a look's material. Nothing: as the look has it.
struct MaterialRequest {
  std::optional<float> ambient{}, roughness{}, specular{}, shininess{};

  bool empty() const { return !ambient && !roughness && !specular && !shininess; }
  Material over(Material material) const {
    material.ambient = ambient.value_or(material.ambient);
    material.roughness = roughness.value_or(material.roughness);
    material.specular = specular.value_or(material.specular);
    material.shininess = shininess.value_or(material.shininess);
    return material;
  }
};

}  // namespace meniscus
