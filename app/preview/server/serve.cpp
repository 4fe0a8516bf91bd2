// SPDX-License-Identifier: BSD-3-Clause
// Runs the loop that carries out commands and draws for the pages that wait.
#include "app/preview/server/serve.h"

#include <new>

#include "app/preview/server/clients.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/png_file.h"
#include "core/image/print_file.h"
#include "exporters/page/page_file.h"

namespace meniscus {
namespace {

using Clock = LiveView::Clock;
using Json = nlohmann::json;
using MakeOther = std::function<std::unique_ptr<PreviewSession>(const ReceivedFiles& files)>;

/// Returns pixels as PNG, lightly compressed, without loss. rgba: 4 bytes per pixel, rows from the top; alpha is left
/// out. scene: the scene of the picture; empty for none.
std::vector<std::uint8_t> png_of(std::span<const std::uint8_t> rgba, glm::ivec2 size, std::string scene) {
  ImageToEncode image;
  image.format = "png";
  image.width = size.x;
  image.height = size.y;
  image.channels = {"R", "G", "B"};
  image.color_space = "sRGB";
  image.scene = std::move(scene);
  image.png_level = 1;  // 1 to 9; more takes longer for a little less
  return encode_png(image, rgba, 4);
}

/// A picture as it is sent to pages.
struct SentPicture {
  std::uint64_t number = 0;  ///< 0: none yet
  std::uint64_t revision = 0;
  Quality quality = Quality::draft;
  Json message;
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;
};

class ServedSession {
 public:
  ServedSession(PreviewSession& session, Network& network, Mailbox& mailbox)
      : session_(session), view_(session), network_(network), mailbox_(mailbox) {}

  /// Returns the session that replaces this one, or nullptr if a command ended it.
  std::unique_ptr<PreviewSession> run(const MakeOther& make) {
    while (!session_.wants_to_quit()) {
      Mailbox::Content news = mailbox_.take(next_deadline());
      for (const ClientNumber client : news.gone) {
        waiting_.erase(client);
        shown_.erase(client);
        figure_pages_.erase(client);
      }
      waiting_.merge(news.wanting);
      for (auto& [client, known] : news.wanting_figure) figure_pages_[client].known = std::move(known);
      for (const ClientCommand& command : news.commands) carry_out(command);
      if (news.opening)
        if (auto other = opened(*news.opening, make)) return other;
      play();
      // A large molecule shows balls before its first surface.
      if (picture_.number > 0 || waiting_.empty() || !session_.wants_balls()) show_figure();
      show();
    }
    return nullptr;
  }

 private:
  /// Returns the session of another molecule. If it cannot be opened, all pages say why and the result is nullptr.
  std::unique_ptr<PreviewSession> opened(const OpenRequest& request, const MakeOther& make) {
    try {
      if (question("export_state")["running"])
        throw RequestError("something is still being written; wait for it, or cancel it");
      std::unique_ptr<PreviewSession> other = make(request.files);
      network_.offer_files({});
      network_.announce(nullptr);
      network_.send_to_all({{"event", "opened"}});
      return other;
    } catch (const GpuError&) {
      throw;
    } catch (const Error& error) {
      fail(request, error.what());
    } catch (const std::bad_alloc&) {
      fail(request, "there is not enough memory for this molecule");
    }
    return nullptr;
  }

  void fail(const OpenRequest& request, std::string_view why) {
    network_.announce(nullptr);
    network_.send(request.client, {{"id", request.id}, {"ok", false}});
    network_.send_to_all({{"event", "error"}, {"error", escaped(why)}, {"state", question("state")}});
  }

  void carry_out(const ClientCommand& command) {
    Json reply = view_.apply(command.command);
    network_.offer_files(session_.written_paths());
    for (const Json& id : command.ids) {
      reply["id"] = id;
      network_.send(command.client, reply);
    }
  }

