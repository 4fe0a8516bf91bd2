// SPDX-License-Identifier: BSD-3-Clause
// Connects the stage to the program: shows its sections, sends commands from input, and shows its pictures and state.
import { is_worth_timing, time_casting, webgl_device, who_draws } from "./casting.js";
import { answers, Connection } from "./connection.js";
import { contents_controls } from "./contents.js";
import { figure_controls, rows_of } from "./figure.js";
import { key_help, program_keys } from "./keys.js";
import { follow_lamp, place_lamp } from "./lamp.js";
import { forget_fault, is_working, say_anew, say_fault, say_working, sentence_of, tell } from "./notices.js";
import { open_controls } from "./open.js";
import { Pictures } from "./pictures.js";
import { hex_of, property_controls } from "./properties.js";
import { select_controls } from "./select.js";
import { strip_controls } from "./strip.js";
import { write_controls } from "./write.js";

place_sections();
remember_sections(["cutting", "viewing"]);

const canvas = $("picture"), stage = $("stage");
const numbered = new Set();  // colour schemes that take a map
let viewer = null;     // exists after the first state
let state = null;      // the state that the program shows
let told_states = 0;   // how many requested states were received
let controls = false;  // true if this page controls the preview
let shown = null;      // the message of the picture in the canvas
let full_picture = null;  // the picture's PNG, if it has full quality
let outstanding = 0;   // commands without a reply
let newest = 0;        // the revision of the latest reply
let schemes = [];      // words of the available colour schemes

const server = new Connection({
  picture: (message, bytes) => show_program_picture(message, bytes).finally(want),
  figure: (message, bytes) => show_program_figure(message, bytes).finally(want),
  welcome: async (message) => {
    largest_file = message.largest_file;
    set_role(message.controls);
    if (sessionStorage.getItem(kOpened)) server.request("control");
    sessionStorage.removeItem(kOpened);
    server.ask({ command: "choices" }).then(fill_choices);
    writing.begin();
    await fit();  // before a picture is requested, which would have another size
  },
  role: (message) => { set_role(message.controls); fit(); },
  progress: (message) => say_working(message.what),
  error: (message) => { is_opening = false; apply_state(message.state); say_fault(sentence_of(message.error)); },
  opened: show_other_molecule,
  ended: (message) => { end(message.error ?? "The preview has ended.", Boolean(message.error)); },
  lost: () => {
    end("The connection to the preview is lost; trying again …", true);
    connect_again();
  },
});

/// Moves the program's sections to their places on the stage.
function place_sections() {
  for (const part of $("program").content.children) {
    const { before, in: within } = part.dataset;
    if (before) $(before).before(...part.childNodes);
    else $(within).append(...part.childNodes);
  }
  for (const part of [$("about"), ...document.querySelectorAll(".of-pages")]) part.hidden = true;
  $("controls").hidden = false;
  $("controls").disabled = true;
  $("write").noValidate = false;
}

const kStep = 700;  // the next command after so many ms without one is a separate step for undo
const tells_only = new Set(["pick", "export", "export_state", "cancel_export", "save", "render_command", "end_step", "undo", "redo"]);
const changes_state = new Set(["key", "keep_scene", "forget_scene", "time_scene", "play", "pause", "save"]);
let last_change = 0;

/// Carries out a command; refuse(text) shows a refusal. Returns the reply, or null.
async function command(word, values = {}, refuse = (text) => tell(text, true)) {
  if (is_opening) return null;  // the next molecule would discard the change
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
  if (viewer?.casts && word !== "camera" && reply.revision !== undefined) follow_change(reply.revision);
  note_rest();
  if (!reply.ok && reply.error) refuse(sentence_of(reply.error, word));
  else if (reply.ok && word !== "resize") { forget_fault(); selection.forget_fault(); }
  if (reply.ok && reply.revision === undefined && changes_state.has(word)) ask_state();
  return reply.ok ? reply : null;
}

/// Sets a property; if that is refused, the controls show the old state again.
const set = (key, value) => command("set", { key, value }).then((reply) => { if (!reply && state) apply_state(state); });

/// Asks the program a question after it got the present camera.
function ask(question) {
  tell_camera();
  return server.ask(question);
}

