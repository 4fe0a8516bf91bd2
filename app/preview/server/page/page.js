// SPDX-License-Identifier: BSD-3-Clause
// The page: input becomes commands, pictures become pixels, and the controls show what the server says.
import { Connection } from "./connection.js";
import { follow_lamp, place_lamp } from "./lamp.js";
import { follow_pointer, follow_keys } from "./motion.js";

const $ = (id) => document.getElementById(id);
const canvas = $("picture"), stage = $("stage");
const numbered = new Set();  // colour schemes that take a map
const strengths = ["ambient_occlusion", "silhouettes", "depth_cue"];  // of the look, each with a slider
let state = null;      // what the server shows
let controls = false;  // does this page decide?
let shown = null;      // the message of the picture in the canvas
let full_picture = null;  // its PNG, if it is full
let outstanding = 0;   // commands without a reply
let newest = 0;        // the revision of the latest reply

const server = new Connection({
  picture: show_picture,
  welcome: (message) => { set_role(message.controls); server.ask({ command: "choices" }).then(fill_choices); fit(); },
  role: (message) => { set_role(message.controls); fit(); },
  error: (message) => { apply_state(message.state); say(message.error, true); },
  ended: (message) => { say(message.error ?? "The preview has ended.", Boolean(message.error), true); },
  lost: () => { say("The connection to the preview is lost.", true, true); },
});

/// Carries out a command; a refusal is said. Returns the reply, or null.
async function command(word, values = {}) {
  ++outstanding;
  note_rest();
  const reply = await server.ask({ command: word, ...values });
  --outstanding;
  newest = reply.revision ?? newest;
  note_rest();
  if (!reply.ok && reply.error) say(reply.error, true);
  return reply.ok ? reply : null;
}

/// At rest the canvas shows, in full, what all commands came to.
const is_at_rest = () => Boolean(shown?.full) && outstanding === 0 && shown.state.revision >= newest;
function note_rest() { canvas.dataset.rest = String(is_at_rest()); }

// Messages

let message_timer = 0;
function say(text, is_error = false, stays = false) {
  const box = $("message");
  if (box.classList.contains("stays")) return;
  box.textContent = text;
  box.classList.toggle("error", is_error);
  box.classList.toggle("stays", stays);
  box.hidden = false;
  clearTimeout(message_timer);
  if (!stays) message_timer = setTimeout(() => { box.hidden = true; }, 6000);
  if (stays) $("controls").disabled = true;
}

function set_role(in_control) {
  controls = in_control;
  $("role").hidden = controls;
  $("controls").disabled = !controls;
}

// Pictures

async function show_picture(message, bytes) {
  const blob = new Blob([bytes], { type: message.type });
  const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none" });
  const { width, height } = message.state;
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d", { alpha: false });
  context.imageSmoothingQuality = "high";
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  full_picture = message.full ? blob : null;
  shown = message;
  note_rest();
  canvas.dataset.state = JSON.stringify(message.state);
  canvas.dataset.pictures = String(Number(canvas.dataset.pictures ?? 0) + 1);
  show_stats(message.stats, message.full);
  apply_state(message.state);
}

let moving = "";  // pictures a second, of the last one that was not full
function show_stats(stats, full) {
  const ms = (value) => `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`;
  if (!full) moving = `${stats.fps < 10 ? stats.fps.toFixed(1) : Math.round(stats.fps)} fps`;
  const rest = full ? `full picture in ${ms(stats.frame_milliseconds)}` : "";
  $("fps").textContent = [moving, rest].filter(Boolean).join(" · ");
  fill_list($("stages"), [...stats.stages.map((stage) => [stage.name, ms(stage.milliseconds)]),
    ["encoding", ms(stats.encode_milliseconds)]]);
}

/// Rows of term and text.
function fill_list(list, rows) {
  list.replaceChildren(...rows.flatMap(([term, text]) => {
    const [dt, dd] = [document.createElement("dt"), document.createElement("dd")];
    dt.textContent = term;
    dd.textContent = text;
    return [dt, dd];
  }));
}