  /// Shows the next frame when its time has come and the pages are ready for it.
  void play() {
    if (!session_.state().playing || (waiting_.empty() && !somebody_waits_for_figures()) || Clock::now() < next_frame_)
      return;
    const auto pace = std::chrono::duration<double>(1.0 / session_.state().rate());
    next_frame_ = std::max(next_frame_, Clock::now() - std::chrono::seconds(1)) +
                  std::chrono::duration_cast<Clock::duration>(pace);
    view_.apply({{"command", "next_frame"}});
  }

  /// Returns true if the latest picture is as good as it can be at this time.
  bool is_current() const {
    return picture_.number > 0 && picture_.revision == session_.state().revision &&
           picture_.quality >= view_.due(Clock::now());
  }

  bool somebody_lacks_the_picture() const {
    return std::ranges::any_of(waiting_, [&](ClientNumber client) { return lacks_the_picture(client); });
  }
  bool lacks_the_picture(ClientNumber client) const {
    const auto shown = shown_.find(client);
    return shown == shown_.end() || shown->second != picture_.number;
  }

  void show() {
    if (waiting_.empty() || !view_.fault().empty()) return;
    if (!is_current() && !draw()) return;
    if (!somebody_lacks_the_picture()) return;
    picture_.message["state"] = question("state");  // commands that make no picture may have come since it was drawn
    std::set<ClientNumber> still_waiting;
    for (const ClientNumber client : waiting_) {
      if (!lacks_the_picture(client)) {
        still_waiting.insert(client);
        continue;
      }
      network_.send(client, picture_.message, picture_.bytes);
      shown_[client] = picture_.number;
    }
    waiting_ = std::move(still_waiting);
  }

  /// A page that casts figures itself.
  struct FigurePage {
    std::optional<std::set<std::string>> known{};  ///< digests of its tables; nothing: it is not ready for a figure
    std::uint64_t shown = 0;                       ///< revision of the figure that it was sent last
  };

  bool lacks_the_figure(const FigurePage& page) const { return page.known && page.shown != session_.figure_revision(); }
  bool somebody_lacks_the_figure() const {
    return std::ranges::any_of(figure_pages_, [&](const auto& page) { return lacks_the_figure(page.second); });
  }
  bool somebody_waits_for_figures() const {
    return std::ranges::any_of(figure_pages_, [](const auto& page) { return page.second.known.has_value(); });
  }

  /// Sends the figure to pages that cast it themselves, or the reason why they cannot.
  void show_figure() {
    if (!somebody_lacks_the_figure() || !pack_figure()) return;
    Json message{{"event", "figure"}, {"edition", figure_revision_}, {"revision", session_.state().revision}};
    message["state"] = question("state");
    if (!figure_) message["unavailable"] = escaped(figure_fault_);
    for (auto& [client, reader] : figure_pages_) {
      if (!lacks_the_figure(reader)) continue;
      const std::string bytes = figure_ ? page::bytes_for_page(*figure_, *reader.known) : "";
      network_.send(client, message,
                    figure_ ? std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end()) : nullptr);
      reader = {{}, figure_revision_};
    }
  }

  /// Packs the figure; returns false if another surface is wanted already.
  bool pack_figure() {
    if (figure_revision_ == session_.figure_revision()) return true;
    figure_.reset();
    try {
      figure_ = view_.figure([this] { return mailbox_.waiting_change(); });
      if (!figure_) return false;
    } catch (const GpuError&) {
      throw;
    } catch (const Error& error) {
      figure_fault_ = error.what();
    }
    figure_revision_ = session_.figure_revision();
    return true;
  }

