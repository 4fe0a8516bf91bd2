// SPDX-License-Identifier: BSD-3-Clause
// What the program adds to the stage: its sections, and commands from input; pictures and state from what it says.
import { answers, Connection } from "./connection.js";
import { figure_controls } from "./figure.js";
import { follow_lamp, place_lamp } from "./lamp.js";
import { Pictures } from "./pictures.js";
import { property_controls } from "./properties.js";
import { strip_controls } from "./strip.js";

const $ = element;
place_sections();
remember_sections(["cutting", "viewing"]);

const canvas = $("picture"), stage = $("stage");
const numbered = new Set();  // colour schemes that take a map
let viewer = null;     // from the first state on
let state = null;      // what the program shows
let told_states = 0;   // how many states were asked for and told
let controls = false;  // does this page decide?
let shown = null;      // the message of the picture in the canvas
let full_picture = null;  // its PNG, if it is full
let outstanding = 0;   // commands without a reply
let newest = 0;        // the revision of the latest reply
let actions = null;    // of keys which are the page's, by their names

const server = new Connection({
  picture: show_program_picture,
  welcome: async (message) => {
    set_role(message.controls);
    server.ask({ command: "choices" }).then(fill_choices);
    server.ask({ command: "export_state" }).then((told) => { if (told.running) follow_export(); });
    await fit();  // before a picture is asked for, which would have another size
  },
  role: (message) => { set_role(message.controls); fit(); },
  progress: (message) => say_working(message.what),
  error: (message) => { apply_state(message.state); tell(message.error, true); },
  ended: (message) => { end(message.error ?? "The preview has ended.", Boolean(message.error)); },
  lost: () => {
    end("The connection to the preview is lost; trying again …", true);
    connect_again();
  },
});

/// The program's sections, each in its place of the stage.
function place_sections() {
  for (const part of $("program").content.children) {
    const { before, in: within } = part.dataset;
    if (before) $(before).before(...part.childNodes);
    else $(within).append(...part.childNodes);
  }
  $("about").hidden = true;
  $("controls").hidden = false;
  $("controls").disabled = true;
  $("write").noValidate = false;
}

const kStep = 700;  // ms without a command, after which the next is a step of its own for undo
const tells_only = new Set(["pick", "export", "export_state", "cancel_export", "save", "render_command", "end_step", "undo", "redo"]);
const changes_state = new Set(["key", "save_view", "forget_view", "keep_scene", "forget_scene", "play", "pause", "save"]);
let last_change = 0;

/// What an error says, without the words of its command and its property, which are a program's and no reader's.
const sentence_of = (error, word) => error.replace(new RegExp(`^${word}: ([a-z]+\\.[a-z_]+: )?`), "");

/// Carries out a command; a refusal is said, to the controls it came from if they can tell it. Returns the reply, or
/// null.
async function command(word, values = {}, refuse = (text) => tell(text, true)) {
  if (word !== "camera") tell_camera();
  if (!tells_only.has(word)) {
    const now = performance.now();
    if (now - last_change > kStep) server.ask({ command: "end_step" });
    last_change = now;
  }
  ++outstanding;
  note_rest();
  const reply = await server.ask({ command: word, ...values });
  --outstanding;
  newest = reply.revision ?? newest;
  note_rest();
  if (!reply.ok && reply.error) refuse(sentence_of(reply.error, word));
  else if (reply.ok && word !== "resize") forget_errors();
  if (reply.ok && reply.revision === undefined && changes_state.has(word)) ask_state();
  return reply.ok ? reply : null;
}

/// Sets a property; if that is refused the controls show again what there is.
const set = (key, value) => command("set", { key, value }).then((reply) => { if (!reply && state) apply_state(state); });

/// Asks the program what it has, with the camera that is seen here.
function ask(question) {
  tell_camera();
  return server.ask(question);
}

/// Shows what changed without a new picture.
async function ask_state() {
  const next = await server.ask({ command: "state" });
  if (!next.ok) return;
  ++told_states;
  apply_state(next);
}

/// At rest the stage shows, in full, what all commands came to.
const is_at_rest = () => Boolean(shown?.full) && outstanding === 0 && shown.state.revision >= newest;
function note_rest() { canvas.dataset.rest = String(is_at_rest()); }

$("take").addEventListener("click", () => server.request("control"));

// The camera, which moves here and is told to the program

let told_text = "";   // the camera that both have
let adopted = "";     // the program's, as it was told last
let flights = 0;      // cameras without a reply

