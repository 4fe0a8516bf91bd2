// SPDX-License-Identifier: BSD-3-Clause
// Controls of properties. Each has the key of its property in data-key; help and words of the look's sliders come from
// the program's table.

const value_of = (control) => control.type === "checkbox" ? control.checked
  : !/^(range|number)$/.test(control.type) ? control.value || null
    : Number.isFinite(control.valueAsNumber) ? Math.round(control.valueAsNumber * 1000) / 1000 : null;

/// Lets the page's controls set their properties by set(key, value). Returns add_slider(property, place), and
/// show(state, set_value), which shows the values by set_value(control, value).
export function property_controls(set) {
  const controls = [];
  const follow = (control) => {
    const event = /^(range|color)$/.test(control.type) ? "input" : "change";
    control.addEventListener(event, () => set(control.dataset.key, value_of(control)));
    controls.push(control);
  };
  document.querySelectorAll("[data-key]").forEach(follow);

  function add_slider({ key, label, slider_end, help }, place) {
    const id = key.slice(key.indexOf(".") + 1);
    const slider = Object.assign(document.createElement("input"),
      { id, type: "range", min: 0, max: slider_end, step: slider_end > 2 ? 0.5 : 0.05 });
    slider.dataset.key = key;
    const row = Object.assign(document.createElement("label"), { htmlFor: id, title: help });
    row.append(`${label} `, slider);
    place.append(row);
    follow(slider);
  }

  function show({ values, look }, set_value) {
    for (const control of controls) {
      const value = values[control.dataset.key];
      if (control.type === "checkbox") control.checked = value;
      else set_value(control, control.type === "range" && typeof value === "string" ? look[control.id] : value ?? "");
    }
  }

  return { add_slider, show };
}
