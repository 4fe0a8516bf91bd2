// SPDX-License-Identifier: BSD-3-Clause
// Shows progress, errors and short notices over the picture.

let working = null;  // the task in progress, and when it began
let stays = true;    // true if the notice stays until say_anew() replaces it
say("The first picture …", { is_error: false });
setInterval(() => { if (working) say_working(working.what); }, 1000);

export const is_working = () => working !== null;

/// Shows the task in progress and its seconds so far.
export function say_working(what) {
  const now = performance.now();
  if (!working) say(`${what} …`, { is_error: false });
  stays = true;
  if (working?.what !== what) working = { what, since: now };
  const seconds = Math.floor((now - working.since) / 1000);
  if ($("message").textContent !== `${what} …`) $("message").textContent = `${what} …`;
  $("message").dataset.seconds = seconds < 1 ? "" : ` ${seconds} s`;  // outside the text, so that screen readers do not repeat it
}

/// Shows a sentence over the picture for some seconds, or until say_anew() replaces it.
export function tell(text, is_error = false, for_good = false) {
  if (stays && ($("message").classList.contains("error") || !is_error)) return;
  stays = for_good;
  say(text, { is_error, seconds: for_good ? 0 : 6 });
}

/// Ends the task in progress and replaces a notice that stays.
export function say_anew(text, is_error = false, for_good = false) {
  working = null;
  stays = false;
  tell(text, is_error, for_good);
}

/// Shows an error until the reader does something else.
export function say_fault(text) {
  say_anew("");
  say(text);
}

/// Removes an error that no longer matters.
export function forget_fault() {
  if ($("message").classList.contains("error") && !stays) $("message").hidden = true;
}

/// Returns an error's text without its command and property, the folder of a received file, and advice for shells.
export const sentence_of = (error, word = "open") => error.replace(new RegExp(`^${word}: ([a-z]+\\.[a-z_]+: )?`), "")
  .replace(/\/\S*\/meniscus-[0-9a-f]{32}\//g, "").replace("add --trajectory with a file that has them", "open its trajectory together with it")
  .replace(/; [^;]*--[a-z][^;]*$/, "").replace(/--(?=[a-z])/g, "");
