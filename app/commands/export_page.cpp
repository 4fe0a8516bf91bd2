// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export page`: writes one HTML file in which readers turn the exact surface.
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/commands/page_views.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/preview/server/serve.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/image/color_space.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/scene/annotations.h"
#include "core/scene/molecule.h"
#include "core/scene/scene_paths.h"
#include "exporters/page/page_file.h"
#include "exporters/page/scene_page.h"

namespace meniscus {
namespace {

constexpr double kManyBytes = 15e6;
constexpr std::size_t kMostBytes = 250'000'000;  // a browser's text has at most 2^29 letters

struct PageCommand : SceneCommand {
  std::vector<std::string> named_views;
};

/// Returns a picture as JPEG, on its background; as PNG in a build without TurboJPEG.
page::StillPicture still_picture(const Framebuffer& drawn, const Look& look) {
  constexpr std::size_t kChannels = 4;
  std::vector<std::uint8_t> pixels(kChannels * drawn.color.size());
  display_bytes(drawn.color, look.background, kChannels, pixels.data());
  std::vector<std::uint8_t> bytes = encode_jpeg(pixels, drawn.size, false);
  return bytes.empty() ? page::png_still(drawn, look) : page::StillPicture{"image/jpeg", std::move(bytes)};
}

/// The page of a run; a molecule is a run of one frame.
class PageRun {
 public:
  PageRun(FigureRun& run, const NamedViews& views, std::string scene)
      : run_(run), views_(views), scene_(std::move(scene)) {
    common_.key = run.key();
    common_.others = page::other_colors(run.possible_structure(), color_of(run.scene().molecule),
                                        [&](ColorScheme& scheme) { run.measure(scheme); });
    if (!run.is_run()) return;
    frame_count_ = run.frames().numbers().size();
    common_.origin = run.framing().origin();
    common_.facts = {{"Frames", with_thousands(frame_count_)}};
    longest_ = run.frames().last_time().value_or(0.0);
  }

  /// Packs a figure, on any thread.
  FinishFrame take(FigureFrame frame) {
    page::SceneFrame shown = common_;
    shown.camera = frame.camera;
    shown.views = views_.of(run_.scene(), frame.figure);
    if (run_.is_run()) shown.moment = time_text(frame.time, frame.number, longest_);
    auto packed = std::make_shared<page::PackedFrame>(page::scene_frame(
        run_.scene(), std::move(frame.figure), shown, frame.place == 0 ? still_picture : page::EncodeStill()));
    return [this, packed] { return add(std::move(*packed)); };
  }

 private:
  /// Adds the frames in the order of the run. The last one writes the page: there is no page if a frame failed.
  MadeFrame add(page::PackedFrame frame) {
    const std::size_t before = page_.bytes();
    page_.add(std::move(frame));
    if (page_.frame_count() == 2) log_size(before);
    if (page_.frame_count() < frame_count_) return {};
    const std::string text = page_.text(scene_);
    check_size(text.size());
    OutputFile file(run_.scene().output, run_.command().existing());
    file.write(text);
    file.commit();
    log_line(run_.command(), fmt::format("{} bytes", with_thousands(text.size())));
    if (static_cast<double>(text.size()) > kManyBytes)
      log_line(run_.command(), "warning: readers load all of it; --show or --select make a smaller page" +
                                   std::string(run_.is_run() ? ", and so do fewer frames (--stride)" : ""));
    return {{run_.scene().output}};
  }

  /// Prints the size before the other frames are made. of_first: bytes of the page with only the first frame.
  void log_size(std::size_t of_first) const {
    const std::size_t all = of_first + (frame_count_ - 1) * (page_.bytes() - of_first);
    log_line(run_.command(),
             fmt::format("note: {} frames come to about {} bytes", with_thousands(frame_count_), with_thousands(all)));
    check_size(all);
  }

  void check_size(std::size_t bytes) const {
    if (bytes <= kMostBytes) return;
    const std::string fewer =
        run_.is_run() ? fmt::format("choose fewer frames (--stride {}), or ", (bytes + kMostBytes - 1) / kMostBytes)
                      : std::string();
    throw UsageError(
        fmt::format("the page would have about {} bytes, and browsers open no more than {}; {}show fewer "
                    "atoms (--show, --select)",
                    with_thousands(bytes), with_thousands(kMostBytes), fewer));
  }

  FigureRun& run_;
  const NamedViews& views_;
  const std::string scene_;
  page::SceneFrame common_;
  page::PageWriter page_;
  std::size_t frame_count_ = 1;
  double longest_ = 0.0;  // ps
};

void export_page(const PageCommand& requested, bool trusts_scenes) {
  page::check_scene(requested.scene);
  check_output(requested.scene.output, requested.existing());
  check_saved_camera(requested);
  NamedViews views(requested.named_views, requested, trusts_scenes);
  FigureRun run(requested);
  run.aim(requested.scene.picture, true);
  views.aim(run);
  const bool has_scene = !run.is_run() && scene_fault(requested.scene).empty();
  PageRun page(run, views, has_scene ? scene_text(requested.scene, "", *requested.added) : "");
  run.make({kSurfaceBytesPerAtom},
           [&]() -> FigureRun::Sink { return [&page](FigureFrame frame) { return page.take(std::move(frame)); }; });
  run.save_cameras();
  std::cout << escaped(run.scene().output) << "\n";
}

void declare_page(CLI::App& command) {
  describe(
      command,
      "  meniscus export page 1tii.pdb -o 1tii.html              then open it in a browser\n"
      "  meniscus export page 1tii.pdb -o 1tii.html --color chain --sticks ligand\n"
      "  meniscus export page --scene fig.json -o fig.html\n"
      "  meniscus export page adk.psf adk.dcd --frames all --stride 10 -o adk.html     with a slider\n"
      "  meniscus export page 1tii.pdb -o 1tii.html --named-view 'Active site=site.json' --named-view Back=back.png",
      "The page fetches nothing, and casts the exact patches by WebGL 2 in the browser that opens it. Others "
      "see\na still picture that is in it. Frames of a run are all in the page, each with its own patches.");
  auto declared = std::make_shared<DeclaredCommand<PageCommand>>(
      command, figure_properties().with({"surface.patches", "surface.min_patch", "Light", "Lines", "-look.material",
                                         "-look.ambient_occlusion_rays", "-look.ambient_occlusion_radius",
                                         "-frames.only", "-camera.path", "-camera.turntable", "-camera.follow",
                                         "image.background", "annotations.labels", "annotations.lengths"}));
  PropertyOptions(command).add("camera.named_views", declared->state.named_views);
  declared->options.describe_output("HTML file to write");
  declared->options.show_anyway("legend.shown");
  command.callback([declared, &command] {
    declared->options.take();
    const bool trusts_scenes = command.count("--trust-scene") > 0;
    run_and_save_scene(declared->state, [&] { export_page(declared->state, trusts_scenes); });
  });
}

const ExportCommand kPage("page",
                          "Write one HTML file in which readers turn the exact surface, in any browser with WebGL 2",
                          declare_page);

}  // namespace
}  // namespace meniscus
