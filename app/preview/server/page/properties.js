// SPDX-License-Identifier: BSD-3-Clause
// Makes controls from the table of properties, with its words, limits and help.

const kSuchAs = { "image.width": "such as 85mm", "image.dpi": "300" };
const kWords = { ses: "solvent-excluded", sas: "solvent-accessible", vdw: "van der Waals" };
export const hex_of = (color) => ({ black: "#000000", white: "#ffffff" })[color] ?? (/^#/.test(color) ? color : null);

/// Returns the control of a property, without its label.
function control_of({ type, words, lowest, highest, step, slider_end }) {
  const input = (kind, limits = {}) => Object.assign(document.createElement("input"), kind ? { type: kind } : { autocomplete: "off", spellcheck: false }, limits);
  if (type === "flag") return input("checkbox");
  if (type === "color") return input("color");
  if (type === "word") {
    const select = document.createElement("select");
    select.append(...words.map((word) => new Option(kWords[word] ?? word, word)));
    return select;
  }
  if (lowest === undefined) return input("");
  const end = slider_end ?? (highest - lowest <= 1 ? highest : undefined);
  return end === undefined ? input("number", { min: lowest, max: highest, step: "any" }) : input("range", { min: lowest, max: end, step });
}

/// Fills the elements that name properties; command("set", {key, value}) changes them. "look.*" stands for all of a section
/// that no other element names. Returns fill(properties) and show(values).
export function property_controls({ command }) {
  const controls = new Map();  // controls by key
  let shown = {};

  function row(property) {
    const { key, label, unit, help, type } = property, control = control_of(property), line = document.createElement("label");
    control.id = key.replace(".", "-");
    if (kSuchAs[key]) control.placeholder = kSuchAs[key];
    line.title = help;
    const words = `${label}${unit ? `, ${unit}` : ""} `;
    line.append(...(type === "flag" ? [control, ` ${words}`] : [words, control]));
    const moves = ["range", "color"].includes(control.type);
    control.addEventListener(moves ? "input" : "change", async () => {
      const value = type === "flag" ? control.checked : control.value === "" ? null : Number.isFinite(control.valueAsNumber) ? control.valueAsNumber : control.value;
      if (!await command("set", { key, value })) show(shown);
    });
    controls.set(key, control);
    return line;
  }

  function fill(properties) {
    const parts = [...document.querySelectorAll("[data-properties]")], named = new Set(parts.flatMap((part) => part.dataset.properties.split(" ")));
    for (const { dataset } of document.querySelectorAll("[data-property]")) named.add(dataset.property);
    for (const part of parts)
      for (const word of part.dataset.properties.split(" "))
        part.append(...properties.filter(({ key, is_list }) => key === word || (word === `${key.split(".")[0]}.*` && !is_list && !named.has(key))).map(row));
  }

  function show(values) {
    shown = values;
    for (const [key, control] of controls) {
      const value = values[key] ?? "";
      if (control === document.activeElement && control.type !== "checkbox" && control.type !== "range") continue;
      if (control.type === "checkbox") control.checked = value;
      else if (control.type !== "color") control.value = typeof value === "number" ? Number(value.toPrecision(4)) : value;
      else if (hex_of(value)) control.value = hex_of(value);
    }
  }

  return { fill, show };
}
