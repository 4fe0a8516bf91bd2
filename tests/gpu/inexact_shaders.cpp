// SPDX-License-Identifier: BSD-3-Clause
// Adds inexact functions with GLSL's names behind the #version line of every kernel.
#include "tests/gpu/inexact_shaders.h"

#include <string>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace meniscus::testing {
namespace {

unsigned single_off = 0, double_off = 0;

constexpr const char* kFunctions = R"glsl(
uint scattered(uint h) { h ^= h >> 16; h *= 0x85ebca6bu; h ^= h >> 13; h *= 0xc2b2ae35u; return h ^ (h >> 16); }
float off(float x) {
  uint bits = floatBitsToUint(x);
  if ((bits & 0x7fffffffu) < 0x01000000u || (bits & 0x7f800000u) == 0x7f800000u) return x;
  return uintBitsToFloat(bits + scattered(bits) % (2u * SINGLE_OFF + 1u) - SINGLE_OFF);
}
double off(double x) {
  if (x == 0.0LF || isinf(x) || isnan(x)) return x;
  uvec2 bits = unpackDouble2x32(x);
  uint step = scattered(bits.x ^ bits.y) % (2u * DOUBLE_OFF + 1u);
  uint carry;
  uint borrow;
  bits = uvec2(uaddCarry(bits.x, step, carry), bits.y + carry);
  bits = uvec2(usubBorrow(bits.x, DOUBLE_OFF, borrow), bits.y - borrow);
  return packDouble2x32(bits);
}
float inexact_sqrt(float x) { return off(sqrt(x)); }
double inexact_sqrt(double x) { return off(sqrt(x)); }
float inexact_dot(vec2 a, vec2 b) { return off(fma(a.x, b.x, a.y * b.y)); }
double inexact_dot(dvec2 a, dvec2 b) { return off(fma(a.x, b.x, a.y * b.y)); }
float inexact_dot(vec3 a, vec3 b) { return off(fma(a.x, b.x, fma(a.y, b.y, a.z * b.z))); }
double inexact_dot(dvec3 a, dvec3 b) { return off(fma(a.x, b.x, fma(a.y, b.y, a.z * b.z))); }
vec3 inexact_cross(vec3 a, vec3 b) {
  return vec3(off(fma(a.y, b.z, -(a.z * b.y))), off(fma(a.z, b.x, -(a.x * b.z))), off(fma(a.x, b.y, -(a.y * b.x))));
}
dvec3 inexact_cross(dvec3 a, dvec3 b) {
  return dvec3(off(fma(a.y, b.z, -(a.z * b.y))), off(fma(a.z, b.x, -(a.x * b.z))), off(fma(a.x, b.y, -(a.y * b.x))));
}
float inexact_length(vec2 a) { return inexact_sqrt(inexact_dot(a, a)); }
float inexact_length(vec3 a) { return inexact_sqrt(inexact_dot(a, a)); }
double inexact_length(dvec3 a) { return inexact_sqrt(inexact_dot(a, a)); }
vec3 inexact_normalize(vec3 a) { return a / inexact_length(a); }
dvec3 inexact_normalize(dvec3 a) { return a / inexact_length(a); }
#define sqrt inexact_sqrt
#define dot inexact_dot
#define cross inexact_cross
#define length inexact_length
#define normalize inexact_normalize
)glsl";

void shader_source(GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths) {
  static const auto driver = reinterpret_cast<decltype(epoxy_glShaderSource)>(eglGetProcAddress("glShaderSource"));
  std::string text = strings[0];
  const auto version = text.find("#version");
  if (count != 1 || (single_off == 0 && double_off == 0) || version == text.npos)
    return driver(shader, count, strings, lengths);
  text.insert(text.find('\n', version) + 1, "#define SINGLE_OFF " + std::to_string(single_off) +
                                                "u\n#define DOUBLE_OFF " + std::to_string(double_off) + "u\n" +
                                                kFunctions);
  const GLchar* const rewritten = text.c_str();
  driver(shader, 1, &rewritten, nullptr);
}

}  // namespace

void compile_inexactly(unsigned single_units, unsigned double_units) {
  single_off = single_units;
  double_off = double_units;
  epoxy_glShaderSource = shader_source;
}

void compile_exactly() { compile_inexactly(0, 0); }

}  // namespace meniscus::testing
