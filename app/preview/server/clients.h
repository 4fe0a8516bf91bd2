// SPDX-License-Identifier: BSD-3-Clause
// The clients of the preview server: who may connect, who controls, and their requests on the way to the drawing
// thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>

#include "app/preview/command_json.h"
#include "core/base/output_file.h"

namespace meniscus {

using ClientNumber = std::uint64_t;

/// One command of a client; several of its messages may have become one.
struct ClientCommand {
  ClientNumber client = 0;
  nlohmann::json command;
  std::vector<nlohmann::json> ids;  ///< of the messages, for their replies
};

/// A file that came from a page, in a folder of its own that only this user can read. Both vanish with this
/// object, and when the program is ended from outside.
class ReceivedFile {
 public:
  /// Makes an empty file. Its name must be plain (is_plain_name()). Throws OutputError.
  explicit ReceivedFile(std::string_view name);
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  OutputFolder folder_;
  ScratchFile file_;
};
using ReceivedFiles = std::vector<std::shared_ptr<const ReceivedFile>>;

/// A request for another molecule.
struct OpenRequest {
  ClientNumber client = 0;
  nlohmann::json id;    ///< the number of the message, which its reply repeats
  ReceivedFiles files;  ///< a molecule, its trajectory, or both
};

/// Drags not drawn yet become one drag, and of values such as the probe radius the latest counts, so
/// that a slow picture never makes a queue. Every function may be called from any thread.
class Mailbox {
 public:
  /// False, and nothing happens, if too many commands wait already.
  bool put(ClientNumber client, const nlohmann::json& id, nlohmann::json command);
  /// Requests another molecule. A later request replaces an earlier one.
  void open(OpenRequest request);
  /// The most that a waiting command will change.
  Change waiting_change();
  /// The client has shown its last picture and is ready for another.
  void want_picture(ClientNumber client);
  /// The client is ready for another figure. known: digests of the tables that it has.
  void want_figure(ClientNumber client, std::set<std::string> known);
  /// The client has gone; its commands are still carried out.
  void forget(ClientNumber client);
  /// The network has failed; take() throws Error with this text.
  void fail(const std::string& error);

  struct Content {
    std::vector<ClientCommand> commands;                           ///< in order
    std::optional<OpenRequest> opening;                            ///< a request for another molecule
    std::set<ClientNumber> wanting;                                ///< clients that are ready for a picture
    std::map<ClientNumber, std::set<std::string>> wanting_figure;  ///< those ready for a figure, and their tables
    std::set<ClientNumber> gone;                                   ///< clients that left since the last time
  };
  /// Waits until something new is there or the time has come, and takes all of it.
  Content take(std::optional<std::chrono::steady_clock::time_point> until);

 private:
  void wake();  // take(), while the mutex is locked

  std::mutex mutex_;
  std::condition_variable arrived_;
  Content content_;
  bool news_ = false;
  std::string error_;
};

// How much the server takes from others.
inline constexpr std::size_t kMostClients = 4;  ///< sockets that look or control
inline constexpr std::size_t kMostConnections = 32;
inline constexpr std::size_t kLargestMessage = 4096;        ///< bytes
inline constexpr std::size_t kLargestHeader = 8192;         ///< bytes of a request's header
inline constexpr int kPatience = 10;                        ///< seconds for a request
inline constexpr std::size_t kMostReceived = 2;             ///< files that came from pages and are not open yet
inline constexpr std::uint64_t kLargestFile = 512'000'000;  ///< bytes of such a file

/// 128 random bits of the system as 32 hexadecimal digits. Throws Error where the system has none.
std::string random_token();

/// Why a token of a user's own is none; empty: it is one.
std::string token_fault(std::string_view token);

/// Returns why a text is not a host that a user may trust, such as hub.example.org:8888; empty: it is one.
std::string host_fault(std::string_view host);

/// Returns "rest" for "/TOKEN/rest" if the token is right, otherwise nothing.
std::optional<std::string_view> admitted_path(std::string_view target, std::string_view token);

/// Bytes on their way to clients, which share them.
struct OutgoingMessage {
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;
  bool is_text = true;
};

/// A connected socket, as others see it. Used by the network thread only.
class Client {
 public:
  virtual ~Client() = default;
  virtual void send(OutgoingMessage message) = 0;
  virtual void close() = 0;
};

/// Who is connected, and what all connections share. Used by the network thread only.
struct Clients {
  Clients(Mailbox& box, std::string word) : mailbox(box), token(std::move(word)) {}

  Mailbox& mailbox;
  std::string token;
  std::string entry = random_token();  ///< stands for the token in the first request that has it; then empty
  std::uint16_t port = 0;
  std::vector<std::string> trusted{};  ///< further hosts under which browsers reach this server, as behind a proxy
  std::map<std::string, std::filesystem::path, std::less<>> files{};  ///< what browsers may download, by name
  std::map<std::string, std::shared_ptr<const ReceivedFile>, std::less<>>
      received{};               ///< complete files from pages, by name
  bool is_receiving = false;    ///< true while a file comes from a page
  std::string announcement{};   ///< what a new client is told, as JSON; empty: nothing
  std::size_t connections = 0;  ///< sockets of any kind, open
  std::map<ClientNumber, std::shared_ptr<Client>> sockets;
  ClientNumber next_number = 1;

  /// Connections that have not shown the token yet, oldest first, each by a function that ends it.
  std::map<std::uint64_t, std::function<void()>> strangers;
  std::uint64_t next_stranger = 1;
  ClientNumber controller = 0;  ///< 0: none

  /// Returns true if a Host header names this server: 127.0.0.1:PORT, localhost:PORT or a trusted host. A foreign
  /// name that DNS resolves to this machine is refused (DNS rebinding).
  bool is_host(std::string_view host) const;
  /// Returns true if this server sent the pages of an origin.
  bool is_origin(std::string_view origin) const;
  bool controls(ClientNumber client) const { return client == controller; }
  /// This client controls from now on; both are notified.
  void give_control(ClientNumber client);
  bool full() const;
  /// Returns true, once, for the target of a request that is "/" and the entry.
  bool take_entry(std::string_view target);
  ClientNumber join(std::shared_ptr<Client> client);
  void leave(ClientNumber client);
};

/// A JSON message as text.
OutgoingMessage text_message(const std::string& text);

}  // namespace meniscus
