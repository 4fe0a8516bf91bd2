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

/// Of row_differences() (exporters/page/page_rows.h). surfaces: of the description's light_maps.
function restored_rows({ primitives, rows: sorted, balls }, surfaces, probe) {
  const count = primitives.length / 12, groups = Array.from({ length: 25 }, () => []);
  const first_row = (n) => n < count ? primitives[12 * n + 5] : sorted.length / 4;
  for (let p = 0; p < count; ++p) {
    const [planes, kind, , contacts] = primitives.subarray(12 * p + 6, 12 * p + 10), first = first_row(p), end = first_row(p + 1);
    for (let row = first, n = 0; row < end; ++row, ++n) {
      const part = kind === 2 && n > 1 ? (n > planes ? 4 : n > contacts ? 3 : 1) : Math.min(n, kind === 0 ? 1 : 4);
      groups[5 * kind + part].push(row);
    }
  }
  const rows = new Uint32Array(sorted.length), values = new Float32Array(rows.buffer);
  let at = 0;
  for (const row of groups.flat()) for (let n = 0; n < 4; ++n, ++at) rows[4 * row + n] = (sorted[at] >>> 1) ^ -(sorted[at] & 1);
  const number = new Float32Array(1), bits = new Uint32Array(number.buffer);
  const predict = (row, predicted, steps = 1 << 17) => predicted.forEach((value, n) => {
    number[0] = Number.isFinite(value) ? Math.floor(value * steps + 0.5) / steps : 0;
    rows[4 * row + n] += bits[0];
  });
  const place = new Float32Array(balls.buffer), ball_of = new Map();
  for (const [ball, atom, number] of surfaces)
    for (let n = 0; n < number; ++n) ball_of.set(atom + n, place.subarray(4 * (ball + n), 4 * (ball + n) + 4));
  const none = new Float32Array(4), ball = (atom) => ball_of.get(atom) ?? none, row_of = (row) => values.subarray(4 * row, 4 * row + 4);
  for (let p = 0; p < count; ++p) {
    if (primitives[12 * p + 7] !== 0) continue;
    const atom = primitives[12 * p + 9], first = first_row(p);
    predict(first, ball(atom));
    ball_of.set(atom, row_of(first));
  }
  for (let p = 0; p < count; ++p) {
    const [planes, kind, , atom, second] = primitives.subarray(12 * p + 6, 12 * p + 11), first = first_row(p);
    if (kind === 1) {
      const a = ball(atom), b = ball(second), between = minus(b, a), distance = Math.sqrt(dot(between, between));
      const a_out = a[3] + probe, b_out = b[3] + probe, axis = between.map((x) => x / distance);
      const a_z = -0.5 * (distance + (a_out - b_out) * (a_out + b_out) / distance), b_z = a_z + distance;
      predict(first, [...axis.map((x, n) => a[n] - x * a_z), Math.sqrt(Math.max((a_out - a_z) * (a_out + a_z), 0))]);
      predict(first + 2, axis);
      const major = values[4 * first + 3], a_contact = a_z * (probe / a_out), b_contact = b_z * (probe / b_out);
      const a_rho = major * (a[3] / a_out), b_rho = major * (b[3] / b_out);
      const clip = 0.5 * (a_contact + b_contact) + 0.5 * (b_rho - a_rho) * (b_rho + a_rho) / (b_contact - a_contact), along = a_contact - clip;
      predict(first + 3, [a_contact, b_contact, clip, Math.sqrt(a_rho * a_rho + along * along)]);
      predict(first + 4, [a_z, a_out, b_z, b_out]);
      const z = [...row_of(first + 2).subarray(0, 3)], size = z.map(Math.abs), least = size.indexOf(Math.min(...size));
      const x = unit(cross(z, [0, 1, 2].map((n) => n === least ? 1 : 0))), y = cross(z, x);
      const [start, sweep] = rows.subarray(4 * first + 4, 4 * first + 6);
      const turn = (angle) => [Math.cos(angle / (1 << 18)), Math.sin(angle / (1 << 18))], [right, up] = turn(start), [end_x, end_y] = turn(sweep);
      row_of(first + 1).set([...plus(times(x, right), times(y, up)), end_x]);
      values[4 * first + 11] = end_y;
    } else if (kind === 2) {
      predict(first, [0, 0, 0, probe]);
      const directions = [], center = row_of(first).subarray(0, 3);
      for (let n = 0; n < atom; ++n) {
        directions.push(unit(minus(ball(rows[4 * (first + 1 + planes + n) + 3]), center)));
        predict(first + 1 + planes + n, directions[n], 1 << 13);
      }
      directions.forEach((direction, n) => predict(first + 1 + n, unit(cross(direction, directions[(n + 1) % atom]))));
    }
  }
  return rows;
}

/// A frame's description with its tables: {..., tables: {name: Uint32Array}}. near: frames that may have some of them.
async function read_frame(figure, n, near = []) {
  const own = n === 0 ? figure.first : { ...figure.first, ...await description_of(figure.parts[figure.frames[n]]) };
  const tables = {}, part_of = (name) => own.tables[name][0];
  const sources = Object.fromEntries(Object.keys(own.tables).map((name) => [name, part_of(name)]));
  sources.rows = ["rows", "primitives", "balls"].map(part_of).join();  // rows are restored from all of these
  const known = (name) => near.find((frame) => frame.sources[name] === sources[name])?.tables[name];
  await Promise.all(Object.entries(own.tables).map(async ([name, [part, stride]]) => {
    tables[name] = known(name) ?? restored(name, words_of(await inflated(figure.parts[part]), stride));
  }));
  tables.rows = known("rows") ?? restored_rows(tables, own.light_maps.surfaces, own.probe);
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
