// SPDX-License-Identifier: BSD-3-Clause
// Handles keys that need the program; the stage handles the keys of the camera. Letters are matched as typed, in either
// case, so that they follow the user's keyboard.

const kFast = 1000;  // longest time in ms between the steps of a series
const kUsual = { "look.ambient_occlusion": 1, "look.silhouettes": 1.5 };
// These schemes have no number key, because not every molecule has them, and kinds of patch have their own key.
const kUnnumbered = ["auto", "kind", "copy", "model"];

/// Rows of the list of keys: the key and its effect.
export const key_help = [
  ["click", "select the atom; twice: its residue, three times: its chain"], ["Shift and click", "select one more"],
  ["Escape", "select nothing"], ["Z  Y", "undo, redo"], ["[  ]", "probe radius by 0.1 \u00c5"], ["1 2 3 ...", "colour scheme"],
  ["K", "colour by kind of patch"], ["A", "shade"], ["L", "lines"], ["G", "legend in pictures"], ["E", "name what is written"]];

/// Returns true if a state shows silhouettes or other lines.
const has_lines = ({ values }) => ["silhouettes", "outer_lines", "inner_lines", "part_lines"].some((line) => values[`look.${line}`] > 0);

/// Returns press(key), which does what the key means, and returns false for keys without a meaning. state() returns the
/// program's state, schemes() the words of the colour schemes; name() focuses the name of the output.
export function program_keys({ command, set, set_scheme, state, schemes, name }) {
  const values = () => state().values;
  const flip = (key, is_on) => set(key, is_on ? 0 : kUsual[key]);
  const last = {};  // the values that keys have set, and the times
  /// Returns the next value of a step by a key. Fast steps build on each other, as states may arrive late.
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
