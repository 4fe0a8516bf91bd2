// SPDX-License-Identifier: BSD-3-Clause
// Who comes, who goes, and who controls then.
#include "app/preview/server/clients.h"

#include <utility>

#include "app/preview/command_json.h"
#include "app/preview/server/limits.h"

namespace meniscus {

bool Clients::full() const { return sockets.size() >= kMostClients; }

ClientNumber Clients::join(std::shared_ptr<Client> client) {
  sockets.emplace(next_number, std::move(client));
  if (controller == 0) controller = next_number;
  return next_number++;
}

void Clients::give_control(ClientNumber client) {
  const auto tell = [this](ClientNumber who, bool controls_now) {
    const auto found = sockets.find(who);
    if (found != sockets.end())
      found->second->send(text_message(json_line({{"event", "role"}, {"controls", controls_now}})));
  };
  if (controls(client)) return;
  tell(std::exchange(controller, client), false);
  tell(client, true);
}

void Clients::leave(ClientNumber client) {
  const bool controlled = controls(client);
  if (sockets.erase(client) == 0) return;
  mailbox.forget(client);
  if (!controlled) return;
  controller = 0;
  if (!sockets.empty()) give_control(sockets.begin()->first);
}

OutgoingMessage text_message(const std::string& text) {
  return {std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end()), true};
}

}  // namespace meniscus
