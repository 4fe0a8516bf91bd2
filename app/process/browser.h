// SPDX-License-Identifier: BSD-3-Clause
// Opens an address in the user's browser.
#pragma once

#include <functional>
#include <string>

namespace meniscus {

/// Has the address opened by the program that BROWSER names, or else by the one that the desktop has for it, without a
/// shell. The browser goes on when this program ends. If none can be opened, `failed` is called with the reason, such
/// as "there is no display": on this thread or, later, on another one.
void open_in_browser(const std::string& address, std::function<void(const std::string& reason)> failed);

}  // namespace meniscus
