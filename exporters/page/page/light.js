// SPDX-License-Identifier: BSD-3-Clause
// Maps of the heights of the balls that block light, from the sky's directions and from places on the lamp, for
// gpu_shaders/look/light_maps.glsl. core/render/light_maps.cpp makes the same for pictures.

const kLayerTexels = 2048 * 256;  // texels in a layer of the texture (gpu_shaders/webgl/light.frag)
const kLightSteps = 8192;  // steps of heights in a map (gpu_shaders/look/parameters.glsl)
const kEmptyMap = -1e30;
const kGoldenAngle = Math.PI * (3 - Math.sqrt(5));
const after_point = (x) => x - Math.floor(x);

/// Returns all balls of a frame, {balls: [x, y, z, radius, ...], atoms: the atom of each}, whether they block light or not.
function light_balls({ tables, light_maps: { surfaces, step, mesh_ball } }) {
  const balls = [], atoms = [], numbers = new Float32Array(tables.balls.buffer), words = tables.primitives;
  const rows = new Float32Array(tables.rows.buffer), row = (n) => [rows[4 * n], rows[4 * n + 1], rows[4 * n + 2]];
  const add = (x, y, z, radius, atom) => { balls.push(x, y, z, radius); atoms.push(atom); };
  /// Adds balls along a line, at most `step` apart.
  const walk = (from, way, radius, atom) => {
    const count = Math.ceil(length(way) / step);
    for (let n = 0; n <= count; ++n) add(...plus(from, times(way, count ? n / count : 0)), radius, atom);
  };
  for (const [first_ball, first_atom, count] of surfaces)
    for (let n = 0, at = 4 * first_ball; n < count; ++n, at += 4) add(numbers[at], numbers[at + 1], numbers[at + 2], numbers[at + 3], first_atom + n);
  for (let at = 0; at < words.length; at += 12) {
    const first = words[at + 5], kind = words[at + 7], atom = words[at + 9];
    if (words[at + 8] !== kNoPrimitive) continue;
    const center = row(first), radius = rows[4 * first + 3];
    if (kind === kCylinder) {
      const half = times(row(first + 1), rows[4 * first + 7]);
      walk(minus(center, half), half, radius, atom);
      walk(center, half, radius, words[at + 10]);
    } else if (kind > kCylinder) {
      const inward = (k) => times(row(first + 3 + k), -mesh_ball), way = (k) => plus(row(first + k), minus(inward(k), inward(0)));
      const corner = plus(center, inward(0)), right = way(1), up = way(2);
      const parts = Math.max(Math.ceil(Math.max(length(right), length(up), length(minus(up, right))) / step), 1);
      for (let i = 0; i < parts; ++i)  // the middles of equal triangles, of which every second is upside down
        for (let j = 0; j < 2 * (parts - i) - 1; ++j) {
          const third = (j % 2 + 1) / 3, across = times(right, (i + third) / parts);
          add(...plus(corner, plus(across, times(up, (Math.floor(j / 2) + third) / parts))), mesh_ball, atom);
        }
    } else {
      add(...center, radius, atom);
    }
  }
  return { balls: Float64Array.from(balls), atoms: Uint32Array.from(atoms) };
}

/// Returns the axes of a map that looks against `axis`.
function view_along(axis) {
  const right = unit(cross(Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], axis));
  return { right, up: cross(axis, right), axis };
}

/// The maps of a caster's picture, in a texture array.
class LightMaps {
  constructor(caster) {
    this.caster = caster;
    this.texture = null;
    this.layers = 0;
  }

  /// Makes missing maps. The shown figure has one set of maps of the sky, each camera its maps of the lamp.
  make() {
    const { caster } = this, { figure, look: { light }, frame, hidden } = caster, { planes, opacity } = caster.cuts();
    const shown = [figure.tables.balls, figure.tables.primitives, figure.own_colors, hidden, light.maps_sky, opacity, planes.join()];
    const same = (a, b) => a?.every((part, n) => part === b[n]) ?? false;
    const keeps_sky = same(this.shown, shown), seen = JSON.stringify([frame.right, frame.up, frame.forward, light]);
    if (keeps_sky && seen === this.seen) return;
    if (!keeps_sky) this.place_sky(light.maps_sky ? figure.light_maps.sky.count : 0);
    this.lamp = light.maps_lamp ? this.lamp_views(light) : [];
    if (!keeps_sky) this.draw_sky();
    this.draw_lamp();
    Object.assign(this, { shown, seen });
  }

