// SPDX-License-Identifier: BSD-3-Clause
// The strip: scenes that are kept for a film, and the way from each to the next.
import { element, remove_button } from "./figure.js";

const $ = (id) => document.getElementById(id);
const kRate = 24;  // pictures a second

/// Shows the kept scenes; command(word, values) changes them. Returns show(state).
export function strip_controls({ command }) {
  let strip = { scenes: 0, place: 0, playing: false };
  let known = -1;  // how many scenes the list shows

  $("keep-scene").addEventListener("click", () => command("keep_scene"));
  $("strip").addEventListener("input", () => command("strip", { place: $("strip").valueAsNumber }));
  $("play-strip").addEventListener("click", async () => {
    if (strip.playing) return command("pause");
    // At its end it starts anew. Undo goes back to what was shown before the film.
    if (await command("strip", { place: strip.place < strip.scenes - 1 ? strip.place : 0 }))
      await command("play", { strip: true, fps: kRate });
  });

  const scenes = () => Array.from({ length: strip.scenes }, (_, index) => {
    const button = element("button", { type: "button", className: "recall", textContent: `Scene ${index + 1}` });
    button.addEventListener("click", () => command("strip", { place: index }));
    return element("li", {}, button, remove_button(`scene ${index + 1}`, () => command("forget_scene", { index })));
  });

  return (state) => {
    strip = state.strip;
    if (strip.scenes !== known) {
      known = strip.scenes;
      $("scenes").replaceChildren(...scenes());
    }
    $("play-strip").disabled = strip.scenes < 2;
    $("play-strip").textContent = strip.playing ? "Pause film" : "Play film";
    $("strip").hidden = strip.scenes < 2;
    $("strip").max = Math.max(strip.scenes - 1, 1);
    if ($("strip") !== document.activeElement || strip.playing) $("strip").value = strip.place;
  };
}
