// SPDX-License-Identifier: BSD-3-Clause
// Reads the page's data: text to bytes, bytes to the descriptions of frames and their tables.

const kMostTables = 100, kMostTableBytes = 256e6;  // tables that are kept of what a preview sent

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

async function description_of(part) { return JSON.parse(new TextDecoder().decode(await inflated(part))); }

/// Of packed_table() (exporters/page/page_data.h): words of records, whose bytes lie apart.
function words_of(bytes, stride) {
  const words = stride / 4, count = bytes.length / stride, table = new Uint32Array(words * count);
  for (let word = 0; word < words; ++word) {
    const [a, b, c, d] = [0, 1, 2, 3].map((byte) => bytes.subarray((4 * word + byte) * count, (4 * word + byte + 1) * count));
    for (let n = 0, at = word; n < count; ++n, at += words) table[at] = a[n] | (b[n] << 8) | (c[n] << 16) | (d[n] << 24);
  }
  return table;
}

/// Of PageData::bytes(): its parts, each deflated by itself.
function parts_of(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset), count = view.getUint32(0, true), parts = [];
  let at = 4 * (count + 1);
  for (let n = 1; n <= count; ++n) {
    const end = at + view.getUint32(4 * n, true);
    parts.push(bytes.subarray(at, end));
    at = end;
  }
  if (at !== bytes.length) throw new Error("The page's data is not whole.");
  return parts;
}

/// Of Tables::packed() (exporters/page/page_tables.h), in place: first rows are written as how many more they are than the one
/// before.
function restored(name, words) {
  if (name === "primitives") for (let at = 12; at < words.length; at += 12) words[at + 5] += words[at - 12 + 5];
  return words;
}

/// A frame's description with its tables: {..., tables: {name: Uint32Array}}. near: frames that may have some of them.
async function read_frame(figure, n, near = []) {
  const own = n === 0 ? figure.first : { ...figure.first, ...await description_of(figure.parts[figure.frames[n]]) };
  const tables = {};
  await Promise.all(Object.entries(own.tables).map(async ([name, [part, stride]]) => {
    const known = near.find((frame) => frame.sources[name] === part);
    tables[name] = known ? known.tables[name] : restored(name, words_of(await inflated(figure.parts[part]), stride));
  }));
  const sources = Object.fromEntries(Object.entries(own.tables).map(([name, [part]]) => [name, part]));
  return { ...own, number: n, sources, own_colors: tables.colors, tables };
}

/// What the page shows, at its first frame. count: of the packed bytes; the last two characters may stand for one more.
async function read_figure(text, count) {
  const parts = parts_of(bytes_of_text(text).subarray(0, count)), first = await description_of(parts[0]);
  const figure = { first, parts, frames: first.frames };
  return Object.assign(figure, await read_frame(figure, 0), { frames: first.frames });
}

/// Reads the figure that a preview sends (bytes_for_page() in exporters/page/page_file.h). kept: a Map of tables by digest, which
/// takes up those that come and forgets the oldest; its keys are `has` of the next request. Those that did not come are in it.
/// number: another one for each figure.
function read_figure_bytes(bytes, kept, number) {
  const parts = parts_of(bytes), read_json = (part) => JSON.parse(new TextDecoder().decode(part)), first = read_json(parts[0]);
  const table_of = ([part, , digest], read) => {
    const table = part === null ? kept.get(digest) : read(parts[part]);
    kept.delete(digest);
    kept.set(digest, table);
    return table;
  };
  const names = table_of(first.names, read_json), tables = {}, sources = {};
  for (const [name, entry] of Object.entries(first.tables)) {
    tables[name] = table_of(entry, (part) => restored(name, new Uint32Array(part.slice().buffer)));
    sources[name] = entry[2];
  }
  kept.shaders = first.shaders ?? kept.shaders;
  let count = 0, size = 0;
  for (const [digest, table] of [...kept].reverse())
    if (++count > kMostTables || (size += table.byteLength ?? 0) > kMostTableBytes) kept.delete(digest);
  return { ...first, names, shaders: kept.shaders, number, frames: [0], moments: [""], sources, own_colors: tables.colors, tables };
}
