// SPDX-License-Identifier: BSD-3-Clause
// Mouse, pen, touch and keys as camera commands; without inertia.

const kClick = 4;            // CSS pixels a click may wander
const kHoverRest = 120;      // ms the pointer must rest before an atom is named
const kWheel = 0.0015;       // growth per unit of wheel

/// Calls to.command(word, values) for motions, to.begin() where one begins, to.hover(pixel or null, place),
/// to.pick(pixel, event) for a click and, for one of the middle button, to.center(pixel).
export function follow_pointer(canvas, to) {
  let drag = null;  // of the pointer that came last
  let rest = 0;
  const pointers = new Map();

  /// Column and row in the picture, which stands in the middle of its element.
  const pixel_at = (event) => {
    const scale = Math.min(canvas.clientWidth / canvas.width, canvas.clientHeight / canvas.height);
    const x = Math.floor((event.offsetX - canvas.clientWidth / 2) / scale + canvas.width / 2);
    const y = Math.floor((event.offsetY - canvas.clientHeight / 2) / scale + canvas.height / 2);
    return x >= 0 && y >= 0 && x < canvas.width && y < canvas.height ? { x, y } : null;
  };

  const place_of = (event) =>
    ({ x: event.offsetX, y: event.offsetY, clientX: event.clientX, clientY: event.clientY });

  const pinch = (event) => {
    const before = [...pointers.values()];
    pointers.set(event.pointerId, place_of(event));
    const after = [...pointers.values()];
    const span = ([a, b]) => Math.hypot(a.x - b.x, a.y - b.y) || 1;
    const middle = ([a, b]) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
    const [from, to_place] = [middle(before), middle(after)];
    to.command("zoom", { factor: span(after) / span(before) });
    to.command("pan", { dx: (to_place.x - from.x) / canvas.clientHeight, dy: (to_place.y - from.y) / canvas.clientHeight });
  };

  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    document.activeElement?.blur();  // keys are for the picture again
    clearTimeout(rest);
    to.hover(null);
    to.begin();
    pointers.set(event.pointerId, place_of(event));
    const pans = event.button === 2 || event.button === 1 || event.shiftKey;
    drag = { pointer: event.pointerId, word: pans ? "pan" : "orbit", x: event.clientX, y: event.clientY, wandered: 0,
      button: event.button };
  });
  canvas.addEventListener("pointermove", (event) => {
    if (pointers.size === 2 && pointers.has(event.pointerId)) { drag.wandered = kClick; return pinch(event); }
    if (pointers.has(event.pointerId)) pointers.set(event.pointerId, place_of(event));
    if (!drag) {
      clearTimeout(rest);
      to.hover(null);
      const [pixel, place] = [pixel_at(event), { x: event.offsetX, y: event.offsetY }];
      rest = setTimeout(() => to.hover(pixel, place), kHoverRest);
      return;
    }
    if (event.pointerId !== drag.pointer) return;  // the other ones of three fingers
    const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
    drag.wandered += Math.hypot(dx, dy);
    if (drag.wandered < kClick) return;
    Object.assign(drag, { x: event.clientX, y: event.clientY });
    to.command(drag.word, { dx: dx / canvas.clientHeight, dy: dy / canvas.clientHeight });
  });
  const release = (event) => {
    pointers.delete(event.pointerId);
    const was = drag;
    // A finger that stays behind a pinch begins anew from where it is, and taps nothing.
    const [[pointer, left] = []] = pointers;
    drag = left ? { ...was, pointer, x: left.clientX, y: left.clientY, wandered: kClick } : null;
    const pixel = pixel_at(event);
    if (event.type !== "pointerup" || !was || was.wandered >= kClick || !pixel) return;
    if (was.button === 0) to.pick(pixel, event);
    if (was.button === 1) to.center(pixel);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", () => { clearTimeout(rest); to.hover(null); });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 16;
    const growth = Math.exp(-event.deltaY * lines * kWheel);
    to.command("zoom", { factor: Math.min(2, Math.max(0.5, growth)), ...pixel_at(event) });
  }, { passive: false });
}

const kSwitches = "input[type=checkbox], input[type=color], button, summary";

/// Whether the control that has the focus has a use for the key itself; a slider or a switch that was used last must not
/// keep letters from the picture.
function is_for(control, key) {
  if (control.matches("input[type=range], [role=slider]")) return key.startsWith("Arrow");
  if (control.matches(kSwitches)) return key === " ";
  return control.matches("input, select, textarea");
}

/// Calls press(key) for keys that may mean something, while `allowed`, unless something is being typed.
export function follow_keys(press, allowed) {
  document.addEventListener("keydown", (event) => {
    const known = event.key.length === 1 || event.key.startsWith("Arrow") || event.key === "Escape";
    if (!known || is_for(event.target, event.key) || event.ctrlKey || event.metaKey || event.altKey || !allowed()) return;
    event.preventDefault();
    press(event.key);
  });
}
