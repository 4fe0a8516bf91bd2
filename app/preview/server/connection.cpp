// SPDX-License-Identifier: BSD-3-Clause
// Reads requests, commands and files within limits; answers with files of the page, a refusal, replies and pictures.
#include "app/preview/server/connection.h"

#include <algorithm>
#include <deque>
#include <limits>

#include <boost/asio/buffer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "app/preview/command_json.h"
#include "app/preview/server/page_files.h"
#include "core/base/system_file.h"
#include "core/base/text_file.h"

namespace meniscus {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Json = nlohmann::json;
using StreamBody = http::basic_file_body<beast::file_stdio>;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Returns the digests in a request for a figure, whose "has" may be left out; nothing if the message is not valid.
std::optional<std::set<std::string>> tables_known_to(const Json& message) {
  std::set<std::string> known;
  const Json has = message.value("has", Json::array());
  if (message.value("request", Json()) != "figure" || message.size() > 1 + message.count("has") || !has.is_array())
    return {};
  for (const Json& digest : has)
    if (!digest.is_string() || !known.insert(digest).second) return {};
  return known;
}

/// Returns the names of the files in a request to open them, or nothing if a message is not such a request.
std::optional<std::vector<std::string>> files_to_open(const Json& message) {
  const Json files = message.value("files", Json());
  if (message.value("request", Json()) != "open" || message.size() != 2 || !files.is_array()) return {};
  if (!std::ranges::all_of(files, &Json::is_string) || files.empty() || files.size() > kMostReceived) return {};
  return files.get<std::vector<std::string>>();
}

/// Limit of the messages that wait for a client that does not read; a page that works never has as many.
constexpr std::size_t kLongestQueue = 512;

class SocketClient : public Client, public std::enable_shared_from_this<SocketClient> {
 public:
  SocketClient(beast::tcp_stream stream, std::shared_ptr<Clients> clients)
      : socket_(std::move(stream)), clients_(std::move(clients)) {
    ++clients_->connections;
  }
  ~SocketClient() override { --clients_->connections; }

