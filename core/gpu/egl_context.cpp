// SPDX-License-Identifier: BSD-3-Clause
// EGL device enumeration and context creation, as NVIDIA and Mesa both document it for machines without a display.
#include "core/gpu/egl_context.h"

#include <algorithm>
#include <array>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

std::vector<EGLDeviceEXT> query_devices() {
  if (!epoxy_has_egl()) throw GpuError("EGL was not found; install libegl1 and a GL driver (Debian: libgl1-mesa-dri)");
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device"))
    throw GpuError("this EGL cannot list devices (EGL_EXT_platform_device is missing); a newer GL driver is needed");
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count)) throw GpuError("EGL refused to list devices");
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (count > 0 && !eglQueryDevicesEXT(count, devices.data(), &count)) throw GpuError("EGL refused to list devices");
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

GlDevice describe(EGLDeviceEXT device, int egl_index) {
  const char* words = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  const std::string extensions = words ? words : "";
  GlDevice result;
  result.egl_index = egl_index;
  result.software = extensions.find("EGL_MESA_device_software") != std::string::npos;
  result.name = extensions;
  if (extensions.find("EGL_EXT_device_drm") != std::string::npos)
    if (const char* file = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT)) result.name = file;
  return result;
}

constexpr std::array<EGLint, 7> kCoreProfile{
    EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};

EGLConfig config_of(EGLDisplay display, EGLContext context) {
  EGLint id = 0;
  eglQueryContext(display, context, EGL_CONFIG_ID, &id);
  const std::array<EGLint, 3> same{EGL_CONFIG_ID, id, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  return eglChooseConfig(display, same.data(), &config, 1, &count) && count == 1 ? config : nullptr;
}

/// The devices that fit the wish, best first.
std::vector<GlDevice> candidates(const DeviceChoice& choice) {
  std::vector<GlDevice> devices = list_gl_devices();
  if (choice.kind == DeviceChoice::Kind::software)
    std::erase_if(devices, [](const GlDevice& d) { return !d.software; });
  else if (choice.kind == DeviceChoice::Kind::gpu)
    std::erase_if(devices, [&](const GlDevice& d) { return d.gpu_index != choice.index; });
  else
    std::ranges::stable_partition(devices, [](const GlDevice& d) { return !d.software; });
  return devices;
}

}  // namespace

std::vector<GlDevice> list_gl_devices() {
  std::vector<GlDevice> result;
  int gpu_count = 0;
  for (const EGLDeviceEXT device : query_devices()) {
    result.push_back(describe(device, static_cast<int>(result.size())));
    if (!result.back().software) result.back().gpu_index = gpu_count++;
  }
  return result;
}

std::optional<ForeignContext> current_egl_context() {
  if (!epoxy_has_egl() || eglGetCurrentContext() == EGL_NO_CONTEXT) return {};
  GLint strategy = GL_NO_RESET_NOTIFICATION;
  glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
  return ForeignContext{eglGetCurrentDisplay(), eglGetCurrentContext(), strategy == GL_LOSE_CONTEXT_ON_RESET};
}

EglContext::EglContext(const DeviceChoice& choice) {
  const std::vector<GlDevice> devices = candidates(choice);
  if (devices.empty())
    throw GpuError(fmt::format("no {} for '{}': EGL lists {} device(s), none of that kind",
                               choice.kind == DeviceChoice::Kind::gpu ? "hardware GPU" : "device", to_string(choice),
                               list_gl_devices().size()));
  std::string reasons;
  for (const GlDevice& device : devices) {
    std::string why_not;
    if (try_device(device, why_not)) return;
    reasons += fmt::format("{}device {} ({}): {}", reasons.empty() ? "" : "; ", device.egl_index, device.name, why_not);
  }
  throw GpuError(fmt::format("no usable GL 4.5 device for '{}': {}", to_string(choice), reasons));
}

bool EglContext::try_device(const GlDevice& device, std::string& why_not) {
  const auto devices = query_devices();
  if (static_cast<std::size_t>(device.egl_index) >= devices.size()) return why_not = "it went away", false;
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[device.egl_index], nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    return why_not = fmt::format("EGL cannot open it (error 0x{:x})", eglGetError()), false;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context"))
    return why_not = "no EGL_KHR_surfaceless_context", false;
  if (!eglBindAPI(EGL_OPENGL_API)) return why_not = "no desktop OpenGL", false;
  EGLContext context = EGL_NO_CONTEXT;
  const std::array<EGLint, 3> config_wish{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint config_count = 0;
  // Surfaceless: any config with OpenGL does, and none is needed where EGL_KHR_no_config_context is offered.
  if (!eglChooseConfig(display, config_wish.data(), &config, 1, &config_count) || config_count == 0) config = nullptr;
  context = eglCreateContext(display, config, EGL_NO_CONTEXT, kCoreProfile.data());
  if (context == EGL_NO_CONTEXT)
    return why_not = fmt::format("no GL 4.5 core (EGL error 0x{:x})", eglGetError()), false;
  if (!adopt_context(display, context, why_not)) {
    eglDestroyContext(display, context);
    return false;
  }
  description_.software |= device.software;
  return true;
}

bool EglContext::adopt_context(void* display, void* context, std::string& why_not) {
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    return why_not = fmt::format("its context cannot be made current (EGL error 0x{:x})", eglGetError()), false;
  display_ = display;
  context_ = context;
  description_ = describe_current_context();
  return true;
}

EglContext::EglContext(const ForeignContext& sibling) {
  if (!epoxy_has_egl_extension(sibling.display, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API))
    throw GpuError("this display cannot draw beside its windows (EGL_KHR_surfaceless_context is missing)");
  std::vector<EGLint> wish(kCoreProfile.begin(), kCoreProfile.end() - 1);
  if (sibling.tells_resets)  // contexts that share agree about this
    wish.insert(wish.end(), {EGL_CONTEXT_OPENGL_ROBUST_ACCESS, EGL_TRUE, EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                             EGL_LOSE_CONTEXT_ON_RESET});
  wish.push_back(EGL_NONE);
  const EGLContext context =
      eglCreateContext(sibling.display, config_of(sibling.display, sibling.context), sibling.context, wish.data());
  if (context == EGL_NO_CONTEXT)
    throw GpuError(fmt::format("no GL context beside the window's (EGL error 0x{:x})", eglGetError()));
  if (std::string why_not; !adopt_context(sibling.display, context, why_not)) {
    eglDestroyContext(sibling.display, context);
    throw GpuError("the GL context beside the window's: " + why_not);
  }
}

EglContext::~EglContext() {
  // The display stays initialised: EGL gives all contexts of a device the same one, and terminating it would end them.
  if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void EglContext::make_current() {
  // The bound API is per thread, and its default is OpenGL ES.
  if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    throw GpuError(fmt::format("the GL context cannot be made current (EGL error 0x{:x})", eglGetError()));
}

}  // namespace meniscus
