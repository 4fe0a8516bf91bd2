# SPDX-License-Identifier: BSD-3-Clause
"""manual.py PROGRAM FOLDER: writes the pages of the manual as MkDocs takes them into FOLDER/pages, and FOLDER/mkdocs.yml.

The shelves and the order of pages are those of docs/index.md. Links to files that are not pages become plain words. The
reference gets a page for each command and one for the keys of scenes, made of the program's help and schema.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
# Pages from other folders of the tree, and their places in the site.
GUESTS = {"exporters/povray/README.md": "reference/povray-scene.md", "exporters/blender/README.md": "reference/blender-import.md",
          "exporters/blender/FORMAT.md": "reference/mns-format.md",
          "exporters/path_tracers/README.md": "reference/path-tracers.md", "app/preview/commands.md": "reference/preview-commands.md"}
TOXIN = pathlib.Path("/usr/share/pymol/data/demo/1tii.pdb")
SHELVES = ["tutorials", "how-to", "gallery", "reference", "explanation", "validation"]
COMMANDS = ["surface", "pockets", "render", "preview", "export povray", "export blender", "export mitsuba", "export pbrt",
            "export mesh", "export atoms", "farm bundle", "farm verify", "work", "info", "bench"]
CONFIG = """site_name: Meniscus
docs_dir: pages
use_directory_urls: false
theme:
  name: material
  font: false
  language: en
  palette:
    - {media: "(prefers-color-scheme: light)", scheme: default, primary: blue grey}
    - {media: "(prefers-color-scheme: dark)", scheme: slate, primary: blue grey}
  features: [navigation.tabs, navigation.indexes, navigation.top, search.suggest, content.code.copy]
plugins: [search, offline]
extra: {generator: false, polyfills: [iframe-worker.js]}
extra_css: [manual.css]
extra_javascript: [manual.js]
markdown_extensions:
  - toc: {permalink: true}
  - tables
  - pymdownx.superfences
  - pymdownx.highlight: {use_pygments: true}
