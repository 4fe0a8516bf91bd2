// SPDX-License-Identifier: BSD-3-Clause
// Files in addition to the .mns files of a run or a film: the manifest, the atoms of each frame, the storyboard.
#pragma once

#include "core/base/output_file.h"
#include "exporters/blender/mns_file.h"
#include "exporters/blender/surface_file.h"

namespace meniscus::blender {

/// The properties of a run. Every process that writes some of its frames must have the same.
struct SequenceManifest {
  Provenance provenance;              ///< without its device, because parts of a run may be computed on several
  std::string trajectory;             ///< file name without folder; empty: frames are models of provenance.source
  std::vector<std::uint64_t> frames;  ///< frame numbers of the trajectory; scene frame n, from 1, is frames[n - 1]
  std::vector<Shot> shots;            ///< one for all frames, or one per frame
  glm::dvec3 origin{0.0};             ///< origin of the scene's coordinates, Å
  double scale = 0.1;                 ///< Blender units per Å
  double fps = 24.0;                  ///< scene frames per second
  double probe_radius = 0.0, tolerance = 0.0;  ///< Å
  std::size_t atom_count = 0;

  const Shot& shot(std::size_t place) const { return shots[shots.size() == 1 ? 0 : place]; }
};

/// Returns the file name of a frame, such as "surface_00042.mns".
std::string frame_file(std::uint64_t frame);

/// Returns a checksum of the run as text. Two runs have the same only if their frames may be mixed: everything except
/// cameras, fps and scale contributes to it.
std::string run_name(const SequenceManifest& manifest);

/// Writes surface_sequence.json as FORMAT.md describes and returns its path. A file that exists with exactly this
/// content stays. Throws OutputError.
std::filesystem::path write_manifest(const std::filesystem::path& folder, Existing existing,
                                     const SequenceManifest& manifest);

/// The positions of atoms in one frame.
struct AtomFrame {
  std::vector<glm::dvec3> positions;  ///< Å, in the order of the atoms of the object
  std::optional<double> time;         ///< ps; empty if unknown
};

/// The frames of a run.
struct AtomFrames {
  std::vector<std::uint64_t> numbers;  ///< frame numbers of the trajectory
  std::function<AtomFrame()> next;     ///< returns the next frame; called once for each number, in order
};

/// Writes the atoms of an object and their positions in each frame as FORMAT.md describes. The object must have a
/// single place; copies must be atoms of their own. Throws OutputError, and what AtomFrames::next throws.
void write_atoms(const std::string& path, Existing existing, const SurfaceObject& object, const AtomAttributes& atoms,
                 const Provenance& provenance, const AtomFrames& frames);

/// A scene of a film.
struct StoryScene {
  std::string name, title;  ///< name of its scene file without ending; title that was written into its pictures
  std::string file;         ///< file with its surface, in the same folder
  std::uint64_t first = 0, last = 0;  ///< frames that show it, from 1; frames between two scenes are a transition
  Shot shot;
  std::optional<glm::vec3> background;  ///< sRGB; empty if transparent
};

/// The scenes of a film in order.
struct Story {
  std::vector<StoryScene> scenes;
  bool is_smooth = true;   ///< true if transitions start and end slowly
  glm::dvec3 origin{0.0};  ///< middle of everything that is shown, Å
  double scale = 0.1;      ///< Blender units per Å
  double fps = 25.0;       ///< frames per second
};

/// Returns the file name of the scene at a place from 0, such as "scene_2.mns" for place 1.
std::string scene_file(std::size_t place);

/// Returns the text of story.json as FORMAT.md describes it.
std::string story_json(const Story& story);

}  // namespace meniscus::blender
