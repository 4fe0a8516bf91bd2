// SPDX-License-Identifier: BSD-3-Clause
// Draws the figure when something changes, and turns mouse, fingers and keys into changes.

const kClick = 4;          // CSS pixels a click may wander
const kDraft = 40;         // ms that a frame may take while the view moves
const kMostChains = 24;    // that have a box each
const kMostPixels = 2048;  // along a side
const element = (id) => document.getElementById(id);

class Viewer {
  constructor(figure) {
    this.figure = figure;
    this.canvas = element("picture");
    this.view_number = 0;
    this.camera = this.view.camera;
    this.background = figure.background;
    this.effects = { shade: figure.has_shade, lines: figure.has_lines };
    this.opacity = this.view.opacity;
    this.cut = null;  // a plane beside those of the view
    this.hidden = [];  // atoms
    this.draft_scale = 1;
    this.sample = -1;  // the last one cast of the picture at rest
    this.moving = false;
    this.write_labels();
    this.start();
    this.canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); this.fail("The graphics device was reset; a still picture is shown until it is back."); });
    this.canvas.addEventListener("webglcontextrestored", () => { this.start(); show_picture(true); say(""); this.change(); });
    new ResizeObserver(() => this.change()).observe(element("stage"));
  }

  get view() { return this.figure.views[this.view_number]; }

  write_labels() {
    this.texts = this.figure.labels.map(({ text }) => {
      const made = document.createElementNS("http://www.w3.org/2000/svg", "text");
      made.textContent = text;
      return made;
    });
    element("labels").replaceChildren(...this.texts);
  }

  /// frame: of read_frame().
  show_frame(frame) {
    const { names, labels, tables } = this.figure;
    Object.assign(this.figure, frame);
    if (!this.caster) return;
    if (this.shown_chains && (names !== frame.names || tables.shown !== frame.tables.shown)) this.hidden = this.caster.hidden = this.atoms_beside(this.shown_chains);
    if (names !== frame.names) this.last_picked = undefined;
    if (labels !== frame.labels) this.write_labels();
    this.caster.show(frame);
    if (this.selected_places) this.mark_selected();
    this.lay();
    this.change(true);
  }

  start() {
    this.caster = new (this.figure.layers ? LayeredCaster : Caster)(this.canvas, this.figure);
    this.caster.hidden = this.hidden;
    this.caster.set_scheme(this.scheme ?? 0);
    if (this.selected_places) this.mark_selected();
    this.lay();
  }

  set_scheme(scheme) {
    this.scheme = scheme;
    this.caster.set_scheme(scheme);
    element("legend").innerHTML = this.figure.schemes[scheme].legend;  // escaped where it was written
    this.change();
  }

  lay() {
    const { planes, hatching, looks_inside } = this.view, cut = this.cut ? [this.cut] : [];
    this.caster.fades = this.figure.fades_always || !(looks_inside || this.opacity < 1);
    this.caster.set_layers?.([...planes, ...cut], [...hatching, ...cut.map(() => [0, 0, 0, 0])], this.opacity);
  }

  set_layers() {
    this.lay();
    this.change(true);
  }

  /// depth: share of the molecule's, as it is seen now, that a plane takes away; 0: none.
  set_cut(depth) {
    const { forward } = basis_of(this.camera), balls = new Float32Array(this.figure.tables.balls.buffer);
    let [nearest, farthest] = [Infinity, -Infinity];
    for (let n = 0; n < balls.length; n += 4) {
      const along = balls[n] * forward[0] + balls[n + 1] * forward[1] + balls[n + 2] * forward[2];
      nearest = Math.min(nearest, along - balls[n + 3]);
      farthest = Math.max(farthest, along + balls[n + 3]);
    }
    this.cut = depth > 0 ? [...times(forward, -1), -(nearest + depth * (farthest - nearest))] : null;
    this.set_layers();
  }

  /// shown: names of chains.
  show_chains(shown) {
    this.shown_chains = shown;
    this.hidden = this.atoms_beside(shown);
    this.caster.hide(this.hidden);
    this.change();
  }

  /// Shows atoms as selected. places: their numbers in the figure's names.
  select(places) {
    this.selected_places = new Set(places);
    this.mark_selected();
    this.change();
  }

  mark_selected() {
    const { shown } = this.figure.tables, places = this.selected_places;
    this.caster?.select(places?.size > 0 ? [...shown.keys()].filter((atom) => places.has(shown[atom])) : []);
  }

  /// Atoms of other chains.
  atoms_beside(shown) {
    const { names, tables } = this.figure;
    return [...tables.shown.keys()].filter((atom) => !shown.has(names.chains[this.residue_of(atom)]));
  }

  fail(sentence) {
    cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    this.caster = null;
    show_picture(false);
    say(sentence);
  }

  pixels() {
    const stage = element("stage"), scale = Math.min(window.devicePixelRatio || 1,
      kMostPixels / Math.max(stage.clientWidth, stage.clientHeight, 1));
    return [Math.max(1, Math.round(stage.clientWidth * scale)), Math.max(1, Math.round(stage.clientHeight * scale))];
  }

  /// By how much more is seen from top to bottom than the camera says.
  growth() {
    const [width, height] = this.figure.size, { clientWidth, clientHeight } = element("stage");
    return Math.max(1, (width / height) * (clientHeight / Math.max(clientWidth, 1)));
  }

  begin(width, height) { this.caster.begin(widened(this.camera, this.growth()), width, height); }

  /// Of the camera's picture, CSS pixels: what motions are measured by.
  height() { return this.canvas.clientHeight / this.growth(); }

  /// Something is to be seen otherwise; moving: and will change again soon.
  change(moving = false) {
    this.moving = moving;
    this.sample = -1;
    this.canvas.dataset.rest = "false";
    this.changed?.();
    if (!this.waiting && this.caster && !this.saving) this.waiting = requestAnimationFrame(() => this.draw());
    clearTimeout(this.rest);
    if (moving && !this.playing) this.rest = setTimeout(() => this.change(), 150);
  }

  move(camera, moving = true) {
    this.gliding = null;
    this.camera = camera;
    this.change(moving);
  }

  draw() {
    this.waiting = 0;
    if (!this.caster || this.saving) return;
    const [width, height] = this.pixels();
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    try {
      if (this.moving) this.draw_draft(width, height);
      else this.draw_sample(width, height);
      this.draw_labels();
    } catch (error) {
      if (!(error instanceof NoWebGl)) throw error;
      this.fail(error.message);
    }
  }

  /// Where points are seen, CSS pixels from the top left; nothing for those behind the camera.
  places(points) {
    const { right, up, forward, eye_distance, pixel_size, orthographic, pivot } = this.caster.frame;
    const scale = this.canvas.clientHeight / this.caster.whole[1], { clientWidth, clientHeight } = this.canvas;
    return points.map((point) => {
      const from = minus(point, pivot), depth = eye_distance + dot(from, forward);
      if (!orthographic && depth <= 0) return null;
      const unit_size = pixel_size * (orthographic ? 1 : depth / eye_distance) / scale;
      return [clientWidth / 2 + dot(from, right) / unit_size, clientHeight / 2 - dot(from, up) / unit_size];
    });
  }

  /// Labels stand at their atoms, in front of all.
  draw_labels() {
    const { labels } = this.figure, dark = this.background.reduce((sum, c) => sum + c, 0) < 1.5;
    element("labels").classList.toggle("on-dark", dark);
    this.places(labels.map(({ point }) => point)).forEach((place, n) => {
      const text = this.texts[n];
      text.setAttribute("visibility", place ? "visible" : "hidden");
      if (place) { text.setAttribute("x", place[0].toFixed(1)); text.setAttribute("y", place[1].toFixed(1)); }
    });
  }

  draw_draft(width, height) {
    const began = performance.now(), scale = this.draft_scale;
    this.begin(Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)));
    this.caster.cast(0, { shade: false, lines: false, draft: true });
    this.caster.present(linear_from_srgb(this.background));
    this.caster.read(0, 0, 1, 1, 2);  // waits for the device
    const took = performance.now() - began;
    this.draft_scale = Math.min(1, Math.max(0.125, scale * Math.sqrt(kDraft / Math.max(took, 1))));
    if (this.draft_scale > 0.8) this.draft_scale = 1;
    this.canvas.dataset.draft = took.toFixed(1);
  }

  draw_sample(width, height) {
    if (this.sample < 0) this.begin(width, height);
    this.caster.cast(++this.sample, this.effects);
    this.caster.present(linear_from_srgb(this.background));
    if (this.sample + 1 < this.figure.samples.length) this.waiting = requestAnimationFrame(() => this.draw());
    else this.canvas.dataset.rest = "true";
  }

  pick(x, y) {
    if (!this.caster || this.saving) return null;
    if (this.sample < 0) { this.moving = false; const [width, height] = this.pixels(); this.draw_sample(width, height); }
    const box = this.canvas.getBoundingClientRect();
    return this.caster.pick(Math.floor((x - box.left) * this.canvas.width / box.width),
      Math.floor((y - box.top) * this.canvas.height / box.height));
  }

  residue_of(atom) {
    const { names, tables } = this.figure, place = tables.shown[atom];
    let low = 0, high = names.starts.length;
    while (high - low > 1) { const middle = (low + high) >> 1; if (names.starts[middle] <= place) low = middle; else high = middle; }
    return low;
  }

  atom_name(atom) {
    const { names, tables } = this.figure;
    return `${names.residues[this.residue_of(atom)]} ${names.atoms[tables.shown[atom]]}`;
  }

  /// What the page says of a picked point, and how far its atom is from the one picked before.
  tell(picked) {
    const before = this.last_picked;
    this.last_picked = picked?.atom;
    if (!picked) return "";
    if (before === undefined || before === picked.atom) return this.words(picked);
    const places = [picked.atom, before].map((atom) => this.caster.center_of(atom));
    if (places.includes(null)) return this.words(picked);
    const distance = length(minus(...places));
    return `${this.words(picked)}; ${distance.toFixed(2)} Å from ${this.atom_name(before)}`;
  }

  /// Atom and residue, and which patch it is on.
  words(picked) {
    if (picked.primitive === kOnPlane) return `${this.atom_name(picked.atom)} – nearest to this point of the cut`;
    const record = this.figure.tables.primitives.subarray(12 * picked.primitive, 12 * picked.primitive + 12), kind = record[7];
    if (kind >= kCylinder || record[8] === kNoPrimitive) return this.atom_name(picked.atom);
    if (kind === 0) return `${this.atom_name(picked.atom)} – convex patch`;
    if (kind === 1) return `${this.atom_name(picked.atom)} – toroidal patch of ${this.atom_name(record[9])} and ${this.atom_name(record[10])}`;
    const contacts = [], first = record[5] + 1 + record[6];
    for (let n = 0; n < record[9]; ++n) contacts.push(this.atom_name(this.figure.tables.rows[4 * (first + n) + 3]));
    return `${this.atom_name(picked.atom)} – concave patch of ${contacts.join(", ")}`;
  }

  /// Labels on a picture so many pixels wide.
  paint_labels(context, width) {
    const style = getComputedStyle(element("labels")), scale = width / this.canvas.clientWidth;
    context.scale(scale, scale);
    Object.assign(context, { font: `600 ${style.fontSize} ${style.fontFamily}`, textAlign: "center", textBaseline: "middle", lineWidth: 3, lineJoin: "round" });
    this.places(this.figure.labels.map(({ point }) => point)).forEach((place, n) => {
      if (!place) return;
      const { fill, stroke } = getComputedStyle(this.texts[n]);
      Object.assign(context, { fillStyle: fill, strokeStyle: stroke });
      context.strokeText(this.figure.labels[n].text, ...place);
      context.fillText(this.figure.labels[n].text, ...place);
    });
  }
}