/// Shows changes that make no new picture.
async function ask_state() {
  const next = await server.ask({ command: "state" });
  if (!next.ok) return;
  ++told_states;
  apply_state(next);
}

/// Waits for the state after a change. If the change makes another figure, the program sends it before the state.
async function follow_change(revision) {
  due = revision;
  await ask_state();
  if (due === revision) due = 0;
  note_rest();
}

/// At rest the stage shows the result of all commands in full quality.
const has_picture = () => Boolean(shown?.full) && outstanding === 0 && shown.state.revision >= newest && JSON.stringify(file_camera()) === told_text;
const is_at_rest = () => !viewer?.rests_here ? has_picture() : is_cast && due === 0 && outstanding === 0;
function note_rest() {
  canvas.dataset.rest = String(Boolean(viewer) && is_at_rest());
  const casts = Boolean(viewer?.casts) && (viewer.rests_here || !has_picture());
  $("pictures").hidden = casts;
  $("labels").toggleAttribute("hidden", !casts);  // the program's pictures contain labels
}

$("take").addEventListener("click", () => server.request("control"));

// The camera: the page moves it, and sends it to the program

let told_text = "";   // the camera that both the page and the program have
let adopted = "";     // the latest camera that the program sent
let flights = 0;      // cameras without a reply
let camera_timer = 0;
const kCameraRest = 150;  // the camera is sent when it has rested for so many ms, where this browser draws

/// Returns the camera as files have it, in the molecule's coordinates.
function file_camera() {
  const { projection, vertical_fov, height, ...place } = told_camera(viewer.camera, viewer.figure.origin);
  return { ...place, projection, ...(projection === "perspective" ? { vertical_fov } : { height }) };
}

function tell_camera() {
  clearTimeout(camera_timer);
  if (!viewer) return;
  if (!controls) viewer.camera = page_camera(state.camera, viewer.camera, viewer.figure.origin);  // watchers stay
  const camera = file_camera(), text = JSON.stringify(camera), is_told = text === told_text;
  told_text = text;
  if (is_told || !controls) return;
  ++flights;
  command("camera", { camera }).then(() => { --flights; if (viewer.casts) want(); else tell_camera(); });
}

/// Takes the program's camera, unless this page has moved its own since.
function adopt_camera({ camera, revision }) {
  const text = JSON.stringify(camera);
  if (text === adopted || flights > 0 || revision < newest || JSON.stringify(file_camera()) !== told_text) return;
  adopted = text;
  const next = page_camera(camera, viewer.camera, viewer.figure.origin);
  $("projection").value = projection_of(next);
  if (numbers_of(next) === numbers_of(viewer.camera)) return;
  Object.assign(viewer, { gliding: null, camera: next });
  told_text = JSON.stringify(file_camera());
  viewer.change();
}

const numbers_of = ({ position, target, up, orthographic, fov, height }) =>
  [...position, ...target, ...up, orthographic ? -height : fov].map((x) => x.toFixed(6)).join();

const page_camera = (camera, now = { fov: 30, height: 1 }, origin = [0, 0, 0]) =>
  asked_camera({ vertical_fov: now.fov, height: now.height, ...camera }, now, origin);

// Messages

const kAgain = "meniscus connected again", kOpened = "meniscus opened here";  // keys of the session's storage
let is_opening = false;  // true while this page opens another molecule
let largest_file = 0;    // the server's limit of a file, in bytes

/// Loads the page anew, so that nothing of the previous molecule remains.
function show_other_molecule() {
  for (const key of Object.keys(sessionStorage)) if (key.startsWith("meniscus ")) sessionStorage.removeItem(key);
  if (controls) sessionStorage.setItem(kOpened, "yes");
  state = null;  // prevents the question about unsaved changes
  location.reload();
}

/// Loads the page again when the server answers again.
async function connect_again() {
  let answer = "gone";
  while (answer === "gone") {
    await new Promise((resolve) => setTimeout(resolve, 2000));
    answer = await answers();
  }
  if (answer === "refused")
    return end("The preview was started again under another address, which the terminal shows.", true);
  sessionStorage.setItem(kAgain, "yes");
  state = null;  // prevents the question about unsaved changes, which are lost already
  location.reload();
}

