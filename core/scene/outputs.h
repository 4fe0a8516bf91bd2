// SPDX-License-Identifier: BSD-3-Clause
// The settings of a scene's outputs: pictures, films, meshes, scenes for other renderers.
#pragma once

#include "core/image/color_space.h"
#include "core/mesh/mesh_objects.h"
#include "core/render/image_output.h"
#include "core/render/picture.h"

namespace meniscus {

/// The settings of a picture, except its size, which belongs to its camera (ViewRequest).
struct PictureOutput {
  int samples = 9;                          ///< rays per pixel
  int motion_blur = 1;                      ///< number of moments in the mean that makes a picture of a run
  std::optional<glm::vec3> background;      ///< sRGB; nothing: transparent
  bool aovs = false;                        ///< adds layers such as depth, normals and atoms
  bool cryptomatte = false;                 ///< adds mattes by chain, residue and atom
  Primaries primaries = Primaries::rec709;  ///< the primaries of the colours of EXR files
  TiffFormat tiff;
  std::optional<Extent> extent;  ///< nothing: the complete surface, computed and certified before the picture
};

/// The encoding of a film. An empty text or 0 leaves a setting to the codec, and an empty codec is chosen by the suffix
/// of the film's name.
struct FilmFormat {
  std::string codec;               ///< h264, h265, vp9, prores, prores4444, dnxhr or gif
  std::optional<int> rate_factor;  ///< smaller values give better and larger films
  int bits = 0;                    ///< bits per channel, 8 or 10
  int chroma = 0;                  ///< 420, 422 or 444: the share of pixels with colour
  double frames_per_second = 25.0;
  bool transparent = false;  ///< true: transparency is kept, which not all codecs can; false: white replaces it if
                             ///< there is no background

  bool operator==(const FilmFormat&) const = default;
};

/// The settings of a mesh and of its file.
struct MeshOutput : MeshRequest {
  double density = 0.0;              ///< vertices per Å² of an even mesh; 0: by tolerance
  bool even = false;                 ///< true: nearly equilateral triangles
  std::string format;                ///< format of the file; empty: by the suffix of its name
  std::string attributes = "usual";  ///< numbers of vertices: names separated by commas, usual, all or none
  double scale = 1.0;                ///< length of 1 Å in the file's unit
};

/// The settings of a scene for another renderer.
struct RendererOutput {
  std::string material;   ///< material of the surface, named as in that renderer; empty: the renderer's first
  bool comments = false;  ///< true: comments name patches and atoms
};

}  // namespace meniscus
