// SPDX-License-Identifier: BSD-3-Clause
// Kernels whose arithmetic is less exact than this driver's, by rewriting their source on its way to GL.
#pragma once

namespace meniscus::testing {

/// From now on every kernel that is compiled has scalar products and vector products made of fused products, and each
/// of them, each square root and each length off by up to so many units in the last place of its precision, by a hash
/// of its value. Takes epoxy's glShaderSource.
void compile_inexactly(unsigned single_units, unsigned double_units);

/// From now on they are compiled as they are.
void compile_exactly();

}  // namespace meniscus::testing
