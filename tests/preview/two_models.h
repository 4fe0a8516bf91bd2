// SPDX-License-Identifier: BSD-3-Clause
// Two models of four atoms, for sessions of a preview.
#pragma once

#include <string_view>

namespace meniscus::test {

/// Two models in PDB format; the oxygen moves.
inline constexpr std::string_view kTwoModels = R"(MODEL        1
ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA B   2       1.251   2.390   0.000  1.00 40.00           O
ENDMDL
MODEL        2
ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA B   2       5.251   5.390   0.000  1.00 40.00           O
ENDMDL
END
)";

}  // namespace meniscus::test