function say(sentence) {
  element("message").textContent = sentence;
  element("message").hidden = sentence === "";
}

/// The live picture, or the still one.
function show_picture(live) {
  element("picture").hidden = !live;
  element("labels").toggleAttribute("hidden", !live);
  element("controls").hidden = !live;
  element("frames").hidden = !live || element("frame").max === "0";
  if (element("still")) element("still").hidden = live;
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
  const release = (event) => {
    pointers.delete(event.pointerId);
    if (event.type === "pointerup" && drag && drag.button === 0 && drag.wandered < kClick) {
      const picked = viewer.pick(event.clientX, event.clientY);
      element("picked").textContent = viewer.tell(picked);
      viewer.picked?.(picked);
    }
    if (pointers.size === 0) drag = null;
    else drag.wandered = kClick;
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("dblclick", (event) => {
    const picked = viewer.pick(event.clientX, event.clientY);
    if (picked) viewer.move(centered(viewer.camera, picked.point), false);
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 16) * 0.0015);
    const box = canvas.getBoundingClientRect();
    viewer.move(zoomed(viewer.camera, Math.min(2, Math.max(0.5, factor)),
      (event.clientX - box.left - box.width / 2) / viewer.height(), (event.clientY - box.top - box.height / 2) / viewer.height()));
  }, { passive: false });
}

