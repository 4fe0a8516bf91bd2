// SPDX-License-Identifier: BSD-3-Clause
// Writes counts and components as one sentence.
#include "tests/support/topology.h"

#include <algorithm>
#include <vector>

namespace meniscus::testing {

std::string topology_of(const Surface& surface) {
  const SurfaceCounts n = surface.counts();
  std::string text;
  const auto add = [&](const char* name, std::size_t value) { text += name + std::to_string(value); };
  add("convex ", n.convex);
  add(", toroidal ", n.toroidal);
  add(", concave ", n.concave);
  add(", probes ", n.fixed_probes);
  add(", arcs ", n.arcs);
  add(", free ", n.free_edges);
  add(", spindle ", n.spindle);
  std::vector<std::string> parts;
  for (const Component& c : surface.components)
    parts.push_back((c.kind == ComponentKind::outer ? " outer" : " cavity") + std::to_string(c.euler));
  std::sort(parts.begin(), parts.end());
  text += ";";
  for (const std::string& part : parts) text += part;
  if (!surface.certificate.closed) text += "; open";
  return text;
}

}  // namespace meniscus::testing
