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
  return next_number++;
}

void Clients::leave(ClientNumber client) {
  const bool controlled = controls(client);
  if (sockets.erase(client) == 0) return;
  mailbox.forget(client);
  if (controlled && !sockets.empty())
    sockets.begin()->second->send(text_message(json_line({{"event", "role"}, {"controls", true}})));
}

OutgoingMessage text_message(const std::string& text) {
  return {std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end()), true};
}

}  // namespace meniscus
