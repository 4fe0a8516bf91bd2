// SPDX-License-Identifier: BSD-3-Clause
// Opens other molecules: files that are dropped on the page or chosen, and entries of the Protein Data Bank, which the
// browser fetches only when the reader presses the button.

const kBank = "https://files.rcsb.org/download/";  // the only other host that connection.cpp allows

/// Returns the code of an entry as the bank's file names have it, "4hhb" or "pdb_10004hhb"; undefined for other texts.
export function code_of(text) {
  const [, short, long] = text.trim().toLowerCase().match(/^(?:pdb_0000)?([1-9][a-z0-9]{3})$|^(pdb_[a-z0-9]{8})$/) ?? [];
  return short ?? long;
}

/// Returns a name that the program accepts for a file: without a path, in plain letters, with the same ending.
export const plain_name = (name) => name.replace(/^.*[/\\]/, "").replace(/[^A-Za-z0-9._-]+/g, "_").replace(/^[.-]+/, "").slice(-100) || "file";

/// Fetches the file of an entry. Throws an Error with a sentence for readers.
export async function fetch_entry(code) {
  const answer = await fetch(`${kBank}${code}.cif`, { credentials: "omit", referrerPolicy: "no-referrer" })
    .catch(() => { throw new Error("files.rcsb.org cannot be reached: this browser has no network, or it is not let through."); });
  if (answer.status === 404) throw new Error(`The Protein Data Bank has no entry ${code}.`);
  if (!answer.ok) throw new Error(`files.rcsb.org does not give ${code} now (it answers ${answer.status}).`);
  return new File([await answer.blob()], `${code}.cif`);
}

/// Prepares the page for opening molecules. may(): true if this page controls the preview; loses(): true if changes would be
/// lost; largest(): the limit of a file in bytes; work(what): shows a task, "" ends it; fail(sentence): shows an error.
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

  /// Opens the files that files_of() resolves to.
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
