// SPDX-License-Identifier: BSD-3-Clause
// Controls of the strip: scenes that are kept for a film, and the transition from each to the next.
import { element, remove_button } from "./figure.js";

const kThumb = 112;  // pixels across a small picture

/// Returns a small picture of the stage.
async function thumbnail(viewer) {
  const [width, height] = viewer.pixels(), size = [kThumb, Math.max(1, Math.round(kThumb * height / width))];
  const canvas = element("canvas", { width: size[0], height: size[1] });
  const source = viewer.pictures ? viewer.pictures.canvas : await createImageBitmap(await draw_png(viewer, size, () => {}));
  canvas.getContext("2d").drawImage(source, 0, 0, ...size);
  return canvas;
}

/// Shows the kept scenes. Returns show(state).
export function strip_controls({ command, viewer }) {
  let strip = { scenes: 0, place: 0, playing: false, kept: [] };
  let known = "";  // the numbers of the scenes in the list
  const thumbs = new Map();  // small pictures by the numbers of their scenes

  /// Keeps a small picture of the scene that the stage shows.
  const take = async (number) => {
    thumbs.set(number, await thumbnail(viewer()));
    known = "";
    show_list();
  };
  const keep = async (values) => {
    const reply = await command("keep_scene", values);
    if (reply) take(reply.number);
  };
  /// Shows a scene. A page that was loaded again takes its small picture once the stage shows it at rest.
  const recall = async (index, number) => {
    if (!await command("strip", { place: index }) || thumbs.has(number)) return;
    const wait = setInterval(() => {
      if ($("picture").dataset.rest !== "true") return;
      clearInterval(wait);
      if (strip.place === index && strip.kept[index]?.number === number) take(number);
    }, 200);
  };

  $("keep-scene").addEventListener("click", () => keep());
  $("strip").addEventListener("input", () => command("strip", { place: $("strip").valueAsNumber }));
  $("play-strip").addEventListener("click", async () => {
    if (strip.playing) return command("pause");
    // At its end the film begins again. Undo goes back to the view before the film.
    if (await command("strip", { place: strip.place < strip.scenes - 1 ? strip.place : 0 }))
      await command("play", { strip: true });
  });

  /// Returns a field for a time of a scene in seconds.
  const seconds = (index, what, words) => {
    const field = element("input", { type: "number", min: 0, max: 3600, step: "any", name: what });
    field.addEventListener("change", () => command("time_scene", { index, [what]: field.valueAsNumber }));
    return element("label", {}, words, field);
  };
  const scene = ({ number }, index) => {
    const name = `Scene ${index + 1}`;
    const show = element("button", { type: "button", className: "recall" }, ...(thumbs.has(number) ? [thumbs.get(number)] : []), name);
    show.addEventListener("click", () => recall(index, number));
    const replace = element("button", { type: "button", textContent: "Replace", title: "By what is shown now" });
    replace.addEventListener("click", () => keep({ index }));
    return element("li", {}, show, replace, remove_button(name, () => command("forget_scene", { index })),
      seconds(index, "hold", "Seconds"), ...(index + 1 < strip.scenes ? [seconds(index, "transition", "To the next")] : []));
  };

  function show_list() {
    const numbers = strip.kept.map(({ number }) => number).join();
    if (numbers !== known) $("scenes").replaceChildren(...strip.kept.map(scene));
    known = numbers;
    for (const [index, item] of [...$("scenes").children].entries())
      for (const field of item.querySelectorAll("input"))
        if (field !== document.activeElement) field.value = strip.kept[index][field.name];
  }

  return (state) => {
    strip = state.strip;
    show_list();
    $("play-strip").disabled = strip.scenes < 2;
    $("play-strip").textContent = strip.playing ? "Pause film" : "Play film";
    $("strip").hidden = strip.scenes < 2;
    $("strip").max = Math.max(strip.scenes - 1, 1);
    if ($("strip") !== document.activeElement || strip.playing) $("strip").value = strip.place;
  };
}
