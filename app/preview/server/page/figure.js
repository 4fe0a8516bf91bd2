// SPDX-License-Identifier: BSD-3-Clause
// Controls of the figure: a chip for each shape and cut, and for caps, legend and kept views.

export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/// Returns the terms and texts of a list.
export const rows_of = (rows) => rows.flatMap(([term, text]) => [element("dt", { textContent: term }), element("dd", { textContent: text })]);

export function remove_button(what, action) {
  const button = element("button", { type: "button", className: "remove", textContent: "×" });
  button.setAttribute("aria-label", `Remove ${what}`);
  button.addEventListener("click", action);
  return button;
}

/// Returns the name of a shape.
export function shape_words(as, begins = false) {
  const words = as === "tube" ? "cartoon" : as;
  return begins ? words[0].toUpperCase() + words.slice(1) : words;
}

/// Returns a slider of `what`, with the word for its value.
function slider(word, what, { min, max, step, value }, tell) {
  const range = element("input", { type: "range", min, max, step, value });
  range.setAttribute("aria-label", `${word} of ${what}`);
  range.addEventListener("input", () => tell(range.valueAsNumber));
  return element("label", {}, word, range);
}

export const kShapes = ["sticks", "balls", "tube", "spheres", "bases", "glycans"];
const kPlane = /^(depth|x|y|z|[^<>, ]+,[^<>, ]+,[^<>, ]+)([<>])(.*)$/;

/// Returns the range of a plane's slider. The plane moves along the view, an axis or a direction such as 1,1,0. Returns
/// null for a plane that is placed by a selection of atoms, such as 'before ligand'.
function plane_range(plane, state) {
  const found = plane.match(kPlane);
  if (!found) return null;
  const [, axis, sign, bound] = found, value = Number(bound);
  if (axis === "depth") return { axis, sign, min: 0, max: 1, step: 0.01, value };
  const normal = axis.includes(",") ? axis.split(",").map(Number) : [..."xyz"].map((word) => Number(word === axis));
  const reach = (choose) => normal.reduce((sum, n, c) => sum + choose(n * state.low[c], n * state.high[c]), 0);
  return { axis, sign, min: Math.floor(reach(Math.min)), max: Math.ceil(reach(Math.max)), step: 0.1, value };
}

/// Returns {selection, opacity} of an entry of surface.opacity, such as "chain A=0.4"; 0.4 alone is for all atoms.
function opacity_of(entry) {
  const text = String(entry), at = text.lastIndexOf("=");
  return { selection: at < 0 ? undefined : text.slice(0, at), opacity: Number(text.slice(at + 1)) };
}

