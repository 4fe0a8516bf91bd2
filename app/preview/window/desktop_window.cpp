// SPDX-License-Identifier: BSD-3-Clause
// Opens a GLFW window with an EGL context, collects its events, and says in one line why there is no window.
#include "app/preview/window/desktop_window.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <dlfcn.h>
#include <unistd.h>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "app/process/program_main.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace meniscus {
namespace {

constexpr glm::ivec2 kLeast{480, 240};  // the panel and something of the picture, on an ordinary screen
constexpr const char* kElsewhere = "run on a desktop, or use --serve";

/// Why the last GLFW call failed.
std::string glfw_reason() {
  const char* text = nullptr;
  return glfwGetError(&text) == GLFW_NO_ERROR || !text ? "no reason given" : text;
}

/// Xlib ends the program when the display goes away; this keeps its exit code and its tidiness ours.
int lose_display(void*) {
  constexpr char kLine[] = "meniscus: error: the display disappeared; the preview ends\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kLine, sizeof kLine - 1);
  remove_unfinished_outputs();
  ::_exit(kExitGpu);
}

/// By name, since GLFW is also built without X11.
void catch_lost_display() {
  using Handler = int (*)(void*);
  const auto set_handler = reinterpret_cast<Handler (*)(Handler)>(::dlsym(RTLD_DEFAULT, "XSetIOErrorHandler"));
  if (set_handler) set_handler(lose_display);
}

/// At most as large as the screen has room for, and never too small for the panel.
glm::ivec2 fitting(glm::ivec2 size) {
  size = glm::max(size, kLeast);
  GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
  if (!monitor) return size;
  glm::ivec2 corner{0}, room{0};
  glfwGetMonitorWorkarea(monitor, &corner.x, &corner.y, &room.x, &room.y);
  float scale = 1.0f;
  glfwGetMonitorContentScale(monitor, &scale, nullptr);
  if (room.x <= 0 || room.y <= 0) return size;
  return glm::max(glm::min(size, glm::ivec2(glm::vec2(room) / std::max(scale, 1.0f))), kLeast);
}

GLFWwindow* create_window(const std::string& title, glm::ivec2 size, bool reports_resets) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, reports_resets ? GLFW_LOSE_CONTEXT_ON_RESET : GLFW_NO_ROBUSTNESS);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  return glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
}

DesktopWindow& owner(GLFWwindow* window) { return *static_cast<DesktopWindow*>(glfwGetWindowUserPointer(window)); }

std::optional<MouseButton> button_of(int glfw_button) {
  if (glfw_button == GLFW_MOUSE_BUTTON_LEFT) return MouseButton::left;
  if (glfw_button == GLFW_MOUSE_BUTTON_RIGHT) return MouseButton::right;
  if (glfw_button == GLFW_MOUSE_BUTTON_MIDDLE) return MouseButton::middle;
  return {};
}

}  // namespace

DesktopWindow::DesktopWindow(const std::string& title, glm::ivec2 size) {
  if (!glfwInit()) throw GpuError(fmt::format("no display: {} ({})", kElsewhere, glfw_reason()));
  catch_lost_display();
  window_ = create_window(title, fitting(size), true);
  if (!window_) window_ = create_window(title, fitting(size), false);  // drivers that cannot tell a reset
  if (!window_) {
    const std::string reason = glfw_reason();
    glfwTerminate();
    throw GpuError(fmt::format("no window with GL 4.5 through EGL on this display: {} ({})", kElsewhere, reason));
  }
  const glm::ivec2 least(scale() / pixels_per_unit() * glm::dvec2(kLeast));
  glfwSetWindowSizeLimits(window_, least.x, least.y, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);  // frames are drawn when something changed, not as fast as possible
  context_ = describe_current_context();
  gl_ = current_egl_context().value_or(ForeignContext{});
  listen();
}

DesktopWindow::~DesktopWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool DesktopWindow::wait(double seconds) {
  const double begin = glfwGetTime();
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  return !events_.empty() || glfwGetTime() - begin < seconds;
}

void DesktopWindow::wake() { glfwPostEmptyEvent(); }

std::vector<InputEvent> DesktopWindow::take_events() { return std::exchange(events_, {}); }

void DesktopWindow::swap() {
  glfwSwapBuffers(window_);
  require_living_context();
}

void DesktopWindow::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void DesktopWindow::stay() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
void DesktopWindow::hide() { glfwHideWindow(window_); }
bool DesktopWindow::closing() const { return glfwWindowShouldClose(window_); }

glm::ivec2 DesktopWindow::pixels() const {
  glm::ivec2 size{0};
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

double DesktopWindow::scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return x > 0.0f ? x : 1.0;
}

double DesktopWindow::seconds() const { return glfwGetTime(); }

glm::dvec2 DesktopWindow::pixels_per_unit() const {
  glm::ivec2 units{0};
  glfwGetWindowSize(window_, &units.x, &units.y);
  return units.x > 0 && units.y > 0 ? glm::dvec2(pixels()) / glm::dvec2(units) : glm::dvec2(1.0);
}

InputEvent& DesktopWindow::add_event(InputEvent::Kind kind) {
  InputEvent event;
  event.kind = kind;
  event.position = pointer_;
  event.time = seconds();
  return events_.emplace_back(event);
}

void DesktopWindow::listen() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    // GLFW's own word on where the pointer is may be from after the events that are still to come.
    owner(window).pointer_ = glm::dvec2(x, y) * owner(window).pixels_per_unit();
    owner(window).add_event(InputEvent::Kind::move);
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int entered) {
    if (!entered) owner(window).add_event(InputEvent::Kind::leave);
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int glfw_button, int action, int modifiers) {
    const auto button = button_of(glfw_button);
    if (!button) return;
    InputEvent& event =
        owner(window).add_event(action == GLFW_PRESS ? InputEvent::Kind::press : InputEvent::Kind::release);
    event.button = *button;
    event.shift = modifiers & GLFW_MOD_SHIFT;
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
    owner(window).add_event(InputEvent::Kind::scroll).scroll = notches;
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned letter) {
    owner(window).add_event(InputEvent::Kind::text).letter = letter;
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (key < 0) return;  // a key that GLFW has no name for
    owner(window).add_event(action == GLFW_RELEASE ? InputEvent::Kind::key_up : InputEvent::Kind::key).key = key;
  });
}

}  // namespace meniscus
