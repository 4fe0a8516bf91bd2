# SPDX-License-Identifier: BSD-3-Clause
"""The command meniscus: exact surfaces of atoms as models in their structures, in the atoms' colors."""
import numpy as np
from chimerax.atomic import AtomsArg, all_atoms
from chimerax.core.commands import CmdDesc, NonNegativeFloatArg, PositiveFloatArg
from chimerax.core.errors import UserError
from chimerax.core.models import Surface


class ExactSurface(Surface):
    """A surface model that sessions save with its geometry."""
    SESSION_SAVE_DRAWING = True
    clip_cap = True


def geometry(mesh, colors):
    """Returns vertices, normals, triangles and vertex colors of a meniscus.Mesh. Triangles share no vertices, so that
    colors of atoms meet exactly where patches do, and normals at cusps are exact on both sides. colors: RGBA per atom.
    """
    corners = mesh.triangles.ravel()
    normals = mesh.normals[corners]
    normals[mesh.sharp_corners] = mesh.sharp_normals
    triangles = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    return (mesh.vertices[corners].astype(np.float32), normals.astype(np.float32), triangles,
            np.repeat(colors[mesh.triangle_atoms], 3, axis=0))


def meniscus(session, atoms=None, *, probe_radius=1.4, tolerance=0.05):
    """Adds one surface model to each structure that the atoms belong to, and returns the models. As in ChimeraX's own
    surfaces, atoms outside of chains (solvent, ligands, ions) are left out unless there are no others, and other atoms
    of a structure have no effect.

    probe_radius, tolerance: Å. Raises UserError if there are no atoms or the library refuses them."""
    try:
        import meniscus as library
    except ImportError as error:
        raise UserError(f"Meniscus is not in ChimeraX's Python ({error}); install its wheel by the command: "
                        "pip install meniscus_ses-VERSION-py3-none-SYSTEM.whl") from error
    atoms = all_atoms(session) if atoms is None else atoms
    in_chains = atoms.filter(atoms.in_chains)
    models = []
    for structure, part in (in_chains if len(in_chains) else atoms).by_structure:
        try:
            kind = "ses" if probe_radius > 0 else "vdw"
            exact = library.surface(part.coords, part.radii.astype(float), probe_radius, kind=kind)
            vertices, normals, triangles, colors = geometry(exact.mesh(tolerance), part.colors)
        except library.Error as error:
            raise UserError(str(error)) from error
        model = ExactSurface(f"{structure.name} exact surface", session)
        model.set_geometry(vertices, normals, triangles)
        model.vertex_colors = colors
        structure.add([model])
        models.append(model)
        accessible = exact.atom_sas_areas if kind == "ses" else exact.atom_areas
        session.logger.info(
            f"{structure}: {len(part)} atoms, probe {probe_radius:g} Å: solvent-excluded area {exact.area:.2f} Å², "
            f"volume {exact.volume:.2f} Å³; solvent-accessible area {accessible.sum():.2f} Å²", is_html=False)
    if not models:
        raise UserError("there are no atoms")
    return models


description = CmdDesc(optional=[("atoms", AtomsArg)],
                      keyword=[("probe_radius", NonNegativeFloatArg), ("tolerance", PositiveFloatArg)])
