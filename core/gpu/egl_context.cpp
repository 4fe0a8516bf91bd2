// SPDX-License-Identifier: BSD-3-Clause
// Opens a context by EGL, and keeps the kernels that its driver has compiled in files. Builds without epoxy have no
// contexts.
#include "core/gpu/egl_context.h"

#include "core/base/error.h"

#ifdef MENISCUS_WITH_GL

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace meniscus {
namespace {

thread_local KernelFiles* current_files = nullptr;

/// Computes the 64-bit hash FNV-1a of Fowler, Noll and Vo. It finds names and damage; texts are compared as a whole.
std::uint64_t hash(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return h;
}

std::string gl_words() {
  std::string words;
  for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION}) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    words += fmt::format("{}\n", text ? text : "");
  }
  return words;
}

template <typename Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

/// Returns the file's head before the binary: the driver and the text that it was compiled from.
std::string head_of(const std::string& driver, std::string_view text) {
  return fmt::format("meniscus kernel 1\n{}{}\n{}", driver, text.size(), text);
}

std::optional<std::string> read_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

KernelFiles::KernelFiles(std::filesystem::path folder) : folder_(std::move(folder)), driver_(gl_words()) {
  GLint formats = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
  offered_ = formats > 0;
  current_files = this;
}

KernelFiles::~KernelFiles() {
  if (current_files == this) current_files = nullptr;
}

KernelFiles* KernelFiles::current() { return current_files; }

void KernelFiles::make_current(KernelFiles* files) { current_files = files; }

std::filesystem::path KernelFiles::path_of(const std::string& name) const {
  return folder_ / fmt::format("{:016x}.kernel", hash(driver_ + name));
}

bool KernelFiles::load(std::uint32_t program, const std::string& name, std::string_view text) const {
  if (!offered_) return false;
  const std::optional<std::string> content = read_whole(path_of(name));
  const std::string head = head_of(driver_, text);
  GLenum format = 0;
  std::uint64_t sum = 0;
  if (!content || content->size() < head.size() + sizeof format + sizeof sum || !content->starts_with(head))
    return false;
  const std::string_view all_but_sum = std::string_view(*content).substr(0, content->size() - sizeof sum);
  std::memcpy(&sum, all_but_sum.data() + all_but_sum.size(), sizeof sum);
  if (sum != hash(all_but_sum)) return false;
  std::memcpy(&format, content->data() + head.size(), sizeof format);
  const std::string_view binary = all_but_sum.substr(head.size() + sizeof format);
  glProgramBinary(program, format, binary.data(), static_cast<GLsizei>(binary.size()));
  const bool taken = glGetError() == GL_NO_ERROR;
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  return taken && linked == GL_TRUE;
}

void KernelFiles::save(std::uint32_t program, const std::string& name, std::string_view text) const {
  GLint length = 0;
  if (offered_) glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0) return;
  std::string binary(static_cast<std::size_t>(length), '\0');
  GLenum format = 0;
  GLsizei written = 0;
  glGetProgramBinary(program, length, &written, &format, binary.data());
  if (glGetError() != GL_NO_ERROR || written <= 0) return;
  binary.resize(static_cast<std::size_t>(written));
  std::string content = head_of(driver_, text) + bytes_of(format) + binary;
  content += bytes_of(hash(content));

  static std::atomic<unsigned> count = 0;
  const std::filesystem::path path = path_of(name);
  const std::filesystem::path temporary =
      folder_ / fmt::format(".{}.{}.{}", path.filename().string(), getpid(), count++);
  std::error_code ignored, failed;
  std::filesystem::create_directories(folder_, ignored);
  {
    std::ofstream file(temporary, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    if (!file.flush()) failed = std::make_error_code(std::errc::io_error);
  }
  // The file is not synced, because the checksum finds damage by a crash of the machine.
  if (!failed) std::filesystem::rename(temporary, path, failed);
  if (failed) std::filesystem::remove(temporary, ignored);
}

