// SPDX-License-Identifier: BSD-3-Clause
// Other molecules: files that are dropped on the page or chosen, and entries of the Protein Data Bank, which this browser
// fetches when its button is pressed, and not before.

const kBank = "https://files.rcsb.org/download/";  // connection.cpp lets the page ask this host, and no other

/// Returns the code of an entry as the bank's files have it, "4hhb" or "pdb_10004hhb"; undefined: it is none.
export function code_of(text) {
  const [, short, long] = text.trim().toLowerCase().match(/^(?:pdb_0000)?([1-9][a-z0-9]{3})$|^(pdb_[a-z0-9]{8})$/) ?? [];
  return short ?? long;
}

/// Returns the name under which the program takes a file: no path, plain letters, its ending.
export const plain_name = (name) => name.replace(/^.*[/\\]/, "").replace(/[^A-Za-z0-9._-]+/g, "_").replace(/^[.-]+/, "").slice(-100) || "file";

/// Returns the file of an entry. Throws an Error with a sentence for people.
export async function fetch_entry(code) {
  const answer = await fetch(`${kBank}${code}.cif`, { credentials: "omit", referrerPolicy: "no-referrer" })
    .catch(() => { throw new Error("files.rcsb.org cannot be reached: this browser has no network, or it is not let through."); });
  if (answer.status === 404) throw new Error(`The Protein Data Bank has no entry ${code}.`);
  if (!answer.ok) throw new Error(`files.rcsb.org does not give ${code} now (it answers ${answer.status}).`);
  return new File([await answer.blob()], `${code}.cif`);
}

/// Lets molecules be opened. may(): whether this page decides; loses(): whether changes would be lost; largest(): bytes of a
/// file; work(what): says what is done, and "" that nothing is done any more; fail(sentence): says what is wrong.
export function open_controls({ ask, may, loses, largest, work, fail }) {
  async function hand_over(files) {
    const large = files.find(({ size }) => size > largest()), megabytes = (bytes) => Math.ceil(bytes / 1e6).toLocaleString("en");
    if (large) throw new Error(`${large.name} has ${megabytes(large.size)} MB, and a page can hand over ${megabytes(largest())} MB at most. Start the preview with this file instead.`);
    for (const file of files) {
      work(`Taking ${file.name}`);
      const answer = await fetch(`received/${plain_name(file.name)}`, { method: "POST", body: file }).catch(() => null);
      if (!answer) throw new Error(`${file.name} cannot be read. If it is a folder, open the files in it.`);
      if (!answer.ok) throw new Error(`${file.name} was not taken: ${(await answer.text()).trim()}.`);
    }
    const reply = await ask({ request: "open", files: files.map(({ name }) => plain_name(name)) });
    if (reply.error) throw new Error(`${reply.error}.`);
  }

  /// Opens what files_of() gives, which may take a while.
  async function open(what, files_of, refuse = fail) {
    if (!may()) return refuse("Another page controls this preview. Take control here before you open a molecule.");
    if (loses() && !confirm("The figure has changes that no file has. Open another molecule, without them?")) return;
    work(what);
    try {
      await hand_over(await files_of());
    } catch (error) {
      work("");
      refuse(error.message);
    }
  }
  function open_files(list) {
    const files = [...list];
    if (files.length > 2) fail("Open one molecule at a time, or a molecule together with its trajectory.");
    else if (files.length > 0) open(`Taking ${files[0].name}`, () => files);
  }

  $("open-file").addEventListener("click", () => $("files").click());
  $("files").addEventListener("change", () => { open_files($("files").files); $("files").value = ""; });
  const show_drop = (event, shown) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    $("drop").hidden = !shown;
  };
  document.addEventListener("dragover", (event) => show_drop(event, true));
  document.addEventListener("dragleave", (event) => show_drop(event, event.relatedTarget !== null));
  document.addEventListener("drop", (event) => { show_drop(event, false); open_files(event.dataTransfer?.files ?? []); });

  const fault = (words) => {
    $("code-fault").textContent = words;
    $("code-fault").hidden = !words;
    $("code").setAttribute("aria-invalid", String(Boolean(words)));
  };
  $("code-form").addEventListener("submit", (event) => {
    event.preventDefault();
    const code = code_of($("code").value);
    fault(code ? "" : "A code has four letters and digits, such as 4hhb, or twelve, such as pdb_00004hhb.");
    if (code) open(`Fetching ${code} from files.rcsb.org`, async () => [await fetch_entry(code)], fault);
  });
}
