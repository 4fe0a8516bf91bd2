// SPDX-License-Identifier: BSD-3-Clause
// Handles the keys that need the program; the stage handles the keys of the camera itself. Letters are matched as typed,
// in either case, so that they follow the user's keyboard.

const kFast = 1000;  // ms between steps that follow each other
const kUsual = { "look.ambient_occlusion": 1, "look.silhouettes": 1.5 };
// These have no number: not every molecule has them, and kinds of patch have a key of their own.
const kUnnumbered = ["auto", "kind", "copy", "model"];

/// The keys and what they do, for the list of keys.
export const key_help = [
  ["click", "select the atom; twice: its residue, three times: its chain"], ["Shift and click", "select one more"],
  ["Escape", "select nothing"], ["Z  Y", "undo, redo"], ["[  ]", "probe radius by 0.1 \u00c5"], ["1 2 3 ...", "colour scheme"],
  ["K", "colour by kind of patch"], ["A", "shade"], ["L", "lines"], ["G", "legend in pictures"], ["E", "name what is written"]];

/// True if lines are drawn around what a state shows.
const has_lines = ({ values }) => ["silhouettes", "outer_lines", "inner_lines", "part_lines"].some((line) => values[`look.${line}`] > 0);

/// Returns press(key), which does what the key means, and returns false for keys without a meaning. state() is what the
/// program shows, schemes() the words of the colour schemes, name() goes to the name of what is written.
export function program_keys({ command, set, set_scheme, state, schemes, name }) {
  const values = () => state().values;
  const flip = (key, is_on) => set(key, is_on ? 0 : kUsual[key]);
  const last = {};  // what the keys have set, and when
  /// Returns the next value of a step by a key. Fast steps follow each other, for states of before them may come later.
  const go_on = (name, told, step) => {
    const now = performance.now(), value = step(now - last[name]?.at < kFast ? last[name].value : told);
    last[name] = { value, at: now };
    return value;
  };
  const step_probe = (tenths) => {
    const { "surface.kind": kind, "surface.probe": told } = values();
    if (kind !== "vdw") set("surface.probe", go_on("probe", told, (radius) => Math.max(0, Math.round(10 * radius + tenths) / 10)));
  };
  const step_frame = (step) => {
    const { frame: told, frames } = state();
    if (frames > 1) command("frame", { index: go_on("frame", told, (frame) => (frame + step + frames) % frames) });
  };
  const acts = {
    z: () => { if (state().undo > 0) command("undo"); },
    y: () => { if (state().redo > 0) command("redo"); },
    "[": () => step_probe(-1),
    "]": () => step_probe(1),
    k: () => set("surface.color", values()["surface.color"][0] === "kind" ? "auto" : "kind"),
    a: () => flip("look.ambient_occlusion", values()["look.ambient_occlusion"] > 0),
    l: () => flip("look.silhouettes", has_lines(state())),
    g: () => set("legend.shown", !values()["legend.shown"]),
    e: name,
    " ": () => { if (state().frames > 1) command(state().playing ? "pause" : "play"); },
    ",": () => step_frame(-1),
    ".": () => step_frame(1),
  };
  return (key) => {
    const scheme = /^[1-9]$/.test(key) && schemes().filter((word) => !kUnnumbered.includes(word))[key - 1];
    const act = scheme ? () => set_scheme(scheme) : acts[key.toLowerCase()];
    if (act) act();
    return Boolean(act);
  };
}
