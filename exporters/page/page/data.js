// SPDX-License-Identifier: BSD-3-Clause
// Reads the page's data: text to bytes, bytes to a description and its tables.

/// Of text_of_bytes() (exporters/page/page_data.h).
function bytes_of_text(text) {
  const value = new Uint8Array(128);
  for (let code = 33, known = 0; code < 127; ++code) if (!"&<>".includes(String.fromCharCode(code))) value[code] = known++;
  const bytes = new Uint8Array(Math.ceil(text.length * 13 / 16) + 1);
  let length = 0, waiting = 0, bits = 0, first = -1;
  for (let n = 0; n < text.length; ++n) {
    const code = text.charCodeAt(n);
    if (code < 33) continue;  // ends of lines
    if (first < 0) { first = value[code]; continue; }
    waiting |= (first * 91 + value[code]) << bits;
    bits += 13;
    first = -1;
    for (; bits >= 8; bits -= 8, waiting >>>= 8) bytes[length++] = waiting & 255;
  }
  return bytes.subarray(0, length);
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// {description..., tables: {name: Uint32Array}}. count: of the packed bytes; the last two characters may stand for one more.
async function read_figure(text, count) {
  const bytes = await inflated(bytes_of_text(text).subarray(0, count));
  const words = new DataView(bytes.buffer).getUint32(0, true);
  const figure = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + words)));
  let at = 4 + words;
  const tables = {};
  for (const { name, stride, count } of figure.tables) {
    const table = new Uint8Array(stride * count);
    for (let byte = 0; byte < stride; ++byte)
      for (let n = 0; n < count; ++n) table[n * stride + byte] = bytes[at++];
    tables[name] = new Uint32Array(table.buffer);
  }
  tables.own_colors = tables.colors;
  // First rows are written as how many more they are than the one before.
  for (let n = 12; n < tables.primitives.length; n += 12) tables.primitives[n + 5] += tables.primitives[n - 12 + 5];
  if (at !== bytes.length) throw new Error("The page's data is not whole.");
  return { ...figure, tables };
}