  void accept(const beast::http::request<beast::http::empty_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the socket has timeouts of its own
    websocket::stream_base::timeout patience;
    patience.handshake_timeout = std::chrono::seconds(kPatience);
    patience.idle_timeout = std::chrono::seconds(60);
    patience.keep_alive_pings = true;
    socket_.set_option(patience);
    socket_.read_message_max(kLargestMessage);
    number_ = clients_->join(shared_from_this());
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return self->leave();
      self->open_ = true;
      self->send(text_message(json_line({{"event", "welcome"},
                                         {"controls", self->clients_->controls(self->number_)},
                                         {"largest_file", kLargestFile}})));
      if (!self->clients_->announcement.empty()) self->send(text_message(self->clients_->announcement));
      self->read();
    });
  }

  void send(OutgoingMessage message) override {
    if (gone_) return;
    if (queue_.size() >= kLongestQueue) return abandon();
    queue_.push_back(std::move(message));
    write_next();
  }

  void close() override {
    closing_ = true;
    write_next();
  }

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->leave();
      if (self->socket_.got_text()) self->understand(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void understand(const std::string& text) {
    Json message = is_nested_too_deep(text) ? Json() : Json::parse(text, nullptr, false);
    if (!message.is_object()) return reply(nullptr, "a message is a JSON object such as {\"command\":\"state\"}");
    Json id;
    if (const auto found = message.find("id"); found != message.end()) {
      id = *found;
      message.erase(found);
    }
    if (message == Json{{"request", "picture"}}) return clients_->mailbox.want_picture(number_);
    if (const auto known = tables_known_to(message)) return clients_->mailbox.want_figure(number_, *known);
    if (message == Json{{"request", "control"}}) return clients_->give_control(number_);
    if (!clients_->controls(number_) && !is_question(message)) return reply(id, "another page controls this preview");
    if (const auto names = files_to_open(message)) return open(id, *names);
    if (!clients_->mailbox.put(number_, id, std::move(message))) reply(id, "too many commands wait; send fewer");
  }

  void open(const Json& id, const std::vector<std::string>& names) {
    OpenRequest request{number_, id, {}};
    for (const std::string& name : names) {
      const auto file = clients_->received.find(name);
      if (file == clients_->received.end()) return reply(id, "the file has not come; open it again");
      request.files.push_back(file->second);
    }
    clients_->received.clear();
    clients_->mailbox.open(std::move(request));
  }

  void reply(const Json& id, const char* error) {
    send(text_message(json_line({{"id", id}, {"ok", false}, {"error", error}})));
  }

  void write_next() {
    if (writing_ || gone_ || !open_) return;
    if (queue_.empty()) {
      if (closing_) socket_.async_close(websocket::close_code::going_away, [self = shared_from_this()](auto) {});
      return;
    }
    writing_ = true;
    socket_.text(queue_.front().is_text);
    socket_.async_write(boost::asio::buffer(*queue_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->writing_ = false;
                          self->queue_.pop_front();
                          if (error) return self->leave();
                          self->write_next();
                        });
  }

  void abandon() {
    beast::get_lowest_layer(socket_).close();
    leave();
  }

  void leave() {
    if (std::exchange(gone_, true)) return;
    clients_->leave(number_);
  }

  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_;
  std::shared_ptr<Clients> clients_;
  std::deque<OutgoingMessage> queue_;
  ClientNumber number_ = 0;
  bool open_ = false, writing_ = false, closing_ = false, gone_ = false;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket socket, std::shared_ptr<Clients> clients)
      : stream_(std::move(socket)), clients_(std::move(clients)) {
    ++clients_->connections;
  }
  ~Connection() {
    clients_->strangers.erase(stranger_);
    end_receiving();
    --clients_->connections;
  }

  void read() {
    stranger_ = clients_->next_stranger++;
    clients_->strangers[stranger_] = [weak = weak_from_this()] {
      if (const auto self = weak.lock()) self->stream_.close();
    };
    parser_.header_limit(kLargestHeader);
    parser_.body_limit(std::numeric_limits<std::uint64_t>::max());  // another parser, with a limit, reads the body
    stream_.expires_after(std::chrono::seconds(kPatience));
    const auto answered = [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) return self->answer();
      if (error == http::error::header_limit)
        self->refuse(http::status::request_header_fields_too_large, "the request is too large");
    };
    http::async_read_header(stream_, buffer_, parser_, answered);
  }

 private:
  void answer() {
    const auto& request = parser_.get();
    const std::string_view host = view(request[http::field::host]), target = view(request.target());
    // This server would read the first of two, a proxy perhaps the second.
    for (const http::field header : {http::field::host, http::field::origin})
      if (request.count(header) > 1) return refuse(http::status::bad_request, "a header appears twice");
    if (!clients_->is_host(host)) return refuse(http::status::forbidden, "this is not the host asked for");
    if (request.method() == http::verb::get && clients_->take_entry(target)) return lead_to_the_page();
    // A proxy may add its own query, such as its user's token.
    const std::optional<std::string_view> path = admitted_path(target.substr(0, target.find('?')), clients_->token);
    if (!path) return refuse(http::status::forbidden, "the address lacks the token that meniscus printed");
    clients_->strangers.erase(stranger_);
    constexpr std::string_view kReceived = "received/";
    if (request.method() == http::verb::post && path->starts_with(kReceived))
      return receive(path->substr(kReceived.size()));
    if (!parser_.is_done()) return refuse(http::status::request_header_fields_too_large, "the request is too large");
    if (request.method() != http::verb::get) return refuse(http::status::method_not_allowed, "only GET is supported");
    if (*path == "socket") return open_socket();
    constexpr std::string_view kFiles = "files/";
    if (path->starts_with(kFiles)) return send_file(path->substr(kFiles.size()));
    const std::optional<std::string> file = served_file(*path);
    if (!file) return refuse(http::status::not_found, "there is no such page");
    send(http::status::ok, content_type(*path), *file);
  }

  void open_socket() {
    const auto& request = parser_.get();
    if (!websocket::is_upgrade(request)) return refuse(http::status::upgrade_required, "this is a WebSocket");
    if (!clients_->is_origin(view(request[http::field::origin])))
      return refuse(http::status::forbidden, "this page is from another site");
    if (clients_->full()) return refuse(http::status::service_unavailable, "too many pages are open already");
    std::make_shared<SocketClient>(std::move(stream_), clients_)->accept(request);
  }

  void lead_to_the_page() {
    response_.set(http::field::location, fmt::format("/{}/", clients_->token));
    send(http::status::see_other, content_type(".txt"), "");
  }

  void refuse(http::status status, std::string_view why) {
    send(status, content_type(".txt"), fmt::format("{}\n", why));
  }

  void send(http::status status, std::string_view type, std::string_view body) {
    describe(response_, status, type);
    response_.body().assign(body);
    response_.prepare_payload();
    stream_.expires_after(std::chrono::seconds(kPatience));
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) { self->end(); });
  }

  void end() {
    beast::error_code ignored;
    stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  }

  /// Receives a file from the page. Pages of other sites are refused by their Origin.
  void receive(std::string_view name) {
    if (!clients_->is_origin(view(parser_.get()[http::field::origin])))
      return refuse(http::status::forbidden, "this page is from another site");
    if (!is_plain_name(name))
      return refuse(http::status::bad_request, "the file name has other letters than it may have");
    const auto length = parser_.content_length();
    if (!length) return refuse(http::status::length_required, "the request does not say how long the file is");
    if (*length > kLargestFile) return refuse(http::status::payload_too_large, "the file is too large");
    if (clients_->is_receiving)
      return refuse(http::status::service_unavailable, "another file is on its way; open this one again after it");
    receives_ = clients_->is_receiving = true;
    beast::error_code error;
    try {
      received_ = std::make_shared<const ReceivedFile>(name);
      upload_.emplace(std::move(parser_));
      upload_->body_limit(kLargestFile);
      upload_->get().body().open(text_of_path(received_->path()).c_str(), beast::file_mode::write, error);
    } catch (const std::exception&) {
      error = beast::errc::make_error_code(beast::errc::no_space_on_device);
    }
    if (!error) return receive_piece();
    end_receiving();
    refuse(http::status::insufficient_storage, "there is no room for the file where temporary files are");
  }

  void end_receiving() {
    if (std::exchange(receives_, false)) clients_->is_receiving = false;
  }

  /// Reads the file piece by piece, so that the time limit applies to each piece.
  void receive_piece() {
    if (upload_->is_done()) return keep_received();
    stream_.expires_after(std::chrono::seconds(kPatience));
    http::async_read_some(stream_, buffer_, *upload_,
                          [self = shared_from_this()](beast::error_code error, std::size_t) {
                            if (!error) self->receive_piece();
                          });
  }

  void keep_received() {
    upload_->get().body().close();
    end_receiving();
    auto& received = clients_->received;
    if (received.size() >= kMostReceived) received.clear();  // the page never opened them
    received.insert_or_assign(received_->path().filename().string(), received_);
    send(http::status::ok, content_type(".txt"), "");
  }

  /// Sends a file that the session has written, as a download.
  void send_file(std::string_view name) {
    const auto file = clients_->files.find(name);
    if (file == clients_->files.end()) return refuse(http::status::not_found, "this preview has written no such file");
    std::FILE* const stream = system_file::open_plain(file->second);
    if (!stream) return refuse(http::status::gone, "that file is gone");
    beast::file_stdio opened;
    opened.native_handle(stream);
    beast::error_code error;
    download_.body().reset(std::move(opened), error);
    if (error) return refuse(http::status::gone, "that file cannot be read");
    describe(download_, http::status::ok, "application/octet-stream");
    download_.set(http::field::content_disposition, fmt::format("attachment; filename=\"{}\"", name));
    download_.prepare_payload();
    serializer_.emplace(download_);
    send_piece();
  }

  /// Sends the file piece by piece, so that the time limit applies to each piece.
  void send_piece() {
    stream_.expires_after(std::chrono::seconds(kPatience));
    http::async_write_some(stream_, *serializer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->serializer_->is_done()) return self->end();
      self->send_piece();
    });
  }

  /// Allows the page only its own script and style, this server and the Protein Data Bank, and no frame around it.
  void describe(auto& response, http::status status, std::string_view type) {
    response.result(status);
    response.version(11);
    response.keep_alive(false);
    response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    std::string hosts = fmt::format("'self' ws://127.0.0.1:{0} ws://localhost:{0}", clients_->port);
    for (const std::string& host : clients_->trusted) hosts += fmt::format(" ws://{0} wss://{0}", host);
    if (type == content_type("")) hosts += " https://files.rcsb.org";
    response.set("Content-Security-Policy",
                 "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src " + hosts +
                     "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set(http::field::cache_control, "no-store");
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{2 * kLargestHeader};
  http::request_parser<http::empty_body> parser_;
  std::optional<http::request_parser<http::file_body>> upload_;
  std::shared_ptr<const ReceivedFile> received_;
  bool receives_ = false;
  http::response<http::string_body> response_;
  http::response<StreamBody> download_;
  std::optional<http::response_serializer<StreamBody>> serializer_;
  std::shared_ptr<Clients> clients_;
  std::uint64_t stranger_ = 0;  // number in Clients::strangers
};

}  // namespace

void serve_connection(boost::asio::ip::tcp::socket socket, const std::shared_ptr<Clients>& clients) {
  std::make_shared<Connection>(std::move(socket), clients)->read();
}

}  // namespace meniscus
