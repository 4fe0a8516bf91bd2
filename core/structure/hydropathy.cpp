// SPDX-License-Identifier: BSD-3-Clause
// The table of Kyte and Doolittle.
#include "core/structure/hydropathy.h"

#include <limits>
#include <string>

namespace meniscus {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct Hydropathy {
  double value;
  std::string_view names;
};

constexpr Hydropathy kKyteDoolittle[] = {{4.5, " ILE "},         {4.2, " VAL "},
                                         {3.8, " LEU "},         {2.8, " PHE "},
                                         {2.5, " CYS CYX CYM "}, {1.9, " MET MSE "},
                                         {1.8, " ALA "},         {-0.4, " GLY "},
                                         {-0.7, " THR "},        {-0.8, " SER "},
                                         {-0.9, " TRP "},        {-1.3, " TYR "},
                                         {-1.6, " PRO "},        {-3.2, " HIS HID HIE HIP HSD HSE HSP "},
                                         {-3.5, " GLU GLH "},    {-3.5, " GLN "},
                                         {-3.5, " ASP ASH "},    {-3.5, " ASN "},
                                         {-3.9, " LYS LYN "},    {-4.5, " ARG "}};

}  // namespace

double hydropathy(std::string_view residue_name) {
  if (residue_name.empty()) return kMissing;
  const std::string word = std::string(" ").append(residue_name).append(" ");
  for (const Hydropathy& entry : kKyteDoolittle) {
    if (entry.names.find(word) != std::string_view::npos) return entry.value;
  }
  return kMissing;
}

}  // namespace meniscus