/// Shows a last notice and disables the controls.
function end(text, is_error) {
  say_anew(text, is_error, true);
  $("controls").disabled = true;
}

function set_role(in_control) {
  controls = in_control;
  $("role").hidden = controls;
  allow_controls();
}

/// Enables the controls if this page is in control and there is a state to change.
function allow_controls() { $("controls").disabled = !controls || !state; }

// Pictures

const pictures = new Pictures($("pictures"), ask, () => state, () => viewer.figure.origin);
const kept = new Map();  // tables of figures, by their digests
let device = webgl_device();  // the device of this browser; empty: it casts nothing
const times = { browser: null, program: { draft: Infinity, rest: Infinity, took: 0 } };  // ms; took: of a draft
let figures = 0;        // how many figures have come
let unavailable = "";   // why this browser cannot cast the program's figure
let due = 0;            // the revision of a change that may make another figure; 0 after it has come
let is_cast = false;    // true if the browser's picture at rest is complete

const is_faster = (what) => $("drawn").value === "browser" || ($("drawn").value === "fastest" && times.browser?.[what] < times.program[what]);
const wants_figures = () => device && shown?.full && (is_faster("draft") || (!times.browser && $("drawn").value === "fastest" && is_worth_timing(device, times.program)));

/// Asks for the next picture or figure.
function want() {
  if (!viewer?.casts || (!viewer.rests_here && !has_picture())) server.request("picture");
  if (wants_figures()) server.request("figure", { has: [...kept.keys()] });
}

/// Chooses whether this browser or the program draws.
function settle() {
  const casts = Boolean(device && figures > 0 && !unavailable && is_faster("draft"));
  if (casts !== viewer.casts || !viewer.caster) viewer.show_pictures(casts ? null : pictures);
  if (!casts) $("legend").textContent = "";  // the legend belongs to the figure that was cast
  viewer.rests_here = casts && !state.values["legend.shown"] && is_faster("rest");
  $("drawn-by").textContent = who_draws({ device, unavailable, times, casts, rests: viewer.rests_here });
  note_rest();
  want();
}
$("drawn").addEventListener("change", settle);

async function show_program_figure(message, bytes) {
  unavailable = message.unavailable ?? "";
  if (message.revision >= due) due = 0;
  if (!unavailable) {
    const figure = read_figure_bytes(new Uint8Array(bytes), kept), cuts = message.state.values["surface.clip"].map((plane) => plane.match(/^depth>(.*)/)?.[1]);
    const depths = cuts.length === figure.views[0].planes.length && cuts.some(Boolean) ? cuts.map((text) => text && Number(text)) : undefined;
    const is_told = JSON.stringify(file_camera()) === told_text;
    viewer.show_figure({ ...figure, number: ++figures, depths });
    if (is_told) told_text = JSON.stringify(file_camera());  // another origin rounds the coordinates differently
  }
  if (message.state.revision >= state.revision) apply_state(message.state);
  if (figures > 0 && !times.browser && $("drawn").value === "fastest") time_this_browser();
  settle();
}

function time_this_browser() {
  try {
    viewer.show_pictures(null);
    times.browser = time_casting(viewer);
  } catch (error) {
    if (!(error instanceof NoWebGl)) throw error;
    device = "";
  }
}

async function show_program_picture(message, bytes) {
  const blob = new Blob([bytes], { type: message.type }), before = told_states;
  if (viewer?.casts && !message.full) return;
  const share = await pictures.show(blob, message.state), took = message.stats.frame_milliseconds + message.stats.encode_milliseconds;
  Object.assign(times.program, message.full ? { rest: took } : { draft: took / share ** 2, took });
  if (message.balls) {
    say_working(`Computing the surface of ${message.state.atoms.toLocaleString("en")} atoms`);
  } else if (!shown || (is_working() && !is_opening)) {
    say_anew(sessionStorage.getItem(kAgain) ? "Connected again." : "");
    sessionStorage.removeItem(kAgain);
  }
  full_picture = message.full ? blob : null;
  shown = message;
  note_rest();
  canvas.dataset.pictures = String(Number(canvas.dataset.pictures ?? 0) + 1);
  show_stats(message.stats, message.full);
  // A state that arrived while the picture was being decoded is newer than the picture's.
  if (told_states === before || message.state.revision > state.revision) apply_state(message.state);
  if (message.full || $("drawn-by").textContent === "") settle();
}

