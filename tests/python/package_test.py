# SPDX-License-Identifier: BSD-3-Clause
"""The Python package over libmeniscus; runs in any interpreter that has numpy, Blender's included (blender -b --python
package_test.py). MENISCUS_LIBRARY names the library, MENISCUS_PACKAGE the folder with the package unless it is installed."""
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

#: Names of the files with the tests.
PARTS = ["surfaces_test", "inputs_test", "outputs_test", "objects_test"]

if __name__ == "__main__":
    # Blender passes its own arguments on.
    result = unittest.main(module=None, argv=["package_test", *PARTS], exit=False, verbosity=1).result
    sys.stdout.flush()
    os._exit(0 if result.wasSuccessful() and result.testsRun > 15 else 1) if "bpy" in sys.modules else sys.exit(
        0 if result.wasSuccessful() else 1)
