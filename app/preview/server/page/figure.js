// SPDX-License-Identifier: BSD-3-Clause
// The controls of the figure: a chip for each thing shown, cuts, caps, legend, kept views.

const $ = (id) => document.getElementById(id);

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

/// Returns what a shape is called.
export function shape_words(as, begins = false) {
  const words = as === "tube" ? "cartoon" : as;
  return begins ? words[0].toUpperCase() + words.slice(1) : words;
}

/// Returns a slider with its word, which is the slider of a thing: `what`.
function slider(word, what, { min, max, step, value }, tell) {
  const range = element("input", { type: "range", min, max, step, value });
  range.setAttribute("aria-label", `${word} of ${what}`);
  range.addEventListener("input", () => tell(range.valueAsNumber));
  return element("label", {}, word, range);
}

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

/// Shows what the figure has, each with its controls; command(word, values) and set(key, value) change it. Returns show(state).
export function figure_controls({ command, set, viewer }) {
  let known = "";  // what the chips show: they are made anew when there are others, not when a slider moves

  ["x", "y", "z"].forEach((axis, a) => $(`cut-${axis}`).addEventListener("click", () =>
    command("cut", { plane: `${axis}>${Math.round(5 * (latest.low[a] + latest.high[a])) / 10}` })));
  $("cut").addEventListener("input", () => cut_by($("cut").valueAsNumber / 100));
  $("cut-with").addEventListener("change", () => { if (latest.cuts[slider_cut(latest)]) cut_by($("cut").valueAsNumber / 100, true); });
  $("opacity").addEventListener("input", () => {
    const opacity = $("opacity").valueAsNumber / 100, index = latest.opacities.findIndex((rule) => rule.selection === undefined);
    command("opacity", index < 0 ? { opacity } : { opacity, index });
  });
  $("surface-shown").addEventListener("change", (event) =>
    command("set", { key: "surface.shown", value: event.target.checked }).then((reply) => { if (!reply) event.target.checked = true; }));
  $("cap").addEventListener("change", (event) =>
    command("set", { key: "surface.cap_color", value: event.target.value === "own" ? $("cap-color").value : event.target.value }));
  $("cap-color").addEventListener("input", (event) => command("set", { key: "surface.cap_color", value: event.target.value }));
  for (const word of ["undo", "redo"]) $(word).addEventListener("click", () => command(word));
  $("view-form").addEventListener("submit", async (event) => {
    event.preventDefault();
    if (await command("save_view", { name: $("view-name").value.trim() })) {
      $("view-name").value = "";
      command("end_step");
    }
  });

  let latest = null;
  let own_plane = "";  // the last one that the slider placed with the molecule

  /// Which of the planes the slider moves: the one with the view, or the last one that it placed with the molecule.
  const slider_cut = ({ cuts }) => cuts.findIndex((plane) => /^depth>/.test(plane) || plane === own_plane);

  /// Cuts away a share of the molecule. again: across the view as it is now.
  function cut_by(share, again = false) {
    const index = slider_cut(latest), before = latest.cuts[index];
    if (share === 0) return before && command("remove", { of: "cuts", index });
    let plane = `depth>${share}`;
    if ($("cut-with").value === "molecule") {
      const direction = !again && before === own_plane ? own_plane.match(kPlane)[1] : basis_of(viewer().camera).forward.map((x) => x.toFixed(4)).join();
      const { min, max } = plane_range(`${direction}>0`, latest);
      plane = own_plane = `${direction}>${(min + share * (max - min)).toFixed(2)}`;
    }
    if (before) latest.cuts[index] = plane;  // the next change may come before the reply
    return command("cut", before ? { plane, index } : { plane });
  }

  /// of: the list of the state that has the thing, or what takes the thing away.
  const chip = (what, of, index, ...more) =>
    element("li", {}, element("span", { textContent: what }),
      remove_button(what, typeof of === "function" ? of : () => command("remove", { of, index })), ...more);

  /// An object with its colour, its opacity if that is one number, and a surface's cut along the view.
  function object_chip(object, index) {
    const what = `${shape_words(object.representation)}: ${object.selection}`;
    const change = (key, value) => {
      latest.objects[index] = { ...latest.objects[index], [key]: value };  // the next change may come before the reply
      command("object", { index, object: latest.objects[index] });
    };
    const more = [];
    const colour = element("input", { type: "color", value: /^#/.test(object.color ?? "") ? object.color : "#d8d8d0" });
    colour.setAttribute("aria-label", `Colour of ${what}`);
    colour.addEventListener("input", () => change("color", colour.value));
    more.push(colour);
    if (object.opacity === undefined || !/=/.test(object.opacity))
      more.push(slider("Opacity", what, { min: 0, max: 1, step: 0.05, value: object.opacity ?? 1 },
        (value) => change("opacity", String(value))));
    if (object.representation === "surface" && (object.clip === undefined || /^depth>/.test(object.clip))) {
      const cut = slider("Cut", what, { min: 0, max: 1, step: 0.01, value: (object.clip ?? "depth>0").slice(6) },
        (value) => change("clip", value > 0 ? `depth>${value}` : []));
      cut.title = "Cut along the view";
      more.push(cut);
    }
    return chip(what, "objects", index, ...more);
  }

  function chips(state) {
    const list = [];
    if (state.show !== null) list.push(chip(`surface of ${state.show}`, () => set("surface.show", null)));
    if (state.patches.selection !== null) list.push(chip(`patches of ${state.patches.selection}`, () => set("surface.patches", null)));
    state.representations.forEach(({ as, selection }, n) => list.push(chip(`${shape_words(as)}: ${selection}`, "representations", n)));
    state.objects.forEach((object, n) => list.push(object_chip(object, n)));
    (state.color.rules ?? []).forEach((rule, n) => {
      const at = rule.lastIndexOf("=");
      list.push(chip(`${rule.slice(at + 1)}: ${rule.slice(0, at)}`, "rules", n));
    });
    const labels = state.values["annotations.labels"];
    labels.forEach((label) => list.push(chip(`label: ${label.slice(label.lastIndexOf("=") + 1)}`,
      () => set("annotations.labels", labels.filter((other) => other !== label)))));
    state.opacities.forEach(({ opacity, selection }, index) => {
      if (selection === undefined) return;  // the slider of all
      const what = `see through: ${selection}`;
      list.push(chip(what, "opacities", index, slider("Opacity", what, { min: 0, max: 1, step: 0.05, value: opacity },
        (value) => command("opacity", { opacity: value, index }))));
    });
    state.cuts.forEach((plane, index) => {
      if (index === slider_cut(state)) return;
      const range = plane_range(plane, state);
      const more = [];
      if (range) {
        const side = element("button", { type: "button", textContent: "⇄", title: "The other side" });
        side.setAttribute("aria-label", `Show the other side of ${plane}`);
        side.addEventListener("click", () => {
          const now = plane_range(latest.cuts[index], latest);
          command("cut", { plane: `${now.axis}${now.sign === "<" ? ">" : "<"}${now.value}`, index });
        });
        more.push(slider("Place", `the cut ${range.axis}`, range, (value) => {
          const now = plane_range(latest.cuts[index], latest);
          command("cut", { plane: `${now.axis}${now.sign}${value}`, index });
        }), side);
      }
      list.push(chip(range ? `cut ${range.axis} ${range.sign}` : `cut ${plane}`, "cuts", index, ...more));
    });
    return list;
  }

  function views(state) {
    return state.views.map((name) => {
      const button = element("button", { type: "button", className: "recall", textContent: name });
      button.addEventListener("click", () => command("recall_view", { name }));
      return element("li", {}, button,
        remove_button(`the view ${name}`, () => command("forget_view", { name }).then(() => command("end_step"))));
    });
  }

  function show(state) {
    latest = state;
    const shape = JSON.stringify([state.show, state.patches.selection, state.representations, state.objects.map((o) => [o.representation, o.selection]), state.color.rules, state.opacities.map((o) => o.selection), state.values["annotations.labels"],
      state.cuts.map((plane) => plane.match(kPlane)?.slice(1, 3) ?? plane), state.views]);
    if (shape !== known) {
      known = shape;
      $("chips").replaceChildren(...chips(state));
      $("kept-views").replaceChildren(...views(state));
    }
    $("surface-shown").checked = !state.surface_hidden;
    $("surface-shown").parentElement.hidden = state.representations.length + state.objects.length === 0;
    const of_all = state.opacities.find((rule) => rule.selection === undefined), cut = state.cuts[slider_cut(state)];
    if ($("opacity") !== document.activeElement) $("opacity").value = 100 * (of_all?.opacity ?? 1);
    if ($("cut") !== document.activeElement && !cut) $("cut").value = 0;
    if ($("cut") !== document.activeElement && /^depth>/.test(cut)) $("cut").value = 100 * cut.slice(6);
    if (cut) $("cut-with").value = /^depth>/.test(cut) ? "view" : "molecule";
    const named = [...$("cap").options].some((option) => option.value === state.cap.color);
    $("cap").value = named ? state.cap.color : "own";
    $("cap-color-row").hidden = named || state.cuts.length === 0;
    if (state.cap.color !== "atom") $("cap-color").value = state.cap.color;
    const of_cuts = ["cap", "surface-cap_hatching", "surface-clip_all"].map((id) => [id, state.cuts.length > 0]);
    for (const [id, there] of [...of_cuts, ["surface-film_opacity", state.opacities.length > 0]]) if ($(id)) $(id).parentElement.hidden = !there;
    for (const word of ["undo", "redo"]) $(word).disabled = state[word] === 0;
    $("legend-fault").textContent = state.legend.fault ?? "";
    $("legend-fault").hidden = !state.legend.fault;
  }

  return show;
}
