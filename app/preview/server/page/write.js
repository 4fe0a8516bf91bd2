// SPDX-License-Identifier: BSD-3-Clause
// Writes pictures, films, scenes and files into the program's folder, from which this browser can download them.
import { element } from "./figure.js";
import { hex_of } from "./properties.js";

const kEndings = { film: ".mp4", povray: "", blender: ".mns", scene: ".json", story: ".json", camera_path: ".json" };
const kFilms = { strip: "Strip", turntable: "Turntable", frames: "Frames" };

/// picture() returns the PNG on the stage if it has full quality; changed() is called after something was written.
/// Returns show(state), and begin(), which shows an export that an earlier page has begun.
export function write_controls({ command, ask, say, picture, changed }) {
  let state = null;
  let offered = "";  // the values on which the list of films depends
  let taken = "";    // the sizes that a scene requested

  /// Returns the size and the number of samples that the fields ask for.
  const wishes = () => {
    const [width, height, samples] = ["width", "height", "export-samples"].map((id) => $(id).valueAsNumber), ratio = state.width / state.height;
    const sides = { width: width || Math.max(16, Math.round(height * ratio)), height: height || Math.max(16, Math.round(width / ratio)) };
    return { samples: samples || state.values["image.samples"], transparent: $("export-transparent").checked, ...((width || height) && sides) };
  };

  /// Lists the films that can be made, with the number of pictures of each.
  const offer_films = async () => {
    const { width, height } = wishes(), told = await ask({ command: "films", ...(width && { width, height }) });
    if (!told.ok) return;
    const before = $("film-of").options[0]?.value, chosen = $("film-of").value;
    $("film-of").replaceChildren(...told.films.map(({ of, seconds, pictures }) => {
      const words = `${kFilms[of]}: ${Number(seconds.toFixed(1))} s`;
      return Object.assign(new Option(words, of), { title: `${pictures} pictures of ${told.width} × ${told.height} pixels` });
    }));
    const kept = told.films.some(({ of }) => of === chosen) && before === told.films[0].of;
    $("film-of").value = kept ? chosen : told.films[0].of;
  };
  for (const id of ["width", "height"]) $(id).addEventListener("change", offer_films);

  /// Lists the written files with a link to each, and their folder.
  const list_written = (written = []) => $("written").replaceChildren(...written.map(({ name, path, folder }) => element("li", {},
    folder ? element("span", { textContent: name, title: path }) : element("a", { href: `files/${name}`, download: name, textContent: name, title: path }))));

  /// Asks for the progress of the export, and lists the written files.
  const ask_written = async () => {
    const told = await ask({ command: "export_state" });
    list_written(told.written);
    return told;
  };

  $("write").addEventListener("submit", async (event) => {
    event.preventDefault();
    const format = event.submitter?.value ?? "png", path = $("export-name").value + (kEndings[format] ?? $("ending").value);
    const values = { path, force: $("export-force").checked, ...wishes() };
    // The browser already has the picture that is shown.
    const at_hand = path.endsWith(".png") && !$("width").value && !$("height").value && !$("export-samples").value && !values.transparent ? picture() : null;
    const more = format === "film" ? { of: $("film-of").value } : { archive: format === "povray" };
    const reply = await (format === "scene" || format === "story" ? command("save", { ...values, strip: format === "story" })
      : command("export", { format, wait: false, ...values, ...more }));
    if (!reply) return;
    if (at_hand) download(at_hand, path);
    if (reply.running) return follow();
    changed();
    await ask_written();
    say(`Written: ${reply.path}`);
  });
  $("ending").addEventListener("change", () => { $("save").textContent = `Save ${$("ending").selectedOptions[0].text}`; });
  $("open-scene").addEventListener("click", async () => {
    const name = $("export-name").value;
    const reply = await command("open", { path: /\.(json|png|tiff?|jpe?g|html)$/.test(name) ? name : `${name}.json` });
    if (reply) say(`Opened: ${reply.path}`);
  });
  $("job-cancel").addEventListener("click", () => command("cancel_export"));

  /// Shows the progress of the export until it is done; the view can be turned meanwhile.
  async function follow() {
    const buttons = document.querySelectorAll("#writers button");
    for (const button of buttons) button.disabled = true;
    let told = { running: true };
    while (told.running) {
      told = await ask_written();
      $("job").hidden = !told.running;
      $("job-text").textContent = `Writing ${told.path?.split("/").pop() ?? ""}: ${told.stage ?? "begin"}, ${Math.round(told.seconds ?? 0)} s`;
      $("job-share").value = told.share ?? 0;
      if (told.running) await new Promise((resolve) => setTimeout(resolve, 250));
    }
    for (const button of buttons) button.disabled = false;
    changed();
    if (told.error) say(told.error.replace(/^export: /, ""), true);
    else if (told.path) say([`Written: ${told.path}`, told.note, told.render_with && `render it with: ${told.render_with}`].filter(Boolean).join("; "));
  }

  $("copy-command").addEventListener("click", async () => {
    const reply = await command("render_command", wishes());
    if (!reply) return;
    $("command-text").value = reply.text;
    $("command-text").hidden = false;
    $("command-text").select();
    const copied = await navigator.clipboard?.writeText(reply.text).then(() => true, () => false);
    say(copied ? "The command is copied." : "Here it is, to be copied.");
  });

  const show = (next) => {
    state = next;
    const { export_size, values } = next, opaque = Boolean(hex_of(values["image.background"]));
    const told = JSON.stringify([export_size, export_size && values["image.samples"], opaque]), films = JSON.stringify([next.strip.kept, next.frames, next.fps, next.width, next.height]);
    if (told !== taken) {
      const asked = export_size ? [...export_size, values["image.samples"]] : ["", "", ""];
      ["width", "height", "export-samples"].forEach((id, n) => { $(id).value = asked[n]; });
      $("export-transparent").checked = !opaque;
    }
    if (films !== offered || told !== taken) offer_films();
    $("save-story").hidden = next.strip.scenes === 0;
    taken = told;
    offered = films;
  };
  const begin = async () => { if ((await ask_written()).running) follow(); };
  return { show, begin };
}
