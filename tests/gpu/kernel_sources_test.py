# SPDX-License-Identifier: BSD-3-Clause
"""Kernels are free of GLSL that real drivers refuse or get wrong, though the reference compiler accepts it."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

#: Types that are double in some builds, or contain one.
DOUBLES = r"(?:double|dvec[234]|real[23]?|Circle|Blocker|HalfPlane|CoveredArc|ExposedArc|FixedProbe|RollingArc|SaddleShape|PatchBound)"
#: Arrays of such types that may stay, by file and name, with the reason.
HARMLESS = {
    ("reduced_surface/exposed_arcs.glsl", "exposed_arcs"),  # of floats: where it is double, another one takes its place
    ("geometry/patch_bounds.glsl", "height"),               # these four: no index is a variable
    ("geometry/patch_bounds.glsl", "extended"),
    ("geometry/patch_bounds.glsl", "contact_z"),
    ("geometry/patch_bounds.glsl", "contact_rho"),
    ("geometry/ray_torus.glsl", "knot"),                    # rays are in single precision on GPUs
    ("geometry/torus_hits.glsl", "t"),
}


def sources():
    """Yields the path below gpu_shaders and the text without comments and buffers, which are in memory."""
    for path in sorted((ROOT / "gpu_shaders").rglob("*")):
        if path.suffix in {".comp", ".glsl"}:
            text = re.sub(r"//.*", "", path.read_text())
            yield str(path.relative_to(ROOT / "gpu_shaders")), re.sub(r"\bbuffer \w+ \{.*?\}", "", text, flags=re.S)


class KernelSources(unittest.TestCase):
    def test_no_array_with_a_variable_index_holds_doubles(self):
        """NVIDIA's compiler (580.159) silently rounds them to floats."""
        found = set()
        for path, text in sources():
            if path.startswith("test_support/"):
                text = re.sub(r"struct Answer \{.*?\};", "", text, flags=re.S)  # The struct is a buffer's.
            for name in re.findall(rf"\b{DOUBLES} (\w+)\[", text):
                found.add((path, name))
        self.assertEqual(found, HARMLESS)

    def test_arrays_of_patch_bounds_have_constant_indices(self):
        for path, text in sources():
            for name, index in re.findall(r"\b(?:s|shape)\.(height|extended|contact_z|contact_rho)\[([^]]*)\]", text):
                self.assertIn(index, "01", f"{path}: {name}[{index}]")

    def test_what_is_only_written_is_not_read_in_a_chain(self):
        """`a[i] = b[i] = 1u` reads b, which NVIDIA's compiler refuses for a writeonly buffer."""
        for path, text in sources():
            self.assertIsNone(re.search(r"\w+\[[^]]*\] = \w+\[[^]]*\] =[^=]", text), path)


if __name__ == "__main__":
    unittest.main()