/// The camera as files have it, in the molecule's coordinates.
function file_camera() {
  const { projection, vertical_fov, height, ...place } = told_camera(viewer.camera, viewer.figure.origin);
  return { ...place, projection, ...(projection === "perspective" ? { vertical_fov } : { height }) };
}

function tell_camera() {
  if (!viewer || !controls) return;
  const camera = file_camera(), text = JSON.stringify(camera);
  if (text === told_text) return;
  told_text = text;
  ++flights;
  command("camera", { camera }).then(() => { --flights; tell_camera(); });
}

/// Takes the program's camera, unless it has not heard of a newer one from here.
function adopt_camera({ camera, revision }) {
  const text = JSON.stringify(camera);
  if (text === adopted || flights > 0 || revision < newest || JSON.stringify(file_camera()) !== told_text) return;
  adopted = text;
  viewer.gliding = null;
  viewer.camera = page_camera(camera);
  told_text = JSON.stringify(file_camera());
  $("projection").value = projection_of(viewer.camera);
}

const page_camera = (camera, now = { fov: 30, height: 1 }, origin = [0, 0, 0]) =>
  asked_camera({ vertical_fov: now.fov, height: now.height, ...camera }, now, origin);

// Messages

let message_timer = 0;
let working = null;  // what is done before the first picture, and since when
let stays = true;    // does what is said stay until another takes its place by say_anew()?
const kAgain = "meniscus connected again";  // in the session's storage
say("The first picture …", { is_error: false });
setInterval(() => { if (working) say_working(working.what); }, 1000);

/// What takes long, and how long it has by now.
function say_working(what) {
  const now = performance.now();
  if (working?.what !== what) working = { what, since: now };
  const seconds = Math.floor((now - working.since) / 1000);
  if ($("message").textContent !== `${what} …`) $("message").textContent = `${what} …`;
  $("message").dataset.seconds = seconds < 1 ? "" : ` ${seconds} s`;  // which nobody wants to hear each time
}

/// Says a sentence over the picture for some seconds, or until another takes its place by say_anew().
function tell(text, is_error = false, for_good = false) {
  if (stays && ($("message").classList.contains("error") || !is_error)) return;
  stays = for_good;
  say(text, { is_error, seconds: for_good ? 0 : 6 });
}

/// What was wrong with an earlier command, once another one has worked.
function forget_errors() {
  if ($("message").classList.contains("error") && !stays) $("message").hidden = true;
  figure.forget_fault();
}

/// A fresh page, once the server answers again.
async function connect_again() {
  let answer = "gone";
  while (answer === "gone") {
    await new Promise((resolve) => setTimeout(resolve, 2000));
    answer = await answers();
  }
  if (answer === "refused")
    return end("The preview was started again under another address, which the terminal shows.", true);
  sessionStorage.setItem(kAgain, "yes");
  state = null;  // what is gone cannot be lost
  location.reload();
}

/// The last word.
function end(text, is_error) {
  working = null;
  say_anew("");
  tell(text, is_error, true);
  $("controls").disabled = true;
}

/// In place of one that stays.
function say_anew(text, is_error = false) {
  stays = false;
  allow_controls();
  tell(text, is_error);
}

function set_role(in_control) {
  controls = in_control;
  $("role").hidden = controls;
  allow_controls();
}

/// Sends the choice, once there is something to be changed.
function allow_controls() { $("controls").disabled = !controls || !state; }

// Pictures

const pictures = new Pictures($("pictures"), ask, () => state);

async function show_program_picture(message, bytes) {
  const blob = new Blob([bytes], { type: message.type }), before = told_states;
  await pictures.show(blob, message.state);
  if (message.balls) {
    say_working(`Computing the surface of ${message.state.atoms.toLocaleString("en")} atoms`);
  } else if (!shown || working) {
    working = null;
    say_anew(sessionStorage.getItem(kAgain) ? "Connected again." : "");
    sessionStorage.removeItem(kAgain);
  }
  full_picture = message.full ? blob : null;
  shown = message;
  note_rest();
  canvas.dataset.pictures = String(Number(canvas.dataset.pictures ?? 0) + 1);
  show_stats(message.stats, message.full);
  // What was told while the picture was being decoded is newer.
  if (told_states === before || message.state.revision > state.revision) apply_state(message.state);
}

$("times").addEventListener("toggle", () => { $("fps").hidden = !$("times").open; });

