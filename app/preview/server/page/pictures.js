// SPDX-License-Identifier: BSD-3-Clause
// Shows the program's pictures if this browser does not cast the figure: a Viewer uses it like a caster.

const kind_text = (kind) => ["cap", "shape"].includes(kind) ? kind : `${kind} patch`;

export class Pictures {
  /// ask(command) resolves to the program's reply, state() returns the program's state, origin() the viewer's origin.
  constructor(canvas, ask, state, origin) {
    Object.assign(this, { canvas, ask, state, origin });
  }

  set_scheme() {}
  set_layers() {}

  /// Returns the radius of a ball around all atoms, in Å.
  get radius() { return length(minus(this.state().high, this.state().low)) / 2; }

  /// Draws a picture in the size in which it is shown. Returns the picture's own width as a share of that.
  async show(blob, { width, height }) {
    const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none" }), share = bitmap.width / width;
    const { canvas } = this;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = this.canvas.getContext("2d", { alpha: false });
    context.imageSmoothingQuality = "high";
    context.drawImage(bitmap, 0, 0, width, height);
    bitmap.close();
    return share;
  }

  /// Returns what a pixel shows as Viewer.pick() does, with exposed_area and area_follows. more: part of the question.
  async pick(x, y, more = { area: false }) {
    const { width, height } = this.canvas;
    if (x < 0 || y < 0 || x >= width || y >= height) return null;
    const found = await this.ask({ command: "pick", x, y, wait: false, ...more });
    if (!found.ok || !found.hit) return null;
    return { ...found, x, y, label: found.place, what: kind_text(found.kind), words: `${found.place} – ${kind_text(found.kind)}`,
      place: found.index, point: minus(found.position, this.origin()) };
  }
}
