// SPDX-License-Identifier: BSD-3-Clause
// Joins the objects of a mesh file into one, for formats that hold no more.
#include "exporters/mesh_files/mesh_file.h"

#include <algorithm>
#include <utility>

namespace meniscus {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

FileObject joined(std::vector<FileObject> objects) {
  FileObject whole = std::move(objects.front());
  for (std::size_t n = 1; n < objects.size(); ++n) {
    FileObject& next = objects[n];
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    append(whole.positions, next.positions);
    append(whole.normals, next.normals);
    append(whole.colors, next.colors);
    append(whole.atom, next.atom);
    append(whole.kind, next.kind);
    append(whole.component, next.component);
    for (const auto& [a, b, c] : next.triangles) whole.triangles.push_back({first + a, first + b, first + c});
    for (std::size_t k = 0; k < whole.numbers.size(); ++k) append(whole.numbers[k].values, next.numbers[k].values);
    whole.is_cavity = whole.is_cavity && next.is_cavity;
    next = {};
  }
  return whole;
}

}  // namespace meniscus
