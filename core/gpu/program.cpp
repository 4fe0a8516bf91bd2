// SPDX-License-Identifier: BSD-3-Clause
// Compiles, caches and starts compute kernels, and names their stages for the clock and for GL debuggers.
#include "core/gpu/program.h"

#include <cstring>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/gpu/context_description.h"
#include "core/gpu/egl_context.h"

namespace meniscus {
namespace {

/// Returns the log of a shader or a program, by the functions of GL for its kind.
template <typename GetNumber, typename GetLog>
std::string log_of(GLuint object, GetNumber get_number, GetLog get_log) {
  GLint length = 0;
  get_number(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  get_log(object, length, nullptr, log.data());
  return log.substr(0, log.find('\0'));
}

/// Rounds up to whole rows of 16 bytes. Uniform blocks consist of such rows; some drivers count the last row as whole.
std::size_t in_vectors(std::size_t byte_count) { return (byte_count + 15) / 16 * 16; }

/// Returns the name of a kernel with its defines.
std::string form_of(std::string_view path, const ShaderDefines& defines) {
  std::string name(path);
  for (const auto& [word, value] : defines) name += fmt::format(" {}={}", word, value);
  return name;
}

}  // namespace

Program::Program(std::string_view path, const ShaderDefines& defines) : path_(path), name_(glCreateProgram()) {
  const KernelFiles* const files = KernelFiles::current();
  const ShaderSource source = expand_embedded_shader(path, defines);
  if (!files || !files->load(name_, form_of(path, defines), source.text)) {
    if (files) glProgramParameteri(name_, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    compile(source);
    if (files) files->save(name_, form_of(path, defines), source.text);
  }
  find_blocks();
}

Program::Program(std::string_view path, const ShaderSource& source) : path_(path), name_(glCreateProgram()) {
  compile(source);
  find_blocks();
}

// Deletes its GL objects if it throws, because the destructor does not run then.
void Program::compile(const ShaderSource& source) {
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* text = source.text.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) {
    const std::string log = translate_shader_log(log_of(shader, glGetShaderiv, glGetShaderInfoLog), source.files);
    glDeleteShader(shader);
    glDeleteProgram(name_);
    throw GpuError("{} does not compile:\n{}", path_, log);
  }
  glAttachShader(name_, shader);
  glLinkProgram(name_);
  glDeleteShader(shader);
  glGetProgramiv(name_, GL_LINK_STATUS, &ok);
  if (!ok) {
    const std::string log = translate_shader_log(log_of(name_, glGetProgramiv, glGetProgramInfoLog), source.files);
    glDeleteProgram(name_);
    throw GpuError("{} does not link:\n{}", path_, log);
  }
}

Program::~Program() {
  for (const Block& block : blocks_) glDeleteBuffers(1, &block.buffer);
  glDeleteProgram(name_);
}

void Program::find_blocks() {
  GLint count = 0;
  glGetProgramInterfaceiv(name_, GL_UNIFORM_BLOCK, GL_ACTIVE_RESOURCES, &count);
  for (GLuint n = 0; n < static_cast<GLuint>(count); ++n) {
    constexpr GLenum kQueried[] = {GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
    GLint found[2] = {};
    glGetProgramResourceiv(name_, GL_UNIFORM_BLOCK, n, 2, kQueried, 2, nullptr, found);
    blocks_.push_back({static_cast<std::uint32_t>(found[0]), 0, std::vector<std::byte>(in_vectors(found[1]))});
  }
}

void Program::set_block(int binding, const void* bytes, std::size_t byte_count) const {
  const auto block =
      std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) { return int(b.binding) == binding; });
  if (block == blocks_.end()) throw GpuError("{} has no parameters at binding {}", path_, binding);
  std::vector<std::byte>& content = block->content;
  if (in_vectors(byte_count) != content.size())
    throw GpuError("{}: {} bytes of parameters at binding {} are given, {} wanted", path_, in_vectors(byte_count),
                   binding, content.size());
  if (block->buffer && std::memcmp(content.data(), bytes, byte_count) == 0) return;
  std::memcpy(content.data(), bytes, byte_count);
  const auto size = static_cast<GLsizeiptr>(content.size());
  if (block->buffer) {
    glNamedBufferSubData(block->buffer, 0, size, content.data());
  } else {
    glCreateBuffers(1, &block->buffer);
    glNamedBufferStorage(block->buffer, size, content.data(), GL_DYNAMIC_STORAGE_BIT);
  }
  check_gl("setting the parameters of a kernel");
}

void Program::dispatch(std::size_t group_count, std::uint32_t longest_row) const {
  if (group_count == 0) return;
  GLint limit = 0;
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &limit);
  const std::size_t row = longest_row ? longest_row : static_cast<std::size_t>(limit);
  // The rectangle closest to the count has as many rows as needed, all of one width.
  const std::size_t height = (group_count + row - 1) / row;
  const std::size_t width = (group_count + height - 1) / height;
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &limit);
  if (height > static_cast<std::size_t>(limit))
    throw CapacityError("{}: {} groups are more than this GPU can start", path_, group_count);
  dispatch_2d(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
}

void Program::dispatch_2d(std::uint32_t x, std::uint32_t y) const {
  start();
  glDispatchCompute(x, y, 1);
  finish();
  WorkProof::current().started(x * y);
}

void Program::dispatch_indirect(const Buffer& counts, std::size_t byte_offset) const {
  start();
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, counts.gl_name());
  // This comes first, because it may read the counts to make room, which must not find unregistered groups.
  WorkProof::current().started_indirect(counts.gl_name(), byte_offset);
  glDispatchComputeIndirect(static_cast<GLintptr>(byte_offset));
  finish();
}

void Program::start() const {
  for (const Block& block : blocks_) {
    if (!block.buffer) throw GpuError("{}: the parameters at binding {} are not set", path_, block.binding);
    glBindBufferBase(GL_UNIFORM_BUFFER, block.binding, block.buffer);
  }
  glUseProgram(name_);
}

void Program::finish() const {
  try {
    check_gl(("starting " + path_).c_str());
  } catch (const Error&) {
    WorkProof::current().resync();
    throw;
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

const Program& ProgramCache::get(const std::string& path, const ShaderDefines& defines) {
  auto& program = programs_[{path, defines}];
  if (!program) program = std::make_unique<Program>(path, defines);
  return *program;
}

GpuStage::GpuStage(StageClock& clock, const std::string& name) : waits_(clock.is_exact()) {
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
  if (waits_) glFinish();
  stage_.emplace(clock, name);
}

GpuStage::~GpuStage() {
  if (waits_) glFinish();
  stage_.reset();
  glPopDebugGroup();
}

}  // namespace meniscus