$("times").addEventListener("toggle", () => { $("fps").hidden = !$("times").open; });

const a_second = (fps) => `${fps < 10 ? fps.toFixed(1) : Math.round(fps)} a second`;
let moving = "";  // pictures per second of the last one that was not full
function show_stats(stats, full) {
  const ms = (value) => `${value < 10 ? value.toFixed(1) : Math.round(value)} ms`;
  if (!full && Number(canvas.dataset.pictures) > 2) moving = a_second(stats.fps);
  const rest = full ? `full picture in ${ms(stats.frame_milliseconds)}` : "";
  $("fps").textContent = [moving, rest].filter(Boolean).join(" · ");
  const grown = stats.radii_grown_by > 0 ? [["radii grown for ties by up to", `${stats.radii_grown_by.toExponential(1)} \u00c5`]] : [];
  $("stages").replaceChildren(...rows_of([...grown, ...stats.stages.map((stage) => [stage.name, ms(stage.milliseconds)]),
    ["encoding", ms(stats.encode_milliseconds)]]));
}

/// Asks for pictures with as many pixels as the canvas has on this screen.
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

const context = { command, set, ask, say: tell, viewer: () => viewer, page_camera };
const show_figure = figure_controls(context);
const properties = property_controls(context);
const show_strip = strip_controls(context);
const selection = select_controls(context);
const show_contents = contents_controls(context, selection);
const press = program_keys({ command, set, set_scheme, state: () => state, schemes: () => schemes, name: go_to_name });
open_controls({ ask: (question) => server.ask(question), may: () => controls, loses: () => Boolean(state?.unsaved), largest: () => largest_file,
  work: (what) => { is_opening = Boolean(what); if (what) say_working(what); else say_anew(""); }, fail: (error) => say_fault(sentence_of(error)) });
const writing = write_controls({ ...context, picture: () => has_picture() ? full_picture : null, changed: ask_state });

/// Colours by another scheme and keeps the rules.
function set_scheme(scheme) { set("surface.color", [scheme, ...state.values["surface.color"].filter((entry) => entry.includes("="))]); }

/// Focuses the name of the output at once, so that the next typed letters go there however late the session replies.
function go_to_name() {
  document.body.classList.remove("bare");
  $("export-name").focus();
  $("export-name").select();
}

/// Sets a control, unless the user types in it or drags it ahead of the pictures.
function set_value(control, value) {
  if (control !== document.activeElement || (control.type === "range" && outstanding === 0)) control.value = value;
}

/// Begins the stage with the program's pictures.
function begin(first) {
  const views = [{ camera: page_camera(first.camera), planes: [], hatching: [], opacity: 1 }];
  viewer = window.meniscus = new Viewer({ views, size: [first.width, first.height], origin: [0, 0, 0], labels: [], schemes: [], samples: [] }, pictures);
  viewer.rests_here = false;
  viewer.rest = (whole) => { is_cast = whole; note_rest(); };
  viewer.drafted = (took) => { $("fps").textContent = a_second(1000 / took); };
  viewer.failed = () => { device = ""; settle(); };
  viewer.changed = () => {
    clearTimeout(camera_timer);
    if (viewer.casts) camera_timer = setTimeout(tell_camera, kCameraRest);
    else if (flights === 0) tell_camera();
  };
  viewer.selects = true;
  viewer.picked = selection.click;
  told_text = JSON.stringify(file_camera());
  follow_pointer(viewer);
  follow_keys(viewer, (key) => controls && press(key));
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
  const { values } = next, [scheme] = values["surface.color"], background = hex_of(values["image.background"]) ?? "#ffffff";
  $("probe").disabled = $("probe-number").disabled = values["surface.kind"] === "vdw";
  set_value($("probe"), values["surface.probe"]);
  set_value($("probe-number"), Number(values["surface.probe"].toFixed(3)));
  show_scheme(scheme);
  set_value($("map"), values["surface.map"] ?? "");
  $("map-row").hidden = $("range-row").hidden = !numbered.has(scheme);
  set_value($("range"), values["surface.color_range"] === "auto" ? "" : values["surface.color_range"]);
  if ($("map").options[0]) $("map").options[0].text = next.own_map ? "the file's" : "its own";
  properties.show(next.values);
  show_figure(next);
  show_strip(next);
  selection.show(next);
  show_contents(next);
  writing.show(next);
  $("scale-bar").checked = values["annotations.scale_bar"] !== null;
  set_value($("background"), background);
  stage.style.background = background;
  place_lamp($("lamp"), values["look.light"].split(",").map(Number));
  $("frames").hidden = next.frames < 2;
  $("frame").max = next.frames - 1;
  set_value($("frame"), next.frame);
  $("moment").textContent = `${next.frame + 1} of ${next.frames}`;
  $("play").textContent = next.playing && !next.strip.playing ? "Pause" : "Play";
  $("key").textContent = is_key(next) ? "Remove key" : "Set key";
  $("save-path").disabled = next.keys.length === 0;
  $("follow").checked = next.follow_keys;
}