/// Shows the parts of the figure with controls; command(word, values), set(key, value) change it. Returns show(state).
export function figure_controls({ command, set, viewer }) {
  let known = "";  // the entries in the chips, which are made again when entries change, not when a slider moves
  const add = (key, value) => command("add", { key, value });
  const change = (key, index, value) => command("set", { key, index, value });  // null removes the entry

  ["x", "y", "z"].forEach((axis, a) => $(`cut-${axis}`).addEventListener("click", () =>
    add("surface.clip", `${axis}>${Math.round(5 * (latest.low[a] + latest.high[a])) / 10}`)));
  $("cut").addEventListener("input", () => cut_by($("cut").valueAsNumber / 100));
  $("cut-with").addEventListener("change", () => { if (slider_cut(latest.values) >= 0) cut_by($("cut").valueAsNumber / 100, true); });
  $("opacity").addEventListener("input", () => {
    const opacity = $("opacity").valueAsNumber / 100, index = latest.values["surface.opacity"].findIndex((rule) => typeof rule === "number");
    if (index < 0) add("surface.opacity", opacity);
    else change("surface.opacity", index, opacity);
  });
  $("surface-shown").addEventListener("change", (event) =>
    command("set", { key: "surface.shown", value: event.target.checked }).then((reply) => { if (!reply) event.target.checked = true; }));
  $("cap").addEventListener("change", (event) =>
    command("set", { key: "surface.cap_color", value: event.target.value === "own" ? $("cap-color").value : event.target.value }));
  $("cap-color").addEventListener("input", (event) => command("set", { key: "surface.cap_color", value: event.target.value }));
  for (const word of ["undo", "redo"]) $(word).addEventListener("click", () => command(word));
  $("view-form").addEventListener("submit", (event) => {
    event.preventDefault();
    const name = $("view-name").value.trim(), { camera, figure: { origin } } = viewer();
    if (name) keep_view(name, told_camera(camera, origin));
    $("view-name").value = "";
  });

  // This tab of the browser keeps the views.
  const kViews = `meniscus views ${location.pathname}`, kept = new Map(JSON.parse(sessionStorage.getItem(kViews) ?? "[]"));
  function keep_view(name, camera) {
    if (camera) kept.set(name, camera);
    else kept.delete(name);
    sessionStorage.setItem(kViews, JSON.stringify([...kept]));
    show_views();
  }
  const show_views = () => $("kept-views").replaceChildren(...[...kept].map(([name, view]) => {
    const button = element("button", { type: "button", className: "recall", textContent: name });
    button.addEventListener("click", () => viewer().move(asked_camera(view, viewer().camera, viewer().figure.origin), false));
    return element("li", {}, button, remove_button(`the view ${name}`, () => keep_view(name)));
  }));
  show_views();

  let latest = null;
  let own_plane = "";  // the last plane that the slider placed relative to the molecule

  /// Returns the index of the plane that the slider moves: one across the view, or the last that it placed.
  const slider_cut = ({ "surface.clip": cuts }) => cuts.findIndex((plane) => /^depth>/.test(plane) || plane === own_plane);

  /// Cuts away a share of the molecule. again: the plane goes across the present view.
  function cut_by(share, again = false) {
    const cuts = latest.values["surface.clip"], index = slider_cut(latest.values), before = cuts[index];
    if (share === 0) return before && change("surface.clip", index, null);
    let plane = `depth>${share}`;
    if ($("cut-with").value === "molecule") {
      const direction = !again && before === own_plane ? own_plane.match(kPlane)[1] : basis_of(viewer().camera).forward.map((x) => x.toFixed(4)).join();
      const { min, max } = plane_range(`${direction}>0`, latest);
      plane = own_plane = `${direction}>${(min + share * (max - min)).toFixed(2)}`;
    }
    if (before) cuts[index] = plane;  // the next change may come before the reply
    return before ? change("surface.clip", index, plane) : add("surface.clip", plane);
  }

  const chip = (what, remove, ...more) =>
    element("li", {}, element("span", { textContent: what }), remove_button(what, remove), ...more);
  const entry_chip = (what, key, index, ...more) => chip(what, () => change(key, index, null), ...more);

  /// Returns a chip with the object's colour, its opacity if that is one number, and a slider that cuts its surface.
  function object_chip(object, index) {
    const what = `${shape_words(object.representation)}: ${object.selection}`;
    const vary = (key, value) => {
      const objects = latest.values["figure.object"];
      objects[index] = { ...objects[index], [key]: value };  // the next change may come before the reply
      change("figure.object", index, objects[index]);
    };
    const more = [];
    const colour = element("input", { type: "color", value: /^#/.test(object.color ?? "") ? object.color : "#d8d8d0", title: object.color ? "" : "As the molecule so far" });
    colour.setAttribute("aria-label", `Colour of ${what}`);
    colour.addEventListener("input", () => vary("color", colour.value));
    more.push(colour);
    if (object.opacity === undefined || !/=/.test(object.opacity))
      more.push(slider("Opacity", what, { min: 0, max: 1, step: 0.05, value: object.opacity ?? 1 },
        (value) => vary("opacity", String(value))));
    if (object.representation === "surface" && (object.clip === undefined || /^depth>/.test(object.clip))) {
      const cut = slider("Cut", what, { min: 0, max: 1, step: 0.01, value: (object.clip ?? "depth>0").slice(6) },
        (value) => vary("clip", value > 0 ? `depth>${value}` : []));
      cut.title = "Cut along the view";
      more.push(cut);
    }
    return entry_chip(what, "figure.object", index, ...more);
  }

  function chips(state) {
    const list = [], { "surface.show": shown, "surface.patches": patches } = state.values;
    if (shown !== null) list.push(chip(`surface of ${shown}`, () => set("surface.show", null)));
    if (patches !== null) list.push(chip(`patches of ${patches}`, () => set("surface.patches", null)));
    for (const as of kShapes)
      state.values[`figure.${as}`].forEach((selection, n) => list.push(entry_chip(`${shape_words(as)}: ${selection}`, `figure.${as}`, n)));
    state.values["figure.object"].forEach((object, n) => list.push(object_chip(object, n)));
    state.values["surface.color"].forEach((rule, n) => {
      const at = rule.lastIndexOf("=");
      if (at >= 0) list.push(entry_chip(`${rule.slice(at + 1)}: ${rule.slice(0, at)}`, "surface.color", n));
    });
    state.values["annotations.labels"].forEach((label, n) =>
      list.push(entry_chip(`label: ${label.slice(label.lastIndexOf("=") + 1)}`, "annotations.labels", n)));
    state.values["surface.opacity"].map(opacity_of).forEach(({ opacity, selection }, index) => {
      if (selection === undefined) return;  // a slider of its own is for all atoms
      const what = `see through: ${selection}`;
      list.push(entry_chip(what, "surface.opacity", index, slider("Opacity", what, { min: 0, max: 1, step: 0.05, value: opacity },
        (value) => change("surface.opacity", index, `${selection}=${value}`))));
    });
    state.values["surface.clip"].forEach((plane, index) => {
      if (index === slider_cut(state.values)) return;
      const range = plane_range(plane, state);
      const more = [];
      if (range) {
        const side = element("button", { type: "button", textContent: "⇄", title: "The other side" });
        side.setAttribute("aria-label", `Show the other side of ${plane}`);
        side.addEventListener("click", () => {
          const now = plane_range(latest.values["surface.clip"][index], latest);
          change("surface.clip", index, `${now.axis}${now.sign === "<" ? ">" : "<"}${now.value}`);
        });
        more.push(slider("Place", `the cut ${range.axis}`, range, (value) => {
          const now = plane_range(latest.values["surface.clip"][index], latest);
          change("surface.clip", index, `${now.axis}${now.sign}${value}`);
        }), side);
      }
      list.push(entry_chip(range ? `cut ${range.axis} ${range.sign}` : `cut ${plane}`, "surface.clip", index, ...more));
    });
    return list;
  }

  function show(state) {
    latest = state;
    const { values } = state, cuts = values["surface.clip"], opacities = values["surface.opacity"].map(opacity_of), objects = values["figure.object"];
    const shape = JSON.stringify([values["surface.show"], values["surface.patches"], kShapes.map((as) => values[`figure.${as}`]), objects.map((o) => [o.representation, o.selection]), values["surface.color"], opacities.map((o) => o.selection), values["annotations.labels"],
      cuts.map((plane) => plane.match(kPlane)?.slice(1, 3) ?? plane)]);
    if (shape !== known) {
      known = shape;
      $("chips").replaceChildren(...chips(state));
    }
    $("surface-shown").checked = values["surface.shown"];
    $("surface-shown").parentElement.hidden = objects.length === 0 && kShapes.every((as) => values[`figure.${as}`].length === 0);
    const of_all = opacities.find((rule) => rule.selection === undefined), cut = cuts[slider_cut(values)], cap = values["surface.cap_color"];
    if ($("opacity") !== document.activeElement) $("opacity").value = 100 * (of_all?.opacity ?? 1);
    if ($("cut") !== document.activeElement && !cut) $("cut").value = 0;
    if ($("cut") !== document.activeElement && /^depth>/.test(cut)) $("cut").value = 100 * cut.slice(6);
    if (cut) $("cut-with").value = /^depth>/.test(cut) ? "view" : "molecule";
    const named = [...$("cap").options].some((option) => option.value === cap);
    $("cap").value = named ? cap : "own";
    $("cap-color-row").hidden = named || cuts.length === 0;
    if (cap !== "atom") $("cap-color").value = cap;
    const of_cuts = ["cap", "surface-cap_hatching", "surface-clip_all"].map((id) => [id, cuts.length > 0]);
    for (const [id, there] of [...of_cuts, ["surface-film_opacity", opacities.length > 0]]) if ($(id)) $(id).parentElement.hidden = !there;
    for (const word of ["undo", "redo"]) $(word).disabled = state[word] === 0;
    $("legend-fault").textContent = state.legend_fault;
    $("legend-fault").hidden = !state.legend_fault;
  }

  return show;
}