namespace {

std::vector<EGLDeviceEXT> query_devices() {
  if (!epoxy_has_egl()) throw GpuError("EGL was not found; install libegl1 and a GL driver (Debian: libgl1-mesa-dri)");
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!can_list_devices(extensions ? extensions : ""))
    throw GpuError(
        "this EGL cannot list devices (EGL_EXT_device_base or EGL_EXT_platform_device is missing); a newer GL "
        "driver is needed");
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count)) throw GpuError("EGL cannot list devices");
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (count > 0 && !eglQueryDevicesEXT(count, devices.data(), &count)) throw GpuError("EGL cannot list devices");
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

// A constant of EGL_EXT_device_persistent_id, which Debian's headers do not have yet.
constexpr EGLint kDeviceUuid = 0x335C;  // EGL_DEVICE_UUID_EXT
using QueryDeviceBinary = EGLBoolean (*)(EGLDeviceEXT device, EGLint name, EGLint max_size, void* value, EGLint* size);

/// Returns the UUID as CUDA and nvidia-smi write it; empty if the device has none.
std::string uuid_of(EGLDeviceEXT device) {
  const auto query = reinterpret_cast<QueryDeviceBinary>(eglGetProcAddress("eglQueryDeviceBinaryEXT"));
  std::array<unsigned char, 16> bytes{};
  EGLint size = 0;
  if (!query || !query(device, kDeviceUuid, static_cast<EGLint>(bytes.size()), bytes.data(), &size) || size != 16)
    return {};
  std::string text = "GPU";
  for (std::size_t n = 0; n < bytes.size(); ++n)
    text += fmt::format("{}{:02x}", n == 0 || n == 4 || n == 6 || n == 8 || n == 10 ? "-" : "", bytes[n]);
  return text;
}

/// Returns the PCI address of a file such as /dev/dri/card0; empty if there is none.
std::string pci_of(const std::string& drm_file) {
  std::error_code none;
  const auto name = std::filesystem::path(drm_file).filename();
  return std::filesystem::read_symlink("/sys/class/drm" / name / "device", none).filename().string();
}

GlDevice describe(EGLDeviceEXT device, int egl_index) {
  const char* words = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  const std::string extensions = words ? words : "";
  const auto has = [&](const char* extension) { return extensions.find(extension) != std::string::npos; };
  GlDevice result;
  result.egl_index = egl_index;
  result.software = has("EGL_MESA_device_software");
  result.name = extensions;
  if (has("EGL_EXT_device_drm"))
    if (const char* file = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT)) {
      result.name = file;
      result.pci = pci_of(file);
    }
  EGLAttrib cuda = 0;
  if (has("EGL_NV_device_cuda") && eglQueryDeviceAttribEXT(device, EGL_CUDA_DEVICE_NV, &cuda))
    result.cuda_index = static_cast<int>(cuda);
  if (has("EGL_EXT_device_persistent_id")) result.uuid = uuid_of(device);
  return result;
}

/// Creates a GL 4.5 core context; returns EGL_NO_CONTEXT on failure.
EGLContext create_context(EGLDisplay display, EGLConfig config, bool reports_resets) {
  std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       4,
                                 EGL_CONTEXT_MINOR_VERSION,       5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
  if (reports_resets)
    attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE,
                                         EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  attributes.push_back(EGL_NONE);
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

std::string visibility_note(const DeviceChoice& choice) {
  return choice.cuda_visible ? fmt::format(" among those that CUDA_VISIBLE_DEVICES='{}' leaves", *choice.cuda_visible)
                             : "";
}

}  // namespace

std::vector<GlDevice> list_gl_devices() {
  std::vector<GlDevice> result;
  for (const EGLDeviceEXT device : query_devices()) result.push_back(describe(device, static_cast<int>(result.size())));
  return result;
}

