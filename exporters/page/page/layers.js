// SPDX-License-Identifier: BSD-3-Clause
// Draws surfaces that are cut or translucent: their hits are cast one after another, and combined along each ray.

const kMostLayers = 8, kDraftLayers = 2, kMostPlanes = 8;
const kOnPlane = 0xfffffffe;

class LayeredCaster extends Caster {
  constructor(canvas, figure) {
    super(canvas, figure);
    this.layers = { ...this.layers, planes: [], hatching: [] };
    this.queries = [];
  }

  table_names() { return [...super.table_names(), "balls"]; }

  show(frame) {
    super.show(frame);
    this.layers = { ...this.layers, ...frame.layers };
    this.surface_atoms = Uint32Array.from({ length: frame.layers?.surface_atoms ?? 0 }, (_, n) => n);
  }

  /// Sets the layers. planes: [x, y, z, w] each, points with dot(xyz, x) < w stay; opacity: a factor of that of atoms.
  set_layers(planes, hatching, opacity) {
    Object.assign(this.layers, { planes, hatching, opacity, seen_through: this.figure.layers && (this.figure.layers.seen_through || opacity < 1) ? 1 : 0 });
  }

  /// Returns true if the surface is cut or translucent; otherwise one pass casts it.
  has_layers() { return this.layers.planes.length > 0 || this.layers.seen_through > 0; }

  /// Returns true if hidden atoms are left out. Cuts include them, since their points determine what is solid.
  hides_some() { return this.layers.planes.length === 0 && super.hides_some(); }
  is_seen_through() { return this.layers.seen_through > 0 || (this.layers.planes.length > 0 && super.hides_some()); }

  resize(width, height) {
    if (this.laid !== this.has_layers()) this.size = [0, 0];
    this.laid = this.has_layers();
    super.resize(width, height);
  }

  make_pixels() {
    const { gl } = this, wide = () => this.wide();
    if (!this.laid) return super.make_pixels();
    return { ...super.make_pixels(), event: wide(), cap_atom: this.texture(gl.R32UI), shape_what: wide(),
      over: wide(), other_over: wide(), state: wide(), other_state: wide(),
      opaque_color: wide(), opaque_normal: wide(), opaque_what: wide(),
      front_shade: wide(), seen_color: wide(), seen_normal: wide(), seen_what: wide(), front: wide(), ink: this.texture(gl.R32UI), behind: wide() };
  }

  make_targets(pixels) {
    if (!this.laid) return super.make_targets(pixels);
    return { ...super.make_targets(pixels), shapes: this.target(pixels.color, pixels.normal, pixels.shape_what),
      event: this.target(pixels.event), cap_atom: this.target(pixels.cap_atom),
      ray: this.target(pixels.over, pixels.state), other_ray: this.target(pixels.other_over, pixels.other_state),
      opaque: this.target(pixels.opaque_color, pixels.opaque_normal, pixels.opaque_what),
      front_shade: this.target(pixels.front_shade), first: this.target(pixels.seen_color, pixels.seen_normal, pixels.first_what),
      seen: this.target(pixels.seen_color, pixels.seen_normal, pixels.seen_what),
      front: this.target(pixels.front, pixels.ink), behind: this.target(pixels.behind) };
  }

  is_cut_away(atom, center, radius) {
    return atom < this.surface_atoms.length && this.layers.planes.some((plane) => dot(plane, center) - radius >= plane[3]);
  }

  cuts() { return { planes: this.layers.planes, atoms: this.layers.surface_atoms, opacity: this.layers.opacity ?? 1 }; }

  /// Returns the uniforms that all shaders of layers share.
  layer_numbers() {
    const { layers } = this, padded = (list) => [...list.flat(), ...Array(4 * (kMostPlanes - list.length)).fill(0)];
    return { pivot: this.frame.pivot, planes: padded(layers.planes), planes_there: [layers.planes.length], hatching: padded(layers.hatching),
      hatched_look: layers.hatched_look, cap_color: layers.cap_color, thickens: [layers.thickens], surface_opacity: [layers.opacity ?? 1], seen_through: [this.is_seen_through() ? 1 : 0],
      probe: [layers.probe], largest_ball: [layers.largest_ball] };
  }

