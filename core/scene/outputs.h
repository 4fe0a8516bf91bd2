// SPDX-License-Identifier: BSD-3-Clause
// What a scene says about its outputs: pictures, films, meshes, scenes for other renderers.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "core/image/color_space.h"
#include "core/mesh/mesh_objects.h"
#include "core/render/picture.h"

namespace meniscus {

/// Of a picture, beside its size, which is that of its camera (ViewRequest).
struct PictureOutput {
  int samples = 9;                          ///< rays per pixel
  int motion_blur = 1;                      ///< moments that a picture of a run is the mean of
  std::optional<glm::vec3> background;      ///< sRGB; nothing: transparent
  bool aovs = false;                        ///< depth, normals, atoms and the like beside colour
  bool cryptomatte = false;                 ///< mattes by chain, residue and atom beside colour
  Primaries primaries = Primaries::rec709;  ///< of the colours of EXR files
  std::optional<Extent> extent;  ///< nothing: the complete surface, computed and certified before the picture
};

/// How the pictures of a film are encoded. What is empty or 0 is left to the codec, and the codec to the ending of the
/// film's name.
struct FilmFormat {
  std::string codec;               ///< h264, h265, vp9, prores, prores4444, dnxhr or gif
  std::optional<int> rate_factor;  ///< smaller is better and larger
  int bits = 0;                    ///< of a channel, 8 or 10
  int chroma = 0;                  ///< 420, 422 or 444: colour in how many of the pixels
  double frames_per_second = 25.0;
  bool transparent = false;  ///< what is transparent stays so, which not all codecs can; else white where none is

  bool operator==(const FilmFormat&) const = default;
};

/// Of a mesh and its file.
struct MeshOutput : MeshRequest {
  double density = 0.0;              ///< vertices per Å², of an even mesh; 0: by tolerance
  bool even = false;                 ///< nearly equilateral triangles
  std::string format;                ///< empty: by the ending of the file's name
  std::string attributes = "usual";  ///< numbers of vertices: names separated by commas, usual, all or none
  double scale = 1.0;                ///< length of 1 Å in the file
};

/// Of a scene for another renderer.
struct RendererOutput {
  std::string material;   ///< of the surface, in the words of that renderer; empty: its first
  bool comments = false;  ///< that name patches and atoms
};

}  // namespace meniscus