function follow_keys(viewer) {
  const step = 1 / 36, steps = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
  viewer.canvas.addEventListener("keydown", (event) => {
    if (viewer.saving || event.ctrlKey || event.metaKey || event.altKey) return;
    const camera = viewer.camera, way = steps[event.key];
    if (way) viewer.move((event.shiftKey ? panned : orbited)(camera, ...way));
    else if (event.key === "+" || event.key === "=") viewer.move(zoomed(camera, 1.1));
    else if (event.key === "-") viewer.move(zoomed(camera, 1 / 1.1));
    else if (event.key === "," || event.key === ".") viewer.move(rolled(camera, event.key === "," ? -0.1 : 0.1));
    else if (event.key === "r" || event.key === "R") element("reset").click();
    else if (/^[op]$/i.test(event.key)) set_projection(viewer, !camera.orthographic);
    else return;
    event.preventDefault();
  });
}

function set_projection(viewer, orthographic) {
  viewer.move(projected(viewer.camera, orthographic, viewer.caster.radius), false);
  element("projection").value = projection_of(viewer.camera);
}

const projection_of = (camera) => (camera.orthographic ? "orthographic" : "perspective");

function follow_controls(viewer) {
  const hex = viewer.background.map((c) => Math.round(255 * c).toString(16).padStart(2, "0")).join("");
  element("background").value = `#${hex}`;
  element("projection").value = projection_of(viewer.camera);
  for (const name of ["shade", "lines"]) {
    element(name).checked = viewer.effects[name];
    element(name).parentElement.hidden = !viewer.effects[name];
    element(name).addEventListener("change", () => { viewer.effects[name] = element(name).checked; viewer.change(); });
  }
  follow_layers(viewer);
  follow_views(viewer);
  viewer.figure.schemes.forEach(({ name }, n) => element("scheme").append(new Option(name, n)));
  element("scheme").addEventListener("change", () => viewer.set_scheme(Number(element("scheme").value)));
  element("projection").addEventListener("change", () => set_projection(viewer, element("projection").value === "orthographic"));
  element("background").addEventListener("input", () => {
    viewer.background = [1, 3, 5].map((n) => parseInt(element("background").value.slice(n, n + 2), 16) / 255);
    viewer.change();
  });
  follow_frames(viewer);
  follow_png(viewer);
}

