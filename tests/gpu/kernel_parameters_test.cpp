// SPDX-License-Identifier: BSD-3-Clause
// The parameters of kernels are where the driver looks for them, all of them are set, and there are no others.
#include <cstddef>
#include <map>
#include <set>
#include <string>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/shader_source.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "tests/gpu/kernel_variants.h"

namespace meniscus {
namespace {

/// Offsets of members by the names "Struct.member".
using Places = std::map<std::string, std::size_t>;

#define AT(type, member) \
  { #type "." #member, offsetof(kernel::type, member) }

const Places& places_in_cpp() {
  static const Places kPlaces{
      AT(ScanParameters, count),
      AT(ScanParameters, chunk_length),
      AT(ScanParameters, limit),
      AT(CellGrid, low),
      AT(CellGrid, size),
      AT(GridParameters, atom_count),
      AT(NeighborParameters, first_entry),
      AT(NeighborParameters, entry_count),
      AT(NeighborParameters, largest_radius),
      AT(NeighborParameters, capacity),
      AT(PairParameters, first_entry),
      AT(PairParameters, entry_count),
      AT(CircleParameters, doubt),
      AT(CircleParameters, first_entry),
      AT(CircleParameters, entry_count),
      AT(CircleParameters, circle_count),
      AT(CircleParameters, list_limit),
      AT(CircleParameters, arc_capacity),
      AT(CircleParameters, doubtful_capacity),
      AT(FixedProbeParameters, middle),
      AT(FixedProbeParameters, probe_radius),
      AT(FixedProbeParameters, arc_count),
      AT(FixedProbeParameters, probe_capacity),
      AT(CutParameters, first_probe),
      AT(CutParameters, probe_count),
      AT(CutParameters, probe_radius),
      AT(CuspParameters, first_probe),
      AT(CuspParameters, circle_count),
      AT(CuspParameters, arc_capacity),
      AT(CuspParameters, doubtful_capacity),
      AT(PrimitiveParameters, pivot),
      AT(PrimitiveParameters, eye_distance),
      AT(PrimitiveParameters, camera_position),
      AT(PrimitiveParameters, probe_radius),
      AT(PrimitiveParameters, camera_forward),
      AT(PrimitiveParameters, slack),
      AT(PrimitiveParameters, orthographic),
      AT(PrimitiveParameters, primitive_capacity),
      AT(PrimitiveParameters, row_capacity),
      AT(ArcParameters, arc_count),
      AT(ConcaveParameters, first_probe),
      AT(ConcaveParameters, probe_count),
      AT(ConvexParameters, middle),
      AT(ConvexParameters, first_entry),
      AT(ConvexParameters, entry_count),
      AT(ConvexParameters, atom_count),
      AT(View, eye),
      AT(View, pixel_scale),
      AT(View, right),
      AT(View, margin),
      AT(View, up),
      AT(View, orthographic),
      AT(View, forward),
      AT(View, block_edge),
      AT(View, picture_size),
      AT(View, keep_all),
      AT(VisibleAtomsParameters, atom_count),
      AT(VisibleAtomsParameters, probe_radius),
      AT(DrawParameters, count),
      AT(DrawParameters, probe_radius),
      AT(DrawParameters, pass),
      AT(FaceTableParameters, table_size),
      AT(FaceTableParameters, count),
      AT(FaceParameters, probe_count),
      AT(BlockView, right),
      AT(BlockView, eye_distance),
      AT(BlockView, up),
      AT(BlockView, pixel_size),
      AT(BlockView, forward),
      AT(BlockView, orthographic),
      AT(BlockView, first_offset),
      AT(BlockView, sample_offset),
      AT(BlockView, size),
      AT(DepthSlices, first_depth),
      AT(DepthSlices, slices_per_angstrom),
      AT(TileListParameters, right),
      AT(TileListParameters, eye_distance),
      AT(TileListParameters, up),
      AT(TileListParameters, pixels_per_angstrom),
      AT(TileListParameters, forward),
      AT(TileListParameters, orthographic),
      AT(TileListParameters, block_center),
      AT(TileListParameters, tiles),
      AT(TileListParameters, first_tile),
      AT(TileListParameters, picture_tile_columns),
      AT(TileListParameters, bounded),
      AT(TileListParameters, primitive_count),
      AT(TileListParameters, entry_capacity),
      AT(SplitTilesParameters, tile_count),
      AT(EmptyTilesParameters, size),
      AT(EmptyTilesParameters, tiles),
      AT(RayCastParameters, key_direction),
      AT(RayCastParameters, key_strength),
      AT(RayCastParameters, key_color),
      AT(RayCastParameters, key_share),
      AT(RayCastParameters, fill_direction),
      AT(RayCastParameters, fill_share),
      AT(RayCastParameters, fill_color),
      AT(RayCastParameters, sky),
      AT(RayCastParameters, ambient),
      AT(RayCastParameters, ground),
      AT(RayCastParameters, roughness),
      AT(RayCastParameters, tiles),
      AT(RayCastParameters, probe_radius),
      AT(RayCastParameters, slack),
      AT(RayCastParameters, specular),
      AT(RayCastParameters, shininess),
      AT(RayCastParameters, add),
      AT(RayCastParameters, color_by_kind),
      AT(RayCastParameters, atom_count),
      AT(RayCastParameters, part_length),
      AT(RayCastParameters, part),
      AT(RayCastParameters, is_last_part),
      AT(DepthParameters, has_marks),
      AT(LightMapParameters, rows[0]),
      AT(LightMapParameters, sky_texel),
      AT(LightMapParameters, lamp_texel),
      AT(LightMapParameters, sky_edge),
      AT(LightMapParameters, lamp_edge),
      AT(LightMapParameters, sky_axes),
      AT(LightMapParameters, lamp_places),
      AT(LightMapParameters, first_lamp_texel),
      AT(FinishParameters, key_direction),
      AT(FinishParameters, key_strength),
      AT(FinishParameters, key_color),
      AT(FinishParameters, key_share),
      AT(FinishParameters, fill_direction),
      AT(FinishParameters, fill_share),
      AT(FinishParameters, fill_color),
      AT(FinishParameters, ambient),
      AT(FinishParameters, sky),
      AT(FinishParameters, roughness),
      AT(FinishParameters, ground),
      AT(FinishParameters, shadow),
      AT(FinishParameters, air),
      AT(FinishParameters, keeps_alpha),
      AT(FinishParameters, patch_line_color),
      AT(FinishParameters, patch_lines),
      AT(FinishParameters, specular),
      AT(FinishParameters, shininess),
      AT(FinishParameters, ambient_occlusion),
      AT(FinishParameters, outer_lines),
      AT(FinishParameters, inner_lines),
      AT(FinishParameters, part_lines),
      AT(FinishParameters, widest_line),
      AT(FinishParameters, step_pixels),
      AT(FinishParameters, fade_pixels),
      AT(FinishParameters, depth_cue),
      AT(FinishParameters, first_depth),
      AT(FinishParameters, last_depth),
      AT(FinishParameters, sample_index),
      AT(FinishParameters, has_marks),
      AT(PresentParameters, background),
      AT(PresentParameters, per_sample),
      AT(PresentParameters, size),
      AT(ScaleParameters, count),
      AT(ScaleParameters, offset),
      AT(LoopParameters, outer),
      AT(LoopParameters, inner),
      AT(QueryParameters, count),
  };
  return kPlaces;
}

#undef AT

GLuint linked(const ShaderSource& source) {
  const char* text = source.text.c_str();
  const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
  GLint ok = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &ok);
  EXPECT_TRUE(ok) << source.files.front();
  return program;
}

/// The struct in each block of a kernel, by the block's name: "uniform ViewBlock { View view; }" is a View.
std::map<std::string, std::string> structs_of_blocks(const std::string& text) {
  std::map<std::string, std::string> structs;
  for (std::size_t at = text.find(") uniform "); at != std::string::npos; at = text.find(") uniform ", at + 1)) {
    const std::size_t name = at + 10, brace = text.find(" { ", name), line_end = text.find('\n', name);
    if (brace < line_end)
      structs[text.substr(name, brace - name)] = text.substr(brace + 3, text.find(' ', brace + 3) - brace - 3);
  }
  return structs;
}

/// What the driver says of a uniform: "" for those outside of blocks.
std::string place_of(GLuint program, GLuint index, const std::map<std::string, std::string>& structs,
                     std::size_t& offset) {
  constexpr GLenum kAsked[] = {GL_BLOCK_INDEX, GL_OFFSET};
  GLint found[2] = {};
  glGetProgramResourceiv(program, GL_UNIFORM, index, 2, kAsked, 2, nullptr, found);
  if (found[0] < 0) return "";
  char block[64], name[64];
  glGetProgramResourceName(program, GL_UNIFORM_BLOCK, static_cast<GLuint>(found[0]), sizeof block, nullptr, block);
  glGetProgramResourceName(program, GL_UNIFORM, index, sizeof name, nullptr, name);
  offset = static_cast<std::size_t>(found[1]);
  const std::string member = name;
  return structs.at(block) + member.substr(member.rfind('.'));
}

bool is_opaque(GLuint program, GLuint index) {
  constexpr GLenum kType = GL_TYPE;
  GLint type = 0;
  glGetProgramResourceiv(program, GL_UNIFORM, index, 1, &kType, 1, nullptr, &type);
  return type == GL_UNSIGNED_INT_SAMPLER_BUFFER || type == GL_IMAGE_2D || type == GL_UNSIGNED_INT_ATOMIC_COUNTER;
}

TEST(KernelParameters, StandWhereTheDriverLooks) {
  const EglContext context;
  std::set<std::string> seen;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (!shader.path.ends_with(".comp")) continue;
    for (const ShaderDefines& defines : variants_of(shader)) {
      const ShaderSource source = expand_embedded_shader(shader.path, defines);
      const GLuint program = linked(source);
      GLint count = 0;
      glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
      for (GLuint index = 0; index < static_cast<GLuint>(count); ++index) {
        if (is_opaque(program, index)) continue;  // NVIDIA's driver says that atomic counters are in some block
        std::size_t offset = 0;
        const std::string place = place_of(program, index, structs_of_blocks(source.text), offset);
        if (place.empty()) {
          ADD_FAILURE() << shader.path << " has a number outside of its blocks";
          continue;
        }
        const auto expected = places_in_cpp().find(place);
        ASSERT_NE(expected, places_in_cpp().end()) << place << " is not in the table of this test";
        EXPECT_EQ(offset, expected->second) << place << " in " << shader.path;
        seen.insert(place);
      }
      glDeleteProgram(program);
    }
  }
  for (const auto& [place, offset] : places_in_cpp()) EXPECT_TRUE(seen.contains(place)) << place << " is in no kernel";
}

struct RecordPlace {
  const char* kernel;
  const char* member;  // as the driver names it
  std::size_t offset;
  std::size_t size;  // of the record
};

TEST(KernelRecords, StandWhereTheDriverLooks) {
  using kernel::CuspArcRecord, kernel::ProbeRecord, kernel::SideRecord;
  constexpr std::size_t kBeforeArcs = 16;
  constexpr const char *kCusps = "gpu_shaders/singularities/cusps.comp",
                       *kProbes = "gpu_shaders/reduced_surface/fixed_probes.comp";
  const RecordPlace places[] = {
      {"gpu_shaders/singularities/cuts.comp", "sides[0].contact", offsetof(SideRecord, contact), sizeof(SideRecord)},
      {kCusps, "sides[0].gap_direction", offsetof(SideRecord, gap_direction), sizeof(SideRecord)},
      {kCusps, "sides[0].circle_center", offsetof(SideRecord, circle_center), sizeof(SideRecord)},
      {kCusps, "sides[0].circle", offsetof(SideRecord, circle), sizeof(SideRecord)},
      {kCusps, "sides[0].partner", offsetof(SideRecord, partner), sizeof(SideRecord)},
      {kCusps, "sides[0].touching", offsetof(SideRecord, touching), sizeof(SideRecord)},
      {kCusps, "arcs[0].names", kBeforeArcs + offsetof(CuspArcRecord, names), sizeof(CuspArcRecord)},
      {kCusps, "arcs[0].begin", kBeforeArcs + offsetof(CuspArcRecord, begin), sizeof(CuspArcRecord)},
      {kCusps, "arcs[0].end", kBeforeArcs + offsetof(CuspArcRecord, end), sizeof(CuspArcRecord)},
      {kProbes, "probes[0].position", offsetof(ProbeRecord, position), sizeof(ProbeRecord)},
      {kProbes, "probes[0].height", offsetof(ProbeRecord, height), sizeof(ProbeRecord)},
      {kProbes, "probes[0].atoms", offsetof(ProbeRecord, atoms), sizeof(ProbeRecord)},
      {kProbes, "probes[0].key", offsetof(ProbeRecord, key), sizeof(ProbeRecord)},
  };
  const EglContext context;
  for (const RecordPlace& place : places) {
    const GLuint program = linked(expand_embedded_shader(place.kernel));
    const GLuint index = glGetProgramResourceIndex(program, GL_BUFFER_VARIABLE, place.member);
    ASSERT_NE(index, GL_INVALID_INDEX) << place.member << " in " << place.kernel;
    constexpr GLenum kAsked[] = {GL_OFFSET, GL_TOP_LEVEL_ARRAY_STRIDE};
    GLint found[2] = {};
    glGetProgramResourceiv(program, GL_BUFFER_VARIABLE, index, 2, kAsked, 2, nullptr, found);
    EXPECT_EQ(static_cast<std::size_t>(found[0]), place.offset) << place.member;
    EXPECT_EQ(static_cast<std::size_t>(found[1]), place.size) << place.member;
    glDeleteProgram(program);
  }
}

TEST(KernelParameters, AreNeitherForgottenNorMistaken) {
  const EglContext context;
  const Program program("gpu_shaders/test_support/scale.comp");
  Buffer words(4 * sizeof(std::uint32_t)), surplus(sizeof(std::uint32_t));
  words.bind(0);
  surplus.fill(0);
  surplus.bind(1);
  EXPECT_THROW(program.dispatch(1), GpuError) << "never set";
  EXPECT_THROW(program.set(kernel::ScaleParameters{4, 1}, 3), GpuError) << "no such binding";
  EXPECT_THROW(program.set(kernel::CellGrid{}), GpuError) << "too large";
  const Program larger("gpu_shaders/ray_cast/tile_lists.comp", ShaderDefines{{"PASS", "0"}});
  EXPECT_THROW(larger.set(kernel::ScaleParameters{4, 1}), GpuError) << "too small";
  EXPECT_THROW(program.dispatch(1), GpuError) << "still not set";
  program.set(kernel::ScaleParameters{.count = 4, .offset = 1});
  program.dispatch(1);
  EXPECT_EQ(words.download<std::uint32_t>(4), (std::vector<std::uint32_t>{1, 2, 3, 4}));
  program.set(kernel::ScaleParameters{.count = 2, .offset = 7});
  program.dispatch(1);
  EXPECT_EQ(words.download<std::uint32_t>(4), (std::vector<std::uint32_t>{7, 8, 3, 4}));
}

}  // namespace
}  // namespace meniscus