const kOneColor = "one colour";

/// Shows the scheme that colours the surface.
function show_scheme(scheme) {
  const is_one = scheme.startsWith("#");
  if (is_one) $("one-color").value = scheme;
  $("one-color-row").hidden = !is_one;
  set_value($("scheme"), is_one ? kOneColor : scheme);
}

function fill_choices(choices) {
  if (!choices.ok) return;
  schemes = choices.schemes.map(({ word }) => word);
  for (const { word, has_map, description, lacks } of choices.schemes) {
    const option = new Option(lacks ? `${word}: the file ${lacks}` : word, word);
    option.title = description;
    option.disabled = Boolean(lacks);
    $("scheme").add(option);
    if (has_map) numbered.add(word);
  }
  $("scheme").add(new Option(kOneColor));
  $("map").add(new Option("its own", ""));
  for (const map of choices.maps) $("map").add(new Option(map, map));
  properties.fill(choices.properties);
  $("keys").append(...rows_of(key_help));
  if (state) apply_state(state);
}

// Controls

const set_probe = (radius) => { if (Number.isFinite(radius)) set("surface.probe", Math.round(radius * 1000) / 1000); };
$("probe").addEventListener("input", (event) => set_probe(event.target.valueAsNumber));
$("probe-number").addEventListener("change", (event) => set_probe(event.target.valueAsNumber));

$("scheme").addEventListener("change", () => set_scheme($("scheme").value === kOneColor ? $("one-color").value : $("scheme").value));
$("one-color").addEventListener("input", () => set_scheme($("one-color").value));
$("range").addEventListener("change", () => set("surface.color_range", $("range").value.trim() || null));
$("map").addEventListener("change", () => set("surface.map", $("map").value || null));
$("projection").addEventListener("change", (event) => set_projection(viewer, event.target.value === "orthographic"));
$("background").addEventListener("input", (event) => set("image.background", event.target.value));
$("scale-bar").addEventListener("change", (event) => set("annotations.scale_bar", event.target.checked ? "auto" : null));
follow_lamp($("lamp"), (direction) => { if (controls) set("look.light", direction.join()); });
$("reset").addEventListener("click", () => command("reset_view"));
$("frame").addEventListener("input", (event) => command("frame", { index: event.target.valueAsNumber }));
const is_key = ({ keys, frame_number }) => keys.some((key) => key.frame === frame_number);
const toggle_playing = () => state?.playing ? command("pause") : command("play", { fps: $("rate").valueAsNumber || 10 });
$("play").addEventListener("click", () => toggle_playing().then((reply) => {
  if (reply) apply_state({ ...state, playing: Boolean(reply.playing) });
}));
$("key").addEventListener("click", () => command("key", { on: !is_key(state) }));
$("follow").addEventListener("change", (event) => command("follow_keys", { on: event.target.checked }));
$("rate").addEventListener("change", () => { if (state?.playing) command("play", { fps: $("rate").valueAsNumber || 10 }); });

canvas.addEventListener("pointerdown", () => { last_change = 0; });

/// Warns before unsaved changes of the figure are lost: the server keeps them, but the user may not come back.
window.addEventListener("beforeunload", (event) => { if (controls && state?.unsaved) event.preventDefault(); });