  /// Draws a picture; returns false if it cannot be drawn, or if a newer command stopped it.
  bool draw() {
    // However late a page asks, it first gets a draft of a view that it has not seen.
    const bool begun =
        picture_.number > 0 && picture_.revision == session_.state().revision && picture_.quality > Quality::balls;
    const Quality due = view_.due(Clock::now()), quality = begun ? due : std::min(due, view_.at_once());
    if (!view_.draw(quality, [this] { return mailbox_.waiting_change(); })) {
      if (!view_.fault().empty())
        network_.send_to_all({{"event", "error"}, {"error", escaped(view_.fault())}, {"state", question("state")}});
      return false;
    }
    encode(quality);
    return true;
  }

  void encode(Quality quality) {
    const std::vector<std::uint8_t> rgba = session_.rgba();
    const glm::ivec2 size = session_.picture_size();
    const auto begin = Clock::now();
    const bool full = quality == Quality::full;
    picture_.bytes = std::make_shared<const std::vector<std::uint8_t>>(
        full ? png_of(rgba, size, scene()) : encode_jpeg(rgba, size.x, size.y, JpegUse::draft));
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - begin;
    ++picture_.number;
    picture_.revision = session_.state().revision;
    picture_.quality = quality;
    picture_.message = {{"event", "picture"},
                        {"type", full ? "image/png" : "image/jpeg"},
                        {"full", full},
                        {"balls", quality == Quality::balls},
                        {"state", question("state")},
                        {"stats", question("stats")}};
    picture_.message["stats"]["encode_milliseconds"] = elapsed.count();
  }

  /// Returns the scene of the present picture.
  std::string scene() {
    const PreviewState& state = session_.state();
    const Json asked{{"command", "scene"},
                     {"width", state.size.x},
                     {"height", state.size.y},
                     {"samples", state.image.samples},
                     {"transparent", false}};
    return session_.apply(asked).value("text", "");
  }

  Json question(const char* word) { return session_.apply({{"command", word}}); }

  std::optional<Clock::time_point> next_deadline() const {
    std::optional<Clock::time_point> deadline;
    if (somebody_lacks_the_figure()) return Clock::now();
    if (session_.state().playing && somebody_waits_for_figures()) deadline = next_frame_;
    if (waiting_.empty()) return deadline;
    const bool drawable = view_.fault().empty();
    if (drawable && !is_current()) return Clock::now();
    if (drawable && picture_.quality != Quality::full && !session_.state().playing)
      deadline = view_.last_change() + view_.rest(picture_.quality == Quality::draft ? Quality::plain : Quality::full);
    if (session_.state().playing) deadline = deadline ? std::min(*deadline, next_frame_) : next_frame_;
    return deadline;
  }

  PreviewSession& session_;
  LiveView view_;
  Network& network_;
  Mailbox& mailbox_;
  SentPicture picture_;
  std::set<ClientNumber> waiting_;                   ///< clients that wait for a picture
  std::map<ClientNumber, std::uint64_t> shown_;      ///< number of the picture that each client was sent last
  std::shared_ptr<const page::PackedFrame> figure_;  ///< nullptr: none yet, or pages cannot show it
  std::string figure_fault_;                         ///< why pages cannot show the figure
  std::uint64_t figure_revision_ = 0;                ///< 0: none yet
  std::map<ClientNumber, FigurePage> figure_pages_;
  Clock::time_point next_frame_{};
};

}  // namespace

void serve_session(const ServeOptions& options, const MakeSession& make) {
  Mailbox mailbox;
  Network network(options, mailbox);
  options.ready({network.url(), network.url_once(), network.port()});
  try {
    const auto begun = [&](const ReceivedFiles& files) {
      return make(files, [&](const std::string& what) {
        network.announce({{"event", "progress"}, {"what", escaped(what)}});
      });
    };
    std::unique_ptr<PreviewSession> session = begun({});
    network.announce(nullptr);
    while (auto other = ServedSession(*session, network, mailbox).run(begun)) session = std::move(other);
  } catch (const std::exception& error) {
    network.send_to_all({{"event", "ended"}, {"error", escaped(error.what())}});
    throw;
  }
  network.send_to_all({{"event", "ended"}});
}

}  // namespace meniscus
