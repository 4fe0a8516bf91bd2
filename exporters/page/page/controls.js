// SPDX-License-Identifier: BSD-3-Clause
// Changes the view by mouse, fingers, keys and controls, and starts the stage.

const kClick = 4;        // CSS pixels that a click may wander
const kMostChains = 24;  // chains that have a box each
const kSections = "meniscus sections";  // a key of the browser's storage

/// Shows a sentence over the picture for some seconds, or until another one replaces it.
function say(sentence, { is_error = true, seconds = 0 } = {}) {
  const box = $("message");
  box.textContent = sentence;
  delete box.dataset.seconds;
  box.classList.toggle("error", is_error);
  box.hidden = sentence === "";
  clearTimeout(say.timer);
  if (seconds) say.timer = setTimeout(() => { box.hidden = true; }, 1000 * seconds);
}

/// Shows the live picture, or else the still one.
function show_picture(live) {
  $("picture").hidden = !live;
  $("labels").toggleAttribute("hidden", !live);
  $("controls").hidden = !live;
  $("frames").hidden = !live || $("frame").max === "0";
  if ($("still")) $("still").hidden = live;
}

function follow_pointer(viewer) {
  const canvas = viewer.canvas, pointers = new Map();
  let drag = null;
  const middle = () => { const all = [...pointers.values()]; return { x: (all[0].x + all[1].x) / 2, y: (all[0].y + all[1].y) / 2, span: Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) || 1 }; };
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    drag = { pans: event.button !== 0 || event.shiftKey, button: event.button, wandered: 0 };
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last || !drag) return;
    const height = viewer.height(), before = pointers.size === 2 ? middle() : null;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (before) {
      const after = middle();
      drag.wandered = kClick;
      viewer.move(panned(zoomed(viewer.camera, after.span / before.span), (after.x - before.x) / height, (after.y - before.y) / height));
      return;
    }
    drag.wandered += Math.hypot(dx, dy);
    if (drag.wandered < kClick) return;
    viewer.move(drag.pans ? panned(viewer.camera, dx / height, dy / height) : orbited(viewer.camera, dx / height, dy / height));
  });
  const center = async (event) => {
    const picked = await viewer.pick(event.clientX, event.clientY);
    if (picked) viewer.move(centered(viewer.camera, picked.point), false);
  };
  const release = (event) => {
    pointers.delete(event.pointerId);
    if (event.type === "pointerup" && drag && drag.button === 0 && drag.wandered < kClick) {
      viewer.pick(event.clientX, event.clientY).then((found) => {
        if (!viewer.selects) $("picked").textContent = viewer.tell(found);
        viewer.picked?.(found, event);
      });
    }
    if (event.type === "pointerup" && drag?.button === 1 && drag.wandered < kClick) center(event);
    if (pointers.size === 0) drag = null;
    else drag.wandered = kClick;
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", (event) => { if (!viewer.selects) center(event); });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 16) * 0.0015);
    const box = canvas.getBoundingClientRect();
    viewer.move(zoomed(viewer.camera, Math.min(2, Math.max(0.5, factor)),
      (event.clientX - box.left - box.width / 2) / viewer.height(), (event.clientY - box.top - box.height / 2) / viewer.height()));
  }, { passive: false });
}

/// Returns true if the control with the focus uses the key itself. Sliders and switches leave letters to the picture.
function is_for(control, key) {
  if (control.matches("input[type=range], [role=slider]")) return key.startsWith("Arrow");
  if (control.matches("input[type=checkbox], input[type=color], button, summary")) return key === " " || key === "Enter";
  return control.matches("input, select, textarea");
}

/// Handles keys. other: is called with the keys that have no meaning here, and returns true for those that it handles.
function follow_keys(viewer, other = () => false) {
  const step = 1 / 36, steps = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
  const acts = { "+": () => viewer.move(zoomed(viewer.camera, 1.1)), "-": () => viewer.move(zoomed(viewer.camera, 1 / 1.1)),
    "<": () => viewer.move(rolled(viewer.camera, -0.1)), ">": () => viewer.move(rolled(viewer.camera, 0.1)), r: () => $("reset").click(),
    o: () => set_projection(viewer, !viewer.camera.orthographic) };
  const faces = { h: () => show_help($("help").hidden), Escape: () => show_help(false), p: () => document.body.classList.toggle("bare") };
  Object.assign(acts, { "=": acts["+"] });
  Object.assign(faces, { "?": faces.h });
  const frames = { " ": (all) => all.toggle(), ",": (all) => all.go(-1), ".": (all) => all.go(1), PageUp: (all) => all.go(-1), PageDown: (all) => all.go(1) };
  document.addEventListener("keydown", (event) => {
    const { key } = event, small = key.length === 1 ? key.toLowerCase() : key, way = steps[key];
    if (viewer.saving || event.ctrlKey || event.metaKey || event.altKey || is_for(event.target, key)) return;
    if (faces[small]) faces[small]();
    else if (way && viewer.caster) viewer.move((event.shiftKey ? panned : orbited)(viewer.camera, ...way));
    else if (acts[small] && viewer.caster) acts[small]();
    else if (frames[key] && viewer.frames) frames[key](viewer.frames);
    else if (!other(key)) return;
    event.preventDefault();
  });
}

