// SPDX-License-Identifier: BSD-3-Clause
// Reads the page's data: converts text to bytes, and bytes to the descriptions of frames and their tables.

const kMostTables = 100, kMostTableBytes = 256e6;  // limits of the tables of a preview that are kept

/// Reverses text_of_bytes() (exporters/page/page_data.h).
function bytes_of_text(text) {
  const value = new Uint8Array(128);
  for (let code = 33, known = 0; code < 127; ++code) if (!"&<>".includes(String.fromCharCode(code))) value[code] = known++;
  const bytes = new Uint8Array(Math.ceil(text.length * 13 / 16) + 1);
  let length = 0, waiting = 0, bits = 0, first = -1;
  for (let n = 0; n < text.length; ++n) {
    const code = text.charCodeAt(n);
    if (code < 33) continue;  // skips ends of lines
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

/// Reverses packed_table() (exporters/page/page_data.h): returns the words of records whose bytes are apart.
function words_of(bytes, stride) {
  const words = stride / 4, count = bytes.length / stride, table = new Uint32Array(words * count);
  for (let word = 0; word < words; ++word) {
    const [a, b, c, d] = [0, 1, 2, 3].map((byte) => bytes.subarray((4 * word + byte) * count, (4 * word + byte + 1) * count));
    for (let n = 0, at = word; n < count; ++n, at += words) table[at] = a[n] | (b[n] << 8) | (c[n] << 16) | (d[n] << 24);
  }
  return table;
}

/// Reverses PageData::bytes(): returns its parts, which are deflated separately.
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

/// Reverses Tables::packed() (exporters/page/page_tables.h) in place: first rows are differences from those before.
function restored(name, words) {
  if (name === "primitives") for (let at = 12; at < words.length; at += 12) words[at + 5] += words[at - 12 + 5];
  return words;
}

/// Restores the rows of patches from the differences of row_differences() (exporters/page/page_tables.h). surfaces: the
/// list of this name in the description's light_maps.
function restored_rows({ primitives, rows: sorted, balls, shown }, surfaces, probe) {
  const count = primitives.length / 12, groups = Array.from({ length: 25 }, () => []);
  const first_row = (n) => n < count ? primitives[12 * n + 5] : sorted.length / 4;
  for (let p = 0; p < count; ++p) {
    const planes = primitives[12 * p + 6], kind = primitives[12 * p + 7], contacts = primitives[12 * p + 9], end = first_row(p + 1);
    for (let row = first_row(p), n = 0; row < end; ++row, ++n) {
      const part = kind === 2 && n > 1 ? (n > planes ? 4 : n > contacts ? 3 : 1) : Math.min(n, kind === 0 ? 1 : 4);
      groups[5 * kind + part].push(row);
    }
  }
  const rows = new Uint32Array(sorted.length), values = new Float32Array(rows.buffer);
  let from = 0;
  for (const group of groups)
    for (const row of group) for (let n = 4 * row; n < 4 * row + 4; ++n, ++from) rows[n] = (sorted[from] >>> 1) ^ -(sorted[from] & 1);
  const number = new Float32Array(1), bits = new Uint32Array(number.buffer);
  const add = (at, value, steps) => {
    number[0] = Math.abs(value) < Infinity ? Math.floor(value * steps + 0.5) / steps : 0;
    rows[at] += bits[0];
  };
  const predict = (row, x, y, z, w, steps = 1 << 17) => [x, y, z, w].forEach((value, n) => add(4 * row + n, value, steps));
  const place = new Float32Array(balls.buffer), atoms = new Float32Array(4 * shown.length), vector = (table, n) => [table[4 * n], table[4 * n + 1], table[4 * n + 2]];
  for (const [ball, atom, size] of surfaces) atoms.set(place.subarray(4 * ball, 4 * (ball + size)), 4 * atom);
  for (let p = 0; p < count; ++p) {
    if (primitives[12 * p + 7] !== 0) continue;
    const atom = 4 * primitives[12 * p + 9], first = first_row(p);
    predict(first, atoms[atom], atoms[atom + 1], atoms[atom + 2], atoms[atom + 3]);
    for (let n = 0; n < 4; ++n) atoms[atom + n] = values[4 * first + n];
  }
  const turn = (angle) => [Math.cos(angle / (1 << 18)), Math.sin(angle / (1 << 18))];
  for (let p = 0; p < count; ++p) {
    const kind = primitives[12 * p + 7], a = primitives[12 * p + 9], b = primitives[12 * p + 10], first = first_row(p);
    if (kind === 1) {
      const center = vector(atoms, a), between = minus(vector(atoms, b), center), distance = Math.sqrt(dot(between, between));
      const axis = [between[0] / distance, between[1] / distance, between[2] / distance];
      const a_radius = atoms[4 * a + 3], b_radius = atoms[4 * b + 3], a_out = a_radius + probe, b_out = b_radius + probe;
      const a_z = -0.5 * (distance + (a_out - b_out) * (a_out + b_out) / distance), b_z = a_z + distance;
      predict(first, ...minus(center, times(axis, a_z)), Math.sqrt(Math.max((a_out - a_z) * (a_out + a_z), 0)));
      predict(first + 2, ...axis, 0);
      const major = values[4 * first + 3], a_contact = a_z * (probe / a_out), b_contact = b_z * (probe / b_out);
      const a_rho = major * (a_radius / a_out), b_rho = major * (b_radius / b_out);
      const clip = 0.5 * (a_contact + b_contact) + 0.5 * (b_rho - a_rho) * (b_rho + a_rho) / (b_contact - a_contact), along = a_contact - clip;
      predict(first + 3, a_contact, b_contact, clip, Math.sqrt(a_rho * a_rho + along * along));
      predict(first + 4, a_z, a_out, b_z, b_out);
      const z = vector(values, first + 2), [x_size, y_size, z_size] = z.map(Math.abs);
      const far = x_size <= y_size && x_size <= z_size ? [1, 0, 0] : y_size <= z_size ? [0, 1, 0] : [0, 0, 1];
      const x = unit(cross(z, far)), y = cross(z, x), [right, up] = turn(rows[4 * first + 4]), [end_x, end_y] = turn(rows[4 * first + 5]);
      values.set([...plus(times(x, right), times(y, up)), end_x], 4 * first + 4);
      values[4 * first + 11] = end_y;
    } else if (kind === 2) {
      predict(first, 0, 0, 0, probe);
      const directions = [], center = vector(values, first), contact = first + 1 + primitives[12 * p + 6];
      for (let n = 0; n < a; ++n) {
        directions.push(unit(minus(vector(atoms, rows[4 * (contact + n) + 3]), center)));
        predict(contact + n, ...directions[n], 0, 1 << 13);
      }
      for (let n = 0; n < a; ++n) predict(first + 1 + n, ...unit(cross(directions[n], directions[(n + 1) % a])), 0);
    }
  }
  return rows;
}

/// Returns a frame's description with its tables: {..., tables: {name: Uint32Array}}. near: frames that may share some.
async function read_frame(figure, n, near = []) {
  const own = n === 0 ? figure.first : { ...figure.first, ...await description_of(figure.parts[figure.frames[n]]) };
  const tables = {}, part_of = (name) => own.tables[name][0];
  const sources = Object.fromEntries(Object.keys(own.tables).map((name) => [name, part_of(name)]));
  sources.rows = ["rows", "primitives", "balls"].map(part_of).join();  // rows are restored from all three
  const known = (name) => near.find((frame) => frame.sources[name] === sources[name])?.tables[name];
  await Promise.all(Object.entries(own.tables).map(async ([name, [part, stride]]) => {
    tables[name] = known(name) ?? restored(name, words_of(await inflated(figure.parts[part]), stride));
  }));
  tables.rows = known("rows") ?? restored_rows(tables, own.light_maps.surfaces, own.probe);
  return { ...own, number: n, sources, own_colors: tables.colors, tables };
}

/// Returns the page's figure at its first frame. count: of packed bytes; the last two characters may encode one more.
async function read_figure(text, count) {
  const parts = parts_of(bytes_of_text(text).subarray(0, count)), first = await description_of(parts[0]);
  const figure = { first, parts, frames: first.frames };
  return Object.assign(figure, await read_frame(figure, 0), { frames: first.frames });
}

/// Reads the figure that a preview sends (bytes_for_page() in exporters/page/page_file.h). kept: a Map of tables by
/// digest, which has those that are not sent, gets the new ones and loses the oldest; its keys are `has` of the next
/// request. number: unique for each figure.
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
