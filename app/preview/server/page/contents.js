// SPDX-License-Identifier: BSD-3-Clause
// Lists the chains, ligands, ions and waters of the molecule, and shows the sequence of a chain.
import { element } from "./figure.js";

/// Shows the list and the sequence. selection: the result of select_controls(). Returns show(state).
export function contents_controls({ command, ask }, selection) {
  let entries = [], known = "", chain = null;  // chain: the entry whose sequence is shown

  const row = (entry) => {
    const eye = element("button", { type: "button", className: "plain eye", textContent: entry.shown > 0 ? "◉" : "○" });
    eye.setAttribute("aria-pressed", String(entry.shown > 0));
    eye.setAttribute("aria-label", `Show ${entry.name}`);
    eye.addEventListener("click", () => command(entry.shown > 0 ? "take_away" : "bring_back", { selection: entry.selection }));
    const [, residue, chain, number] = entry.residues === 1 && entry.name.match(/^(\S+) (\S+) (-?\d\S*)$/) || [];
    const size = residue ? `${entry.kind} in ${chain}` : entry.kind === "water" ? `${entry.residues.toLocaleString("en")} molecules`
      : `${entry.kind}, ${(entry.residues > 1 ? entry.residues : entry.atoms).toLocaleString("en")} ${entry.residues > 1 ? "residues" : "atoms"}`;
    const name = element("button", { type: "button", className: "recall", title: entry.selection }, residue ? `${residue} ${number}` : entry.name,
      element("small", { textContent: size }));
    name.addEventListener("click", (event) => selection.choose({ ...entry, molecule: entry.selection }, event.shiftKey));
    // Atoms that are not on the surface have the colours of their elements.
    if (entry.shown === 0 || (!entry.color && entry.selection.endsWith("polymer"))) return element("li", {}, eye, name);
    const colour = element("input", { type: "color", value: entry.color ?? "#45a878" });
    colour.setAttribute("aria-label", `Colour of ${entry.name}`);
    colour.addEventListener("change", () => command("add", { key: "surface.color", value: `${entry.selection}=${colour.value}` }));
    return element("li", {}, eye, name, colour);
  };

  async function read() {
    const found = await ask({ command: "contents" });
    if (!found.ok) return;
    entries = found.entries;
    $("entries").replaceChildren(...entries.map(row));
    $("entries-left").hidden = found.left_out === 0;
    $("entries-left").textContent = `${found.left_out.toLocaleString("en")} more are not listed.`;
    mark();
  }

  // The sequence

  const letters = () => [...$("letters").children];
  const words_of = ([, number, name]) => `${chain.selection.replace(/ and polymer$/, "")} and resid ${number} and resname ${name}`;

  async function show_sequence(of) {
    if (chain?.selection === of?.selection) return;
    chain = of;
    $("sequence").hidden = !of;
    if (!of) return;
    const found = await ask({ command: "contents", selection: of.selection });
    if (chain !== of || !found.ok) return;
    $("sequence-name").textContent = of.name;
    $("letters").replaceChildren(...found.residues.map((residue, n) => {
      const [letter, number, name] = residue;
      const button = element("button", { type: "button", textContent: letter, title: `${name} ${number}`, tabIndex: n === 0 ? 0 : -1 });
      button.setAttribute("aria-label", `${number} ${name}`);
      button.dataset.number = n % 10 === 0 ? number : "";
      button.dataset.selection = words_of(residue);
      return button;
    }));
    mark();
  }

  const choose = (button, adds) => selection.choose({ selection: button.dataset.selection,
    name: `${chain.name} ${button.getAttribute("aria-label")}`, residue: button.dataset.selection, molecule: chain.selection }, adds);
  $("letters").addEventListener("click", (event) => {
    if (event.target.matches("button")) choose(event.target, event.shiftKey);
  });
  $("letters").addEventListener("focusin", ({ target }) => { for (const letter of letters()) letter.tabIndex = letter === target ? 0 : -1; });
  $("letters").addEventListener("keydown", (event) => {
    const all = letters(), at = all.indexOf(event.target);
    const next = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: all.length - 1 }[event.key];
    if (next === undefined || !all[next]) return;
    event.preventDefault();
    event.stopPropagation();
    all[next].focus();
    if (event.shiftKey) choose(all[next], true);
  });

  // Links between the list, the sequence and the stage

  let chosen = [];
  function mark() {
    for (const [n, { children: [, name] }] of [...$("entries").children].entries())
      name.setAttribute("aria-pressed", String(selection.has(entries[n].selection)));
    const residues = new Set(chosen.map(({ residue }) => residue));
    const whole = chain && selection.has(chain.selection);
    let first = null;
    for (const button of letters()) {
      const is_chosen = whole || residues.has(button.dataset.selection);
      button.setAttribute("aria-pressed", String(is_chosen));
      if (is_chosen && !whole) first ??= button;
    }
    if (first && !$("letters").contains(document.activeElement)) first.scrollIntoView({ block: "nearest", inline: "center" });
  }

  selection.listen((next) => {
    chosen = next;
    show_sequence(entries.find(({ selection: own }) => own === next.at(-1)?.molecule && own.endsWith("polymer")) ?? null);
    mark();
  });

  return (state) => {
    const shape = JSON.stringify(Object.entries(state.values).filter(([key]) => /^(figure|shapes\.bare|surface\.(show|color|map|missing))/.test(key)));
    if (shape === known) return;
    known = shape;
    read();
  };
}
