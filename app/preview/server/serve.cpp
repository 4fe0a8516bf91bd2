// SPDX-License-Identifier: BSD-3-Clause
// The loop that carries out commands and draws what waiting pages have not seen.
#include "app/preview/server/serve.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "app/preview/server/mailbox.h"
#include "app/preview/server/network.h"
#include "app/preview/server/picture_encoder.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/gpu/context_description.h"

namespace meniscus {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

// Without a change for so long: time for a picture in full size, and later for the full one.
constexpr std::chrono::milliseconds kPause{120}, kRest{250}, kLongestRest{1500};
constexpr int kJpegQuality = 80;

/// A picture as pages get it.
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
      : session_(session), network_(network), mailbox_(mailbox) {}

  void run() {
    while (!session_.wants_to_quit()) {
      Mailbox::Content news = mailbox_.take(next_deadline());
      for (const ClientNumber client : news.gone) {
        waiting_.erase(client);
        shown_.erase(client);
      }
      waiting_.merge(news.wanting);
      for (const ClientCommand& command : news.commands) carry_out(command);
      play();
      show();
    }
  }

 private:
  void carry_out(const ClientCommand& command) {
    Json reply = session_.apply(command.command);
    for (const Json& id : command.ids) {
      reply["id"] = id;
      network_.send(command.client, reply);
    }
    note_change();
  }

  void note_change() {
    if (session_.revision() == seen_revision_) return;
    seen_revision_ = session_.revision();
    last_change_ = Clock::now();
    broken_ = false;
  }

  /// The next frame, when it is time and the pages have come along.
  void play() {
    if (!session_.playing() || waiting_.empty() || Clock::now() < next_frame_) return;
    const auto pace = std::chrono::duration<double>(1.0 / session_.frames_per_second());
    next_frame_ = std::max(next_frame_, Clock::now() - std::chrono::seconds(1)) +
                  std::chrono::duration_cast<Clock::duration>(pace);
    session_.apply({{"command", "next_frame"}});
    note_change();
  }

  /// A full picture is begun after a rest that is as long as it may take, for it stops between samples only.
  Clock::time_point time_for(Quality quality) const {
    if (quality == Quality::draft) return last_change_;
    return last_change_ + (quality == Quality::plain ? kPause : rest_);
  }
  Quality wanted() const {
    const Clock::time_point now = Clock::now();
    return now < time_for(Quality::plain)  ? Quality::draft
           : now < time_for(Quality::full) ? Quality::plain
                                           : Quality::full;
  }

  /// Is the latest picture good enough for now?
  bool is_current() const {
    return picture_.number > 0 && picture_.revision == session_.revision() && picture_.quality >= wanted();
  }

  bool somebody_lacks_the_picture() const {
    return std::ranges::any_of(waiting_, [&](ClientNumber client) { return lacks_the_picture(client); });
  }
  bool lacks_the_picture(ClientNumber client) const {
    const auto shown = shown_.find(client);
    return shown == shown_.end() || shown->second != picture_.number;
  }

  void show() {
    if (waiting_.empty() || broken_) return;
    if (!is_current() && !draw()) return;
    if (!somebody_lacks_the_picture()) return;
    std::set<ClientNumber> still_waiting;
    for (const ClientNumber client : waiting_) {
      if (!lacks_the_picture(client)) {
        still_waiting.insert(client);
        continue;
      }
      network_.send_picture(client, picture_.message, picture_.bytes);
      shown_[client] = picture_.number;
    }
    waiting_ = std::move(still_waiting);
  }

  /// False if there is nothing to show: it cannot be drawn, or a newer command stopped it.
  bool draw() {
    const Quality quality = wanted();
    const Clock::time_point begin = Clock::now();
    try {
      const bool whole = session_.render(quality, [this] { return mailbox_.has_changes(); });
      require_living_context();
      if (!whole) return false;
    } catch (const GpuError&) {
      throw;
    } catch (const Error& error) {
      broken_ = true;
      network_.send_to_all({{"event", "error"}, {"error", escaped(error.what())}, {"state", question("state")}});
      return false;
    }
    if (quality == Quality::full)
      rest_ =
          std::clamp(std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin), kRest, kLongestRest);
    encode(quality);
    return true;
  }

  void encode(Quality quality) {
    const std::vector<std::uint8_t> rgba = session_.rgba();
    const glm::ivec2 size = session_.picture_size();
    const auto begin = Clock::now();
    const bool full = quality == Quality::full;
    picture_.bytes = std::make_shared<const std::vector<std::uint8_t>>(full ? encode_png(rgba, size)
                                                                            : jpeg_.encode(rgba, size, kJpegQuality));
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - begin;
    ++picture_.number;
    picture_.revision = session_.revision();
    picture_.quality = quality;
    picture_.message = {{"event", "picture"},
                        {"type", full ? "image/png" : "image/jpeg"},
                        {"full", full},
                        {"state", question("state")},
                        {"stats", question("stats")}};
    picture_.message["stats"]["encode_milliseconds"] = elapsed.count();
  }

  Json question(const char* word) { return session_.apply({{"command", word}}); }

  std::optional<Clock::time_point> next_deadline() const {
    std::optional<Clock::time_point> deadline;
    if (waiting_.empty()) return deadline;
    if (!broken_ && !is_current()) return Clock::now();
    if (!broken_ && picture_.quality != Quality::full)
      deadline = time_for(picture_.quality == Quality::draft ? Quality::plain : Quality::full);
    if (session_.playing()) deadline = deadline ? std::min(*deadline, next_frame_) : next_frame_;
    return deadline;
  }

  PreviewSession& session_;
  Network& network_;
  Mailbox& mailbox_;
  JpegEncoder jpeg_;
  SentPicture picture_;
  std::set<ClientNumber> waiting_;               ///< for a picture they have not seen
  std::map<ClientNumber, std::uint64_t> shown_;  ///< number of the picture each was sent last
  std::uint64_t seen_revision_ = 0;
  Clock::time_point last_change_{}, next_frame_{};
  std::chrono::milliseconds rest_ = kRest;
  bool broken_ = false;  ///< what is asked for cannot be drawn; said once
};

}  // namespace

void serve_session(PreviewSession& session, std::uint16_t port,
                   const std::function<void(const std::string& url, std::uint16_t port)>& ready) {
  Mailbox mailbox;
  Network network(port, mailbox);
  ready(network.url(), network.port());
  try {
    ServedSession(session, network, mailbox).run();
  } catch (const std::exception& error) {
    network.send_to_all({{"event", "ended"}, {"error", escaped(error.what())}});
    throw;
  }
  network.send_to_all({{"event", "ended"}});
}

}  // namespace meniscus
