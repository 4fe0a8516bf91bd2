// SPDX-License-Identifier: BSD-3-Clause
// Draws a PNG of any size tile by tile, with its labels; the reader sees the progress and may stop it.

const kMostPngPixels = 64e6;
/// A picture whose sides do not exceed `whole` is one tile. Lengths are in pixels.
const kTiles = { whole: 2048, tile: 1024 };

/// Puts a file into the browser's downloads.
function download(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

const later = () => new Promise((go) => setTimeout(go));

/// Returns the pixels of a tile without its margin, rows from the top.
function tile_pixels(caster, background, { x, y, width, height, left, top, size }) {
  const gl = caster.gl, target = caster.target(caster.texture(gl.RGBA8)), all = new Uint8Array(4 * size[0] * size[1]);
  caster.present(background, target, size);
  gl.readBuffer(gl.COLOR_ATTACHMENT0);
  gl.readPixels(0, 0, ...size, gl.RGBA, gl.UNSIGNED_BYTE, all);
  gl.deleteTexture(gl.getFramebufferAttachmentParameter(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
  gl.deleteFramebuffer(target);
  const pixels = new ImageData(width, height);
  for (let row = 0; row < height; ++row) {
    const from = 4 * ((size[1] - 1 - (y - top + row)) * size[0] + x - left);
    pixels.data.set(all.subarray(from, from + 4 * width), 4 * row * width);
  }
  return pixels;
}

/// Returns the tiles of a picture, each with a margin as wide as the reach of effects between neighbouring pixels.
function tiles_of([width, height]) {
  if (Math.max(width, height) <= kTiles.whole) return [{ x: 0, y: 0, width, height, left: 0, top: 0, size: [width, height] }];
  const tiles = [], step = kTiles.tile, margin = 16;
  for (let y = 0; y < height; y += step)
    for (let x = 0; x < width; x += step) {
      const left = Math.max(x - margin, 0), top = Math.max(y - margin, 0);
      tiles.push({ x, y, left, top, width: Math.min(step, width - x), height: Math.min(step, height - y),
        size: [Math.min(x + step + margin, width) - left, Math.min(y + step + margin, height) - top] });
    }
  return tiles;
}

/// Draws the view at rest as a PNG; null if it was stopped. tell(done, all) reports numbers of samples in all tiles.
async function draw_png(viewer, size, tell) {
  const { caster, figure, effects } = viewer, page = Object.assign(document.createElement("canvas"), { width: size[0], height: size[1] });
  const context = page.getContext("2d"), camera = widened(viewer.camera, viewer.growth()), background = linear_from_srgb(viewer.background);
  const saving = viewer.saving = { stopped: false };
  caster.select([]);
  try {
    const tiles = tiles_of(size);
    for (const [n, tile] of tiles.entries()) {
      caster.begin(camera, ...size, tile);
      for (let sample = 0; sample < figure.samples.length; ++sample) {
        tell(n * figure.samples.length + sample, tiles.length * figure.samples.length);
        await later();
        if (saving.stopped || viewer.caster !== caster) return null;
        caster.cast(sample, effects);
        caster.read(0, 0, 1, 1, 2);  // waits until the device has drawn
      }
      context.putImageData(tile_pixels(caster, background, tile), tile.x, tile.y);
    }
    viewer.paint_labels(context, size[0]);
    return await new Promise((done) => page.toBlob(done, "image/png"));
  } finally {
    caster.size = [0, 0];
    viewer.saving = null;
    viewer.mark_selected();
    viewer.change();
  }
}

function follow_png(viewer) {
  const button = $("save"), input = $("width"), words = button.textContent;
  $("write").addEventListener("submit", (event) => event.preventDefault());
  input.addEventListener("focus", () => {
    $("widths").replaceChildren(...[1, 2, 4].map((times) => new Option("", times * viewer.pixels()[0])));
  });
  button.addEventListener("click", async () => {
    if (viewer.saving) { viewer.saving.stopped = true; return; }
    const window_size = viewer.pixels(), width = Math.round(Number(input.value)) || window_size[0];
    const size = [width, Math.max(1, Math.round(width * window_size[1] / window_size[0]))];
    const most = Math.floor(Math.sqrt(kMostPngPixels * window_size[0] / window_size[1]));
    if (width < 16 || width > most) return say(`The width of a PNG of this view is 16 to ${most} pixels.`);
    say("");
    button.textContent = "Stop";
    const others = [$("sections"), input.parentElement];
    for (const other of others) other.inert = true;
    const tell = (done, all) => { $("picked").textContent = `Drawing ${size[0]} × ${size[1]} pixels: ${Math.floor(100 * done / all)} %`; };
    try {
      const png = await draw_png(viewer, size, tell);
      $("picked").textContent = png ? "The PNG is drawn." : "Nothing is saved.";
      if (!png) return;
      download(png, `${(viewer.figure.title.match(/[\w-]+/g) ?? ["figure"]).join("_")}.png`);
    } catch (error) {
      say(`This device cannot draw so large a PNG; choose a smaller width. (${error.message})`);
    } finally {
      button.textContent = words;
      for (const other of others) other.inert = false;
    }
  });
}