/// What of the surface is shown.
function follow_layers(viewer) {
  const { layers, names, views } = viewer.figure;
  // Where the figure hides atoms, their patches are not in it, and nothing tells what is solid.
  const cuts = layers?.whole && views.every(({ planes }) => planes.length < kMostPlanes);
  for (const [name, there] of [["cut", cuts], ["opacity", layers]]) element(name).parentElement.hidden = !there;
  element("cut").addEventListener("input", () => viewer.set_cut(Number(element("cut").value) / 100));
  element("opacity").addEventListener("input", () => { viewer.opacity = Number(element("opacity").value) / 100; viewer.set_layers(); });
  const chains = [...new Set(names.chains)], shown = new Set(chains);
  if (chains.length < 2 || chains.length > kMostChains) return;
  element("chains").hidden = false;
  for (const chain of chains) {
    const label = document.createElement("label"), box = document.createElement("input");
    Object.assign(box, { type: "checkbox", checked: true });
    label.append(box, ` ${chain || "none"}`);
    box.addEventListener("change", () => { shown[box.checked ? "add" : "delete"](chain); viewer.show_chains(shown); });
    element("chains").append(label);
  }
}

async function main() {
  show_picture(false);
  if (typeof DecompressionStream === "undefined") return say("This browser is too old to unpack the figure: what is shown is a still picture.");
  try {
    const viewer = new Viewer(await read_figure(element("data").textContent, Number(element("data").dataset.bytes)));
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
