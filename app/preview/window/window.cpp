// SPDX-License-Identifier: BSD-3-Clause
// The loop of the window: turns events into commands and shows the pictures that come back; else it sleeps.
#include "app/preview/window/window.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <epoxy/gl.h>
#include <imgui.h>

#include "app/preview/command_json.h"
#include "app/preview/window/desktop_window.h"
#include "app/preview/window/gestures.h"
#include "app/preview/window/gui.h"
#include "app/preview/window/panel.h"
#include "app/preview/window/pictures.h"
#include "app/preview/window/session_link.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr double kMouseRest = 0.25;  // seconds until the mouse is taken to point at something
constexpr double kLongSleep = 10.0;
constexpr double kBusyLook = 0.25;  // how often the word that it is working is renewed
constexpr int kSettlingFrames = 3;  // ImGui shows the effect of an event one or two frames later

class PreviewWindow {
 public:
  PreviewWindow(const WindowOptions& options, SessionThread::Make make)
      : options_(options),
        window_(options.title, options.size + glm::ivec2(static_cast<int>(Panel::width(Gui::kLetterHeight)), 0)),
        gui_(window_),
        thread_(window_.gl(options.kernel_folder), std::move(make), DesktopWindow::wake),
        link_(thread_, [this](std::uint64_t number, const Json& command) { note(number, command); }),
        panel_(link_) {
    replay_done_ = options_.commands.empty();
    if (replay_done_) link_.send(resize_command());
  }

  WindowReport run();

 private:
  bool may_end();
  void answer(bool leaves);
  bool replaying() const { return !replay_done_; }
  glm::ivec2 picture_area() const;
  Json resize_command() const;
  void tick();
  double patience();
  void note(std::uint64_t number, const Json& command);
  void take_events();
  void assume_typing(bool typing);
  void take_pointer(const InputEvent& event, bool elsewhere);
  void take_key(const InputEvent& event);
  void take_click(const Click& click);
  void take_update();
  void take_reply(const SessionReply& reply);
  void go_on();
  void fit_picture();
  void draw();
  void write_state() const;

  const WindowOptions& options_;
  DesktopWindow window_;
  Gui gui_;
  PictureView view_;
  SessionThread thread_;
  SessionLink link_;
  Panel panel_;
  Gestures gestures_;
  AtomQuestion hover_{false}, clicked_{true};
  LatencyMeter latency_;
  WindowReport report_;
  bool help_ = false, panel_shown_ = true;
  bool asks_ = false, leaves_ = false;  // whether unsaved work may be lost, and that it may
  int unsure_frames_ = 0;               // after a click, until ImGui has said whether that was into a field
  bool typing_assumed_ = false;         // as long as that is unsure
  int redraws_ = kSettlingFrames;
  std::size_t next_ = 0;  // of options_.commands
  std::uint64_t first_number_ = 0;
  bool replay_done_ = false;
  double next_frame_due_ = 0.0, next_tick_ = 0.0;
  const char* const state_file_ = std::getenv("MENISCUS_WINDOW_STATE");  // for tests: see write_state()
  std::size_t letters_ = 0;                                              // that came so far
};

WindowReport PreviewWindow::run() {
  report_.context = window_.context();
  while (!may_end()) {
    const bool happened = window_.wait(redraws_ > 0 ? 0.0 : patience());
    // While the mouse drags, only what comes of it is news.
    if (happened && !gestures_.dragging()) redraws_ = kSettlingFrames;
    tick();
    take_events();
    take_update();
    if (redraws_ > 0) draw();
    go_on();
  }
  window_.hide();
  report_.latency = latency_.result();
  return std::move(report_);
}

/// Whether the window is to be closed, and the user was asked if that loses something.
bool PreviewWindow::may_end() {
  if (!window_.closing()) return false;
  if (leaves_ || !link_.has_state() || !link_.state().value("unsaved", false)) return true;
  window_.stay();
  asks_ = true;
  redraws_ = kSettlingFrames;
  return false;
}

void PreviewWindow::answer(bool leaves) {
  asks_ = false;
  leaves_ = leaves;
  if (leaves) window_.close();
}

glm::ivec2 PreviewWindow::picture_area() const {
  glm::ivec2 area = window_.pixels();
  if (panel_shown_) area.x -= static_cast<int>(Panel::width(gui_.em()) * window_.pixels_per_unit().x);
  return glm::max(area, glm::ivec2(16));
}

