# SPDX-License-Identifier: BSD-3-Clause
"""The package for package_test.py and atoms for its tests."""
import os
import sys

if "MENISCUS_PACKAGE" in os.environ:
    sys.path.insert(0, os.environ["MENISCUS_PACKAGE"])

import numpy as np

PROGRAM = os.environ.get("MENISCUS_PROGRAM")


def chain(count):
    n = np.arange(count)
    return np.stack([1.5 * n, 0.3 * (n % 3), 0.1 * n], axis=1), 1.7 - 0.05 * (n % 4)


def cloud(count, seed):
    random = np.random.default_rng(seed)
    return random.uniform(0.0, 2.2 * count ** (1 / 3), (count, 3)), random.uniform(1.2, 1.9, count)