let moving = "";  // pictures a second, of the last one that was not full
function show_stats(stats, full) {
  const ms = (value) => `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`;
  if (!full && Number(canvas.dataset.pictures) > 2) moving = `${stats.fps < 10 ? stats.fps.toFixed(1) : Math.round(stats.fps)} a second`;
  const rest = full ? `full picture in ${ms(stats.frame_milliseconds)}` : "";
  $("fps").textContent = [moving, rest].filter(Boolean).join(" · ");
  const grown = stats.radii_grown_by > 0 ? [["radii grown for ties by up to", `${stats.radii_grown_by.toExponential(1)} \u00c5`]] : [];
  $("stages").replaceChildren(...rows_of([...grown, ...stats.stages.map((stage) => [stage.name, ms(stage.milliseconds)]),
    ["encoding", ms(stats.encode_milliseconds)]]));
}

/// Terms and texts of a list.
const rows_of = (rows) => rows.flatMap((row) => row.map((text, n) =>
  Object.assign(document.createElement(n === 0 ? "dt" : "dd"), { textContent: text })));

/// The server draws as many pixels as the canvas has on this screen.
function fit() {
  if (!controls) return;
  const scale = Math.min(window.devicePixelRatio || 1, 2);
  const side = (length) => Math.min(4096, Math.max(16, Math.round(length * scale)));
  const [width, height] = [side(stage.clientWidth), side(stage.clientHeight)];
  if (state && state.width === width && state.height === height) return;
  return command("resize", { width, height });
}
new ResizeObserver(fit).observe(stage);

// State

const context = { command, set, ask, say: (text, is_error) => tell(text, is_error), viewer: () => viewer };
const figure = figure_controls(context);
const properties = property_controls(set);
const show_strip = strip_controls(context);

/// Unless somebody is at it: what is typed, or dragged ahead of the pictures, stays.
function set_value(control, value) {
  if (control !== document.activeElement || (control.type === "range" && outstanding === 0)) control.value = value;
}

/// The stage begins with the program's pictures.
function begin(first) {
  const { size, ...others } = { size: [first.width, first.height], origin: [0, 0, 0], labels: [], schemes: [], samples: [], number: -1 };
  viewer = window.meniscus = new Viewer({ size, ...others, background: [1, 1, 1],
    views: [{ camera: page_camera(first.camera), planes: [], hatching: [], opacity: 1 }] }, pictures);
  viewer.rest = note_rest;
  viewer.changed = () => { if (flights === 0) tell_camera(); };
  viewer.picked = tell_of_atom;
  told_text = JSON.stringify(file_camera());
  follow_pointer(viewer);
  follow_keys(viewer, (key) => {
    if (!controls || !actions || (key.length > 1 && !key.startsWith("Arrow"))) return false;
    // At once: what is typed behind the key that opens a field is for the field, however late the session replies.
    if (actions[key.toLowerCase()] === "export") { document.body.classList.remove("bare"); $("export-name").focus(); $("export-name").select(); }
    else command("press", { key });
    return true;
  });
}

function apply_state(next) {
  const is_first = !state;
  state = next;
  if (is_first) { allow_controls(); begin(next); }
  canvas.dataset.state = JSON.stringify(next);
  viewer.figure.size = [next.width, next.height];
  adopt_camera(next);
  const name = next.file.split("/").pop();
  document.title = `${name} · Meniscus`;
  document.querySelector("h1").textContent = name;
  $("file").textContent = `${next.atoms.toLocaleString("en")} atoms`;
  $("probe").disabled = $("probe-number").disabled = next.surface === "vdw";
  properties.show(next, set_value);
  set_value($("scheme"), next.color.scheme);
  set_value($("map"), next.color.map ?? "");
  $("map-row").hidden = $("range-row").hidden = !numbered.has(next.color.scheme);
  set_value($("range"), next.color.range ?? "");
  if ($("map").options[0]) $("map").options[0].text = next.color.own_map ? "the file's" : "its own";
  figure.show(next);
  show_strip(next);
  take_wishes(next);
  $("kinds").checked = next.patch_kinds;
  $("kinds-key").hidden = !(next.patch_kinds || next.color.scheme === "kind");
  set_value($("background"), next.look.background);
  stage.style.background = next.look.background;
  $("shade").checked = next.look.ambient_occlusion > 0;
  $("lines").checked = next.look.silhouettes > 0;
  place_lamp($("lamp"), next.look.light_direction);
  $("frames").hidden = next.frames < 2;
  $("frame").max = next.frames - 1;
  set_value($("frame"), next.frame);
  $("moment").textContent = `${next.frame + 1} of ${next.frames}`;
  $("play").textContent = next.playing && !next.strip.playing ? "Pause" : "Play";
  $("key").textContent = is_key(next) ? "Remove key" : "Set key";
  $("save-path").disabled = next.keys.length === 0;
  $("follow").checked = next.follow_keys;
}

