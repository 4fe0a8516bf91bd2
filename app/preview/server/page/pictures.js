// SPDX-License-Identifier: BSD-3-Clause
// The program's pictures, where this browser does not cast the figure itself: what a Viewer asks of its caster.

const kind_text = (kind) => ["cap", "shape"].includes(kind) ? kind : `${kind} patch`;

export class Pictures {
  /// ask(command) resolves to the program's reply; state() is what the program shows.
  constructor(canvas, ask, state) {
    Object.assign(this, { canvas, ask, state });
  }

  set_scheme() {}
  set_layers() {}

  /// Of a ball around all atoms, in Å.
  get radius() { return length(minus(this.state().high, this.state().low)) / 2; }

  /// Draws a picture, in the size in which it is shown.
  async show(blob, { width, height }) {
    const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none" });
    for (const canvas of [this.canvas, element("picture")])
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = this.canvas.getContext("2d", { alpha: false });
    context.imageSmoothingQuality = "high";
    context.drawImage(bitmap, 0, 0, width, height);
    bitmap.close();
  }

  /// What a pixel shows, as Viewer.pick() has it; also exposed_area and area_follows. more: members of the question.
  async pick(x, y, more = { area: false }) {
    const { width, height } = this.canvas;
    if (x < 0 || y < 0 || x >= width || y >= height) return null;
    const found = await this.ask({ command: "pick", x, y, wait: false, ...more });
    if (!found.ok || !found.hit) return null;
    return { ...found, x, y, label: found.place, what: kind_text(found.kind), words: `${found.place} – ${kind_text(found.kind)}`,
      place: found.index, point: found.position };
  }
}
