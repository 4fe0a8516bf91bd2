// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export page`: writes one HTML file in which readers turn the exact surface.
#include <iostream>
#include <system_error>

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/camera/camera.h"
#include "core/image/color_space.h"
#include "core/image/png_file.h"
#include "core/image/print_file.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/scene/annotations.h"
#include "core/scene/cut.h"
#include "core/scene/figure.h"
#include "core/scene/molecule.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_values.h"
#include "exporters/page/page_file.h"
#include "exporters/page/scene_page.h"

namespace meniscus {
namespace {

/// The views of --named-view NAME=FILE. FILE is a camera, as for --camera, or a scene, which provides its camera, its
/// cuts and the opacity of all atoms.
class NamedViews {
 public:
  /// Reads the files and protects them from being replaced by outputs. trusts_scenes: scenes may name any files. Throws
  /// UsageError, and the errors of reading.
  NamedViews(const std::vector<std::string>& texts, const SceneCommand& page, bool trusts_scenes);

  /// Finds the cameras. Throws like FigureRun::camera_for(), with the name of the view.
  void aim(FigureRun& run);
  /// Returns the views of a figure; call aim() first. Throws the errors of cut_atoms(), with the name of the view.
  std::vector<page::PageView> of(const Scene& page, const Figure& figure) const;

 private:
  struct View {
    std::string name;
    Scene scene;                   ///< the view's scene, with the size of the page
    std::optional<Camera> camera;  ///< the camera of a file, until the view is aimed
  };
  std::vector<View> views_;
};

/// Returns true for a picture, or for a text that is a scene.
bool is_scene(const std::string& file) {
  std::error_code unreadable;
  if (file.starts_with('{') || !std::filesystem::is_regular_file(path_of_text(file), unreadable)) return false;
  return is_png(file) || read_scene_text(file).find("\"meniscus_scene\"") != std::string::npos;
}

/// Returns the opacity of all atoms; 1 if some differ.
float opacity_of(const Scene& scene) {
  const std::vector<OpacityRule>& rules = scene.molecule.color.opacities;
  return rules.size() == 1 && !rules.front().atoms ? rules.front().opacity : 1.0f;
}

/// Adds the name of the view to errors.
template <typename Work>
void named(const std::string& name, const Work& work) {
  try {
    work();
  } catch (const RequestError& error) {
    throw RequestError("--named-view {}: {}", in_quotes(name), error.what());
  }
}

NamedViews::NamedViews(const std::vector<std::string>& texts, const SceneCommand& page, bool trusts_scenes) {
  const auto refuse = [](const std::string& text, const std::string& why) {
    throw UsageError("--named-view {}: {}", in_quotes(text), why);
  };
  for (const std::string& text : texts) {
    const std::size_t sign = std::min(text.find('='), text.size());
    const std::string file = text.substr(std::min(sign + 1, text.size()));
    View view{text.substr(0, sign), {}, {}};
    if (view.name.empty() || file.empty()) refuse(text, "write NAME=FILE, such as 'Active site=site.json'");
    if (std::ranges::any_of(views_, [&](const View& other) { return other.name == view.name; }))
      refuse(text, "another view has this name; choose another one");
    if (is_scene(file)) {
      std::vector<std::string> words{page.scene.molecule.file};
      if (trusts_scenes) words.push_back("--trust-scene");
      view.scene = prepared_scene(read_scene_file(file, std::move(words), page.reporting).scene);
    } else {
      view.scene.picture.camera_file = file;
    }
    view.scene.picture.width = page.scene.picture.width;
    view.scene.picture.height = page.scene.picture.height;
    view.camera = given_camera(view.scene.picture);
    if (view.scene.figure.cuts.size() > page::kMostPlanes)
      refuse(text, fmt::format("a page shows at most {} planes, but this scene has {}", page::kMostPlanes,
                               view.scene.figure.cuts.size()));
    views_.push_back(std::move(view));
  }
}

void NamedViews::aim(FigureRun& run) {
  for (View& view : views_) named(view.name, [&] { view.camera = run.camera_for(view.scene.picture, view.camera); });
}

std::vector<page::PageView> NamedViews::of(const Scene& page, const Figure& figure) const {
  std::vector<page::PageView> shown;
  for (const View& view : views_) {
    page::PageView& made = shown.emplace_back(page::PageView{view.name, view.camera.value()});
    if (page.figure.hides_surface) continue;
    const FigureRequest& requested = view.scene.figure;
    named(view.name, [&] {
      made.clip = surface_planes(requested, cut_atoms(requested.cuts, figure.molecule.structure), made.camera,
                                 figure.molecule.objects);
    });
    made.opacity = opacity_of(view.scene);
    made.looks_inside = uses_atoms(requested.cuts);
  }
  return shown;
}

constexpr double kManyBytes = 15e6;
constexpr std::size_t kMostBytes = 250'000'000;  // a browser's text has at most 2^29 letters

struct PageCommand : SceneCommand {
  std::vector<std::string> named_views;
};

/// Returns a picture as JPEG, on its background.
page::StillPicture still_picture(const Framebuffer& drawn, const Look& look) {
  constexpr std::size_t kChannels = 4;
  std::vector<std::uint8_t> pixels(kChannels * drawn.color.size());
  display_bytes(drawn.color, look.background, kChannels, pixels.data());
  return {"image/jpeg", encode_jpeg(pixels, drawn.size.x, drawn.size.y, JpegUse::page)};
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
        "the page would have about {} bytes, and browsers open no more than {}; {}show fewer "
        "atoms (--show, --select)",
        with_thousands(bytes), with_thousands(kMostBytes), fewer);
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
      "The page fetches nothing, and casts the exact patches by WebGL 2 in the browser that opens it. Other browsers\n"
      "show a still picture. Frames of a run are all in the page, each with its own patches.");
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
