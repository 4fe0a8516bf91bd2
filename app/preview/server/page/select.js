// SPDX-License-Identifier: BSD-3-Clause
// Selects atoms, residues and chains on the stage, in the list or in the sequence; a card has actions on them.
import { element, kShapes, rows_of, shape_words } from "./figure.js";

const kSeries = 400;                             // ms between the clicks of a double or triple click
const kNear = 6;                                 // CSS pixels between the clicks of a double or triple click
const kAround = 5;                               // radius of "around" the selection, in Å
const kHoverRest = 120;                          // ms that the pointer rests before an atom is named
const kLevels = ["atom", "residue", "molecule"];  // selected by one, two and three clicks

/// Returns the rule of a label, which names a residue or an atom as "ASP 25" or "ASP 25 CA".
function label_of({ selection, name }) {
  const [, number, residue, atom] = selection.match(/ resid (\S+) and resname (\S+)(?: and name (\S+))?$/) ?? [];
  return `${selection}=${residue ? [residue, number, atom].filter(Boolean).join(" ") : name}`;
}

/// Names the atom under the cursor, with its exposed area. viewer() returns the viewer of the stage.
function follow_hover(viewer) {
  const canvas = $("picture"), tip = $("tip");
  let hovered = 0;  // number of the latest hover; older answers are late

  async function hover(event, number, more = 10) {
    if (canvas.dataset.rest !== "true") return;
    const found = await viewer().pick(event.clientX, event.clientY);
    if (number !== hovered || !found) return;
    const area = found.exposed_area, [label, what] = found.label ? [found.label, found.what] : viewer().words(found).split(" – ");
    tip.hidden = false;
    tip.children[0].textContent = label;
    tip.children[1].textContent = (what ?? "") + (typeof area === "number" ? ` · ${area.toFixed(2)} Å² exposed` : "");
    const { left, top } = $("stage").getBoundingClientRect(), { clientWidth, clientHeight } = $("stage");
    const x = Math.min(event.clientX - left + 14, clientWidth - tip.offsetWidth - 8);
    const y = Math.min(event.clientY - top + 16, clientHeight - tip.offsetHeight - 8);
    tip.style.transform = `translate(${Math.max(x, 0)}px, ${Math.max(y, 0)}px)`;
    // The area follows soon if the program knows it already.
    if (found.area_follows && more > 0) setTimeout(() => { if (number === hovered) hover(event, number, more - 1); }, 300);
  }

  for (const kind of ["pointermove", "pointerdown", "pointerleave"])
    canvas.addEventListener(kind, (event) => {
      const number = ++hovered;
      tip.hidden = true;
      if (kind === "pointermove" && event.buttons === 0) setTimeout(() => { if (number === hovered) hover(event, number); }, kHoverRest);
    });
}

