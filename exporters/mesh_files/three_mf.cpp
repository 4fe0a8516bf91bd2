// SPDX-License-Identifier: BSD-3-Clause
// Writes 3MF files: an XML model in a zip archive.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/base/version.h"
#include "exporters/mesh_files/writers.h"
#include "exporters/mesh_files/zip_archive.h"

namespace meniscus {
namespace {

using Color = std::array<std::uint8_t, 3>;

constexpr std::string_view kContentTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";
constexpr std::string_view kRelationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";
constexpr int kColorGroup = 1, kFirstObject = 2;

std::vector<Color> palette_of(const MeshFile& mesh) {
  std::vector<Color> palette;
  for (const FileObject& object : mesh.objects)
    palette.insert(palette.end(), object.colors.begin(), object.colors.end());
  std::ranges::sort(palette);
  palette.erase(std::unique(palette.begin(), palette.end()), palette.end());
  return palette;
}

/// Returns the XML of an object. 3MF requires triangles that face outwards, so the triangles of an object that consists
/// of cavities only are reversed: it represents the body that would fill them.
std::string object_text(const FileObject& object, int id, const std::vector<Color>& palette) {
  std::vector<std::uint32_t> color;
  color.reserve(object.colors.size());
  for (const Color& c : object.colors)
    color.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(palette, c) - palette.begin()));
  std::string text = text_of_rows(
      fmt::format("  <object id=\"{}\" name=\"{}\" type=\"model\" pid=\"{}\" pindex=\"0\">\n   <mesh>\n    "
                  "<vertices>\n",
                  id, xml_text(object.name), kColorGroup),
      object.positions.size(), [&](std::size_t v, auto out) {
        const glm::vec3& x = object.positions[v];
        fmt::format_to(out, FMT_COMPILE("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n"), x.x, x.y, x.z);
      });
  text = text_of_rows(
      std::move(text) + "    </vertices>\n    <triangles>\n", object.triangles.size(), [&](std::size_t t, auto out) {
        auto [a, b, c] = object.triangles[t];
        if (object.is_cavity) std::swap(b, c);
        fmt::format_to(out,
                       FMT_COMPILE("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\" pid=\"{}\" p1=\"{}\" p2=\"{}\" "
                                   "p3=\"{}\"/>\n"),
                       a, b, c, kColorGroup, color[a], color[b], color[c]);
      });
  return text + "    </triangles>\n   </mesh>\n  </object>\n";
}

/// Returns the attribute of a placement. The rows of its matrix are the images of the axes and of the origin.
std::string transform_text(const RigidMotion& place) {
  const auto& [x, y, z] = std::array{place.rotation[0], place.rotation[1], place.rotation[2]};
  const glm::dvec3& to = place.translation;
  return fmt::format(" transform=\"{} {} {} {} {} {} {} {} {} {} {} {}\"", x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z,
                     to.x, to.y, to.z);
}

std::string model_text(const MeshFile& mesh) {
  const std::vector<Color> palette = palette_of(mesh);
  std::string text = text_of_rows(
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
                  "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
                  "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n"
                  " <metadata name=\"Application\">Meniscus {}</metadata>\n"
                  " <metadata name=\"Description\">{}</metadata>\n <resources>\n  <m:colorgroup id=\"{}\">\n",
                  MENISCUS_VERSION, xml_text(mesh.about), kColorGroup),
      palette.size(), [&](std::size_t n, auto out) {
        const auto& [red, green, blue] = palette[n];
        fmt::format_to(out, FMT_COMPILE("<m:color color=\"#{:02X}{:02X}{:02X}\"/>\n"), red, green, blue);
      });
  text += "  </m:colorgroup>\n";
  int id = kFirstObject;
  for (const FileObject& object : mesh.objects) text += object_text(object, id++, palette);
  text += " </resources>\n <build>\n";
  id = kFirstObject;
  for (const FileObject& object : mesh.objects) {
    for (const RigidMotion& place : object.places)
      text += fmt::format("  <item objectid=\"{}\"{}/>\n", id, object.is_placed_once() ? "" : transform_text(place));
    ++id;
  }
  return text + " </build>\n</model>\n";
}

}  // namespace

void write_3mf(OutputFile& file, const MeshFile& mesh) {
  ZipArchive archive;
  archive.add_deflated("[Content_Types].xml", kContentTypes);
  archive.add_deflated("_rels/.rels", kRelationships);
  archive.add_deflated("3D/3dmodel.model", model_text(mesh));
  file.write(archive.finish());
}

}  // namespace meniscus
