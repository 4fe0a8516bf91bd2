// SPDX-License-Identifier: BSD-3-Clause
// The socket: numbered questions with their replies, and one picture or figure at a time.

/// Resolves to "open" if the server accepts this page, "refused" if its token has changed, or "gone".
export const answers = () => fetch(location.href, { cache: "no-store" })
  .then((answer) => answer.ok ? "open" : "refused", () => "gone");

/// Calls handlers[event](message) for announcements of the server, and with the bytes as well for pictures and figures.
export class Connection {
  #socket;
  #handlers;
  #open;
  #announced = null;  // the message whose bytes come next
  #replies = new Map();
  #next = 1;
  #ended = false;

  constructor(handlers) {
    this.#handlers = handlers;
    const address = new URL("socket", location.href);
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    this.#socket = new WebSocket(address);
    this.#socket.binaryType = "arraybuffer";
    this.#open = new Promise((resolve) => this.#socket.addEventListener("open", resolve));
    this.#socket.addEventListener("message", (event) => this.#receive(event.data));
    this.#socket.addEventListener("close", () => this.#close());
  }

  /// Sends a command; the promise resolves to its reply.
  async ask(command) {
    await this.#open;
    const id = this.#next++;
    return new Promise((resolve) => {
      this.#replies.set(id, resolve);
      this.#socket.send(JSON.stringify({ id, ...command }));
    });
  }

  /// Sends a request to the server itself, which does not reply.
  request(what, values = {}) {
    if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify({ request: what, ...values }));
  }

  #receive(data) {
    if (typeof data !== "string") return this.#handlers[this.#announced.event](this.#announced, data);
    const message = JSON.parse(data);
    if (message.event === "picture" || (message.event === "figure" && !message.unavailable)) this.#announced = message;
    else if (message.event) this.#tell(message);
    else {
      this.#replies.get(message.id)?.(message);
      this.#replies.delete(message.id);
    }
  }

  async #tell(message) {
    this.#ended ||= message.event === "ended";
    await this.#handlers[message.event]?.(message);
    if (message.event === "welcome") this.request("picture");
  }

  #close() {
    for (const resolve of this.#replies.values()) resolve({ ok: false });
    this.#replies.clear();
    if (!this.#ended) this.#handlers.lost();
  }
}
