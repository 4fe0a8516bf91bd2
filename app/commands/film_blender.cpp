// SPDX-License-Identifier: BSD-3-Clause
// `meniscus film --to blender`: writes a storyboard as surfaces, with the times and the appearance of each.
#include <fstream>
#include <iostream>

#include "app/commands/figure_meshes.h"
#include "app/commands/storyboard.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/output_file.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/math/box.h"
#include "exporters/blender/sequence_manifest.h"

namespace meniscus {
namespace {

bool have_one_content(const std::filesystem::path& one, const std::filesystem::path& other) {
  if (std::filesystem::file_size(one) != std::filesystem::file_size(other)) return false;
  std::ifstream first(one, std::ios::binary), second(other, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return std::equal(Bytes(first), Bytes(), Bytes(second));
}

void check(Storyboard& storyboard) {
  for (std::size_t n = 0; n < storyboard.size(); ++n) {
    FilmScene& scene = storyboard.scene(n);
    check_blender(scene.run.scene());
    if (scene.run.is_run())
      throw UsageError(
          "{}: --to blender takes scenes of one molecule, and this is one of a run of frames; give it to "
          "meniscus export blender",
          in_quotes(storyboard.command().files[n]));
  }
}

std::vector<std::string> left_out_of_blender(Storyboard& storyboard) {
  std::vector<std::string> sentences;
  const double probe = storyboard.scene(0).run.scene().molecule.surface.probe_radius;
  if (storyboard.leaves_writing_out())
    sentences.emplace_back(
        "titles, labels, legends and scale bars are left out: Blender gets only the molecule; titles name the markers "
        "of its timeline");
  const bool cuts = storyboard.any([](const Scene& scene) { return !scene.figure.cuts.empty(); });
  const bool probes = storyboard.any([&](const Scene& scene) { return scene.molecule.surface.probe_radius != probe; });
  if (cuts || probes)
    sentences.push_back(
        fmt::format("{} not move in Blender: each scene has its own mesh, and the meshes fade into each other",
                    cuts && probes ? "cut planes and the probe's radius do"
                    : cuts         ? "cut planes do"
                                   : "the probe's radius does"));
  return sentences;
}

class BlenderFilm {
 public:
  explicit BlenderFilm(Storyboard& storyboard)
      : storyboard_(storyboard),
        command_(storyboard.command()),
        folder_(command_.scene.output, command_.existing()),
        progress_(progress_on_stderr(command_), "film", storyboard.size()) {}

  void write() {
    storyboard_.log_left_out(left_out_of_blender(storyboard_));
    story_.is_smooth = command_.pace == Pace::smooth;
    story_.fps = command_.scene.film.frames_per_second;
    std::uint64_t frame = 1;
    for (std::size_t n = 0; n < storyboard_.size(); ++n) {
      blender::StoryScene& scene = story_.scenes.emplace_back();
      scene.first = frame;
      scene.last = frame + storyboard_.held(n) - 1;
      frame = scene.last + 1 + (n + 1 < storyboard_.size() ? storyboard_.between(n) : 0);
      add(n, scene);
      progress_.advance(1);
    }
    story_.origin = 0.5 * (extent_.low + extent_.high);
    folder_.file("story.json").write(blender::story_json(story_));
    for (const auto& file : files_) file->commit();
    folder_.commit();
    const std::filesystem::path written = folder_.path() / "story.json";
    log_line(command_, fmt::format("{} scenes as {} files, {} frames, {:.1f} s", storyboard_.size(), files_.size(),
                                   with_thousands(frame - 1), static_cast<double>(frame - 1) / story_.fps));
    std::cout << escaped(written.string()) << "\n";
  }

 private:
  void add(std::size_t n, blender::StoryScene& made) {
    FigureRun& run = storyboard_.scene(n).run;
    const Scene& scene = run.scene();
    made.name = std::filesystem::path(command_.files[n]).stem().string();
    made.title = storyboard_.title(n);
    made.background = scene.image.background;
    made.shot = blender_shot(scene, run.camera(0));
    for (const Ball& ball : run.figure().balls()) {
      extent_.include(ball.center - ball.radius);
      extent_.include(ball.center + ball.radius);
    }
    run.make({kMeshBytesPerAtom}, [&]() -> FigureRun::Sink {
      return [&](FigureFrame frame) -> FinishFrame {
        made.file = write_surface(n, std::move(frame));
        return [] { return MadeFrame{}; };
      };
    });
  }

  /// Returns the name of the file with the surface, which may be that of an earlier scene with the same look.
  std::string write_surface(std::size_t n, FigureFrame frame) {
    const SceneCommand& command = storyboard_.scene(n).run.command();
    const MeshFineness fineness{blender::kTolerance, {}, 0.0, false};
    const blender::CutFile cut = cut_file(command, frame);
    const blender::Provenance provenance = provenance_of(frame.figure.molecule);
    warn_of_many(command, expected_triangles(frame.figure.molecule.objects, fineness, CopiesOfMesh::shared));
    FigureMeshes meshes;
    mesh_figure(command, frame, cut, fineness, meshes);
    add_numbers(command, blender::parse_surface_numbers(command.scene.mesh.attributes), frame.figure.molecule.structure,
                meshes.objects);
    auto file = std::make_unique<OutputFile>(folder_.path() / blender::scene_file(n), command_.existing());
    write_objects(*file, meshes.objects, provenance, cut);
    const auto same = std::ranges::find_if(
        files_, [&](const auto& other) { return have_one_content(other->temporary_path(), file->temporary_path()); });
    if (same != files_.end()) return (*same)->target().filename().string();
    files_.push_back(std::move(file));
    return files_.back()->target().filename().string();
  }

  Storyboard& storyboard_;
  const FilmCommand& command_;
  OutputFolder folder_;
  Progress progress_;
  blender::Story story_;
  Box extent_;
  std::vector<std::unique_ptr<OutputFile>> files_;  ///< surfaces, kept open until all are complete
};

}  // namespace

void write_blender_film(Storyboard& storyboard) {
  check(storyboard);
  BlenderFilm(storyboard).write();
}

}  // namespace meniscus
