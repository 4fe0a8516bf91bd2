// SPDX-License-Identifier: BSD-3-Clause
// Checks what goes into a scene, gathers its colours in one order, and writes its folder; and writes the shared files
// of a run, the geometry of its frames, and the scene that makes a film of the rendered pictures.
#include "exporters/povray/povray_scene.h"

#include <iterator>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "core/color/color_key_json.h"

namespace meniscus::povray {

std::vector<MaterialRequest> materials_of(std::span<const SceneObject> objects) {
  std::vector<MaterialRequest> materials;
  for (const SceneObject& object : objects)
    if (!object.material.empty()) materials.push_back(object.material);
  return materials;
}

SceneContent::SceneContent(const Shown& shown, const Camera& camera, const SceneOptions& options,
                           const glm::dvec3& origin, ColorTable& table)
    : shown_(shown),
      origin_(origin),
      table_(table),
      cut_(shown.surface, shown_.cut, camera, options),
      geometry_(cut_.objects(), origin, table, {shown.film.value_or(options.film), 0}, shown_.cut.planes, shown.names) {
  if (has_shapes()) add_colors(*shown.shapes, table);
  if (cut_.has_caps()) geometry_.add_caps(cut_.caps(), cut_.objects(), shown_.cut, table);
  for (const SceneObject& object : shown.objects) add(object, camera, options);
}

void SceneContent::add(const SceneObject& object, const Camera& camera, const SceneOptions& options) {
  Further& further = further_.emplace_back();
  further.object = &object;
  further.style.film = object.film;
  if (!object.material.empty()) further.style.finish = ++finishes_;
  if (object.shapes) add_colors(*object.shapes, table_, further.style);
  if (!object.surface) return;
  further.cut.emplace(std::span(object.surface, 1), object.cut, camera, options);
  further.geometry.emplace(further.cut->objects(), origin_, table_, further.style, object.cut.planes, shown_.names);
  if (further.cut->has_caps())
    further.geometry->add_caps(further.cut->caps(), further.cut->objects(), object.cut, table_);
}

const VolumePaint* SceneContent::map() const {
  for (const SurfaceObject& object : cut_.objects())
    if (object.coloring.volume) return object.coloring.volume.get();
  for (const SceneObject& object : shown_.objects)
    if (object.surface && object.surface->coloring.volume) return object.surface->coloring.volume.get();
  return nullptr;
}

std::vector<ObjectPart> SceneContent::parts() const {
  std::vector<ObjectPart> parts;
  for (const Further& further : further_)
    parts.push_back({further.object->surface != nullptr,
                     further.geometry && further.geometry->is_one_item() && !further.cut->has_caps()});
  return parts;
}

std::size_t SceneContent::primitive_count() const {
  std::size_t count = geometry_.primitive_count();
  for (const Further& further : further_)
    if (further.geometry) count += further.geometry->primitive_count();
  return count;
}

void SceneContent::write(const SceneParts& parts, const BeginFile& begin_file, std::string_view head) const {
  if (parts.surface) geometry_.write(begin_file("geometry"), head);
  if (parts.caps) geometry_.write_caps(begin_file("caps"), shown_.cut);
  if (parts.shapes) write_shapes(begin_file("shapes"), *shown_.shapes, origin_, table_);
  std::size_t number = 0;
  for (const Further& further : further_) {
    OutputFile& file = begin_file(fmt::format("object_{}", ++number));
    if (further.object->shapes) write_shapes(file, *further.object->shapes, origin_, table_, further.style);
    if (!further.geometry) continue;
    further.geometry->write(file);
    if (further.cut->has_caps()) further.geometry->write_caps(file, further.object->cut);
  }
}

namespace {

void include_shapes(const ColoredShapes& shapes, Box& extent) {
  for (const Ball& ball : balls_around(shapes.shapes)) {
    extent.include(ball.center - ball.radius);
    extent.include(ball.center + ball.radius);
  }
}

/// Returns the box of everything that the scene shows.
Box scene_extent(std::span<const SurfaceObject> objects, const SceneOptions& options) {
  Box extent = atom_extent(objects);
  if (options.shapes) include_shapes(*options.shapes, extent);
  for (const SceneObject& object : options.objects) {
    if (object.surface) {
      const Box box = atom_extent({object.surface, 1});
      extent.include(box.low);
      extent.include(box.high);
    }
    if (object.shapes) include_shapes(*object.shapes, extent);
  }
  return extent;
}

}  // namespace

SceneReport write_scene(std::span<const SurfaceObject> given, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder) {
  check(given, options);
  const Box extent = scene_extent(given, options);
  const glm::dvec3 origin = options.origin ? *options.origin : middle(given.empty() ? extent : atom_extent(given));
  ColorTable table;
  const Shown shown{given, options.cut, options.shapes, options.objects, options.atom_names};
  const SceneContent content(shown, camera, options, origin, table);
  const Geometry& geometry = content.geometry();
  const bool has_surface = geometry.primitive_count() > 0;
  const SceneParts parts{has_surface,          geometry.is_one_item(), has_surface && content.has_caps(),
                         content.has_shapes(), table.is_translucent(), content.parts()};
  if (content.primitive_count() == 0 && !content.has_shapes() && options.objects.empty())
    throw RequestError("no part of the surface is shown, so there is no scene to write");

  OutputFolder output(folder, options.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(folder / (options.name + ending));
    return output.file(options.name + ending);
  };
  content.write(parts,
                [&](const std::string& part) -> OutputFile& { return begin_file(fmt::format("_{}.inc", part)); });
  const SceneStyle style{&table.colors(), content.map(), materials_of(options.objects)};
  if (style.map) {
    OutputFile& file = begin_file(std::string(kMapFileEnding));
    write_density(style.map->grid, [&](std::string_view bytes) { file.write(bytes); });
  }
  const std::string buffers = buffer_text(&table.colors(), options, extent, origin);
  const std::string styles = style_text(style, options, origin);
  const std::string main = main_text({&camera, 1}, options, origin, parts);
  begin_file("_aov.inc").write(buffers);
  begin_file("_style.inc").write(styles);
  begin_file(".pov").write(main);
  begin_file(".inc").write(own_scene_text(options.name, std::array<std::string_view, 3>{main, styles, buffers}));
  begin_file(".ini").write(ini_text(options));
  begin_file("_objects.json").write(geometry.names_json(options.colors));
  output.commit();

  report.object_count = content.primitive_count();
  report.origin = origin;
  report.notes = notes(content.objects(), geometry, camera);
  report.command = fmt::format("cd {} && povray {}.ini", shell_word(folder.string()), options.name);
  return report;
}

namespace {

/// Returns the text of <name>_story.pov, which shows the pictures that <name>.ini rendered.
std::string story_text(const SceneOptions& options, const Story& story) {
  const std::vector<StoryPicture>& film = story.pictures;
  SceneText out;
  out.literal("// The film: each of its pictures is one of those that ").literal(options.name);
  out.literal(".ini renders, or two of them blended in linear light.\n#version 3.7;\n");
  const auto list = [&](std::string_view name, const auto& append) {
    out.literal("#declare ").literal(name).literal(" = array[").count(film.size()).literal("] {");
    for (std::size_t n = 0; n < film.size(); ++n) append(out.literal(n == 0 ? "" : n % 16 == 0 ? ",\n" : ","), film[n]);
    out.literal("};\n");
  };
  out.literal("// Numbers of pictures, 0 where there is none; and the share of the second.\n");
  list("Meniscus_First", [](SceneText& text, const StoryPicture& picture) { text.count(picture.first); });
  list("Meniscus_Second", [](SceneText& text, const StoryPicture& picture) { text.count(picture.second); });
  list("Meniscus_Share", [](SceneText& text, const StoryPicture& picture) { text.ratio(picture.share); });
  out.literal(filled(template_text(povray_templates(), "story.pov"), {{"NAME", options.name}}));
  return out.text();
}

/// Returns the text of <name>_story.ini.
std::string story_ini_text(const SceneOptions& options, const Story& film) {
  return filled(template_text(povray_templates(), "story.ini"), {{"NAME", options.name},
                                                                 {"WIDTH", std::to_string(options.width)},
                                                                 {"HEIGHT", std::to_string(options.height)},
                                                                 {"COUNT", std::to_string(film.pictures.size())},
                                                                 {"RATE", fmt::format("{:g}", film.rate)}});
}

void check(const Run& run) {
  if (run.frames.empty()) throw Error("POV-Ray export: a run has at least one frame");
  if (run.cameras.size() != 1 && run.cameras.size() != run.frames.size())
    throw Error("POV-Ray export: a run has one camera, or one for each frame");
}

std::uint32_t palette_number(const std::vector<SceneColor>& colors, const glm::dvec3& origin) {
  SceneText text;
  text.full_vector(origin);
  for (const SceneColor& color : colors) {
    text.full_vector(glm::dvec3(color.color));
    if (color.opacity < 1.0f) text.full(color.opacity);
    if (color.by_map) text.literal(" by map");
    if (color.film) text.literal(" film");
  }
  const std::string& bytes = text.text();
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

// Returns a check of the palette for an include file. Geometry depends on the colours, which it refers to by number,
// and on the origin of coordinates.
std::string palette_check(std::uint32_t palette) {
  SceneText out;
  out.literal("#ifdef (Meniscus_Palette) #if (Meniscus_Palette != ").count(palette);
  out.literal(
      ")\n  #error \"This geometry was written with other colours or another origin than the scene: export its ");
  out.literal("frame again.\\n\"\n#end #end\n");
  return out.text();
}

// Returns one frame's file of colours, with checks that it belongs to the run, and the geometry to the frame.
SceneText frame_colors_text(const std::vector<SceneColor>& colors, const SceneOptions& options, std::uint32_t of_run,
                            std::uint32_t of_frame) {
  SceneText out;
  out.literal("// The colours of one frame.\n").literal(palette_check(of_run));
  out.literal("#declare Meniscus_Palette = ").count(of_frame).literal(";\n");
  out.literal(colors_text(colors, options.colors));
  return out;
}

std::string objects_text(const Run& run, const std::optional<ColorKey>& colors) {
  nlohmann::ordered_json json{{"frames", run.frames}};
  if (colors) json["colors"] = color_key_json(*colors);
  return json.dump(1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

SequenceScene::SequenceScene(Run run, SceneOptions options, std::filesystem::path folder)
    : SequenceScene(Film{}, std::move(run), std::move(options), std::move(folder)) {
  check(run_);
}

SequenceScene::SequenceScene(Film, Run run, SceneOptions options, std::filesystem::path folder)
    : run_(std::move(run)), options_(std::move(options)), folder_(std::move(folder)) {
  check({}, options_);
  origin_ = options_.origin ? *options_.origin : middle(run_.extent);
  palette_ = palette_number(run_.colors.value_or(std::vector<SceneColor>{}), origin_);
}

std::size_t SequenceScene::add_frame(const Camera& camera, const FrameLook& look) {
  run_.cameras.push_back(camera);
  run_.looks.push_back(look);
  run_.frames.push_back(run_.frames.size() + 1);
  return run_.frames.size() - 1;
}

SceneParts SequenceScene::parts() const {
  return {run_.surface, false, run_.caps, run_.shapes, run_.translucent, run_.objects};
}

SceneReport SequenceScene::write_shared(const Story* film) const {
  const SceneFrames frames{run_.frames, palette_, run_.looks};
  const std::string& name = options_.name;
  const std::vector<SceneColor>* const colors = run_.colors ? &*run_.colors : nullptr;
  std::vector<SharedFile> files;
  if (run_.map) {
    files.push_back({name + std::string(kMapFileEnding), {}});
    std::string& values = files.back().text;
    write_density(run_.map->grid, [&](std::string_view bytes) { values += bytes; });
  }
  const std::string buffers = buffer_text(colors, options_, run_.extent, origin_);
  const std::string style = style_text({colors, run_.map.get(), run_.materials}, options_, origin_);
  const std::string main = main_text(run_.cameras, options_, origin_, parts(), &frames);
  const SharedFile texts[] = {
      {name + "_aov.inc", buffers},
      {name + "_style.inc", style},
      {name + "_objects.json", objects_text(run_, options_.colors)},
      {name + ".pov", main},
      {name + ".inc", own_scene_text(name, std::array<std::string_view, 3>{main, style, buffers}, run_.maps_change)},
      {name + ".ini", ini_text(options_, run_.frames)}};
  files.insert(files.end(), std::begin(texts), std::end(texts));
  if (film) {
    files.push_back({name + "_story.pov", story_text(options_, *film)});
    files.push_back({name + "_story.ini", story_ini_text(options_, *film)});
  }
  write_shared_files(folder_, options_.existing, files);
  SceneReport report;
  for (const SharedFile& file : files) report.files.push_back(folder_ / file.name);
  report.origin = origin_;
  report.command = fmt::format("cd {} && {}", shell_word(folder_.string()), render_command(options_, run_.frames));
  if (film) report.command += fmt::format(" && povray {}_story.ini", name);
  return report;
}

SceneReport SequenceScene::write_frame(std::size_t place, const Shown& shown) const {
  check(shown.surface, options_);
  const Camera& camera = run_.cameras[run_.cameras.size() == 1 ? 0 : place];
  ColorTable table;
  if (run_.colors)
    for (const SceneColor& color : *run_.colors) table.number(color);
  const SceneContent content(shown, camera, options_, origin_, table);
  if (run_.colors && table.colors().size() > run_.colors->size())
    throw Error("frame {} has a colour that the run does not have", run_.frames[place]);
  OutputFolder output(folder_, options_.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& what, const char* ending = ".inc") -> OutputFile& {
    const std::string name = fmt::format("{}_{}_{:05}{}", options_.name, what, run_.frames[place], ending);
    report.files.push_back(folder_ / name);
    return output.file(name);
  };
  const Geometry& geometry = content.geometry();
  if (geometry.declares_objects()) begin_file("objects", ".json").write(geometry.names_json({}));
  const std::uint32_t palette = run_.colors ? palette_ : palette_number(table.colors(), origin_);
  if (!run_.colors) {
    SceneText colors = frame_colors_text(table.colors(), options_, palette_, palette);
    if (const VolumePaint* const map = run_.maps_change ? content.map() : nullptr) {
      OutputFile& file = begin_file("map", ".df3");
      write_density(map->grid, [&](std::string_view bytes) { file.write(bytes); });
      append_map(colors, *map, report.files.back().filename().string(), origin_);
    }
    begin_file("colors").write(colors.text());
  }
  content.write(parts(), begin_file, palette_check(palette));
  output.commit();
  report.object_count = content.primitive_count();
  report.origin = origin_;
  report.notes = notes(content.objects(), geometry, camera);
  return report;
}

}  // namespace meniscus::povray