/// The server draws as many pixels as the canvas has on this screen.
function fit() {
  if (!controls) return;
  const scale = Math.min(window.devicePixelRatio || 1, 2);
  const side = (length) => Math.min(4096, Math.max(16, Math.round(length * scale)));
  const [width, height] = [side(stage.clientWidth), side(stage.clientHeight)];
  if (state && state.width === width && state.height === height) return;
  command("resize", { width, height });
}
new ResizeObserver(fit).observe(stage);

// State

/// Unless somebody is at it: what is typed, or dragged ahead of the pictures, stays.
function set_value(element, value) {
  if (element !== document.activeElement || (element.type === "range" && outstanding === 0)) element.value = value;
}

function apply_state(next) {
  state = next;
  const name = next.file.split("/").pop();
  document.title = `${name} · Meniscus`;
  $("file").textContent = `${name}, ${next.atoms.toLocaleString("en")} atoms`;
  set_value($("probe"), next.probe_radius);
  set_value($("probe-number"), Number(next.probe_radius.toFixed(3)));
  set_value($("scheme"), next.color.scheme);
  set_value($("map"), next.color.map ?? "");
  $("map-row").hidden = !numbered.has(next.color.scheme);
  $("kinds").checked = next.patch_kinds;
  $("kinds-key").hidden = !(next.patch_kinds || next.color.scheme === "kind");
  set_value($("projection"), next.camera.projection);
  set_value($("background"), next.look.background);
  stage.style.background = next.look.background;
  for (const key of strengths) set_value($(key), next.look[key]);
  place_lamp($("lamp"), next.look.light_direction);
  $("frames").hidden = next.frames < 2;
  $("frame").max = next.frames - 1;
  set_value($("frame"), next.frame);
  $("frame-number").textContent = `${next.frame + 1} of ${next.frames}`;
  $("play").textContent = next.playing ? "Pause" : "Play";
  $("key").textContent = is_key(next) ? "Remove key" : "Set key";
  $("save-path").disabled = next.keys.length === 0;
  $("follow").checked = next.follow_keys;
}

function fill_choices(choices) {
  if (!choices.ok) return;
  for (const { word, has_map, description } of choices.schemes) {
    const option = new Option(word, word);
    option.title = description;
    $("scheme").add(option);
    if (has_map) numbered.add(word);
  }
  $("map").add(new Option("its own", ""));
  for (const map of choices.maps) $("map").add(new Option(map, map));
  if (state) apply_state(state);
}

// Controls

const set_probe = (radius) => {
  if (Number.isFinite(radius)) command("probe", { radius: Math.round(radius * 1000) / 1000 });
};
$("probe").addEventListener("input", (event) => set_probe(event.target.valueAsNumber));
$("probe-number").addEventListener("change", (event) => set_probe(event.target.valueAsNumber));

const set_color = () => {
  const scheme = $("scheme").value, map = $("map").value;
  command("color", numbered.has(scheme) && map ? { scheme, map } : { scheme }).then((reply) => reply ?? apply_state(state));
};
$("scheme").addEventListener("change", set_color);
$("map").addEventListener("change", set_color);
$("kinds").addEventListener("change", (event) => command("patch_kinds", { on: event.target.checked }));
$("projection").addEventListener("change", (event) => command("projection", { projection: event.target.value }));
$("background").addEventListener("input", (event) => command("look", { background: event.target.value }));
for (const key of strengths)
  $(key).addEventListener("input", (event) => command("look", { [key]: event.target.valueAsNumber }));
