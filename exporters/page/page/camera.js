// SPDX-License-Identifier: BSD-3-Clause
// The camera and its motions, with the formulas of core/camera and app/preview/camera_commands.cpp.

const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(...a);
const unit = (a) => times(a, 1 / length(a));

/// Returns v turned about a unit axis.
function turned(v, axis, angle) {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return plus(plus(times(v, c), times(cross(axis, v), s)), times(axis, dot(axis, v) * (1 - c)));
}

function basis_of(camera) {
  const forward = unit(minus(camera.target, camera.position));
  const right = unit(cross(forward, camera.up));
  return { right, up: cross(right, forward), forward };
}

const reach_of = (camera) => length(minus(camera.target, camera.position));

/// Returns the height of the picture in Å, in the plane through the target.
const height_at_target = (camera) =>
  camera.orthographic ? camera.height : 2 * reach_of(camera) * Math.tan(camera.fov * Math.PI / 360);

/// Returns a camera turned about its target. dx, dy: to the right and down, in heights of the picture.
function orbited(camera, dx, dy) {
  const { right, up } = basis_of(camera);
  const angle = Math.PI * Math.hypot(dx, dy);
  if (angle === 0) return camera;
  const axis = unit(plus(times(right, -dy), times(up, -dx)));
  return { ...camera, up: turned(up, axis, angle),
    position: plus(camera.target, turned(minus(camera.position, camera.target), axis, angle)) };
}

function panned(camera, dx, dy) {
  const { right, up } = basis_of(camera), height = height_at_target(camera);
  const shift = plus(times(right, -dx * height), times(up, dy * height));
  return { ...camera, position: plus(camera.position, shift), target: plus(camera.target, shift) };
}

function rolled(camera, angle) {
  return { ...camera, up: turned(basis_of(camera).up, basis_of(camera).forward, -angle) };
}

/// Returns a camera that is nearer by a factor; the point at x, y stays there (from the middle, in picture heights).
function zoomed(camera, factor, x = 0, y = 0) {
  const moved = panned(camera, -x, -y), reach = minus(moved.position, moved.target);
  const nearer = camera.orthographic ? { ...moved, height: moved.height / factor }
    : { ...moved, position: plus(moved.target, times(reach, 1 / factor)) };
  return panned(nearer, x, y);
}

function centered(camera, point) {
  const shift = minus(point, camera.target);
  return { ...camera, target: point, position: plus(camera.position, shift) };
}

/// Returns the same view in the other projection: objects in the target's plane keep their size. An orthographic camera
/// is outside of everything, because it sees nothing behind its plane.
function projected(camera, orthographic, radius) {
  if (camera.orthographic === orthographic) return camera;
  const { forward } = basis_of(camera), height = height_at_target(camera);
  const reach = orthographic ? length(camera.target) + 2 * radius : height / (2 * Math.tan(camera.fov * Math.PI / 360));
  return { ...camera, orthographic, height, position: minus(camera.target, times(forward, reach)) };
}

/// Returns the picture's geometry as the shaders have it (BlockView). Its pivot is on the axis, as deep as the middle.
function frame_of(camera, width, height) {
  const basis = basis_of(camera);
  const eye_distance = Math.max(-dot(camera.position, basis.forward), 1);
  const angstroms = camera.orthographic ? camera.height : 2 * Math.tan(camera.fov * Math.PI / 360) * eye_distance;
  return { ...basis, eye_distance, pixel_size: angstroms / height, orthographic: camera.orthographic ? 1 : 0,
    first_offset: [0.5 - width / 2, 0.5 - height / 2], sample_offset: [0, 0], size: [width, height],
    pivot: plus(camera.position, times(basis.forward, eye_distance)) };
}

/// Returns the pixels at which points appear, from the top left of a picture; null for points behind the camera.
function places_of(points, { right, up, forward, eye_distance, pixel_size, orthographic, pivot }, [width, height]) {
  return points.map((point) => {
    const from = minus(point, pivot), depth = eye_distance + dot(from, forward);
    if (!orthographic && depth <= 0) return null;
    const unit_size = pixel_size * (orthographic ? 1 : depth / eye_distance);
    return [width / 2 + dot(from, right) / unit_size, height / 2 - dot(from, up) / unit_size];
  });
}

/// Returns a view for a picture that is narrower than the one it was made for: it shows the same width.
function widened(camera, factor) {
  if (camera.orthographic) return { ...camera, height: camera.height * factor };
  return { ...camera, fov: Math.atan(Math.tan(camera.fov * Math.PI / 360) * factor) * 360 / Math.PI };
}
