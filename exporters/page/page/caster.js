// SPDX-License-Identifier: BSD-3-Clause
// Passes tables and parameters to the shaders, and runs their passes: cast, points, light, finish, present.

const kTableColumns = 2048;  // the value of gpu_shaders/webgl/tables.glsl
const kNoPrimitive = 0xffffffff;
const kToroidal = 1, kCylinder = 3;
const kIsBeside = 1;    // the value of exporters/page/page_tables.cpp
const kBuckets = 4096;  // steps of depth, front to back
const kSelected = [1, 0.43, 0], kSelectedShare = 0.75;  // linear colour of selected atoms, and its share

/// The error of a figure that cannot be drawn here, with a sentence for its reader.
class NoWebGl extends Error {}

const linear_from_srgb = (color) => color.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));

/// Returns a source in which includes are replaced by the text of their files, each file once.
function expanded(sources, path, seen = new Set()) {
  if (seen.has(path)) return "";
  seen.add(path);
  return sources[path].replace(/^#include "(.*)"$/gm, (_, included) => expanded(sources, included, seen));
}

class Caster {
  constructor(canvas, figure) {
    this.figure = figure;
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, depth: false, powerPreference: "high-performance" });
    if (!gl) throw new NoWebGl("This browser has no WebGL 2: what is shown is a still picture.");
    this.gl = gl;
    this.canvas = canvas;
    this.early_depth = gl.getExtension("EXT_conservative_depth") !== null;
    this.programs = new Map();
    this.size = [0, 0];
    this.tables = {};
    this.ready = new Map();  // the resources of frames on the device, by their numbers
    this.scheme = 0;
    this.light = new LightMaps(this);
    this.buffer = gl.createBuffer();
    this.vertices = gl.createVertexArray();
    gl.pixelStorei(gl.PACK_ALIGNMENT, 1);
    gl.disable(gl.DITHER);
    this.show(figure);
  }

  table_names() { return ["primitives", "rows", "marks", "map"]; }

  /// Makes the resources of a frame: textures of its tables, and its primitives in groups.
  prepare(frame) {
    if (this.ready.has(frame.number)) return this.ready.get(frame.number);
    const alike = (name) => [...this.ready.values()].find((other) => other.tables[name] === frame.tables[name]);
    const made = { tables: frame.tables, textures: {}, grouped: alike("primitives")?.grouped ?? this.grouped(frame.tables.primitives) };
    for (const name of this.table_names().filter((table) => table in frame.tables))
      made.textures[name] = alike(name)?.textures[name] ?? this.table(frame.tables[name], kSingle.has(name));
    this.ready.set(frame.number, made);
    return made;
  }

  /// Makes the frame the current one.
  show(frame) {
    const { textures, grouped } = this.prepare(frame);
    Object.assign(this, grouped, { tables: { ...textures, colors: this.tables.colors } });
    this.set_scheme(this.scheme);
  }

  /// Frees the resources of a frame that is not shown.
  forget(number) {
    const { textures = {} } = this.ready.get(number) ?? {};
    this.ready.delete(number);
    const kept = new Set([...this.ready.values()].flatMap((frame) => Object.values(frame.textures)));
    for (const texture of Object.values(textures)) if (!kept.has(texture)) this.gl.deleteTexture(texture);
  }

  texture(format) {
    const gl = this.gl, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    if (format) gl.texStorage2D(gl.TEXTURE_2D, 1, format, ...this.size);
    return texture;
  }

  /// Returns a texture with a table of records, of four words per texel, or of one.
  table(words, single = false) {
    const gl = this.gl, channels = single ? 1 : 4;
    const rows = Math.max(1, Math.ceil(words.length / channels / kTableColumns));
    if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE))
      throw new NoWebGl("This figure is too large for the textures of this device: what is shown is a still picture.");
    const texture = this.texture(null);
    const padded = new Uint32Array(rows * kTableColumns * channels);
    padded.set(words);
    gl.texImage2D(gl.TEXTURE_2D, 0, single ? gl.R32UI : gl.RGBA32UI, kTableColumns, rows, 0,
      single ? gl.RED_INTEGER : gl.RGBA_INTEGER, gl.UNSIGNED_INT, padded);
    return texture;
  }

  /// Returns the primitives in groups that are drawn together, because they have one shader.
  grouped(words) {
    const numbers = new Float32Array(words.buffer), primitive_count = words.length / 12;
    const centers = new Float32Array(3 * primitive_count), radii = new Float32Array(primitive_count), groups = [[], [], [], [], []];
    for (let n = 0; n < primitive_count; ++n) {
      centers.set(numbers.subarray(12 * n, 12 * n + 3), 3 * n);
      radii[n] = numbers[12 * n + 3];
      const kind = words[12 * n + 7], is_beside = words[12 * n + 8] & kIsBeside ? 2 : 0;
      groups[kind >= kCylinder ? 4 : is_beside + (kind === kToroidal ? 1 : 0)].push(n);
    }
    return { primitive_count, centers, radii,
      groups: groups.map((list, n) => ({ define: ["", "TORI", "", "TORI", "SHAPES"][n], of_surface: n < 2, list: Uint32Array.from(list) })) };
  }

  /// Sets the colour scheme. scheme: its index among the figure's.
  set_scheme(scheme) {
    const { own_colors, tables, schemes } = this.figure, words = scheme > 0 ? tables[`scheme_${scheme}`] : own_colors;
    const made_of = [words, own_colors, this.hidden, this.selected], is_same = made_of.every((part, n) => part === this.colors_of?.[n]);
    this.by_kind = schemes[scheme].by_kind ? 1 : 0;
    this.scheme = scheme;
    this.look = schemes[scheme].look ?? this.figure.look;
    if (is_same) return;
    const own = new Float32Array(own_colors.buffer), colors = scheme > 0 ? new Float32Array(4 * words.length) : own.slice();
    if (scheme > 0)
      words.forEach((word, n) => colors.set([...linear_from_srgb([0, 8, 16].map((bit) => ((word >> bit) & 255) / 255)),
        n < tables.shown.length ? own[4 * n + 3] : 1], 4 * n));
    for (const atom of this.hidden ?? []) colors[4 * atom + 3] = 0;
    for (const atom of this.selected ?? [])
      kSelected.forEach((channel, n) => { colors[4 * atom + n] += kSelectedShare * (channel - colors[4 * atom + n]); });
    this.gl.deleteTexture(this.tables.colors ?? null);
    this.tables.colors = this.table(new Uint32Array(colors.buffer));
    this.colors_of = made_of;
  }

  /// Frees all resources of the figure on the device.
  release() {
    for (const number of [...this.ready.keys()]) this.forget(number);
    this.gl.deleteTexture(this.tables.colors ?? null);
    this.gl.deleteTexture(this.light.texture);
    this.resize(1, 1);
  }

  /// Hides atoms. atoms: the numbers of those that are hidden in addition to those that the figure hides.
  hide(atoms) {
    this.hidden = atoms;
    this.set_scheme(this.scheme);
  }

  /// Tints atoms as selected. atoms: their numbers.
  select(atoms) {
    this.selected = atoms;
    this.set_scheme(this.scheme);
  }

  hides_some() { return this.figure.some_hidden || (this.hidden?.length ?? 0) > 0; }

  shader(type, name, defines) {
    const gl = this.gl, shader = gl.createShader(type), text = expanded(this.figure.shaders, `gpu_shaders/webgl/${name}`);
    const start = text.indexOf("#version"), end = text.indexOf("\n", start) + 1;
    gl.shaderSource(shader, text.slice(start, end) + defines.map((word) => `#define ${word} 1\n`).join("") + text.slice(end));
    gl.compileShader(shader);
    return shader;
  }

  /// Returns a program with the offsets of its blocks' members by name, and compiles it if it is new.
  program(vertex, fragment, defines = []) {
    const key = [vertex, fragment, ...defines].join();
    if (this.programs.has(key)) return this.programs.get(key);
    const gl = this.gl, program = gl.createProgram();
    const shaders = [this.shader(gl.VERTEX_SHADER, vertex, defines.filter((word) => word === "BALLS")), this.shader(gl.FRAGMENT_SHADER, fragment, defines)];
    for (const shader of shaders) gl.attachShader(program, shader);
    gl.bindAttribLocation(program, 0, "primitive");
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      throw new NoWebGl(`This device cannot compile the figure's shaders (${fragment}): what is shown is a still picture. ` +
        shaders.map((shader) => gl.getShaderInfoLog(shader)).join(" ") + gl.getProgramInfoLog(program));
    const made = { program, blocks: {} };
    for (let n = 0; n < gl.getProgramParameter(program, gl.ACTIVE_UNIFORM_BLOCKS); ++n) {
      const name = gl.getActiveUniformBlockName(program, n), members = {};
      const indices = gl.getActiveUniformBlockParameter(program, n, gl.UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES);
      const offsets = gl.getActiveUniforms(program, indices, gl.UNIFORM_OFFSET);
      [...indices].forEach((index, k) => { members[gl.getActiveUniform(program, index).name.split(".").pop()] = offsets[k]; });
      gl.uniformBlockBinding(program, n, n);
      const buffer = gl.createBuffer();
      const size = gl.getActiveUniformBlockParameter(program, n, gl.UNIFORM_BLOCK_DATA_SIZE);
      made.blocks[name] = { binding: n, members, buffer, bytes: new ArrayBuffer(size) };
    }
    this.programs.set(key, made);
    return made;
  }

  /// Sets the members of a block. words: the whole block as the exporter wrote it; values: members that differ from it.
  set_block(program, name, words, values) {
    const gl = this.gl, block = program.blocks[name];
    if (!block) return;
    new Uint32Array(block.bytes).set(words.slice(0, block.bytes.byteLength / 4));
    const view = new DataView(block.bytes);
    for (const [member, value] of Object.entries(values)) {
      if (!(member in block.members)) continue;
      const whole = kWholeMembers.has(member);
      [value].flat().forEach((number, n) => {
        const at = block.members[member] + 4 * n;
        if (whole) view.setInt32(at, number, true);
        else view.setFloat32(at, number, true);
      });
    }
    gl.bindBuffer(gl.UNIFORM_BUFFER, block.buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, block.bytes, gl.DYNAMIC_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, block.binding, block.buffer);
  }

  /// Uses a program. textures: by the samplers' names; numbers: uniforms of floats.
  use(made, textures, numbers = {}) {
    const gl = this.gl;
    gl.useProgram(made.program);
    Object.entries(textures).forEach(([name, texture], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(name === "light_texels" ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D, texture);
      gl.uniform1i(gl.getUniformLocation(made.program, name), unit);
    });
    for (const [name, value] of Object.entries(numbers))  // more than four numbers are an array of vectors of four
      gl[`uniform${Math.min(value.length, 4)}fv`](gl.getUniformLocation(made.program, name), value);
    this.set_block(made, "ViewBlock", [], this.frame);
  }

  target(...textures) {
    const gl = this.gl, target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    textures.forEach((texture, n) =>
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + n, gl.TEXTURE_2D, texture, 0));
    gl.drawBuffers(textures.map((_, n) => gl.COLOR_ATTACHMENT0 + n));
    return target;
  }

  resize(width, height) {
    if (this.size[0] === width && this.size[1] === height) return;
    const gl = this.gl;
    for (const texture of Object.values(this.pixels ?? {})) gl.deleteTexture(texture);
    for (const target of Object.values(this.targets ?? {})) gl.deleteFramebuffer(target);
    if (this.depth) gl.deleteRenderbuffer(this.depth);
    this.size = [width, height];
    const pixels = this.make_pixels(), targets = this.make_targets(pixels);
    this.depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
    for (const name of kDeepTargets) {
      if (!targets[name]) continue;
      gl.bindFramebuffer(gl.FRAMEBUFFER, targets[name]);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
    }
    for (const [name, target] of Object.entries(targets)) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, target);
      const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
      if (status !== gl.FRAMEBUFFER_COMPLETE)
        throw new NoWebGl(`This device cannot draw into the textures of the figure (${name}, ${status}): what is shown is a still picture.`);
    }
    Object.assign(this, { pixels, targets });
  }

  wide() { return this.texture(this.gl.RGBA32UI); }

  make_pixels() {
    const { gl } = this, wide = () => this.wide();
    return { found: this.texture(gl.RG32UI), shade: wide(), color: wide(), normal: wide(), what: wide(),
      first_what: wide(), sum: wide(), other_sum: wide() };
  }

  make_targets(pixels) {
    return { found: this.target(pixels.found), first: this.target(pixels.color, pixels.normal, pixels.first_what),
      points: this.target(pixels.color, pixels.normal, pixels.what), shade: this.target(pixels.shade),
      sum: this.target(pixels.sum), other_sum: this.target(pixels.other_sum) };
  }

  /// Sorts the primitives front to back, by the beginning of their bounds.
  sort() {
    const { forward } = this.frame, all = this.centers, places = new Uint16Array(this.primitive_count);
    let low = Infinity, high = -Infinity;
    const nearest = new Float32Array(this.primitive_count);
    for (let n = 0; n < this.primitive_count; ++n) {
      nearest[n] = all[3 * n] * forward[0] + all[3 * n + 1] * forward[1] + all[3 * n + 2] * forward[2] - this.radii[n];
      low = Math.min(low, nearest[n]);
      high = Math.max(high, nearest[n]);
    }
    const scale = (kBuckets - 1) / Math.max(high - low, 1e-6);
    for (let n = 0; n < this.primitive_count; ++n) places[n] = (nearest[n] - low) * scale;
    for (const group of this.groups) {
      const starts = new Uint32Array(kBuckets + 1), sorted = new Uint32Array(group.list.length);
      for (const n of group.list) ++starts[places[n] + 1];
      for (let k = 0; k < kBuckets; ++k) starts[k + 1] += starts[k];
      for (const n of group.list) sorted[starts[places[n]]++] = n;
      group.sorted = sorted;
    }
  }

  /// Finds the range of all atoms along the view axis, which depth cues need, and the range of distances from the eye.
  depths() {
    const balls = new Float32Array(this.figure.tables.balls.buffer), { forward, pivot, eye_distance } = this.frame;
    const eye = minus(pivot, times(forward, eye_distance));
    let first = Infinity, last = -Infinity, radius = 0;
    for (let n = 0; n < balls.length; n += 4) {
      const center = [balls[n], balls[n + 1], balls[n + 2]], depth = dot(minus(center, eye), forward);
      if (!this.is_cut_away(n / 4, center, balls[n + 3])) {
        first = Math.min(first, depth - balls[n + 3]);
        last = Math.max(last, depth + balls[n + 3]);
      }
      radius = Math.max(radius, length(center) + balls[n + 3]);
    }
    const reach = this.frame.orthographic ? -dot(eye, forward) : length(eye);
    this.radius = radius;
    this.range = [Math.max(reach - radius - 1, 0), reach + radius + 1];
    this.depth_range = { first_depth: Math.max(Math.min(first, last), 0), last_depth: last };
  }

  is_cut_away() { return false; }

  /// Returns the planes that cut the surface of the first `atoms` atoms, whose opacity is that of the atoms times `opacity`.
  cuts() { return { planes: [], atoms: 0, opacity: 1 }; }

  /// Begins a picture of so many pixels, or a part of it: {size, left, top}.
  begin(camera, width, height, { size = [width, height], left = 0, top = 0 } = {}) {
    this.resize(...size);
    this.whole = [width, height];
    this.frame = { ...frame_of(camera, width, height), size, first_offset: [0.5 - width / 2 + left, 0.5 - height / 2 + top] };
    this.depths();
    this.sort();
  }

  /// Casts one sample of the picture. effects: {shade, lines}, both true or false; sample: from 0.
  cast(sample, effects) {
    const { pixels, targets } = this, first = sample === 0;
    this.begin_sample(sample);
    this.find(this.groups);
    this.color_points(first ? targets.first : targets.points, { found_texels: pixels.found });
    const { normal } = pixels, what = first ? pixels.first_what : pixels.what;
    if (effects.shade && first) this.shade(normal, "shade");
    const { to, from } = this.sums(sample);
    this.finish(targets[to], { normal, what, color: pixels.color, sum: pixels[from] }, effects, { sample_index: sample });
    this.summed = { texture: pixels[to], samples: sample + 1 };
  }

  begin_sample(sample) {
    this.frame.sample_offset = this.figure.samples[sample];
    this.gl.viewport(0, 0, ...this.size);
  }

  /// Returns the names of the target for the sum of samples and of the target with the sum so far.
  sums(sample) { return sample % 2 === 0 ? { to: "sum", from: "other_sum" } : { to: "other_sum", from: "sum" }; }

  /// Draws a pass over the whole picture.
  draw_whole(target, made, textures, numbers = {}, blocks = {}) {
    const gl = this.gl;
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    this.use(made, textures, numbers);
    for (const [name, { words, values }] of Object.entries(blocks)) this.set_block(made, name, words, values);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  scene_tables() {
    const { tables } = this;
    return { primitive_texels: tables.primitives, row_texels: tables.rows, color_texels: tables.colors };
  }

  /// Lights the points that were found. more: numbers, members of the block and defines for layers.
  color_points(target, textures, { numbers = {}, values = {}, defines = [] } = {}) {
    const { map } = this.figure, paint = map ? { map_axes: map.axes, map_size: map.size, map_scale: map.scale, map_parts: map.parts,
      map_is_shown: [this.scheme === 0 ? 1 : 0] } : {};
    this.draw_whole(target, this.program("whole.vert", "points.frag", map ? [...defines, "PAINTED"] : defines),
      { ...this.scene_tables(), mark_texels: this.tables.marks, ...(map ? { map_texels: this.tables.map } : {}), ...textures },
      { pivot: this.frame.pivot, ...paint, ...numbers },
      { Parameters: { words: this.look.cast, values: { color_by_kind: this.by_kind, ...values } } });
  }

  /// Computes the light at points of the first sample, which all samples share. target: its name.
  shade(normal, target) {
    this.light.make();
    this.draw_whole(this.targets[target], this.program("whole.vert", "light.frag"), { normal_texels: normal, light_texels: this.light.texture }, {},
      { Parameters: { words: [], values: this.light.parameters() } });
  }

  /// Finishes the look of points, and adds it to the sum if this is not the first sample.
  finish(target, { normal, what, color, sum, shade = this.pixels.shade }, effects, values, defines = []) {
    const wanted = [...(effects.shade ? ["SHADE"] : []), ...(effects.lines ? ["SILHOUETTES"] : []), ...defines];
    this.draw_whole(target, this.program("whole.vert", "finish.frag", wanted), { normal_texels: normal, sample_texels: color, what_texels: what,
      ...(effects.shade ? { shade_texels: shade } : {}), sum_texels: sum }, {},
      { Parameters: { words: this.look.finish, values: { ...this.depth_range, ...this.line_widths(), ...(this.fades ? {} : { depth_cue: 0 }), ...values } } });
  }

  /// Draws the footprints of some primitives or balls, in order. made: the program for their kind.
  draw_footprints(list, made, textures, numbers, target) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    gl.bindVertexArray(this.vertices);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribDivisor(0, 1);
    gl.bufferData(gl.ARRAY_BUFFER, list, gl.STREAM_DRAW);
    gl.vertexAttribIPointer(0, 1, gl.UNSIGNED_INT, 0, 0);
    this.use(made, textures, { pivot: this.frame.pivot, depth_range: this.range, ...numbers });
    this.set_block(made, "Parameters", this.look.cast, {});
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, list.length);
  }

  /// Finds the nearest primitive at each pixel.
  find(groups, { textures = {}, numbers = {}, defines = [], hides_some = this.hides_some() } = {}) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.targets.found);
    gl.clearBufferuiv(gl.COLOR, 0, [0, kNoPrimitive, 0, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
    for (const group of groups) {
      if (group.list.length === 0) continue;
      const wanted = [...(group.define ? [group.define] : []), ...(hides_some ? ["SOME_HIDDEN"] : []), ...defines];
      this.draw_footprints(group.sorted, this.program("footprint.vert", "cast.frag", wanted),
        { ...this.scene_tables(), ...textures }, numbers, this.targets.found);
    }
  }

  /// Returns the widths of lines, which grow with the picture like those of presets.
  line_widths() {
    const { figure, whole } = this, shorter = Math.min(...whole), growth = shorter / Math.min(...figure.size);
    const widths = Object.fromEntries(Object.entries(this.look.line_widths).map(([name, width]) => [name, Math.min(16, width * growth)]));
    const step = figure.line_step * shorter;
    return { ...widths, step_pixels: Math.max(step, 2), fade_pixels: 2 * step };
  }

  /// Draws the picture on the canvas, which may have more pixels, as for a draft. background: linear.
  present(background, target = null, size = [this.canvas.width, this.canvas.height]) {
    const { texture, samples } = this.summed;
    this.gl.viewport(0, 0, ...size);
    this.draw_whole(target, this.program("whole.vert", "present.frag"), { sum_texels: texture }, {},
      { Parameters: { words: [], values: { background, per_sample: 1 / samples, size } } });
  }

  /// Returns an attachment of the first sample in a rectangle of pixels, four words a pixel, rows from the top.
  read(x, y, width, height, attachment) {
    const gl = this.gl, words = new Uint32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.targets.first);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + attachment);
    gl.readPixels(x, y, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
    return words;
  }

  /// Returns the position of an atom, relative to the origin of the records; null for an atom that only meshes show.
  center_of(atom) {
    const { tables, light_maps: { surfaces } } = this.figure, { primitives, rows, balls } = tables;
    const own = surfaces.find(([, first, count]) => atom >= first && atom < first + count);
    if (own) return [...new Float32Array(balls.buffer, 16 * (own[0] + atom - own[1]), 3)];
    for (let at = 0; at < primitives.length; at += 12)
      if (primitives[at + 7] === 0 && primitives[at + 8] === kNoPrimitive && primitives[at + 9] === atom)
        return [...new Float32Array(rows.buffer, 16 * primitives[at + 5], 3)];
    return null;
  }

  /// Returns what a pixel shows: {atom, primitive, point}, or null.
  pick(x, y) {
    const [width, height] = this.size;
    if (x < 0 || y < 0 || x >= width || y >= height) return null;
    const [atom, primitive, , t] = this.read(x, y, 1, 1, 2);
    if (primitive === kNoPrimitive) return null;
    const { right, up, forward, pixel_size, first_offset, eye_distance, orthographic, pivot } = this.frame;
    const p = plus(times(right, (first_offset[0] + x) * pixel_size), times(up, -(first_offset[1] + y) * pixel_size));
    const d = orthographic ? forward : unit(plus(forward, times(p, 1 / eye_distance)));
    const along = new Float32Array(Uint32Array.of(t).buffer)[0];
    return { atom, primitive, point: plus(pivot, plus(p, times(d, along))) };
  }
}

/// Members of blocks that are whole numbers; the others are floats.
const kWholeMembers = new Set(["orthographic", "size", "sky_edge", "lamp_edge", "sky_axes", "lamp_places", "first_lamp_texel", "sample_index", "has_marks", "keeps_alpha", "tiles", "color_by_kind"]);
/// Tables whose records have one word.
const kSingle = new Set(["marks", "map"]);
/// Targets that share one depth buffer.
const kDeepTargets = ["found", "cap_atom"];
