// SPDX-License-Identifier: BSD-3-Clause
// Answers messages of a page around this one about the camera, picked atoms and colours of atoms. Lengths are in Å from
// the origin of the molecule's file. Only pages that have sent a request get messages.

const is_point = (v) => Array.isArray(v) && v.length === 3 && v.every((x) => Number.isFinite(x) && Math.abs(x) < 1e7);

/// Returns a camera in the form of Python's Camera.
function told_camera(camera, origin) {
  const { up } = basis_of(camera);
  return { position: plus(camera.position, origin), target: plus(camera.target, origin), up, projection: projection_of(camera),
    vertical_fov: camera.fov, height: camera.height };
}

/// Returns the camera of a message; null if it is not valid.
function asked_camera(asked, now, origin) {
  const { position, target, up, projection, vertical_fov, height } = asked;
  if (![position, target, up].every(is_point) || length(cross(minus(target, position), up)) < 1e-9) return null;
  if (!(vertical_fov > 0 && vertical_fov < 180 && height > 0 && height < 1e7)) return null;
  return { ...now, position: minus(position, origin), target: minus(target, origin), up, orthographic: projection === "orthographic",
    fov: vertical_fov, height };
}

/// Shows given colours. colors: three bytes for each atom of the figure, red first; label: their meaning.
function show_colors(viewer, colors, label) {
  const { figure } = viewer, { shown } = figure.tables, last = figure.schemes.length - 1;
  if (colors.length !== 3 * figure.names.atoms.length) return say(`There are ${colors.length / 3} colours for ${figure.names.atoms.length} atoms.`);
  say("");
  const words = Uint32Array.from(shown, (place) => colors[3 * place] | colors[3 * place + 1] << 8 | colors[3 * place + 2] << 16);
  const asked = figure.schemes[last].asked ? last : last + 1;
  figure.tables[`scheme_${asked}`] = words;
  figure.schemes[asked] = { name: label, legend: "", by_kind: false, asked: true };
  if (asked > last) $("scheme").append(new Option(label, asked));
  $("scheme").options[asked].text = label;
  $("scheme").value = asked;
  viewer.set_scheme(asked);
  $("legend").textContent = label;
}

function follow_messages(viewer) {
  if (window.parent === window) return;
  const { origin } = viewer.figure, tell = (what) => window.parent.postMessage({ meniscus: what }, "*");
  let told = "", listens = false;
  viewer.changed = () => {
    const camera = told_camera(viewer.camera, origin), text = JSON.stringify(camera);
    if (!listens || text === told) return;
    told = text;
    tell({ camera });
  };
  viewer.picked = (picked) => {
    if (!listens) return;
    const { tables } = viewer.figure;
    tell({ picked: picked && { atom: tables.shown[picked.atom], name: viewer.atom_name(picked.atom), point: plus(picked.point, origin) } });
  };
  window.addEventListener("message", ({ source, data }) => {
    if (source !== window.parent || typeof data?.meniscus !== "object" || !viewer.caster) return;
    const { hello, camera, colors, label, scheme } = data.meniscus, asked = camera && asked_camera(camera, viewer.camera, origin);
    if (hello) {
      [listens, told] = [true, ""];
      tell({ atoms: viewer.figure.names.atoms.length });
    }
    if (asked) {
      told = JSON.stringify(told_camera(asked, origin));
      $("projection").value = projection_of(asked);
      viewer.move(asked, false);
    }
    if (colors instanceof Uint8Array) show_colors(viewer, colors, String(label ?? "given"));
    if (scheme === 0) { $("scheme").value = 0; viewer.set_scheme(0); }
    viewer.changed();
  });
}