follow_lamp($("lamp"), (light_direction) => { if (controls) command("look", { light_direction }); });
$("reset").addEventListener("click", () => command("reset_view"));
$("zoom-form").addEventListener("submit", async (event) => {
  event.preventDefault();
  const reply = await command("zoom_to", { selection: $("selection").value });
  if (reply) say(`${reply.atoms.toLocaleString("en")} atoms`);
});
$("frame").addEventListener("input", (event) => command("frame", { index: event.target.valueAsNumber }));
const is_key = ({ keys, frame_number }) => keys.some((key) => key.frame === frame_number);
const toggle_playing = () => state?.playing ? command("pause") : command("play", { fps: $("rate").valueAsNumber || 10 });
$("play").addEventListener("click", () => toggle_playing().then((reply) => {
  if (reply) apply_state({ ...state, playing: Boolean(reply.playing) });
}));
$("key").addEventListener("click", () => command("key", { on: !is_key(state) }));
$("follow").addEventListener("change", (event) => command("follow_keys", { on: event.target.checked }));
$("rate").addEventListener("change", () => { if (state?.playing) command("play", { fps: $("rate").valueAsNumber || 10 }); });

// Atoms under the cursor

const area_text = (area) => area === null ? "area …" : `${area.toFixed(2)} Å² exposed`;
let hovered = 0;  // number of the latest hover; older answers are late

async function hover(pixel, place) {
  const number = ++hovered;
  const tip = $("tip");
  if (!pixel || !is_at_rest()) { tip.hidden = true; return; }
  const found = await server.ask({ command: "pick", ...pixel, wait: false });
  if (number !== hovered) return;
  tip.hidden = !(found.ok && found.hit);
  if (tip.hidden) return;
  tip.children[0].textContent = found.place;
  tip.children[1].textContent = `${found.kind} patch · ${area_text(found.exposed_area)}`;
  const left = Math.min(place.x + 14, stage.clientWidth - tip.offsetWidth - 8);
  const top = Math.min(place.y + 16, stage.clientHeight - tip.offsetHeight - 8);
  tip.style.transform = `translate(${Math.max(left, 0)}px, ${Math.max(top, 0)}px)`;
  if (found.exposed_area === null) setTimeout(() => { if (number === hovered) hover(pixel, place); }, 300);
}

async function pick(pixel) {
  if (!controls) return;
  const found = await command("pick", pixel);
  const rows = found?.hit ? [
    ["place", found.place], ["element", found.element], ["patch", found.kind],
    ["exposed", `${found.exposed_area.toFixed(3)} Å²`], ["position", found.position.map((x) => x.toFixed(2)).join(", ")],
  ] : [];
  $("picked").hidden = rows.length === 0;
  fill_list($("picked").querySelector("dl"), rows);
}

follow_pointer(canvas, { command: (...values) => { if (controls) command(...values); }, hover, pick });

// Saving

function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const stem = () => state.file.split("/").pop().replace(/\.[^.]*$/, "").replace(/[^A-Za-z0-9_-]+/g, "_") || "view";
const save_picture = () => is_at_rest() ? download(full_picture, `${stem()}.png`) : say("One moment: the picture is not finished.");
$("save-png").addEventListener("click", save_picture);
$("save-camera").addEventListener("click", () => {
  download(new Blob([JSON.stringify(state.camera, null, 2) + "\n"], { type: "application/json" }), `${stem()}_camera.json`);
});
$("save-path").addEventListener("click", () => {
  download(new Blob([JSON.stringify({ keys: state.keys }, null, 2) + "\n"], { type: "application/json" }), `${stem()}_camera_path.json`);
});
$("export-form").addEventListener("submit", async (event) => {
  event.preventDefault();
  const format = event.submitter?.value ?? "png";
  const ending = { png: ".png", povray: "", blender: ".mns" }[format];
  const reply = await command("export", { format, path: $("export-name").value + ending, force: $("export-force").checked });
  if (reply) say(`Written: ${reply.path}`);
});

// Keys

follow_keys({
  orbit: (dx, dy) => command("orbit", { dx, dy }),
  zoom: (factor) => command("zoom", { factor }),
  probe: (step) => set_probe(Math.min(100, Math.max(0, state.probe_radius + step))),
  kinds: () => command("patch_kinds", { on: !state.patch_kinds }),
  projection: () => command("projection", { projection: state.camera.projection === "perspective" ? "orthographic" : "perspective" }),
  reset: () => command("reset_view"),
  play: () => $("frames").hidden || $("play").click(),
  save: save_picture,
  panel: () => { document.body.classList.toggle("bare"); },
}, () => controls && state !== null);