function show_help(open) {
  $("help").hidden = !open;
  $("show-help").setAttribute("aria-expanded", String(open));
}

/// Restores which sections are open. closed: sections that are closed at first.
function remember_sections(closed = []) {
  const sections = [...document.querySelectorAll("#sections > details")];
  let left = {};
  try { left = JSON.parse(localStorage.getItem(kSections)) ?? {}; } catch { /* a frame may have no storage */ }
  for (const section of sections) {
    section.open = left[section.id] ?? (section.open && !closed.includes(section.id));
    section.addEventListener("toggle", () => {
      left[section.id] = section.open;
      try { localStorage.setItem(kSections, JSON.stringify(left)); } catch { /* a frame may have no storage */ }
    });
  }
}

function set_projection(viewer, orthographic) {
  viewer.move(projected(viewer.camera, orthographic, viewer.caster.radius), false);
  $("projection").value = projection_of(viewer.camera);
}

const projection_of = (camera) => (camera.orthographic ? "orthographic" : "perspective");

function follow_controls(viewer) {
  const hex = viewer.background.map((c) => Math.round(255 * c).toString(16).padStart(2, "0")).join("");
  $("background").value = `#${hex}`;
  $("projection").value = projection_of(viewer.camera);
  for (const name of ["shade", "lines"]) {
    $(name).checked = viewer.effects[name];
    $(name).parentElement.hidden = !viewer.effects[name];
    $(name).addEventListener("change", () => { viewer.effects[name] = $(name).checked; viewer.change(); });
  }
  follow_layers(viewer);
  follow_views(viewer);
  viewer.figure.schemes.forEach(({ name }, n) => $("scheme").append(new Option(name, n)));
  $("scheme").addEventListener("change", () => viewer.set_scheme(Number($("scheme").value)));
  $("projection").addEventListener("change", () => set_projection(viewer, $("projection").value === "orthographic"));
  $("background").addEventListener("input", () => {
    viewer.background = [1, 3, 5].map((n) => parseInt($("background").value.slice(n, n + 2), 16) / 255);
    viewer.change();
  });
  follow_frames(viewer);
  follow_png(viewer);
}

/// Connects the controls of cuts, opacity and chains.
function follow_layers(viewer) {
  const { layers, names, views } = viewer.figure;
  // Where the figure hides atoms, their patches are missing, so that it is unknown what is solid.
  const cuts = layers?.whole && views.every(({ planes }) => planes.length < kMostPlanes);
  $("cutting").hidden = !cuts;
  $("opacity").parentElement.hidden = !layers;
  $("cut").addEventListener("input", () => viewer.set_cut(Number($("cut").value) / 100));
  $("cut-with").addEventListener("change", () => { viewer.cuts_with_view = $("cut-with").value === "view"; viewer.set_layers(); });
  $("opacity").addEventListener("input", () => { viewer.opacity = Number($("opacity").value) / 100; viewer.set_layers(); });
  const chains = [...new Set(names.chains)], shown = new Set(chains);
  $("chains").hidden = chains.length < 2 || chains.length > kMostChains;
  $("shown").hidden = !layers && $("chains").hidden;
  if ($("chains").hidden) return;
  for (const chain of chains) {
    const label = document.createElement("label"), box = document.createElement("input");
    Object.assign(box, { type: "checkbox", checked: true });
    label.append(box, ` ${chain || "none"}`);
    box.addEventListener("change", () => { shown[box.checked ? "add" : "delete"](chain); viewer.show_chains(shown); });
    $("chains").append(label);
  }
}

async function main() {
  $("show-help").addEventListener("click", () => show_help($("help").hidden));
  if ($("data").dataset.bytes === "0") return;  // the preview's program sends the figure later
  remember_sections();
  show_picture(false);
  if (typeof DecompressionStream === "undefined") return say("This browser is too old to unpack the figure: what is shown is a still picture.");
  try {
    const viewer = new Viewer(await read_figure($("data").textContent, Number($("data").dataset.bytes)));
    show_picture(true);
    follow_pointer(viewer);
    follow_keys(viewer);
    follow_controls(viewer);
    follow_messages(viewer);
    viewer.change();
    window.meniscus = viewer;
  } catch (error) {
    say(error instanceof NoWebGl ? error.message : `The figure cannot be shown: ${error.message}`);
    if (!(error instanceof NoWebGl)) throw error;
  }
}

main();