Json PreviewWindow::resize_command() const {
  const glm::ivec2 area = picture_area();
  return {{"command", "resize"}, {"width", area.x}, {"height", area.y}};
}

/// Redraws what changes by itself, at its own pace, however much the mouse moves meanwhile.
void PreviewWindow::tick() {
  const bool changing = link_.news().busy_seconds || Gui::typing();
  if (!changing || window_.seconds() < next_tick_) return;
  next_tick_ = window_.seconds() + kBusyLook;
  redraws_ = std::max(redraws_, 1);
}

/// Asks what is due to be asked; seconds for which there is nothing else to do by itself.
double PreviewWindow::patience() {
  double seconds = link_.news().busy_seconds ? kBusyLook : kLongSleep;
  if (Gui::typing()) seconds = kBusyLook;  // the cursor in a field blinks
  if (!link_.has_state() || replaying()) return seconds;
  const double now = window_.seconds();
  if (link_.news().at_rest)
    if (const auto due = hover_.advance(link_, now)) seconds = std::min(seconds, *due);
  if (const auto due = clicked_.advance(link_, now)) seconds = std::min(seconds, *due);
  if (const auto due = panel_.exports().question().advance(link_, now)) seconds = std::min(seconds, *due);
  if (link_.state()["playing"].get<bool>()) seconds = std::min(seconds, std::max(next_frame_due_ - now, 1e-3));
  return seconds;
}

void PreviewWindow::note(std::uint64_t number, const Json& command) {
  latency_.sent(number, command, window_.seconds());
  const std::string word = command_word(command);
  if (word == "pick" || word == "export" || word == "export_state") return;
  hover_.forget();
  clicked_.stop();
}

void PreviewWindow::take_events() {
  std::vector<Json> movements;
  const auto send_movements = [&] {
    for (const Json& command : std::exchange(movements, {})) link_.send(command);
  };
  const bool list_open = Gui::list_open() || asks_;
  for (const InputEvent& event : window_.take_events()) {
    const bool elsewhere = list_open || event.position.x >= picture_area().x;
    // A click into a field, or out of it, counts for what is typed after it, though nothing has been drawn since.
    if (event.kind == InputEvent::Kind::press) assume_typing(elsewhere);
    letters_ += event.kind == InputEvent::Kind::text;
    const bool for_panel = unsure_frames_ > 0 ? typing_assumed_ : Gui::typing();
    // A letter that is a command must not turn up in the field that it opens.
    if (event.kind != InputEvent::Kind::text || for_panel) gui_.take(event);
    // A file that takes long to read need not be waited for.
    if (!link_.has_state() && (event.letter == 'q' || event.letter == 'Q')) window_.close();
    if (!link_.has_state() || replaying()) continue;
    gestures_.take(event, picture_area(), elsewhere, movements);
    if (gestures_.click()) take_click(*gestures_.click());
    if (event.kind == InputEvent::Kind::text || event.kind == InputEvent::Kind::key) {
      send_movements();  // things happen in the order they were done
      if (!for_panel) take_key(event);
    }
    if (event.kind == InputEvent::Kind::move || event.kind == InputEvent::Kind::leave) take_pointer(event, elsewhere);
  }
  send_movements();
}

void PreviewWindow::assume_typing(bool typing) {
  unsure_frames_ = 2;
  typing_assumed_ = typing;
}

void PreviewWindow::take_pointer(const InputEvent& event, bool elsewhere) {
  hover_.forget();
  if (event.kind == InputEvent::Kind::move && !elsewhere && !gestures_.dragging())
    hover_.ask_at(event.position, event.time + kMouseRest);
}

void PreviewWindow::take_key(const InputEvent& event) {
  if (asks_) {
    if (event.kind == InputEvent::Kind::text && (event.letter == 'y' || event.letter == 'Y')) answer(true);
    if (event.kind == InputEvent::Kind::text && (event.letter == 'n' || event.letter == 'N')) answer(false);
    return;
  }
  const KeyMeaning meaning = event_meaning(event, link_.state());
  if (Gui::list_open() && meaning.action == FaceAction::leave) return gui_.close_lists();
  if (meaning.command) link_.send(*meaning.command);
  if (!meaning.action) return;
  switch (*meaning.action) {
    case FaceAction::help:
      help_ = !help_;
      break;
    case FaceAction::panel:
      panel_shown_ = !panel_shown_;
      break;
    case FaceAction::export_name:
      panel_shown_ = true;
      panel_.exports().ask_for_name();
      assume_typing(true);  // what is typed after it is for the name
      break;
    case FaceAction::leave:
      if (event.kind == InputEvent::Kind::text || !std::exchange(help_, false))
        window_.close();  // Esc first closes help
      break;
  }
}

