// SPDX-License-Identifier: BSD-3-Clause
// Joins faces across borders by disjoint sets that all threads share, then counts vertices, borders and faces.
#include "core/surface/components.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/math/union_find.h"
#include "core/surface/numbering.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

// Calls visit(range) for parts of a table, each long enough for what a part costs by itself.
template <typename Visit>
void for_each_part(std::size_t size, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, 1024), visit);
}

// Adds to the Euler characteristics, as a rule many times to the same one before another's turn.
class EulerSum {
 public:
  explicit EulerSum(std::vector<Component>& components) : components_(components) {}
  ~EulerSum() { hand_over(); }
  EulerSum(const EulerSum&) = delete;
  EulerSum& operator=(const EulerSum&) = delete;

  void add(std::uint32_t component, int count) {
    if (component != component_) hand_over();
    component_ = component;
    sum_ += count;
  }

 private:
  void hand_over() {
    if (sum_ != 0) std::atomic_ref<int>(components_[component_].euler).fetch_add(sum_, std::memory_order_relaxed);
    sum_ = 0;
  }

  std::vector<Component>& components_;
  std::uint32_t component_ = 0;
  int sum_ = 0;
};

class ComponentFinder {
 public:
  explicit ComponentFinder(Surface& surface)
      : s_(surface), first_border_(std::make_unique_for_overwrite<std::atomic<std::uint32_t>[]>(s_.vertices.size())) {}

  bool run() {
    for_each_part(s_.vertices.size(), [&](const auto& range) {
      for (std::size_t v = range.begin(); v != range.end(); ++v)
        first_border_[v].store(kNone, std::memory_order_relaxed);
    });
    const bool closed = join_faces();
    count_borders();
    return closed;
  }

 private:
  bool join_faces() {
    SharedUnionFind joined(s_.faces.size());
    std::atomic<bool> closed = true;
    for_each_part(s_.borders.size(), [&](const auto& range) {
      for (std::size_t b = range.begin(); b != range.end(); ++b) {
        const Border& border = s_.borders[b];
        if (border.face[0] != kNone) claim_vertices(border, static_cast<std::uint32_t>(b));
        if (border.face[0] != kNone && border.face[1] != kNone)
          joined.unite(border.face[0], border.face[1]);
        else
          closed.store(false, std::memory_order_relaxed);
      }
    });
    number_components(joined);
    return closed;
  }

  // A set is named by its smallest face, so the names in rising order are the components in the order of first faces.
  void number_components(SharedUnionFind& joined) {
    const RowNumbers<std::uint32_t> numbers(s_.faces.size(), 0,
                                            [&](std::size_t f) { return joined.find(index(f)) == f ? 1u : 0u; });
    s_.components.resize(numbers.past());
    for (Component& component : s_.components) component.euler = 0;
    numbers.for_each([&](std::size_t f, std::uint32_t& next) {
      if (joined.find(index(f)) == f) s_.faces[f].component = next++;
    });
    for_each_part(s_.faces.size(), [&](const auto& range) {
      EulerSum euler(s_.components);
      for (std::size_t f = range.begin(); f != range.end(); ++f) {
        Face& face = s_.faces[f];
        if (const std::uint32_t root = joined.find(index(f)); root != f) face.component = s_.faces[root].component;
        euler.add(face.component, 2 - static_cast<int>(face.loop_count));
      }
    });
  }

  // Vertices - borders with ends + sum over faces of (2 - loops); whole circles count nothing.
  void count_borders() {
    for_each_part(s_.borders.size(), [&](const auto& range) {
      EulerSum euler(s_.components);
      for (std::size_t b = range.begin(); b != range.end(); ++b) {
        const Border& border = s_.borders[b];
        if (border.vertex[0] == kNone || border.face[0] == kNone) continue;
        const int vertices =
            claims(border.vertex[0], b) + (border.vertex[1] != border.vertex[0] ? claims(border.vertex[1], b) : 0);
        euler.add(s_.faces[border.face[0]].component, vertices - 1);
      }
    });
  }

  // Each vertex is counted once: with the first border that has it.
  void claim_vertices(const Border& border, std::uint32_t b) {
    if (border.vertex[0] == kNone) return;
    for (const std::uint32_t v : border.vertex) {
      std::uint32_t first = first_border_[v].load(std::memory_order_relaxed);
      while (b < first && !first_border_[v].compare_exchange_weak(first, b, std::memory_order_relaxed)) {
      }
    }
  }

  int claims(std::uint32_t vertex, std::size_t b) const {
    return first_border_[vertex].load(std::memory_order_relaxed) == b ? 1 : 0;
  }

  static std::uint32_t index(std::size_t n) { return static_cast<std::uint32_t>(n); }

  Surface& s_;
  std::unique_ptr<std::atomic<std::uint32_t>[]> first_border_;  // of each vertex
};

}  // namespace

bool connect_components(Surface& surface) { return ComponentFinder(surface).run(); }

}  // namespace meniscus
