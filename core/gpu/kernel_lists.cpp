// SPDX-License-Identifier: BSD-3-Clause
// Counts, grows and sums the lists that kernels write.
#include "core/gpu/kernel_lists.h"

#include <cassert>

#include "core/gpu/context_description.h"
#include "core/gpu/kernel_records.h"

namespace meniscus {

void AppendList::make_room() {
  const std::size_t bytes = header_bytes_ + capacity_ * record_bytes_;
  if (count_ > 0 && bytes > buffer.byte_count())
    buffer.grow(bytes);
  else
    buffer.resize(bytes);
}

bool AppendList::fits(std::uint32_t counted) {
  if (counted <= capacity_) return true;
  capacity_ = counted + counted / 4;
  return false;
}

void AppendList::append_bytes(std::span<const std::byte> bytes, std::uint32_t count) {
  const std::size_t place = header_bytes_ + count_ * record_bytes_;
  if (count_ + count > capacity_) {
    capacity_ = count_ + count + (count_ + count) / 4;
    make_room();
  }
  buffer.write(place, bytes.data(), bytes.size());
  count_ += count;
}

void append_all(std::initializer_list<AppendList*> lists, Buffer& counters, std::span<std::uint32_t> counted,
                const std::function<void()>& run) {
  assert(lists.size() <= counted.size());
  for (bool all_fit = false; !all_fit;) {
    std::ranges::fill(counted, 0u);
    std::ranges::transform(lists, counted.begin(), [](const AppendList* list) { return list->count(); });
    for (AppendList* list : lists) list->make_room();
    if (counters.byte_count() < counted.size_bytes()) counters.resize(counted.size_bytes());
    counters.write(0, counted.data(), counted.size_bytes());
    run();
    counters.read(0, counted.data(), counted.size_bytes());
    all_fit = true;
    auto count = counted.begin();
    for (AppendList* list : lists) all_fit &= list->fits(*count++);
  }
  // Counts are set only when all lists fit, so that records of a list are not appended twice.
  auto count = counted.begin();
  for (AppendList* list : lists) list->set_count(*count++);
}

void append_later(std::initializer_list<AppendList*> lists, Buffer& counters, std::span<std::uint32_t> counted,
                  const std::function<void()>& run) {
  std::ranges::fill(counted, 0u);
  for (AppendList* list : lists) {
    list->clear();
    list->leave_open();
    list->make_room();
  }
  if (counters.byte_count() < counted.size_bytes()) counters.resize(counted.size_bytes());
  counters.write(0, counted.data(), counted.size_bytes());
  run();
}

bool take_list_counts(std::initializer_list<AppendList*> lists, std::span<const std::uint32_t> counted) {
  assert(lists.size() <= counted.size());
  bool all_fit = true;
  auto count = counted.begin();
  for (AppendList* list : lists) {
    if (list->fits(*count))
      list->set_count(*count);
    else
      list->clear(), all_fit = false;
    ++count;
  }
  return all_fit;
}

void PrefixSum::operator()(const Buffer& words, std::uint32_t count, std::uint32_t limit) {
  if (!kind_) kind_ = describe_current_context().software ? ScanKind::serial : ScanKind::parallel;
  const bool serial = kind_ == ScanKind::serial;
  const char* const path = serial ? "gpu_shaders/parallel/scan.comp" : "gpu_shaders/parallel/block_scan.comp";
  const std::uint32_t chunk_length = serial ? 512 : 1024;  // words per invocation, or per group of 256
  const std::uint32_t chunks = (count + chunk_length - 1) / chunk_length;
  totals_.resize(std::max(1u, chunks) * sizeof(std::uint32_t));
  for (int pass = 0; pass < 3; ++pass) {
    words.bind(0);
    totals_.bind(1);
    const Program& program = programs_.get(path, {{"PASS", std::to_string(pass)}});
    program.set(kernel::ScanParameters{.count = count, .chunk_length = chunk_length, .limit = limit});
    program.dispatch(pass == 1 ? 1 : serial ? group_count(chunks) : chunks);
  }
}

}  // namespace meniscus
