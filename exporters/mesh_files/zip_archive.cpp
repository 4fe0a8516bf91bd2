// SPDX-License-Identifier: BSD-3-Clause
// Makes zip archives, and the two mesh formats that are zip archives: 3MF and USDZ.
#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

#ifdef MENISCUS_WITH_DEFLATE

#include <limits>
#include <new>

#include <fmt/compile.h>
#include <libdeflate.h>

#include "core/base/version.h"

namespace meniscus {
namespace {

constexpr std::uint16_t kZipVersion = 20;            // 2.0: folders and deflate
constexpr std::uint16_t kStored = 0, kDeflated = 8;  // method
constexpr std::uint16_t kTime = 0, kDate = 33;       // 1980-01-01 00:00
constexpr std::size_t kLocalHeader = 30, kExtraHeader = 4, kUsdAlignment = 64;
constexpr std::uint16_t kPadding = 0x1986;  // identifier of the extra field in archives that OpenUSD writes
constexpr int kLevel = 6;

struct CompressorDeleter {
  void operator()(libdeflate_compressor* compressor) const { ::libdeflate_free_compressor(compressor); }
};

void require_small(std::size_t size, const std::string& name) {
  if (size < std::numeric_limits<std::uint32_t>::max()) return;
  throw CapacityError("{} would have {} bytes, and zip has room for 4 GiB; ask for a coarser mesh", name, size);
}

std::uint32_t checksum_of(std::string_view content) { return ::libdeflate_crc32(0, content.data(), content.size()); }

}  // namespace

void ZipArchive::add_deflated(const std::string& name, std::string_view content) {
  require_small(content.size(), name);
  const std::unique_ptr<libdeflate_compressor, CompressorDeleter> compressor(::libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> packed(::libdeflate_deflate_compress_bound(compressor.get(), content.size()));
  packed.resize(
      ::libdeflate_deflate_compress(compressor.get(), content.data(), content.size(), packed.data(), packed.size()));
  add({name, kDeflated, checksum_of(content), static_cast<std::uint32_t>(packed.size()),
       static_cast<std::uint32_t>(content.size())},
      packed.data(), 1);
}

void ZipArchive::add_stored(const std::string& name, std::string_view content) {
  require_small(content.size(), name);
  const auto size = static_cast<std::uint32_t>(content.size());
  add({name, kStored, checksum_of(content), size, size}, content.data(), kUsdAlignment);
}

void ZipArchive::add(Entry entry, const void* content, std::size_t alignment) {
  require_small(bytes_.size() + entry.packed, "the archive");
  entry.place = static_cast<std::uint32_t>(bytes_.size());
  const std::size_t start = bytes_.size() + kLocalHeader + entry.name.size();
  const bool pads = start % alignment != 0;
  // Padding is an extra field, which begins with a header of its own.
  const std::size_t padding = (alignment - (start + kExtraHeader) % alignment) % alignment;
  BinaryRows header;
  header.put(std::uint32_t{0x04034b50});
  for (const std::uint16_t word : {kZipVersion, std::uint16_t{0}, entry.method, kTime, kDate}) header.put(word);
  for (const std::uint32_t word : {entry.checksum, entry.packed, entry.size}) header.put(word);
  header.put(static_cast<std::uint16_t>(entry.name.size()));
  header.put(static_cast<std::uint16_t>(pads ? kExtraHeader + padding : 0));
  header.put_text(entry.name);
  if (pads) {
    header.put(kPadding);
    header.put(static_cast<std::uint16_t>(padding));
    header.put_text(std::string(padding, '\0'));
  }
  const std::span<const std::byte> body(static_cast<const std::byte*>(content), entry.packed);
  bytes_.insert(bytes_.end(), header.bytes().begin(), header.bytes().end());
  bytes_.insert(bytes_.end(), body.begin(), body.end());
  entries_.push_back(std::move(entry));
}

std::vector<std::byte> ZipArchive::finish() {
  BinaryRows directory;
  for (const Entry& entry : entries_) {
    directory.put(std::uint32_t{0x02014b50});
    for (const std::uint16_t word : {kZipVersion, kZipVersion, std::uint16_t{0}, entry.method, kTime, kDate})
      directory.put(word);
    for (const std::uint32_t word : {entry.checksum, entry.packed, entry.size}) directory.put(word);
    directory.put(static_cast<std::uint16_t>(entry.name.size()));
    for (int n = 0; n < 4; ++n) directory.put(std::uint16_t{0});  // extra field, comment, disk, internal attributes
    directory.put(std::uint32_t{0});                              // external attributes
    directory.put(entry.place);
    directory.put_text(entry.name);
  }
  const auto count = static_cast<std::uint16_t>(entries_.size());
  BinaryRows end;
  end.put(std::uint32_t{0x06054b50});
  for (const std::uint16_t word : {std::uint16_t{0}, std::uint16_t{0}, count, count}) end.put(word);
  end.put(static_cast<std::uint32_t>(directory.size()));
  end.put(static_cast<std::uint32_t>(bytes_.size()));
  end.put(std::uint16_t{0});
  bytes_.insert(bytes_.end(), directory.bytes().begin(), directory.bytes().end());
  bytes_.insert(bytes_.end(), end.bytes().begin(), end.bytes().end());
  return std::move(bytes_);
}

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

void write_archive(OutputFile& file, std::span<const MeshFile> frames, const RunTimes* times) {
  ZipArchive archive;
  archive.add_stored("molecule.usda", usd_text(frames, times));
  file.write(archive.finish());
}

}  // namespace

void write_3mf(OutputFile& file, const MeshFile& mesh) {
  ZipArchive archive;
  archive.add_deflated("[Content_Types].xml", kContentTypes);
  archive.add_deflated("_rels/.rels", kRelationships);
  archive.add_deflated("3D/3dmodel.model", model_text(mesh));
  file.write(archive.finish());
}

void write_usdz(OutputFile& file, const MeshFile& mesh) { write_archive(file, {&mesh, 1}, nullptr); }

void write_usdz_run(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times) {
  write_archive(file, frames, &times);
}

}  // namespace meniscus

#else

namespace meniscus {

namespace {

[[noreturn]] void refuse(std::string_view format) {
  throw RequestError("this build writes no {} files: it was made without libdeflate; choose another format", format);
}

}  // namespace

void write_3mf(OutputFile&, const MeshFile&) { refuse("3MF"); }
void write_usdz(OutputFile&, const MeshFile&) { refuse("USDZ"); }
void write_usdz_run(OutputFile&, std::span<const MeshFile>, const RunTimes&) { refuse("USDZ"); }

}  // namespace meniscus

#endif
