// SPDX-License-Identifier: BSD-3-Clause
// Opens the interface in frame after frame, in the same way.
#include "core/scene/shown_frames.h"

#include <algorithm>
#include <exception>

#include "core/base/error.h"

namespace meniscus {
namespace {

/// Does `work`, unless the frame is at fault; the code that makes the frame reports that.
template <typename Work>
std::exception_ptr fault_of_frame(const Work& work) {
  try {
    work();
  } catch (const InputError&) {
    return std::current_exception();
  } catch (const OpenSurfaceError&) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace

void ShownFrames::open(std::uint64_t place, Structure& structure, SurfaceComputer& computer) {
  pages_.resize(frames_.numbers().size());
  std::optional<OpenPages>& pages = pages_[place];
  if (pages) return open_book(structure, interface_groups(structure, *molecule_.interface), *pages);
  const Burial burial = burial_of(molecule_, structure, computer);
  most_buried_ = std::max(most_buried_, std::ranges::max(burial.areas));
  pages = open_pages(structure, burial.groups, burial.areas);
  open_book(structure, burial.groups, *pages);
}

void ShownFrames::find_first() {
  if (first_shown_) return;
  SurfaceComputer computer(molecule_.surface);
  std::exception_ptr first_fault;
  for (std::uint64_t place = 0; place < frames_.numbers().size(); ++place) {
    const std::exception_ptr fault = fault_of_frame([&] {
      first_ = frames_.at(frames_.numbers()[place]);
      Structure shown = *first_;
      open(place, shown, computer);
      first_shown_ = std::move(shown);
    });
    if (!fault) return;
    if (!first_fault) first_fault = fault;
  }
  std::rethrow_exception(first_fault);
}

const Structure& ShownFrames::first() {
  if (!molecule_.interface) return frames_.structure();
  find_first();
  return *first_;
}

const Structure& ShownFrames::first_shown() {
  if (!molecule_.interface) return frames_.structure();
  find_first();
  return *first_shown_;
}

void ShownFrames::survey(const Look& look) {
  if (!molecule_.interface)
    return frames_.survey([&](std::uint64_t place, const Structure& read) { look(place, read, read); });
  SurfaceComputer computer(molecule_.surface);
  frames_.survey([&](std::uint64_t place, const Structure& read) {
    Structure shown = read;
    if (!fault_of_frame([&] { open(place, shown, computer); })) look(place, read, shown);
  });
}

double ShownFrames::most_buried() {
  if (molecule_.interface) {
    survey([](std::uint64_t, const Structure&, const Structure&) {});
    return most_buried_;
  }
  SurfaceComputer computer(molecule_.surface);
  frames_.survey([&](std::uint64_t, const Structure& structure) {
    fault_of_frame([&] {
      most_buried_ = std::max(most_buried_, std::ranges::max(burial_of(molecule_, structure, computer).areas));
    });
  });
  return most_buried_;
}

}  // namespace meniscus
