// SPDX-License-Identifier: BSD-3-Clause
// Views by their names: a button each, to which the camera glides.

const kGlide = 500;  // ms

/// A part of the way from one camera to another of the same projection.
function between(from, to, share) {
  const a = basis_of(from), b = basis_of(to), axes = ["right", "up", "forward"];
  const sum = axes.reduce((all, name) => plus(all, cross(a[name], b[name])), [0, 0, 0]);
  const cosine = (axes.reduce((all, name) => all + dot(a[name], b[name]), 0) - 1) / 2, angle = Math.atan2(length(sum) / 2, cosine);
  // Half a turn has no such sum: what turns about the axis and its own opposite meet on it.
  const middles = axes.map((name) => plus(a[name], b[name])).sort((one, other) => length(other) - length(one));
  const axis = unit(length(sum) > 1e-6 ? sum : middles[0]);
  const target = plus(times(from.target, 1 - share), times(to.target, share)), mixed = (x, y) => x ** (1 - share) * y ** share;
  return { ...to, target, up: turned(a.up, axis, share * angle), fov: mixed(from.fov, to.fov), height: mixed(from.height, to.height),
    position: minus(target, times(turned(a.forward, axis, share * angle), mixed(reach_of(from), reach_of(to)))) };
}

/// At once for readers who want no motion.
function glide(viewer, to) {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return viewer.move(to, false);
  const from = projected(viewer.camera, to.orthographic, viewer.caster.radius), began = performance.now();
  viewer.move(from);
  const step = viewer.gliding = () => {
    if (viewer.gliding !== step) return;
    const share = (performance.now() - began) / kGlide;
    if (share >= 1) return viewer.move(to, false);
    viewer.camera = between(from, to, share * share * (3 - 2 * share));
    viewer.change(true);
    requestAnimationFrame(step);
  };
  step();
}

function follow_views(viewer) {
  const show = (number) => {
    const view = viewer.figure.views[number];
    Object.assign(viewer, { view_number: number, cut: null, depth: 0, opacity: view.opacity });
    Object.assign($("cut"), { value: 0 });
    Object.assign($("opacity"), { value: 100 * view.opacity });
    $("projection").value = projection_of(view.camera);
    $("picked").textContent = view.name;
    viewer.set_layers();
    glide(viewer, view.camera);
  };
  $("reset").addEventListener("click", () => show(0));
  viewer.figure.views.forEach(({ name }, number) => {
    if (number === 0) return;
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: name });
    button.addEventListener("click", () => show(number));
    $("views").append(button);
  });
}