  /// Finds the share of the light that each ball blocks, and sets the size of the maps by the balls' extent.
  place_sky(axes) {
    const { caster } = this, { figure } = caster, { planes, atoms, opacity } = caster.cuts(), { sky, lamp, margin } = figure.light_maps;
    if (this.balls_of !== figure.tables.primitives) [this.all, this.balls_of] = [light_balls(figure), figure.tables.primitives];
    const colors = new Float32Array(figure.own_colors.buffer), hidden = new Set(caster.hidden), { all } = this, blockers = [], sizes = [0, 0];
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    all.atoms.forEach((atom, n) => {
      const of_surface = atom < atoms, ball = all.balls.subarray(4 * n, 4 * n + 4), group = of_surface && planes.length ? 1 : 0;
      const share = hidden.has(atom) ? 0 : (colors[4 * atom + 3] * (of_surface ? opacity : 1)) ** 2;
      if (share === 0) return;
      blockers.push({ ball, share, group, is_cut: group && planes.some((plane) => plane[3] - dot(plane, ball) < ball[3]) });
      ++sizes[group];
      for (let k = 0; k < 3; ++k) [low[k], high[k]] = [Math.min(low[k], ball[k]), Math.max(high[k], ball[k])];
    });
    // The order of light_maps.cpp: groups by size, and balls by place. Shares of edges depend on it by rounding.
    blockers.sort((a, b) => sizes[a.group] - sizes[b.group] || a.group - b.group || a.ball[0] - b.ball[0] || a.ball[1] - b.ball[1] ||
      a.ball[2] - b.ball[2] || a.ball[3] - b.ball[3] || a.share - b.share);
    const balls = blockers.flatMap(({ ball }) => [...ball]), cut = blockers.map(({ is_cut }) => is_cut), shares = blockers.map(({ share }) => share);
    this.middle = cut.length ? times(plus(low, high), 0.5) : [0, 0, 0];
    let radius = 1;
    for (let n = 0; n < balls.length; n += 4)
      radius = Math.max(radius, Math.hypot(balls[n] - this.middle[0], balls[n + 1] - this.middle[1], balls[n + 2] - this.middle[2]) + balls[n + 3]);
    const fit = ({ finest_texel, largest_edge }) => {
      const texel = Math.max(finest_texel, 2 * radius / (largest_edge - 2 * margin));
      return { texel, edge: Math.ceil(2 * radius / texel) + 2 * margin };
    };
    Object.assign(this, { balls: Float64Array.from(balls), cut, shares, planes, sky_size: fit(sky), lamp_size: fit(lamp) });
    this.sky = Array.from({ length: axes }, (_, n) => {
      const z = 1 - (n + 0.5) / axes, across = Math.sqrt(1 - z * z), angle = n * kGoldenAngle;
      return view_along([across * Math.cos(angle), across * Math.sin(angle), z]);
    });
  }

  lamp_views({ direction, disc }) {
    const { right, up, forward } = this.caster.frame, { count } = this.caster.figure.light_maps.lamp;
    const lamp = plus(plus(times(right, direction[0]), times(up, direction[1])), times(forward, -direction[2]));
    const x = unit(cross(lamp, Math.abs(dot(lamp, up)) < 0.9 ? up : right)), y = cross(lamp, x);
    return Array.from({ length: count }, (_, n) => {
      const r = disc * Math.sqrt(after_point(0.5 + n * 0.7548776662466927)), angle = 2 * Math.PI * after_point(0.5 + n * 0.5698402909980532);
      return view_along(unit(plus(lamp, plus(times(x, r * Math.cos(angle)), times(y, r * Math.sin(angle))))));
    });
  }