void PreviewWindow::take_click(const Click& click) {
  clicked_.ask_at(click.position, window_.seconds());
  if (!click.twice) return;
  const glm::ivec2 last = picture_area() - 1;
  link_.send({{"command", "center"},
              {"x", std::clamp(static_cast<int>(click.position.x), 0, last.x)},
              {"y", std::clamp(static_cast<int>(click.position.y), 0, last.y)}});
}

void PreviewWindow::take_update() {
  if (!link_.update()) return;
  redraws_ = std::max(redraws_, gestures_.dragging() || replaying() ? 1 : kSettlingFrames);
  for (const SessionReply& reply : link_.replies()) take_reply(reply);
  if (link_.news().quit) answer(true);
}

void PreviewWindow::take_reply(const SessionReply& reply) {
  if (replaying() && options_.replied) options_.replied(reply.number - first_number_, reply.reply);
  const double now = window_.seconds();
  if (hover_.take(reply, now)) return;
  if (!clicked_.take(reply, now)) return panel_.exports().show_reply(reply, now);
  panel_.show_pick(clicked_.answer());
}

/// What the window does by itself: the next command of a replay, the next frame of a film, another size.
void PreviewWindow::go_on() {
  if (!link_.settled() || window_.closing()) return;
  if (next_ < options_.commands.size()) {
    const std::uint64_t number = link_.replay(options_.commands[next_]);
    if (next_++ == 0) first_number_ = number;
    return;
  }
  replay_done_ = true;
  fit_picture();
  if (!link_.state()["playing"].get<bool>() || window_.seconds() < next_frame_due_) return;
  next_frame_due_ = window_.seconds() + 1.0 / link_.state()["fps"].get<double>();
  link_.send({{"command", "next_frame"}});
}

void PreviewWindow::fit_picture() {
  const glm::ivec2 area = picture_area();
  const Json& state = link_.state();
  if (window_.pixels().x == 0 || (state["width"] == area.x && state["height"] == area.y)) return;
  link_.send(resize_command());
}

void PreviewWindow::draw() {
  --redraws_;
  if (window_.pixels().x == 0) return;
  gui_.begin();
  if (panel_shown_) panel_.draw(gui_.em());
  if (help_) draw_help(Panel::width(gui_.em()));
  if (!gestures_.dragging() && !help_ && !asks_) draw_answer(hover_.answer());
  if (asks_)
    if (const std::optional<bool> leaves = draw_close_question(Panel::width(gui_.em()))) answer(*leaves);
  const SharedPicture picture = link_.picture();
  const std::uint64_t shown = link_.news().shown;
  if (!picture.texture && panel_shown_) draw_notice(Panel::width(gui_.em()), working_line(link_));
  glViewport(0, 0, window_.pixels().x, window_.pixels().y);
  glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  if (picture.texture) view_.show(picture.texture, picture.size, picture_area(), window_.pixels());
  if (gui_.end())
    redraws_ = std::max(redraws_, 1);
  else
    unsure_frames_ = std::max(unsure_frames_ - 1, 0);
  window_.swap();
  link_.presented(shown);
  latency_.shown(shown, window_.seconds());
  if (state_file_) write_state();
}

/// Tests wait for what is here instead of for some time, and click where widgets are.
void PreviewWindow::write_state() const {
  const Json state{{"idle", redraws_ == 0},
                   {"settled", link_.settled()},
                   {"full", link_.settled() && link_.news().full},
                   {"asks", asks_},
                   {"unsaved", link_.has_state() && link_.state().value("unsaved", false)},
                   {"line", panel_.exports().line()},
                   {"stage", link_.has_state() ? "" : link_.news().stage},
                   {"typing", Gui::typing()},
                   {"letters", letters_},
                   {"pointed", hover_.answer()},
                   {"widgets", gui_.places()}};
  const std::string part = std::string(state_file_) + ".part";
  std::ofstream(part) << state.dump();
  std::error_code ignored;
  std::filesystem::rename(part, state_file_, ignored);
}

}  // namespace

WindowReport run_window(const WindowOptions& options, SessionThread::Make make) {
  return PreviewWindow(options, std::move(make)).run();
}

}  // namespace meniscus
