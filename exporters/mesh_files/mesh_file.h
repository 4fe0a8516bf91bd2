// SPDX-License-Identifier: BSD-3-Clause
// What a mesh file holds, whatever its format: objects of triangles with colours and numbers, in the unit of the file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/math/rigid_motion.h"

namespace meniscus {

enum class PatchKind : std::uint8_t;

/// A number of each vertex. The name is a word of letters, digits and underscores.
struct VertexNumbers {
  std::string name;
  std::vector<float> values;  ///< NaN: there is none
};

/// Of an atom, what files may name. Texts are those of a molecule file.
struct FileAtom {
  std::string name, residue_name, chain;
  std::int32_t residue_number = 0;
  char insertion_code = ' ';
  glm::dvec3 position{0.0};  ///< Å
};

/// An object of a file. One entry a vertex, or one a triangle.
struct FileObject {
  std::string name;                                     ///< text of a molecule file may be in it
  std::vector<glm::vec3> positions;                     ///< in the unit of the file
  std::vector<glm::vec3> normals;                       ///< unit, towards the solvent
  std::vector<std::array<std::uint8_t, 3>> colors;      ///< sRGB
  std::vector<float> opacities;                         ///< in (0, 1]; empty: it is opaque
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the solvent
  /// sRGB per triangle, which change exactly where patches do; empty where a map colours points, and of objects that
  /// were joined.
  std::vector<std::array<std::uint8_t, 3>> triangle_colors;
  std::vector<VertexNumbers> numbers;    ///< alike in all objects of a file
  std::vector<std::uint32_t> atom;       ///< per vertex: into MeshFile::atoms
  std::vector<PatchKind> kind;           ///< per vertex
  std::vector<glm::vec3> velocities;     ///< in the unit of the file per frame of the run; empty: unknown
  std::vector<std::uint32_t> component;  ///< per triangle: each closed part of the file has a number of its own
  bool is_cavity = false;                ///< all of it bounds cavities
  /// The motions to each place of the object, in the unit of the file; at least one. Only formats with
  /// MeshFormat::places have several, or one that is not the identity.
  std::vector<RigidMotion> places{RigidMotion{}};

  /// True if the object is in one place and is not moved.
  bool stands_once() const {
    return places.size() == 1 && places[0].rotation == glm::dmat3(1.0) && places[0].translation == glm::dvec3(0.0);
  }
};

/// What a file's objects are made of, as renderers by microfacets have it.
struct FileMaterial {
  float roughness = 0.5f;  ///< in [0, 1]
  float ior = 1.5f;        ///< index of refraction, at least 1, which has no highlights
};

/// All of a file.
struct MeshFile {
  std::vector<FileObject> objects;  ///< at least one
  std::vector<FileAtom> atoms;
  double scale = 1.0;  ///< of the file's unit: what 1 Å is
  FileMaterial material;
  std::string about;  ///< one line: the program, what it is, its scale
  /// A point inside each cavity, and inside each solid; with the number of its component.
  struct InnerPoint {
    glm::dvec3 position{0.0};  ///< in the unit of the file
    std::uint32_t component = 0;
  };
  std::vector<InnerPoint> cavities, solids;
};

/// When the frames of one file are.
struct RunTimes {
  std::vector<std::uint64_t> places;  ///< of each in the run, from 1
  double per_second = 25.0;
};

}  // namespace meniscus
