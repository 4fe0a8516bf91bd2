// SPDX-License-Identifier: BSD-3-Clause
// The clients of the preview server: admission, control, and the requests that wait for the drawing thread.
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

/// One command of a client; several messages may have been merged into it.
struct ClientCommand {
  ClientNumber client = 0;
  nlohmann::json command;
  std::vector<nlohmann::json> ids;  ///< identifiers of the messages, for their replies
};

/// A file that came from a page, in its own folder that only this user can read. Both are deleted with this object, and
/// when the program is ended from outside.
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

/// Merges drags that are not drawn yet, and keeps only the latest of values such as the probe radius, so that a slow
/// picture never makes a queue. Every function may be called from any thread.
class Mailbox {
 public:
  /// Adds a command; returns false, and does nothing, if too many commands wait already.
  bool put(ClientNumber client, const nlohmann::json& id, nlohmann::json command);
  /// Requests another molecule. A later request replaces an earlier one.
  void open(OpenRequest request);
  /// Returns the largest change that a waiting command will make.
  Change waiting_change();
  /// Notes that the client has shown its last picture and is ready for another.
  void want_picture(ClientNumber client);
  /// Notes that the client is ready for another figure. known: digests of the tables that it has.
  void want_figure(ClientNumber client, std::set<std::string> known);
  /// Notes that the client has gone; its commands are still carried out.
  void forget(ClientNumber client);
  /// Reports that the network has failed; take() throws Error with this text.
  void fail(const std::string& error);

  struct Content {
    std::vector<ClientCommand> commands;                           ///< in order
    std::optional<OpenRequest> opening;                            ///< a request for another molecule
    std::set<ClientNumber> wanting;                                ///< clients that are ready for a picture
    std::map<ClientNumber, std::set<std::string>> wanting_figure;  ///< clients ready for a figure, and their tables
    std::set<ClientNumber> gone;                                   ///< clients that left since the last call
  };
  /// Waits until there is something new or the time has come, and takes all of it.
  Content take(std::optional<std::chrono::steady_clock::time_point> until);

 private:
  void wake();  // wakes take() while the mutex is locked

  std::mutex mutex_;
  std::condition_variable arrived_;
  Content content_;
  bool news_ = false;
  std::string error_;
};

// Limits of what the server accepts.
inline constexpr std::size_t kMostClients = 4;  ///< sockets that watch or control
inline constexpr std::size_t kMostConnections = 32;
inline constexpr std::size_t kLargestMessage = 4096;        ///< bytes
inline constexpr std::size_t kLargestHeader = 8192;         ///< bytes of a request's header
inline constexpr int kPatience = 10;                        ///< seconds for a request
inline constexpr std::size_t kMostReceived = 2;             ///< files that came from pages and are not open yet
inline constexpr std::uint64_t kLargestFile = 512'000'000;  ///< bytes of such a file

/// Returns 128 random bits of the system as 32 hexadecimal digits. Throws Error where the system has none.
std::string random_token();

/// Returns why a text is not a valid token; empty: it is one.
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

/// A connected socket. Used by the network thread only.
class Client {
 public:
  virtual ~Client() = default;
  virtual void send(OutgoingMessage message) = 0;
  virtual void close() = 0;
};

/// The connected clients, and the data that all connections share. Used by the network thread only.
struct Clients {
  Clients(Mailbox& box, std::string word) : mailbox(box), token(std::move(word)) {}

  Mailbox& mailbox;
  std::string token;
  std::string entry = random_token();  ///< replaces the token in the first request that has it; empty after that
  std::uint16_t port = 0;
  std::vector<std::string> trusted{};  ///< further names of this server in browsers, as behind a proxy
  std::map<std::string, std::filesystem::path, std::less<>> files{};  ///< files that browsers may download, by name
  std::map<std::string, std::shared_ptr<const ReceivedFile>, std::less<>>
      received{};               ///< complete files from pages, by name
  bool is_receiving = false;    ///< true while a file comes from a page
  std::string announcement{};   ///< the JSON message that each new client gets; empty: none
  std::size_t connections = 0;  ///< open sockets of any kind
  std::map<ClientNumber, std::shared_ptr<Client>> sockets;
  ClientNumber next_number = 1;

  /// Functions that end connections without the token so far, oldest first.
  std::map<std::uint64_t, std::function<void()>> strangers;
  std::uint64_t next_stranger = 1;
  ClientNumber controller = 0;  ///< 0: none

  /// Returns true if a Host header names this server: 127.0.0.1:PORT, localhost:PORT or a trusted host. A foreign
  /// name that DNS resolves to this machine is refused (DNS rebinding).
  bool is_host(std::string_view host) const;
  /// Returns true if this server sent the pages of an origin.
  bool is_origin(std::string_view origin) const;
  bool controls(ClientNumber client) const { return client == controller; }
  /// Gives control to this client; it and the former controller are notified.
  void give_control(ClientNumber client);
  bool full() const;
  /// Returns true, once, for the target of a request that is "/" and the entry.
  bool take_entry(std::string_view target);
  ClientNumber join(std::shared_ptr<Client> client);
  void leave(ClientNumber client);
};

/// Returns a JSON text as a message.
OutgoingMessage text_message(const std::string& text);

}  // namespace meniscus