validation: {nav: {omitted_files: warn}, links: {anchors: warn, not_found: warn, unrecognized_links: warn}}
nav:
"""
CSS = """.md-grid { max-width: 72rem; }
.md-typeset a { text-decoration: underline; }
.md-tabs__link { opacity: 1; }
.highlight:not(.language-text):not(.language-json) pre > code { white-space: pre-wrap; }
.whole { white-space: nowrap; }
@media (max-width: 44.9em) { .comment { display: block; padding-left: 2ch; } }
"""
# Adds what the theme lacks for users of a keyboard or a screen reader: a name for the search, and regions that scroll.
# Options are not broken at dashes, and on a phone a comment in a block of commands has its own line.
SCRIPT = """function mark(code, name, pattern) {
  code.dataset.marked = "";
  const texts = document.createNodeIterator(code, NodeFilter.SHOW_TEXT), found = [];
  for (let text; (text = texts.nextNode());) found.push(text);
  for (const text of found)
    text.replaceWith(...text.data.split(pattern).map((piece, n) => n % 2 ? Object.assign(document.createElement("span"),
      {textContent: piece, className: name}) : piece));
}
function complete() {
  document.querySelectorAll(".md-typeset code:not([data-marked])").forEach((code) => {
    mark(code, "comment", /((?<= )# .*\\n?)/);
    mark(code, "whole", /((?<![\\w-])--?[a-z][\\w-]*)/i);
  });
  document.querySelector(".md-search")?.setAttribute("aria-label", "Search");
  document.querySelectorAll("pre > code, .md-typeset__scrollwrap").forEach((region) => { region.tabIndex = 0; });
  document.querySelectorAll(".md-code__nav").forEach((buttons, n) => buttons.setAttribute("aria-label", `Code ${n + 1}`));
}
new MutationObserver(complete).observe(document.body, {childList: true, subtree: true});
complete();
"""
# A page that was opened from a file cannot start a worker. The worker of the search then runs in a hidden frame.
WORKER = """if (location.protocol === "file:") window.Worker = class extends EventTarget {
  constructor(address) {
    super();
    const frame = document.body.appendChild(Object.assign(document.createElement("iframe"), {hidden: true}));
    this.inner = frame.contentWindow;
    this.loaded = new Promise((resolve) => {
      this.inner.document.open();
      this.inner.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", {data}));
      const script = Object.assign(this.inner.document.createElement("script"), {src: address, onload: resolve});
      this.inner.document.appendChild(this.inner.document.createElement("html")).appendChild(script);
      this.inner.document.close();
    });
  }
  postMessage(data) {
    this.loaded.then(() => this.inner.dispatchEvent(new MessageEvent("message", {data})));
  }
};
"""


def site_place(path):
    """Returns the path of a file of the tree below the site; None if it is not there."""
    name = str(path.relative_to(ROOT))
    if name in GUESTS:
        return GUESTS[name]
    if DOCS in path.parents and path.is_file():
        return str(path.relative_to(DOCS))
    return None


def with_links_of_the_site(source, text):
    """Returns the text of a page with the links that lead to pages, and only the words of other links."""
    here = pathlib.PurePath(site_place(source)).parent

    def link(found):
        picture, words, target = found.groups()
        if "://" in target or target.startswith("#"):
            return found.group(0)
        name, _, anchor = target.partition("#")
        path = (source.parent / name).resolve()
        if not path.exists():
            sys.exit(f"{source.relative_to(ROOT)}: {target} leads nowhere")
        place = site_place(path)
        if place is None:
            return words
        return f"{picture}[{words}]({os.path.relpath(place, here)}{'#' + anchor if anchor else ''})"

    text = re.sub(r"`[^`\n]*`", lambda code: code.group(0).replace(r"\|", "|"), text)  # as MkDocs needs it
    return re.sub(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", link, text)


def in_cell(text):
    return text.replace("|", r"\|").replace("<", "&lt;").replace("*", r"\*").replace("#", r"\#")


def page_of_command(program, command):
    """Returns the help of a command: its head unchanged, each of its lists as a table."""
    text = subprocess.run([program, *command.split(), "--help-all"], check=True, capture_output=True, text=True).stdout
    head, *groups = re.split(r"^(?=[A-Z][^\n]*:\n  [-A-Z])", text, flags=re.M)
    summary, _, rest = head.partition("\n")
    page = f"# meniscus {command}\n\n{summary.strip()}.\n\n```text\n{rest.strip()}\n```\n"
    for group in groups:
        title, _, body = group.partition(":\n")
        rows = re.findall(r"^  (\S.*?)(?:  +|\n +)(\S.*(?:\n {6,}\S.*)*)", body, re.M)
        page += f"\n## {title}\n| option | meaning |\n|---|---|\n"
        for names, meaning in rows:
            page += f"| `{names}` | {in_cell(' '.join(meaning.split()))} |\n"
    return page


def page_of_scene_keys(program):
    schema = json.loads(subprocess.run([program, "help", "--scene-schema"], check=True, capture_output=True, text=True).stdout)
    page = "# Keys of scenes\n\nWhat a [scene](../../how-to/scenes.md) may hold, as `meniscus help --scene-schema` says.\n"
    for section, value in schema["properties"].items():
        keys = value.get("properties") or value.get("items", {}).get("properties")
        if keys:
            page += f"\n## {section}\n| key | meaning |\n|---|---|\n"
            for key, entry in keys.items():
                page += f"| `{key}` | {in_cell(entry.get('description', ''))} |\n"
    return page


def title_of(path):
    return re.search(r"^# (.+)$", path.read_text(), re.M).group(1).partition(":")[0]


def add_figure(program, pages):
    """Adds a figure that readers of the manual can turn, if Debian's pymol-data has its molecule."""
    if not TOXIN.exists():
        return
    subprocess.run([program, "export", "page", str(TOXIN), "-o", str(pages / "how-to/1tii.html"), "--color", "chain", "-q"],
                   check=True, stdout=subprocess.DEVNULL)
    page, words = pages / "how-to/pages.md", "Open it by a double click."
    text = page.read_text()
    if words not in text:
        sys.exit(f"how-to/pages.md: no '{words}', before which the manual has the figure")
    page.write_text(text.replace(words, f"**[Turn it here](1tii.html).** {words}", 1))


def main():
    program, folder = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
    pages = folder / "pages"
    shutil.rmtree(pages, ignore_errors=True)
    shutil.copytree(DOCS, pages)
    sources = [*DOCS.rglob("*.md"), *(ROOT / name for name in GUESTS)]
    for source in sources:
        (pages / site_place(source)).write_text(with_links_of_the_site(source, source.read_text()))
    add_figure(program, pages)
    (pages / "manual.css").write_text(CSS)
    (pages / "manual.js").write_text(SCRIPT)
    (pages / "iframe-worker.js").write_text(WORKER)
    options = pages / "reference" / "options"
    options.mkdir()
    for command in COMMANDS:
        (options / f"{command.replace(' ', '-')}.md").write_text(page_of_command(program, command))
    (options / "scene-keys.md").write_text(page_of_scene_keys(program))

    order = re.findall(r"\]\(([^)#]+\.md)\)", (DOCS / "index.md").read_text())
    rank = {name: place for place, name in reversed(list(enumerate(order)))}
    nav = "  - Start: index.md\n"
    for shelf in SHELVES:
        names = sorted((str(path.relative_to(pages)) for path in (pages / shelf).glob("*.md")), key=lambda name: (rank.get(name, 999), name))
        if names:
            nav += f"  - {shelf.capitalize()}:\n" + "".join(f"    - {json.dumps(title_of(pages / name))}: {name}\n" for name in names)
        if shelf == "reference":
            nav += "    - Options of each command:\n" + "".join(f"      - reference/options/{path.name}\n" for path in sorted(options.glob("*.md")))
    (folder / "mkdocs.yml").write_text(CONFIG + nav)


if __name__ == "__main__":
    main()