/// Returns the selection: {click(found, event), choose(entry, adds), forget_fault(), has(text), listen(listener), show(state)}.
/// An entry is {selection, name, residue, molecule}: its expression, its name for people, and the expressions of the
/// residue and the chain that it is part of. `viewer` returns what draws the stage.
export function select_controls({ command, set, ask, say, viewer, page_camera }) {
  const card = $("card"), listeners = [];
  follow_hover(viewer);
  let entries = [], series = { at: -1e9 }, state = null, located = null, key = "", latest = 0, offered = "", labels = [], placed = 0;
  let size = null, written = null;  // the size of the molecule's part of the picture, and the viewer's labels

  const text = () => entries.length === 1 ? entries[0].selection
    : entries.map(({ selection }) => `(${selection})`).join(" or ");
  const has = (selection) => entries.some((entry) => entry.selection === selection);

  /// Selects other entries. place: the card's place on the stage, in CSS pixels.
  function become(next, place = null) {
    entries = next;
    ++latest;
    if ($("atoms").value === offered) $("atoms").value = offered = text();
    show_card(place);
    locate();
    for (const listener of listeners) listener(entries);
  }

  function choose(entry, adds, place) {
    const others = entries.filter(({ selection }) => selection !== entry.selection);
    if (!adds) become(has(entry.selection) && entries.length === 1 && !place ? [] : [entry], place);
    else become(others.length < entries.length ? others : [...others, entry], place);
  }

  /// Selects what was clicked; two clicks select the residue, three the chain. found: Viewer.pick() or null.
  async function click(found, event) {
    const goes_on = event.timeStamp - series.at < kSeries &&
      Math.hypot(event.clientX - series.x, event.clientY - series.y) < kNear;
    series = { at: event.timeStamp, x: event.clientX, y: event.clientY, count: goes_on ? series.count % 3 + 1 : 1,
      before: goes_on ? series.before : entries };
    if (!found) return event.shiftKey ? undefined : become([]);
    const pixel = found.x === undefined ? { place: found.place } : { x: found.x, y: found.y };
    const pick = () => ask({ command: "pick", ...pixel, wait: false });
    const { count, before } = series, told = await pick();
    if (!told.ok || !told.hit) return;
    const { selections, place, name } = told, residue = place.endsWith(name) ? place.slice(0, -name.length - 1) : place;
    const names = [place, residue, selections.molecule.replace(/ and polymer$/, "")];
    const entry = { selection: selections[kLevels[count - 1]], name: names[count - 1], ...selections };
    if (count > 1) entries = before;
    const box = $("stage").getBoundingClientRect();
    choose(entry, event.shiftKey, [event.clientX - box.left, event.clientY - box.top]);
    const number = latest;
    for (let now = told; has(entry.selection) && number === latest; now = await pick()) {
      tell(now);
      if (!now.area_follows) return;
      await new Promise((resolve) => setTimeout(resolve, 300));
    }
  }

  function tell({ element: symbol, kind, exposed_area, area_follows, position }) {
    const rows = [["element", symbol]];
    if (["convex", "toroidal", "concave"].includes(kind)) rows.push(["what", `${kind} patch`]);
    if (area_follows || exposed_area !== null) rows.push(["exposed", area_follows ? "…" : `${exposed_area.toFixed(3)} Å²`]);
    rows.push(["position", position.map((x) => x.toFixed(2)).join(", ")]);
    card.querySelector("dl").replaceChildren(...rows_of(rows));
  }

  // The card

  const colour = element("input", { type: "color", value: "#e69f00" });
  colour.setAttribute("aria-label", "Colour of what is selected");
  colour.addEventListener("change", () => command("add", { key: "surface.color", value: `${text()}=${colour.value}` }));
  const add = (key, value) => command("add", { key, value });
  const actions = {
    "Look into": () => command("look_into", { selection: text() }),
    "Zoom to": () => command("zoom_to", { selection: text() }),
    ...Object.fromEntries(kShapes.map((as) => [shape_words(as, true), () => add(`figure.${as}`, text())])),
    "Surface of": () => add("figure.object", { representation: "surface", selection: text() }),
    "See through": () => add("surface.opacity", `${text()}=0.4`),
    "Cut before": () => add("surface.clip", `before ${text()}`),
    "Hide": () => command("take_away", { selection: text() }),
    "Show only": () => set("surface.show", text()),
    "Outline": () => set("surface.patches", text()),
    "Label": () => set("annotations.labels", [...state.values["annotations.labels"], ...entries.map(label_of)]),
    "Around": () => become([{ selection: `within ${kAround} of (${text()}) and not (${text()})`,
      name: `${kAround} Å around ${entries.map(({ name }) => name).join("; ")}` }]),
    "Distance": () => add("figure.object", { representation: "distance", selection: entries.slice(-2).map(({ selection }) => selection).join(" to ") }),
  };
  const buttons = Object.entries(actions).map(([textContent, act]) => {
    const button = element("button", { type: "button", textContent });
    button.addEventListener("click", act);
    return button;
  });
  card.querySelector(".buttons").append(...buttons, element("label", { textContent: "Colour " }, colour));
  card.querySelector(".plain").addEventListener("click", () => become([]));

  const fault = (words) => {
    $("atoms-fault").textContent = words;
    $("atoms-fault").hidden = !words;
    $("atoms").setAttribute("aria-invalid", String(Boolean(words)));
  };
  $("figure-form").addEventListener("submit", async (event) => {
    event.preventDefault();
    const selection = $("atoms").value.trim(), found = await command("locate", { selection }, fault);
    if (!found) return;
    become([{ selection, name: selection }]);
    say(`${found.atoms.toLocaleString("en")} atoms`);
  });

  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && entries.length > 0) become([]);
  });

  function show_card(place) {
    card.hidden = entries.length === 0;
    if (card.hidden) return;
    card.querySelector("h2").textContent = entries.map(({ name }) => name).join("; ");
    card.querySelector("dl").replaceChildren();
    const distance = buttons.at(-1);
    distance.disabled = entries.length < 2;
    distance.title = distance.disabled ? "Select another with Shift and a click first" : "Between the last two";
    const { clientWidth, clientHeight } = $("stage"), [x, y] = place ?? [clientWidth, 0];
    card.style.left = `${Math.max(8, Math.min(x + 16, clientWidth - card.offsetWidth - 8))}px`;
    card.style.top = `${Math.max(8, Math.min(y + 16, clientHeight - card.offsetHeight - 8))}px`;
  }

  async function points_of(selection) {
    const { atoms, points = [], picture = size } = await ask({ command: "locate", selection });
    size = picture;
    return { points, are_all: points.length === atoms };
  }

  /// Returns the shortest distance of two sets of atoms, in words, and its middle; null if not all places of atoms are known.
  async function nearest(...sides) {
    const [near, far] = await Promise.all(sides.map(points_of));
    const pairs = near.are_all && far.are_all ? near.points.flatMap((a) => far.points.map((b) => [length(minus(a, b)), times(plus(a, b), 0.5)])) : [];
    const [reach, point] = pairs.reduce((best, pair) => pair[0] < best[0] ? pair : best, [Infinity]);
    return point && { text: `${reach.toFixed(2)} Å`, point };
  }

  /// Finds where the labels of atoms and the lengths of dashed lines belong, which pictures of the stage do not have.
  async function place_labels({ values }) {
    const number = ++placed;
    const found = await Promise.all([
      ...values["annotations.labels"].map(async (label) => {
        const [, selection, words] = label.match(/^(.*)=(.*)$/s), { points } = await points_of(selection);
        return points.length > 0 && { text: words, point: times(points.reduce(plus), 1 / points.length) };
      }),
      ...values["figure.object"].filter(({ representation }) => values["annotations.lengths"] && representation === "distance")
        .map(({ selection }) => nearest(...selection.split(" to "))),
    ]);
    if (number !== placed) return;
    [labels, written] = [found.filter(Boolean), null];
    draw();
  }

  // On the stage

  async function locate() {
    const number = latest;
    const found = entries.length > 0 ? await ask({ command: "locate", selection: text() }) : { ok: true, points: [], places: [] };
    if (number !== latest || !found.ok) return;
    [located, size] = [found, found.picture ?? size];
    viewer().select(found.places.flatMap(([first, count]) => Array.from({ length: count }, (_, n) => first + n)));
    draw();
  }

  function drawn(tag, attributes, textContent = "") {
    const made = Object.assign(document.createElementNS("http://www.w3.org/2000/svg", tag), { textContent });
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, typeof value === "number" ? value.toFixed(1) : value);
    return made;
  }

  /// Draws rings around the atoms, and labels on the program's pictures; pictures of this browser have labels already.
  function draw() {
    const { width = 1, height = 1, camera } = state ?? {}, svg = $("rings"), { figure } = viewer();
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const box = size ?? [width, height], frame = state && frame_of(page_camera(camera), ...box);
    const place = (points) => state ? places_of(points, frame, box) : [];
    const rings = place(located?.points ?? []).filter(Boolean).map(([cx, cy]) => drawn("circle", { cx, cy, r: located.points.length > 60 ? 3 : 6 }));
    const texts = place(labels.map(({ point }) => point)).map((at, n) => at && drawn("text", { x: at[0], y: at[1] }, labels[n].text));
    svg.replaceChildren(...rings, ...texts.filter(Boolean));
    if (figure.labels === written) return;
    written = figure.labels = labels.map(({ text: words, point }) => ({ text: words, point: minus(point, figure.origin) }));
    viewer().write_labels();
    if (viewer().casts) viewer().change();
  }

  /// Shows the selection in a state's picture; atoms may have other places in it than before.
  function show(next) {
    state = next;
    const places = JSON.stringify([next.frame, next.width, next.height, next.legend_fault,
      Object.entries(next.values).filter(([name]) => /^(figure|legend|annotations\.l)/.test(name))]);
    if (places !== key && entries.length > 0) locate();
    if (places !== key) place_labels(next);
    key = places;
    draw();
  }

  return { click, choose, forget_fault: () => fault(""), has, listen: (listener) => listeners.push(listener), show };
}
