// SPDX-License-Identifier: BSD-3-Clause
// The content of a mesh file in any format: objects of triangles with colours and numbers, in the unit of the file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/rigid_motion.h"

namespace meniscus {

enum class PatchKind : std::uint8_t;

/// A number for each vertex. The name consists of letters, digits and underscores.
struct VertexNumbers {
  std::string name;
  std::vector<float> values;  ///< NaN for a vertex without a value
};

/// The properties of an atom that files may contain. The texts come from a molecule file.
struct FileAtom {
  std::string name, residue_name, chain;
  std::int32_t residue_number = 0;
  char insertion_code = ' ';
  glm::dvec3 position{0.0};  ///< Å
};

/// An object of a file. Its arrays have one entry per vertex unless they say otherwise.
struct FileObject {
  std::string name;                                     ///< may contain text from a molecule file
  std::vector<glm::vec3> positions;                     ///< in the unit of the file
  std::vector<glm::vec3> normals;                       ///< of unit length, towards the solvent
  std::vector<std::array<std::uint8_t, 3>> colors;      ///< sRGB
  std::vector<float> opacities;                         ///< in (0, 1]; empty if the object is opaque
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the solvent
  /// sRGB per triangle. These colours change exactly at the borders of patches. Empty if a volume map colours points,
  /// and for joined objects.
  std::vector<std::array<std::uint8_t, 3>> triangle_colors;
  std::vector<VertexNumbers> numbers;    ///< the same names in all objects of a file
  std::vector<std::uint32_t> atom;       ///< index into MeshFile::atoms
  std::vector<PatchKind> kind;           ///< kind of the patch
  std::vector<glm::vec3> velocities;     ///< in the unit of the file per frame of the run; empty if unknown
  std::vector<std::uint32_t> component;  ///< per triangle: number of the closed part, unique in the file
  bool is_cavity = false;                ///< true if all parts of the object bound cavities
  /// The motions to each place of the object, in the unit of the file; at least one. Only formats with
  /// MeshFormat::places have several, or one that is not the identity.
  std::vector<RigidMotion> places{RigidMotion{}};

  /// True if the object is in one place and is not moved.
  bool is_placed_once() const {
    return places.size() == 1 && places[0].rotation == glm::dmat3(1.0) && places[0].translation == glm::dvec3(0.0);
  }
};

/// The material of a file's objects, in terms of microfacet models.
struct FileMaterial {
  float roughness = 0.5f;  ///< in [0, 1]
  float ior = 1.5f;        ///< index of refraction, at least 1; there are no highlights at 1
};

/// The whole content of a file.
struct MeshFile {
  std::vector<FileObject> objects;  ///< at least one
  std::vector<FileAtom> atoms;
  double scale = 1.0;  ///< the length of 1 Å in the unit of the file
  FileMaterial material;
  std::string about;  ///< one line with the program, the content and the scale
  /// A point inside a cavity or a solid, with the number of its component.
  struct InnerPoint {
    glm::dvec3 position{0.0};  ///< in the unit of the file
    std::uint32_t component = 0;
  };
  std::vector<InnerPoint> cavities, solids;
};

/// The times of the frames of one file.
struct RunTimes {
  std::vector<std::uint64_t> places;  ///< number of each frame in the run, from 1
  double per_second = 25.0;           ///< frames per second
};

}  // namespace meniscus
