// SPDX-License-Identifier: BSD-3-Clause
// The figure in the reader's browser: draws it when something changes, and names picked atoms.

const kDraft = 40;         // ms that a frame may take while the view moves
const kMostPixels = 2048;  // the most pixels along a side
const $ = (id) => document.getElementById(id);

class Viewer {
  /// pictures: a source of pictures that replaces this browser's WebGL, such as the preview's program.
  constructor(figure, pictures = null) {
    Object.assign(this, { figure, pictures });
    this.canvas = $("picture");
    this.view_number = 0;
    this.camera = this.view.camera;
    this.background = figure.background;
    this.effects = { shade: figure.has_shade, lines: figure.has_lines };
    this.opacity = this.view.opacity;
    this.cut = null;  // the plane of the reader's cut
    this.depth = 0;  // share of the molecule that the cut removes
    this.cuts_with_view = true;
    this.rests_here = true;  // draws the picture at rest; else only drafts
    this.hidden = [];  // numbers of atoms
    this.selected = new Set();  // their numbers in the names
    this.selects = false;  // clicks select, and the middle button centres
    this.draft_scale = 1;
    this.sample = -1;  // the last sample of the picture at rest
    this.moving = false;
    this.write_labels();
    this.start();
    this.canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); this.fail("The graphics device was reset; a still picture is shown until it is back."); });
    this.canvas.addEventListener("webglcontextrestored", () => { this.start(); show_picture(true); say(""); this.change(); });
    new ResizeObserver(() => this.change()).observe($("stage"));
  }

  get view() { return this.figure.views[this.view_number]; }

  write_labels() {
    this.texts = this.figure.labels.map(({ text }) => {
      const made = document.createElementNS("http://www.w3.org/2000/svg", "text");
      made.textContent = text;
      return made;
    });
    $("labels").replaceChildren(...this.texts);
  }

  /// Shows another figure, which has a unique number; the camera stays.
  show_figure(figure) {
    const { names, number, origin } = this.figure, shift = minus(origin, figure.origin);
    Object.assign(this.figure, figure);
    Object.assign(this, { view_number: 0, opacity: this.view.opacity, scheme: 0, background: figure.background });
    Object.assign(this.camera = { ...this.camera }, { position: plus(this.camera.position, shift), target: plus(this.camera.target, shift) });
    this.effects = { shade: figure.has_shade, lines: figure.has_lines };
    if (names !== figure.names) this.last_picked = undefined;
    this.write_labels();
    if (this.pictures || !this.caster) return;
    this.caster.show(this.figure);
    this.caster.forget(number);
    this.mark_selected();
    this.set_scheme(0);
    this.set_layers();
  }

  /// Sets the source of pictures that replaces this browser's WebGL; null: this browser casts.
  show_pictures(pictures) {
    this.pictures = pictures;
    this.start();
    this.change();
  }

  /// Shows a frame that read_frame() returned.
  show_frame(frame) {
    const { names, labels, tables } = this.figure;
    Object.assign(this.figure, frame);
    if (!this.caster) return;
    if (this.shown_chains && (names !== frame.names || tables.shown !== frame.tables.shown)) this.hidden = this.caster.hidden = this.atoms_beside(this.shown_chains);
    if (names !== frame.names) this.last_picked = undefined;
    if (labels !== frame.labels) this.write_labels();
    this.caster.show(frame);
    this.mark_selected();
    this.lay();
    this.change(true);
  }

  start() {
    this.caster?.release?.();
    this.caster = this.pictures ?? new LayeredCaster(this.canvas, this.figure);
    this.caster.hidden = this.hidden;
    this.caster.set_scheme(this.scheme ?? 0);
    this.mark_selected();
    this.lay();
  }

  set_scheme(scheme) {
    this.scheme = scheme;
    this.caster.set_scheme(scheme);
    $("legend").innerHTML = this.figure.schemes[scheme].legend;  // the exporter escapes it
    this.change();
  }

  lay() {
    const { planes, hatching, looks_inside } = this.view, { depths = [] } = this.figure, { forward } = basis_of(this.camera);
    if (this.cuts_with_view && this.cut) this.cut = this.plane_at(this.depth, forward);
    const cut = this.cut ? [this.cut] : [], placed = planes.map((plane, n) => depths[n] === undefined ? plane : this.plane_at(depths[n], forward));
    this.caster.fades = this.figure.fades_always || !(looks_inside || this.opacity < 1);
    this.caster.set_layers([...placed, ...cut], [...hatching, ...cut.map(() => [0, 0, 0, 0])], this.opacity);
  }

  set_layers() {
    this.lay();
    this.change(true);
  }

  /// Returns the plane across `forward` that removes everything nearer than a share of the molecule's depth.
  plane_at(depth, forward) {
    const balls = new Float32Array(this.figure.tables.balls.buffer), end = 4 * (this.figure.layers?.surface_atoms ?? balls.length / 4);
    let [nearest, farthest] = [Infinity, -Infinity];
    for (let n = 0; n < end; n += 4) {
      const along = balls[n] * forward[0] + balls[n + 1] * forward[1] + balls[n + 2] * forward[2];
      nearest = Math.min(nearest, along - balls[n + 3]);
      farthest = Math.max(farthest, along + balls[n + 3]);
    }
    return [...times(forward, -1), -(nearest + depth * (farthest - nearest))];
  }

  /// Cuts the molecule. depth: the share that the plane removes; 0: no plane. The plane is across the present view, or
  /// across the view in which the cut began.
  set_cut(depth) {
    const forward = this.cut && !this.cuts_with_view ? times(this.cut, -1).slice(0, 3) : basis_of(this.camera).forward;
    this.depth = depth;
    this.cut = depth > 0 ? this.plane_at(depth, forward) : null;
    this.set_layers();
  }

  /// Shows chains. shown: their names.
  show_chains(shown) {
    this.shown_chains = shown;
    this.hidden = this.atoms_beside(shown);
    this.caster.hide(this.hidden);
    this.change();
  }

  /// Shows atoms as selected. places: their numbers in the names.
  select(places) {
    this.selected = new Set(places);
    this.mark_selected();
    if (this.casts) this.change();
  }

  mark_selected() {
    if (!this.casts) return;
    const { shown } = this.figure.tables;
    this.caster.select(this.selected.size > 0 ? [...shown.keys()].filter((atom) => this.selected.has(shown[atom])) : []);
  }

  /// Returns the atoms of other chains.
  atoms_beside(shown) {
    const { names, tables } = this.figure;
    return [...tables.shown.keys()].filter((atom) => !shown.has(names.chains[this.residue_of(atom)]));
  }

  fail(sentence) {
    cancelAnimationFrame(this.waiting);
    this.waiting = 0;
    this.caster = null;
    this.failed(sentence);
  }

  failed(sentence) {
    show_picture(false);
    say(sentence);
  }

  /// Returns true if this browser casts the picture itself.
  get casts() { return this.caster !== null && this.caster !== this.pictures; }

  pixels() {
    const stage = $("stage"), scale = Math.min(window.devicePixelRatio || 1,
      kMostPixels / Math.max(stage.clientWidth, stage.clientHeight, 1));
    return [Math.max(1, Math.round(stage.clientWidth * scale)), Math.max(1, Math.round(stage.clientHeight * scale))];
  }

  /// Returns the factor by which the visible height exceeds the camera's.
  growth() {
    const [width, height] = this.figure.size, { clientWidth, clientHeight } = $("stage");
    return Math.max(1, (width / height) * (clientHeight / Math.max(clientWidth, 1)));
  }

  begin(width, height) {
    if (this.cuts_with_view || this.figure.depths) this.lay();
    this.caster.begin(widened(this.camera, this.growth()), width, height);
  }

  /// Returns the height of the camera's picture in CSS pixels, by which motions are measured.
  height() { return this.canvas.clientHeight / this.growth(); }

  /// Requests another picture. moving: true if the view will soon change again.
  change(moving = false) {
    this.moving = moving;
    this.sample = -1;
    this.rest(false);
    this.changed?.();
    if (!this.waiting && this.caster && !this.saving) this.waiting = requestAnimationFrame(() => this.draw());
    clearTimeout(this.pause);
    if (moving && !this.playing) this.pause = setTimeout(() => this.change(), 150);
  }

  /// Notes whether the picture is complete.
  rest(is_whole) { this.canvas.dataset.rest = String(is_whole); }

  move(camera, moving = true) {
    this.gliding = null;
    this.camera = camera;
    this.change(moving);
  }

  draw() {
    this.waiting = 0;
    if (!this.casts || this.saving) return;
    const [width, height] = this.pixels();
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    try {
      if (this.moving || !this.rests_here) this.draw_draft(width, height);
      else this.draw_sample(width, height);
      this.draw_labels();
    } catch (error) {
      if (!(error instanceof NoWebGl)) throw error;
      this.fail(error.message);
    }
  }

  /// Returns the places of points in CSS pixels from the top left; nothing for points behind the camera.
  places(points) {
    const { frame, whole } = this.caster, { clientWidth, clientHeight } = this.canvas;
    return places_of(points, { ...frame, pixel_size: frame.pixel_size * whole[1] / clientHeight }, [clientWidth, clientHeight]);
  }

  /// Draws labels at their atoms, in front of everything.
  draw_labels() {
    const { labels } = this.figure, dark = this.background.reduce((sum, c) => sum + c, 0) < 1.5;
    $("labels").classList.toggle("on-dark", dark);
    this.places(labels.map(({ point }) => point)).forEach((place, n) => {
      const text = this.texts[n];
      text.setAttribute("visibility", place ? "visible" : "hidden");
      if (place) { text.setAttribute("x", place[0].toFixed(1)); text.setAttribute("y", place[1].toFixed(1)); }
    });
  }

  /// Draws a draft, and returns the milliseconds that it takes.
  draw_draft(width, height) {
    const began = performance.now(), scale = this.draft_scale;
    this.begin(Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)));
    this.caster.cast(0, { shade: false, lines: false, draft: true });
    this.caster.present(linear_from_srgb(this.background));
    this.caster.read(0, 0, 1, 1, 2);  // waits until the device has drawn
    const took = performance.now() - began;
    this.draft_scale = Math.min(1, Math.max(0.125, scale * Math.sqrt(kDraft / Math.max(took, 1))));
    if (this.draft_scale > 0.8) this.draft_scale = 1;
    this.canvas.dataset.draft = took.toFixed(1);
    this.drafted?.(took);
    return took;
  }

  draw_sample(width, height) {
    if (this.sample < 0) this.begin(width, height);
    this.caster.cast(++this.sample, this.effects);
    this.caster.present(linear_from_srgb(this.background));
    if (this.sample + 1 < this.figure.samples.length) this.waiting = requestAnimationFrame(() => this.draw());
    else this.rest(true);
  }

  /// Returns what is at a place of the window: {atom, place, primitive, point}, or null. place: index in the names.
  async pick(x, y) {
    if (!this.caster || this.saving) return null;
    if (this.casts && this.sample < 0) { this.moving = false; const [width, height] = this.pixels(); this.draw_sample(width, height); }
    const box = this.canvas.getBoundingClientRect(), { width, height } = this.caster.canvas;
    const found = await this.caster.pick(Math.floor((x - box.left) * width / box.width), Math.floor((y - box.top) * height / box.height));
    return found && { place: this.figure.tables?.shown[found.atom], ...found };
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

  /// Returns a sentence about a picked point, with the distance from the atom that was picked before.
  tell(picked) {
    const before = this.last_picked;
    this.last_picked = picked?.atom;
    if (!picked) return "";
    if (picked.words) return picked.words;
    if (before === undefined || before === picked.atom) return this.words(picked);
    const places = [picked.atom, before].map((atom) => this.caster.center_of(atom));
    if (places.includes(null)) return this.words(picked);
    const distance = length(minus(...places));
    return `${this.words(picked)}; ${distance.toFixed(2)} Å from ${this.atom_name(before)}`;
  }

  /// Returns the names of the atom, its residue and its patch.
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

  /// Paints labels on a picture with this width in pixels.
  paint_labels(context, width) {
    const style = getComputedStyle($("labels")), scale = width / this.canvas.clientWidth;
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

