// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export page`: writes one HTML file in which readers turn the exact surface.
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/figure_run.h"
#include "app/commands/page_views.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/image/color_space.h"
#include "core/image/image_codec.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "exporters/page/page_file.h"
#include "exporters/page/scene_page.h"

namespace meniscus {
namespace {

constexpr double kManyBytes = 15e6;

struct PageCommand : SceneCommand {
  std::vector<std::string> named_views;
};

/// A picture as JPEG, on its background. Throws Error where there is no OpenImageIO.
page::StillPicture jpeg_still(const Framebuffer& drawn, const Look& look) {
  std::vector<float> pixels;
  pixels.reserve(3 * drawn.color.size());
  for (const glm::vec4& pixel : drawn.color) {
    const glm::vec4 color = display_color(pixel, look.background);
    for (const float channel : {color.x, color.y, color.z}) pixels.push_back(channel);
  }
  ImageToEncode image;
  image.format = "jpeg";
  image.compression = "jpeg:80";
  image.color_space = "sRGB";
  image.width = drawn.size.x;
  image.height = drawn.size.y;
  image.channels = {"R", "G", "B"};
  const std::unique_ptr<RowEncoder> encoder = image_codec().begin(image);
  encoder->add(pixels);
  return {"image/jpeg", encoder->finish()};
}

/// What the scene file says and the page does not show, in a sentence. Throws UsageError for frames.
void tell_left_out(const SceneCommand& command, std::span<const std::string> keys) {
  std::string names;
  for (const std::string& key : keys) {
    if (key.starts_with("frames."))
      throw UsageError(
          fmt::format("{}: a page shows one molecule, not a run of frames; leave it out of the scene", key));
    const bool is_seen = key.starts_with("annotations.") || key.starts_with("look.") || key.starts_with("camera.") ||
                         (key.starts_with("legend.") && key != "legend.shown");
    if (is_seen) names += (names.empty() ? "" : ", ") + key;
  }
  if (!names.empty()) say(command, "note: the page does not show what the scene says of " + names);
}

page::StillPicture still_picture(const Framebuffer& drawn, const Look& look) {
  try {
    return jpeg_still(drawn, look);
  } catch (const Error&) {
    return page::png_still(drawn, look);
  }
}

void write_page(const SceneCommand& command, const NamedViews& views, FigureFrame frame) {
  const Scene& scene = command.scene;
  std::vector<page::PageView> aimed = views.aimed(scene, frame.figure);
  const std::string text =
      page::scene_page(scene, std::move(frame.figure), frame.camera, std::move(aimed), still_picture);
  OutputFile file(scene.output, command.existing());
  file.write(text);
  file.commit();
  say(command, fmt::format("{} bytes", with_thousands(text.size())));
  if (static_cast<double>(text.size()) > kManyBytes)
    say(command, "warning: readers load all of it; --show or --select make a smaller page");
}

void export_page(const PageCommand& asked, std::span<const std::string> left_out, bool trusts_scenes) {
  page::check_scene(asked.scene);
  tell_left_out(asked, left_out);
  check_output(asked.scene.output, asked.existing());
  check_saved_camera(asked);
  const NamedViews views(asked.named_views, asked, trusts_scenes);
  FigureRun run(asked);
  run.aim(asked.scene.picture, false);
  const SceneCommand& command = run.command();
  run.make({kSurfaceBytesPerAtom}, [&]() -> FigureRun::Sink {
    return [&](FigureFrame frame) -> FinishFrame {
      write_page(command, views, std::move(frame));
      return [] { return MadeFrame{}; };
    };
  });
  save_camera(command, run.camera(0));
  std::cout << escaped(command.scene.output) << "\n";
}

}  // namespace

void add_export_page(CLI::App& command) {
  describe(
      command,
      "  meniscus export page 1tii.pdb -o 1tii.html              then open it in a browser\n"
      "  meniscus export page 1tii.pdb -o 1tii.html --color chain --sticks ligand\n"
      "  meniscus export page --scene fig.json -o fig.html\n"
      "  meniscus export page 1tii.pdb -o 1tii.html --named-view 'Active site=site.json' --named-view Back=back.png",
      "The page fetches nothing, and casts the exact patches by WebGL 2 in the browser that opens it. Others "
      "see\na still picture that is in it.");
  auto declared = std::make_shared<DeclaredCommand<PageCommand>>(command, for_page);
  PropertyOptions(command).add("camera.named_views", declared->state.named_views);
  declared->options.describe_output("HTML file to write");
  command.callback([declared, &command] {
    declared->options.take();
    const bool trusts_scenes = command.count("--trust-scene") > 0;
    run_and_save_scene(declared->state,
                       [&] { export_page(declared->state, declared->options.left_out(), trusts_scenes); });
  });
}

}  // namespace meniscus