  /// Copies the attachment of a target into a texture.
  copy(target, attachment, texture) {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + attachment);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.copyTexSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 0, 0, ...this.size);
  }

  cast(sample, effects) {
    if (!this.laid) return super.cast(sample, effects);
    const { gl, pixels, targets } = this, first = sample === 0, seen_through = this.is_seen_through();
    const { seen_normal, opaque_normal } = pixels, seen_what = first ? pixels.first_what : pixels.seen_what;
    const seen = first ? targets.first : targets.seen, { opaque } = targets;
    this.begin_sample(sample);
    this.find(this.groups.filter((group) => !group.of_surface), { hides_some: super.hides_some() });
    this.color_points(targets.shapes, { found_texels: pixels.found });
    for (const [attachment, texture] of [[0, pixels.opaque_color], [1, opaque_normal], [1, seen_normal], [2, pixels.opaque_what], [2, seen_what]])
      this.copy(targets.shapes, attachment, texture);
    gl.bindFramebuffer(gl.FRAMEBUFFER, seen);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    this.walk(seen, opaque, !seen_through ? 1 : effects.draft ? kDraftLayers : this.layers_there(sample), first && !effects.draft);
    const { to, from } = this.sums(sample), on_behind = { normal: opaque_normal, what: pixels.opaque_what, color: pixels.opaque_color };
    if (effects.shade && first) {
      this.shade(opaque_normal, "shade");
      if (seen_through) this.shade(seen_normal, "front_shade");
    }
    if (!seen_through) {
      this.finish(targets[to], { ...on_behind, sum: pixels[from] }, effects, { sample_index: sample });
    } else {
      this.finish(targets.front, { normal: seen_normal, what: seen_what, color: pixels.seen_color, sum: pixels[from], shade: pixels.front_shade }, effects,
        { sample_index: 0, specular: 0 }, ["LAYERS"]);
      this.finish(targets.behind, { ...on_behind, sum: pixels[from] }, effects, { sample_index: 0 });
      this.draw_whole(targets[to], this.program("whole.vert", "layer_sum.frag"), { over_texels: pixels[this.over], first_texels: pixels.seen_color,
        front_texels: pixels.front, ink_texels: pixels.ink, behind_texels: pixels.behind, sum_texels: pixels[from] }, {},
        { Parameters: { words: this.look.finish, values: { ...this.line_widths(), sample_index: sample } } });
    }
    this.summed = { texture: pixels[to], samples: sample + 1 };
  }

  /// Returns the number of layers in the picture, as far as the device has reported it after the first sample.
  layers_there(sample) {
    if (sample === 0) return kMostLayers;
    const { gl } = this, told = (query) => gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE) && !gl.getQueryParameter(query, gl.QUERY_RESULT);
    const empty = this.queries.findIndex(told);
    return empty < 0 ? kMostLayers : Math.max(empty, 1);
  }

  /// Goes from hit to hit along the rays, at most `count` times. counts: true to ask the device which layers exist.
  /// seen, opaque: targets that keep the first visible hit and the first opaque one.
  walk(seen, opaque, count, counts) {
    const { gl, figure, pixels, targets } = this, numbers = this.layer_numbers(), layers = ["LAYERS"];
    const surface = this.groups.filter((group) => group.of_surface), block = { Parameters: { words: this.look.cast, values: {} } };
    const lit = this.is_seen_through() ? { specular: this.look.specular } : {};
    let [over, state, next] = ["over", "state", "other_"];
    this.draw_whole(targets.ray, this.program("whole.vert", "layer_start.frag"), this.scene_tables(), numbers, block);
    if (counts) this.queries.forEach((query) => gl.deleteQuery(query));
    if (counts) this.queries = [];
    for (let layer = 0; layer < count; ++layer) {
      if (counts) gl.beginQuery(gl.ANY_SAMPLES_PASSED, this.queries[layer] = gl.createQuery());
      this.find(surface, { textures: { state_texels: pixels[state] }, numbers, defines: layers });
      if (counts) gl.endQuery(gl.ANY_SAMPLES_PASSED);
      this.draw_whole(targets.event, this.program("whole.vert", "layer_event.frag"),
        { ...this.scene_tables(), found_texels: pixels.found, state_texels: pixels[state] }, numbers, block);
      if (this.layers.planes.length > 0) this.find_cap_atoms(numbers);
      this.color_points(targets.points, { event_texels: pixels.event, cap_atom_texels: pixels.cap_atom }, { numbers, values: lit, defines: layers });
      const on_ray = { ...this.scene_tables(), event_texels: pixels.event, state_texels: pixels[state], sample_texels: pixels.color,
        shape_texels: pixels.shape_what };
      const points = { normal_texels: pixels.normal, what_texels: pixels.what };
      this.draw_whole(seen, this.program("whole.vert", "layer_keep.frag", ["FIRST"]), { ...on_ray, ...points }, numbers, block);
      this.draw_whole(opaque, this.program("whole.vert", "layer_keep.frag"), { ...on_ray, ...points }, numbers, block);
      this.draw_whole(next ? targets.other_ray : targets.ray, this.program("whole.vert", "layer_blend.frag"), { ...on_ray, over_texels: pixels[over] }, numbers, block);
      [over, state, next] = next ? ["other_over", "other_state", ""] : ["over", "state", "other_"];
    }
    this.over = over;
  }

  find_cap_atoms(numbers) {
    const { gl, pixels, targets, tables } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets.cap_atom);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    gl.clearBufferfv(gl.DEPTH, 0, [1]);
    this.draw_footprints(this.surface_atoms, this.program("footprint.vert", "cap_atom.frag", ["BALLS"]),
      { ...this.scene_tables(), ball_texels: tables.balls, event_texels: pixels.event }, numbers, targets.cap_atom);
  }
}