function fill_choices(choices) {
  if (!choices.ok) return;
  actions = choices.actions;
  for (const { word, has_map, description, lacks } of choices.schemes) {
    const option = new Option(lacks ? `${word}: the file ${lacks}` : word, word);
    option.title = description;
    option.disabled = Boolean(lacks);
    $("scheme").add(option);
    if (has_map) numbered.add(word);
  }
  $("map").add(new Option("its own", ""));
  for (const map of choices.maps) $("map").add(new Option(map, map));
  for (const property of choices.properties)
    if (property.slider_end) properties.add_slider(property, $("strengths"));
  $("shapes").prepend(...choices.representations.map((as) =>
    Object.assign(document.createElement("button"), { name: "do", value: as, textContent: as[0].toUpperCase() + as.slice(1) })));
  for (const preset of choices.presets) $("preset").add(new Option(preset, preset));
  $("keys").append(...rows_of(choices.keys.map(({ keys, what }) => [keys, what])));
  if (state) apply_state(state);
}

// Controls

let beneath_kinds = "auto";  // the colours before kinds of patch were shown
const set_scheme = (scheme) => {
  if (scheme === "kind") beneath_kinds = state.values["surface.color"];
  set("surface.color", scheme === "kind" ? scheme : [scheme, ...state.color.rules ?? []]);  // rules colour atoms
};
$("scheme").addEventListener("change", (event) => set_scheme(event.target.value));
$("range").addEventListener("change", (event) => set("surface.color_range", event.target.value.trim() || null));
$("map").addEventListener("change", (event) => set("surface.map", event.target.value || null));
$("kinds").addEventListener("change", (event) => event.target.checked ? set_scheme("kind") : set("surface.color", beneath_kinds));
$("projection").addEventListener("change", (event) => set_projection(viewer, event.target.value === "orthographic"));
$("background").addEventListener("input", (event) => set("image.background", event.target.value));
for (const [id, key] of [["shade", "a"], ["lines", "l"]]) $(id).addEventListener("change", () => command("press", { key }));
follow_lamp($("lamp"), (direction) => { if (controls) set("look.light", direction.join(",")); });
$("reset").addEventListener("click", () => command("reset_view"));
$("zoom-form").addEventListener("submit", async (event) => {
  event.preventDefault();
  const reply = await command("zoom_to", { selection: $("selection").value });
  if (reply) tell(`${reply.atoms.toLocaleString("en")} atoms`);
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

const kHoverRest = 120;  // ms that the pointer rests before an atom is named
let hovered = 0;  // number of the latest hover; older answers are late

canvas.addEventListener("pointermove", (event) => {
  const number = ++hovered;
  $("tip").hidden = true;
  if (event.buttons === 0) setTimeout(() => { if (number === hovered) hover(event, number); }, kHoverRest);
});
for (const kind of ["pointerdown", "pointerleave"])
  canvas.addEventListener(kind, () => { ++hovered; $("tip").hidden = true; });
canvas.addEventListener("pointerdown", () => { last_change = 0; });

async function hover(event, number, more = 10) {
  if (canvas.dataset.rest !== "true") return;
  const found = await viewer.pick(event.clientX, event.clientY);
  if (number !== hovered || !found) return;
  const tip = $("tip"), area = found.exposed_area;
  tip.hidden = false;
  tip.children[0].textContent = found.label;
  tip.children[1].textContent = found.what + (typeof area === "number" ? ` · ${area.toFixed(2)} Å² exposed` : "");
  const { left, top } = stage.getBoundingClientRect();
  const x = Math.min(event.clientX - left + 14, stage.clientWidth - tip.offsetWidth - 8);
  const y = Math.min(event.clientY - top + 16, stage.clientHeight - tip.offsetHeight - 8);
  tip.style.transform = `translate(${Math.max(x, 0)}px, ${Math.max(y, 0)}px)`;
  // Where it is cheap the area comes soon.
  if (found.area_follows && more > 0) setTimeout(() => { if (number === hovered) hover(event, number, more - 1); }, 300);
}

let clicked = 0;  // number of the latest click

/// Tells of an atom at once, and of its area when that is known.
async function tell_of_atom(found) {
  const number = ++clicked, revision = newest;
  while (found && number === clicked && newest === revision) {
    found = await pictures.pick(found.x, found.y, {}) ?? found;
    if (number !== clicked) return;
    const area = found.area_follows ? "…" : typeof found.exposed_area === "number" ? `${found.exposed_area.toFixed(3)} Å²` : null;
    const list = document.createElement("dl");
    list.append(...rows_of([["what", found.what], ["element", found.element], ...(area ? [["exposed", area]] : []),
      ["position", found.position.map((x) => x.toFixed(2)).join(", ")]]));
    $("picked").replaceChildren(Object.assign(document.createElement("strong"), { textContent: found.label }), list);
    if (!found.area_follows) return;
    await new Promise((resolve) => setTimeout(resolve, 300));
  }
}

// Writing

/// The server keeps the figure, but nobody may come back to it.
window.addEventListener("beforeunload", (event) => { if (controls && state?.unsaved) event.preventDefault(); });

const stem = () => state.file.split("/").pop().replace(/\.[^.]*$/, "").replace(/[^A-Za-z0-9_-]+/g, "_") || "view";
const download_json = (value, name) => download(new Blob([JSON.stringify(value, null, 2) + "\n"], { type: "application/json" }), `${stem()}_${name}.json`);
$("save-camera").addEventListener("click", () => download_json(state.camera, "camera"));
$("save-path").addEventListener("click", () => download_json({ keys: state.keys }, "camera_path"));

$("write").addEventListener("submit", async (event) => {
  event.preventDefault();
  const format = event.submitter?.value ?? "png", force = $("export-force").checked, name = $("export-name").value;
  if (format === "scene") {
    const reply = await command("save", { path: `${name}.json`, force, ...wishes() });
    return reply && tell(`Written: ${reply.path}`);
  }
  const ending = { png: ".png", film: ".mp4", povray: "", blender: ".mns" }[format];
  // What is shown is at hand: the browser has it, too.
  const picture = format === "png" && is_at_rest() && !$("width").value && !$("height").value && !$("export-samples").value &&
    !$("export-transparent").checked ? full_picture : null;
  if (!await command("export", { format, path: name + ending, force, wait: false, ...wishes() })) return;
  if (picture) download(picture, name + ending);
  follow_export();
});
$("open-scene").addEventListener("click", async () => {
  const name = $("export-name").value;
  const reply = await command("open", { path: /\.(json|png|tiff?|jpe?g|html)$/.test(name) ? name : `${name}.json` });
  if (reply) tell(`Opened: ${reply.path}`);
});

/// Shows how far the export is until it is done; the picture can be turned meanwhile.
async function follow_export() {
  const buttons = document.querySelectorAll("#writers button");
  $("job").hidden = false;
  for (const button of buttons) button.disabled = true;
  let told = { running: true };
  while (told.running) {
    told = await server.ask({ command: "export_state" });
    $("job-text").textContent = `Writing ${told.path?.split("/").pop() ?? ""}: ${told.stage ?? "begin"}, ${Math.round(told.seconds ?? 0)} s`;
    $("job-share").value = told.share ?? 0;
    if (told.running) await new Promise((resolve) => setTimeout(resolve, 250));
  }
  $("job").hidden = true;
  for (const button of buttons) button.disabled = false;
  ask_state();
  if (told.error) tell(sentence_of(told.error, "export"), true);
  else if (told.path) tell([`Written: ${told.path}`, told.note, told.render_with && `render it with: ${told.render_with}`]
    .filter(Boolean).join("; "));
}
$("job-cancel").addEventListener("click", () => command("cancel_export"));

/// What a scene asks of pictures, until somebody types something else.
let taken_wishes = "";
function take_wishes(next) {
  const told = JSON.stringify(next.export);
  if (told === taken_wishes) return;
  taken_wishes = told;
  for (const [id, key] of [["width", "width"], ["height", "height"], ["export-samples", "samples"]]) $(id).value = next.export[key] ?? "";
  $("export-transparent").checked = next.export.transparent;
}

/// What is asked of an exported picture.
function wishes() {
  const wish = { samples: $("export-samples").valueAsNumber || state.samples };
  wish.transparent = $("export-transparent").checked;
  const [width, height] = [$("width").valueAsNumber, $("height").valueAsNumber];
  if (width) wish.width = width;
  if (height) wish.height = height;
  if (width && !height) wish.height = Math.max(16, Math.round(width * state.height / state.width));
  if (height && !width) wish.width = Math.max(16, Math.round(height * state.width / state.height));
  return wish;
}

$("copy-command").addEventListener("click", async () => {
  const reply = await command("render_command", wishes());
  if (!reply) return;
  $("command-text").value = reply.text;
  $("command-text").hidden = false;
  $("command-text").select();
  const copied = await navigator.clipboard?.writeText(reply.text).then(() => true, () => false);
  tell(copied ? "The command is copied." : "Here it is, to be copied.");
});