EglContext::EglContext(const DeviceChoice& choice) {
  const std::vector<GlDevice> devices = list_gl_devices();
  const std::vector<DeviceAttempt> attempts = device_attempts(choice, devices);
  if (attempts.empty())
    throw GpuError("no {} for '{}': EGL lists {} device(s), none of that kind{}",
                   choice.kind == DeviceChoice::Kind::gpu ? "hardware GPU" : "device", to_string(choice),
                   devices.size(), visibility_note(choice));
  std::string reasons;
  for (const DeviceAttempt& attempt : attempts) {
    std::string why_not;
    if (try_device(attempt, choice.kernel_folder, why_not)) return;
    reasons += fmt::format("{}device {} ({}): {}", reasons.empty() ? "" : "; ", attempt.device.egl_index,
                           attempt.device.name, why_not);
  }
  throw GpuError("no usable GL 4.5 device for '{}': {}", to_string(choice), reasons);
}

bool EglContext::try_device(const DeviceAttempt& attempt, const std::string& kernel_folder, std::string& why_not) {
  const GlDevice& device = attempt.device;
  const auto devices = query_devices();
  if (static_cast<std::size_t>(device.egl_index) >= devices.size()) return why_not = "it disappeared", false;
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[device.egl_index], nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    return why_not = fmt::format("EGL cannot open it (error 0x{:x})", eglGetError()), false;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context"))
    return why_not = "no EGL_KHR_surfaceless_context", false;
  if (!eglBindAPI(EGL_OPENGL_API)) return why_not = "no desktop OpenGL", false;
  const std::array<EGLint, 3> config_attributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint config_count = 0;
  // A context without a surface takes any config with OpenGL, or none if EGL_KHR_no_config_context is offered.
  if (!eglChooseConfig(display, config_attributes.data(), &config, 1, &config_count) || config_count == 0)
    config = nullptr;
  // If the driver notifies of resets, work that a reset destroyed is known to be lost.
  EGLContext context = create_context(display, config, true);
  if (context == EGL_NO_CONTEXT) context = create_context(display, config, false);
  if (context == EGL_NO_CONTEXT)
    return why_not = fmt::format("no GL 4.5 core (EGL error 0x{:x})", eglGetError()), false;
  if (!adopt_context(display, context, kernel_folder, why_not)) {
    eglDestroyContext(display, context);
    return false;
  }
  description_.software |= device.software;
  if (!attempt.hardware_only || !description_.software) return true;
  why_not = fmt::format("its renderer is software: {}", description_.renderer);
  abandon();
  return false;
}

bool EglContext::adopt_context(void* display, void* context, const std::string& kernel_folder, std::string& why_not) {
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    return why_not = fmt::format("its context cannot be made current (EGL error 0x{:x})", eglGetError()), false;
  display_ = display;
  context_ = context;
  description_ = describe_current_context();
  proof_.emplace();
  kernel_files_.reset();
  KernelFiles::make_current(nullptr);
  if (!kernel_folder.empty()) kernel_files_.emplace(kernel_folder);
  return true;
}

EglContext::~EglContext() { abandon(); }

void EglContext::abandon() {
  proof_.reset();
  kernel_files_.reset();
  // The display stays initialised: EGL gives all contexts of a device the same one, and terminating it would end them.
  if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  context_ = nullptr;
}

void EglContext::make_current() {
  // The bound API is per thread, and its default is OpenGL ES.
  if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    throw GpuError("the GL context cannot be made current (EGL error 0x{:x})", eglGetError());
  proof_->make_current();
  KernelFiles::make_current(kernel_files_ ? &*kernel_files_ : nullptr);
}

}  // namespace meniscus

#else

namespace meniscus {

WorkProof::~WorkProof() = default;
KernelFiles::~KernelFiles() = default;

EglContext::EglContext(const DeviceChoice&) {
  throw GpuError(
      "this build was made without epoxy and has no GL; choose the CPU, or build Meniscus from source, with epoxy");
}
EglContext::~EglContext() = default;

}  // namespace meniscus

#endif
