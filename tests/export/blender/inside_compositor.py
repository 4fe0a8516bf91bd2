# SPDX-License-Identifier: BSD-3-Clause
"""EXR files in Blender's compositor: every layer is a socket with its values, and a Cryptomatte pick gives the matte of a chain."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import bpy
import numpy as np

PROGRAM = sys.argv[-1]
WIDTH, HEIGHT = 64, 48
CAMERA = {"position": [4, 1, 60], "target": [4, 1, 0], "up": [0, 1, 0], "projection": "orthographic", "height": 14}
ATOM = "ATOM  %5d  CA  ALA %s%4d    %8.3f%8.3f%8.3f  1.00 10.00           C\n"
#: Each chain has the surface that it has alone, and B lies behind A.
PAIR = "".join(ATOM % (n + 1, chain, n + 1, x, y, z) for n, (chain, x, y, z) in enumerate((("A", 0, 0, 0), ("A", 2.5, 0, 0), ("B", 4.2, 1, -15), ("B", 7, 2, -15))))


def tree_and_output(sockets):
    """Returns the emptied compositor of the scene and the node that takes the picture."""
    scene = bpy.context.scene
    if bpy.app.version >= (5, 0, 0):
        tree = bpy.data.node_groups.new("compositor", "CompositorNodeTree")
        scene.compositing_node_group = tree
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type=sockets)
        return tree, tree.nodes.new("NodeGroupOutput").inputs[0]
    scene.use_nodes = True
    scene.node_tree.nodes.clear()
    return scene.node_tree, scene.node_tree.nodes.new("CompositorNodeComposite").inputs["Image"]


class Compositor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(scene.camera)
        scene.render.engine, scene.cycles.samples = "CYCLES", 1
        scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        scene.render.use_compositing = True
        self.write("pair.pdb", PAIR)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="ascii") as file:
            file.write(text)

    def render(self, *words, molecule="pair.pdb"):
        path = os.path.join(self.folder, words[-1].replace("#", "0"))
        subprocess.run([PROGRAM, "render", molecule, "-q", "--force", "--device", "cpu", "--preset", "flat", "--silhouettes", "0",
                        "--depth-cue", "0", "--ambient-occlusion", "0", "--size", f"{WIDTH}x{HEIGHT}", "--camera", json.dumps(CAMERA),
                        *words[:-1], "-o", words[-1]], cwd=self.folder, check=True)
        return path

    def seen(self, build):
        """Returns the compositor's picture, (rows from the top, columns, channels)."""
        tree, output = tree_and_output("NodeSocketColor")
        tree.links.new(build(tree), output)
        path = os.path.join(self.folder, "seen.exr")
        bpy.context.scene.render.filepath = path
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(path, check_existing=False)
        values = np.array(image.pixels[:], np.float32).reshape(HEIGHT, WIDTH, -1)[::-1]
        bpy.data.images.remove(image)
        return values

    def image_node(self, tree, path):
        node = tree.nodes.new("CompositorNodeImage")
        node.image = bpy.data.images.load(path)
        return node

    def test_every_layer_is_a_socket(self):
        self.write("run.pdb", "".join(f"MODEL     {n + 1:4}\n" + ATOM % (1, "A", 1, 4 + 2 * n, 1, 0) + "ENDMDL\n" for n in range(2)))
        path = self.render("--frames", "all", "--aovs", "--cryptomatte", "run_#.exr", molecule="run.pdb")
        tree, _ = tree_and_output("NodeSocketColor")
        names = {socket.name for socket in self.image_node(tree, path).outputs}
        # Blender 3.4 passes over channels of several letters without a layer.
        plain = {"atom", "kind", "component"} if bpy.app.version >= (4, 0, 0) else set()
        self.assertGreaterEqual(names, {"Combined", "Depth", "N", "P", "Nview", "Pview", "forward", *plain,
                                        *(f"Crypto{what}{n:02}" for what in ("Chain", "Residue", "Atom") for n in range(3))})
        motion = self.seen(lambda tree: self.image_node(tree, path).outputs["forward"])
        step = 2.0 * HEIGHT / CAMERA["height"]  # 2 Å in pixels
        self.assertLess(abs(motion[HEIGHT // 2, WIDTH // 2, :3] - [step, 0, 1]).max(), 1e-3)
        self.assertTrue((motion[0, 0, :3] == 0).all())
        if not plain:
            return
        atoms = self.seen(lambda tree: self.image_node(tree, path).outputs["atom"])
        self.assertEqual((atoms[HEIGHT // 2, WIDTH // 2, 0], atoms[0, 0, 0]), (0.0, -1.0))

    def test_a_pick_gives_the_matte_of_a_chain(self):
        path = self.render("--cryptomatte", "--samples", "16", "pair.exr")
        covered = {}
        for chain in "AB":
            alone = self.render("--select", f"chain {chain}", "--samples", "16", f"{chain}.exr")
            covered[chain] = self.seen(lambda tree: self.image_node(tree, alone).outputs["Alpha"])[:, :, 0]

        def matte(name, layer="CryptoChain"):
            def build(tree):
                node = tree.nodes.new("CompositorNodeCryptomatteV2")
                node.source, node.image = "IMAGE", bpy.data.images.load(path, check_existing=True)
                node.layer_name = layer
                node.matte_id = name
                return node.outputs["Matte"]
            return self.seen(build)[:, :, 0]
        first = matte("A")
        self.assertGreater(first.sum(), 100)
        self.assertLess(abs(first - covered["A"]).max(), 1e-5)
        second = matte("B")
        self.assertGreater(np.minimum(covered["A"], covered["B"]).sum(), 5)  # A hides a part of B.
        self.assertTrue((second <= covered["B"] + 1e-5).all() and (second >= covered["B"] - covered["A"] - 1e-5).all())
        atoms = [matte(f"A/ALA {n}/CA", "CryptoAtom") for n in (1, 2)]
        self.assertLess(abs(sum(atoms) - first).max(), 1e-5)
        self.assertTrue(all(part.sum() > 30 for part in atoms))


if not unittest.main(argv=["inside_compositor"], exit=False).result.wasSuccessful():
    sys.exit(1)
