// SPDX-License-Identifier: BSD-3-Clause
// Shows the direction of the light as a dot on a disc, which is a half ball seen from the viewer's side.

/// Puts the dot at the direction from which light comes: [right, up, towards the viewer].
export function place_lamp(disc, [x, y, z]) {
  const length = Math.hypot(x, y, z);
  const dot = disc.firstElementChild;
  dot.style.left = `${50 + 44 * x / length}%`;
  dot.style.top = `${50 - 44 * y / length}%`;
  disc.setAttribute("aria-valuetext", `${Math.round(100 * x / length)} right, ${Math.round(100 * y / length)} up`);
}

/// Returns the direction of a place on the disc, or of the nearest one within the unit circle.
function direction(right, up) {
  const round = (value) => Math.round(value * 1000) / 1000, [x, y] = [right, up].map((value) => value / Math.max(1, Math.hypot(right, up) / 0.98));
  return [round(x), round(y), round(Math.sqrt(1 - x * x - y * y))];
}

/// Calls tell(direction) while the dot is dragged, or moved by the arrow keys.
export function follow_lamp(disc, tell) {
  const follow = (event) => {
    const box = disc.getBoundingClientRect();
    tell(direction((event.clientX - box.left - box.width / 2) / (0.44 * box.width), (box.top + box.height / 2 - event.clientY) / (0.44 * box.height)));
  };
  disc.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const dot = disc.firstElementChild;
    tell(direction((parseFloat(dot.style.left) - 50) / 44 + 0.1 * step[0], (50 - parseFloat(dot.style.top)) / 44 + 0.1 * step[1]));
  });
  disc.addEventListener("pointerdown", (event) => { disc.setPointerCapture(event.pointerId); follow(event); });
  disc.addEventListener("pointermove", (event) => { if (disc.hasPointerCapture(event.pointerId)) follow(event); });
}
