// SPDX-License-Identifier: BSD-3-Clause
// Moves the camera to views by their names, with a button for each, and shows frames of a run by a slider and a button
// that plays them. Each frame is unpacked when it is first shown, and the next one in advance.

const kGlide = 500;  // ms

/// Returns a camera on the way between two cameras of the same projection.
function between(from, to, share) {
  const a = basis_of(from), b = basis_of(to), axes = ["right", "up", "forward"];
  const sum = axes.reduce((all, name) => plus(all, cross(a[name], b[name])), [0, 0, 0]);
  const cosine = (axes.reduce((all, name) => all + dot(a[name], b[name]), 0) - 1) / 2, angle = Math.atan2(length(sum) / 2, cosine);
  // Half a turn has no such sum, but the sum of an axis and its turned image lies on the axis of the turn.
  const middles = axes.map((name) => plus(a[name], b[name])).sort((one, other) => length(other) - length(one));
  const axis = unit(length(sum) > 1e-6 ? sum : middles[0]);
  const target = plus(times(from.target, 1 - share), times(to.target, share)), mixed = (x, y) => x ** (1 - share) * y ** share;
  return { ...to, target, up: turned(a.up, axis, share * angle), fov: mixed(from.fov, to.fov), height: mixed(from.height, to.height),
    position: minus(target, times(turned(a.forward, axis, share * angle), mixed(reach_of(from), reach_of(to)))) };
}

/// Moves the camera smoothly, or at once for readers who want no motion.
function glide(viewer, to) {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return viewer.move(to, false);
  const from = projected(viewer.camera, to.orthographic, viewer.caster.radius), began = performance.now();
  viewer.move(from);
  const step = viewer.gliding = () => {
    if (viewer.gliding !== step) return;
    const share = (performance.now() - began) / kGlide;
    if (share >= 1) return viewer.move(to, false);
    viewer.camera = between(from, to, share * share * (3 - 2 * share));
    viewer.change(true);
    requestAnimationFrame(step);
  };
  step();
}

function follow_views(viewer) {
  const show = (number) => {
    const view = viewer.figure.views[number];
    Object.assign(viewer, { view_number: number, cut: null, depth: 0, opacity: view.opacity });
    Object.assign($("cut"), { value: 0 });
    Object.assign($("opacity"), { value: 100 * view.opacity });
    $("projection").value = projection_of(view.camera);
    $("picked").textContent = view.name;
    viewer.set_layers();
    glide(viewer, view.camera);
  };
  $("reset").addEventListener("click", () => show(0));
  viewer.figure.views.forEach(({ name }, number) => {
    if (number === 0) return;
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: name });
    button.addEventListener("click", () => show(number));
    $("views").append(button);
  });
}

const kFrameTime = 80;       // least ms for each frame
const kMostKept = 384e6;     // limit of the bytes of tables, and of textures

const painted = () => new Promise((go) => requestAnimationFrame(() => setTimeout(go)));
const bytes_of = (frame) => Object.values(frame.tables).reduce((sum, table) => sum + table.byteLength, 0);

class Frames {
  constructor(viewer) {
    this.viewer = viewer;
    this.count = viewer.figure.frames.length;
    this.shown = this.wanted = 0;
    this.kept = new Map([[0, { ...viewer.figure }]]);  // frames by number, the latest at the end
    this.reading = new Map();  // promises by number
    this.step = 1;
  }

  /// Returns a frame, which is unpacked once.
  async read(n) {
    const known = this.kept.get(n);
    const frame = known ?? await (this.reading.get(n) ?? this.begin(n));
    this.kept.delete(n);
    this.kept.set(n, frame);
    return frame;
  }

  begin(n) {
    const reading = read_frame(this.viewer.figure, n, [...this.kept.values()]).finally(() => this.reading.delete(n));
    this.reading.set(n, reading);
    return reading;
  }

  /// Removes old frames beyond the limit, but never the shown one.
  forget() {
    let bytes = [...this.kept.values()].reduce((sum, frame) => sum + bytes_of(frame), 0);
    for (const [n, frame] of this.kept) {
      if (bytes <= kMostKept) return;
      if (n === this.shown) continue;
      bytes -= bytes_of(frame);
      this.kept.delete(n);
      this.viewer.caster?.forget(n);
    }
  }

  /// Shows a frame. The last one of several requests is shown in the end, and earlier ones if there is time.
  async show(n) {
    this.step = n < this.wanted ? -1 : 1;
    this.wanted = n;
    this.tell();
    if (this.busy) return;
    this.busy = true;
    try {
      while (this.shown !== this.wanted) {
        const next = this.wanted, frame = await this.read(next);
        this.shown = next;
        this.viewer.show_frame(frame);
        this.forget();
      }
    } catch (error) {
      this.pause();
      say(`This frame cannot be shown: ${error.message}`);
    } finally {
      this.busy = false;
    }
    this.look_ahead();
  }

  /// Prepares the next frame before it is requested.
  async look_ahead() {
    const next = (this.shown + this.step + this.count) % this.count, shown = this.shown;
    await painted();
    if (this.busy || this.shown !== shown || this.viewer.saving) return;
    const frame = await this.read(next);
    await painted();
    if (this.shown === shown) this.viewer.caster?.prepare(frame);
  }

  tell() {
    const words = `${this.wanted + 1} of ${this.count}: ${this.viewer.figure.moments[this.wanted]}`;
    Object.assign($("frame"), { value: this.wanted }).setAttribute("aria-valuetext", words);
    $("moment").textContent = words;
  }

  /// Plays the frames in order, again from the first, until the reader stops them.
  async play() {
    this.playing = this.viewer.playing = true;
    $("play").textContent = "Pause";
    while (this.playing && this.viewer.caster && !this.viewer.saving) {
      const began = performance.now();
      await this.show((this.wanted + 1) % this.count);
      await painted();
      await new Promise((go) => setTimeout(go, Math.max(0, began + kFrameTime - performance.now())));
    }
    this.pause();
  }

  pause() {
    if (!this.playing) return;
    this.playing = this.viewer.playing = false;
    $("play").textContent = "Play";
    this.viewer.change();
  }

  toggle() { if (this.playing) this.pause(); else this.play(); }

  go(step) {
    this.pause();
    this.show(Math.min(this.count - 1, Math.max(0, this.wanted + step)));
  }
}

function follow_frames(viewer) {
  if (viewer.figure.frames.length < 2) return;
  const frames = viewer.frames = new Frames(viewer), input = $("frame");
  $("frames").hidden = false;
  input.max = frames.count - 1;
  frames.tell();
  input.addEventListener("input", () => { frames.pause(); frames.show(Number(input.value)); });
  $("play").addEventListener("click", () => frames.toggle());
  frames.look_ahead();
}
