// SPDX-License-Identifier: BSD-3-Clause
// What is said over the picture: what takes long, what is wrong, and the last word.

let working = null;  // what takes long, and since when
let stays = true;    // does what is said stay until another takes its place by say_anew()?
say("The first picture …", { is_error: false });
setInterval(() => { if (working) say_working(working.what); }, 1000);

export const is_working = () => working !== null;

/// What takes long, and how long it has by now.
export function say_working(what) {
  const now = performance.now();
  if (!working) say(`${what} …`, { is_error: false });
  stays = true;
  if (working?.what !== what) working = { what, since: now };
  const seconds = Math.floor((now - working.since) / 1000);
  if ($("message").textContent !== `${what} …`) $("message").textContent = `${what} …`;
  $("message").dataset.seconds = seconds < 1 ? "" : ` ${seconds} s`;  // which nobody wants to hear each time
}

/// Says a sentence over the picture for some seconds, or until another takes its place by say_anew().
export function tell(text, is_error = false, for_good = false) {
  if (stays && ($("message").classList.contains("error") || !is_error)) return;
  stays = for_good;
  say(text, { is_error, seconds: for_good ? 0 : 6 });
}

/// Nothing takes long any more, and the text takes the place of one that stays.
export function say_anew(text, is_error = false, for_good = false) {
  working = null;
  stays = false;
  tell(text, is_error, for_good);
}

/// Says what is wrong, until something else is done.
export function say_fault(text) {
  say_anew("");
  say(text);
}

/// What was wrong is of no interest any more.
export function forget_fault() {
  if ($("message").classList.contains("error") && !stays) $("message").hidden = true;
}

/// Returns what an error says, without the words of its command and its property, the folder of a file that was handed over, and
/// advice for a command line, which are a program's and no reader's.
export const sentence_of = (error, word = "open") => error.replace(new RegExp(`^${word}: ([a-z]+\\.[a-z_]+: )?`), "")
  .replace(/\/\S*\/meniscus-[0-9a-f]{32}\//g, "").replace("add --trajectory with a file that has them", "open its trajectory together with it")
  .replace(/; [^;]*--[a-z][^;]*$/, "").replace(/--(?=[a-z])/g, "");