  /// Draws the maps of the sky. The array has room for the maps of the lamp after them.
  draw_sky() {
    const { sky, sky_size, lamp_size, caster: { gl, figure } } = this, texels = sky_size.edge ** 2;
    const layers_of = (maps, edge) => Math.ceil(maps * edge ** 2 / kLayerTexels);
    this.lamp_layer = layers_of(2 * sky.length, sky_size.edge);
    const layers = Math.max(this.lamp_layer + layers_of(figure.light_maps.lamp.count, lamp_size.edge), 1);
    if (layers !== this.layers) {
      gl.deleteTexture(this.texture);
      this.texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D_ARRAY, filter, gl.NEAREST);
      gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.R32UI, 2048, 256, layers);
      this.layers = layers;
    }
    const maps = new Uint32Array(kLayerTexels * this.lamp_layer);
    sky.forEach((view, n) => this.draw(view, n, sky_size, maps.subarray(2 * n * texels), maps.subarray((2 * n + 1) * texels)));
    this.upload(maps, 0);
  }

  draw_lamp() {
    const { lamp, lamp_size } = this, texels = lamp_size.edge ** 2;
    const maps = new Uint32Array(kLayerTexels * Math.ceil(lamp.length * texels / kLayerTexels));
    lamp.forEach((view, n) => this.draw(view, this.sky.length + n, lamp_size, maps.subarray(n * texels), null));
    this.upload(maps, this.lamp_layer);
  }

  upload(maps, first_layer) {
    const { gl } = this.caster;
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
    if (maps.length) gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, first_layer, 2048, 256, maps.length / kLayerTexels, gl.RED_INTEGER, gl.UNSIGNED_INT, maps);
  }

  /// Draws map n along an axis, and against it unless `against` is null, from the balls that block enough of the light.
  draw({ right, up, axis }, n_map, { texel, edge }, along, against) {
    const { balls, cut, shares, middle, planes } = this, half = 0.5 * (edge - 1), least_share = after_point((n_map + 0.5) * Math.sqrt(3));
    const sides = (against ? [along, against] : [along]).map((words) => ({ words, whole: new Float32Array(edge * edge).fill(kEmptyMap),
      highest: new Float32Array(edge * edge).fill(kEmptyMap), clear: new Float32Array(edge * edge).fill(1) }));
    const add = ({ whole, highest, clear }, at, height, share) => {
      if (share >= 1) {
        whole[at] = Math.max(whole[at], height);
        if (height >= highest[at]) clear[at] = 1;
      } else if (height > whole[at]) {
        highest[at] = Math.max(highest[at], height);
        clear[at] *= 1 - share;
      }
    };
    for (let n = 0; n < cut.length; ++n) {
      if (shares[n] <= least_share) continue;
      const cx = balls[4 * n] - middle[0], cy = balls[4 * n + 1] - middle[1], cz = balls[4 * n + 2] - middle[2], radius = balls[4 * n + 3] / texel;
      const x = (cx * right[0] + cy * right[1] + cz * right[2]) / texel + half, y = (cx * up[0] + cy * up[1] + cz * up[2]) / texel + half;
      const z = (cx * axis[0] + cy * axis[1] + cz * axis[2]) / texel, disc = Math.max(radius, 0.5), is_soft = radius >= 1.2, reach = disc + (is_soft ? 0.5 : 0);
      for (let line = Math.ceil(y - reach); line <= y + reach; ++line) {
        const off = line - y, across = Math.sqrt(Math.max(reach * reach - off * off, 0));
        for (let column = Math.ceil(x - across); column <= x + across; ++column) {
          const square = (column - x) ** 2 + off * off, height = Math.sqrt(Math.max(radius * radius - square, 0));
          const share = is_soft ? 0.5 + 0.5 * disc - square * 0.5 / disc : square <= disc * disc ? 1 : 0;
          let low = z - height, high = z + height;
          if (cut[n]) [low, high] = this.kept(planes, { right, up, axis }, (column - half) * texel, (line - half) * texel, low * texel, high * texel).map((end) => end / texel);
          if (low > high || share <= 0) continue;
          add(sides[0], line * edge + column, high, share);
          if (against) add(sides[1], line * edge + column, -low, share);
        }
      }
    }
    const step = (height) => Math.max(height * kLightSteps / edge + 0.5 * (kLightSteps + 1), 0);
    for (const { words, whole, highest, clear } of sides)
      for (let at = 0; at < edge * edge; ++at)
        words[at] = step(whole[at]) << 18 | (highest[at] > whole[at] ? step(highest[at]) << 5 | 31.5 - 31 * clear[at] : 0);
  }

  /// Returns the part from low to high, along an axis at a place of its map, that planes keep: [low, high].
  kept(planes, { right, up, axis }, column, line, low, high) {
    const foot = plus(this.middle, plus(times(right, column), times(up, line)));
    for (const plane of planes) {
      const slope = dot(plane, axis), room = plane[3] - dot(plane, foot);
      if (slope > 0) high = Math.min(high, room / slope);
      if (slope < 0) low = Math.max(low, room / slope);
      if (slope === 0 && room < 0) high = -Infinity;
    }
    return [low, high];
  }

  /// Returns the members of LightMapParameters (gpu_shaders/look/parameters.glsl).
  parameters() {
    const { sky, lamp, sky_size, lamp_size, middle, caster: { frame: { right, up, forward, pivot, eye_distance } } } = this;
    const eye = minus(minus(pivot, times(forward, eye_distance)), middle);
    const row = (v, scale, offset) => [...[dot(v, right), dot(v, up), -dot(v, forward)].map((share) => scale * share), scale * dot(v, eye) + offset];
    const rows = (views, { texel, edge }) => views.flatMap((view) =>
      [...row(view.right, 1 / texel, 0.5 * (edge - 1)), ...row(view.up, 1 / texel, 0.5 * (edge - 1)), ...row(view.axis, 1 / texel, 0)]);
    return { "rows[0]": [...rows(sky, sky_size), ...rows(lamp, lamp_size)], sky_texel: sky_size.texel, lamp_texel: lamp_size.texel,
      sky_edge: sky_size.edge, lamp_edge: lamp_size.edge, sky_axes: sky.length, lamp_places: lamp.length,
      first_lamp_texel: this.lamp_layer * kLayerTexels };
  }
}
