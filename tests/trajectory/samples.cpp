// SPDX-License-Identifier: BSD-3-Clause
// Writes the formats by their descriptions, without the readers under test.
#include "tests/trajectory/samples.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "tests/trajectory/byte_writer.h"

namespace meniscus::test {
namespace {

constexpr std::endian kBig = std::endian::big;

/// Writes bits from the highest of each byte to the lowest.
class BitWriter {
 public:
  void put(std::uint64_t number, int count) {
    for (int bit = count - 1; bit >= 0; --bit) {
      if (used_ % 8 == 0) bytes_.push_back(0);
      bytes_.back() = static_cast<char>(bytes_.back() | ((number >> bit & 1) << (7 - used_ % 8)));
      ++used_;
    }
  }

  /// Writes three numbers as one of `count` bits: whole bytes, lowest first, then the remaining bits.
  void put_joint(const std::array<std::uint64_t, 3>& numbers, const std::array<std::uint64_t, 3>& sizes, int count) {
    std::uint64_t joint = (numbers[0] * sizes[1] + numbers[1]) * sizes[2] + numbers[2];
    for (; count > 8; count -= 8, joint >>= 8) put(joint & 0xff, 8);
    put(joint, count);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t used_ = 0;
};

constexpr std::uint64_t kSmallSize = 101;  // size of class 20

}  // namespace

float coordinate(std::uint32_t frame, std::uint32_t atom, int axis) {
  return static_cast<float>(frame) + 0.125F * static_cast<float>(atom) - 10.0F * static_cast<float>(axis);
}

std::string dcd(const DcdSample& sample) {
  ByteWriter file(sample.order);
  const auto record = [&](const std::function<void(ByteWriter&)>& fill) {
    ByteWriter content(sample.order);
    fill(content);
    const auto length = static_cast<std::uint32_t>(content.bytes().size());
    const auto marker = [&] { sample.marker == 4 ? file.put(length) : file.put(std::uint64_t{length}); };
    marker();
    file.put_text(content.bytes());
    marker();
  };
  record([&](ByteWriter& header) {
    std::int32_t numbers[20] = {sample.promised, 100, 10};
    numbers[8] = sample.free.empty() ? 0 : static_cast<std::int32_t>(sample.atoms - sample.free.size());
    numbers[10] = !sample.cell.empty();
    numbers[11] = sample.fourth_axis;
    numbers[19] = sample.version;
    header.put_text("CORD");
    for (int n = 0; n < 20; ++n) {
      if (n == 9 && sample.version == 0) {
        header.put(sample.time_step);
        ++n;
      } else if (n == 9) {
        header.put(static_cast<float>(sample.time_step));
      } else {
        header.put(numbers[n]);
      }
    }
  });
  record([](ByteWriter& titles) { titles.put(std::int32_t{1}).put_text(std::string(80, ' ')); });
  record([&](ByteWriter& count) { count.put(sample.atoms); });
  if (!sample.free.empty()) {
    record([&](ByteWriter& list) {
      for (const std::int32_t atom : sample.free) list.put(atom);
    });
  }
  for (std::uint32_t frame = 0; frame < sample.frames; ++frame) {
    if (!sample.cell.empty()) {
      record([&](ByteWriter& cell) {
        for (const double number : sample.cell) cell.put(number);
      });
    }
    for (int axis = 0; axis < (sample.fourth_axis ? 4 : 3); ++axis) {
      record([&](ByteWriter& values) {
        for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
          const bool moves = std::find(sample.free.begin(), sample.free.end(), atom + 1) != sample.free.end();
          if (frame == 0 || sample.free.empty() || moves) values.put(coordinate(frame, atom, axis));
        }
      });
    }
  }
  return file.bytes();
}

std::int32_t xtc_step(const XtcSample& sample, std::uint32_t frame, std::uint32_t atom, int axis) {
  const std::uint32_t first = atom / 3 * 3;
  const std::uint32_t mixed = (first * 7 + frame * 3 + static_cast<std::uint32_t>(axis) + 1) * 2654435761U;
  const auto place = static_cast<std::int32_t>(mixed % static_cast<std::uint32_t>(2 * sample.spread));
  return place - sample.spread + static_cast<std::int32_t>(atom % 3) * (axis == 1 ? -9 : 17);
}

namespace {

std::string packed(const XtcSample& sample, std::uint32_t frame, const std::array<std::int32_t, 3>& low,
                   const std::array<std::uint64_t, 3>& sizes) {
  BitWriter bits;
  const bool apart = *std::max_element(sizes.begin(), sizes.end()) > 0xffffff;
  const auto step = [&](std::uint32_t atom, int axis) { return xtc_step(sample, frame, atom, axis); };
  const auto put_near = [&](std::uint32_t atom, std::uint32_t before) {
    std::array<std::uint64_t, 3> numbers;
    for (int axis = 0; axis < 3; ++axis)
      numbers[static_cast<std::size_t>(axis)] =
          static_cast<std::uint64_t>(step(atom, axis) - step(before, axis) + static_cast<std::int32_t>(kSmallSize / 2));
    bits.put_joint(numbers, {kSmallSize, kSmallSize, kSmallSize}, 20);
  };
  for (std::uint32_t atom = 0; atom < sample.atoms; atom += 3) {
    // The second of three is in full, the first a difference to it, the third a difference to the first.
    std::array<std::uint64_t, 3> numbers;
    for (std::size_t axis = 0; axis < 3; ++axis)
      numbers[axis] = static_cast<std::uint64_t>(std::int64_t{step(atom + 1, static_cast<int>(axis))} - low[axis]);
    if (apart) {
      for (std::size_t axis = 0; axis < 3; ++axis) bits.put(numbers[axis], std::bit_width(sizes[axis]));
    } else {
      bits.put_joint(numbers, sizes, std::bit_width(sizes[0] * sizes[1] * sizes[2]));
    }
    // The length of the run is written once and stays.
    bits.put(atom == 0 ? 1 : 0, 1);
    if (atom == 0) bits.put(2 * 3 + 1, 5);
    put_near(atom, atom + 1);
    put_near(atom + 2, atom);
  }
  return bits.bytes();
}

void put_packed(ByteWriter& file, const XtcSample& sample, std::uint32_t frame) {
  std::array<std::int32_t, 3> low, high;
  std::array<std::uint64_t, 3> sizes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = high[axis] = xtc_step(sample, frame, 0, static_cast<int>(axis));
    for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
      low[axis] = std::min(low[axis], xtc_step(sample, frame, atom, static_cast<int>(axis)));
      high[axis] = std::max(high[axis], xtc_step(sample, frame, atom, static_cast<int>(axis)));
    }
    sizes[axis] = static_cast<std::uint64_t>(high[axis] - low[axis]) + 1;
  }
  file.put(sample.precision);
  for (const std::int32_t number : low) file.put(number);
  for (const std::int32_t number : high) file.put(number);
  file.put(sample.small_class);
  std::string bits = packed(sample, frame, low, sizes);
  sample.magic == 2023 ? file.put(std::uint64_t{bits.size()}) : file.put(static_cast<std::uint32_t>(bits.size()));
  bits.resize((bits.size() + 3) / 4 * 4);
  file.put_text(bits);
}

}  // namespace

std::string xtc(const XtcSample& sample) {
  ByteWriter file(kBig);
  for (std::uint32_t frame = 0; frame < sample.frames; ++frame) {
    file.put(sample.magic).put(sample.atoms).put(10 * frame).put(0.5F * static_cast<float>(frame));
    for (const float number : {3.0F, 0.0F, 0.0F, 0.5F, 4.0F, 0.0F, -1.0F, 0.25F, 5.0F}) file.put(number);
    file.put(sample.atoms);
    if (sample.atoms > 9) {
      put_packed(file, sample, frame);
      continue;
    }
    for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
      for (int axis = 0; axis < 3; ++axis)
        file.put(static_cast<float>(xtc_step(sample, frame, atom, axis)) / sample.precision);
    }
  }
  return file.bytes();
}

std::string trr(const TrrSample& sample) {
  ByteWriter file(kBig);
  const auto put_real = [&](double number) {
    sample.doubles ? file.put(number) : file.put(static_cast<float>(number));
  };
  const std::uint32_t width = sample.doubles ? 8 : 4, vectors = 3 * sample.atoms * width;
  for (std::uint32_t frame = 0; frame < sample.frames; ++frame) {
    const bool positions = frame != sample.without_positions;
    file.put(std::int32_t{1993}).put(std::int32_t{13}).put(std::int32_t{12}).put_text("GMX_trn_file");
    const std::uint32_t sizes[10] = {0, 0, 9 * width, 9 * width, 0, 0, 0, positions ? vectors : 0, vectors, 0};
    for (const std::uint32_t size : sizes) file.put(size);
    file.put(sample.atoms).put(10 * frame).put(std::int32_t{0});
    put_real(0.5 * frame);
    put_real(0.0);
    for (const double number : {3.0, 0.0, 0.0, 0.5, 4.0, 0.0, -1.0, 0.25, 5.0}) put_real(number);
    for (int n = 0; n < 9; ++n) put_real(77.0);  // the virial
    for (const bool velocities : {false, true}) {
      for (std::uint32_t n = 0; (positions || velocities) && n < 3 * sample.atoms; ++n)
        put_real(velocities ? 99.0 : double{coordinate(frame, n / 3, static_cast<int>(n % 3))});
    }
  }
  return file.bytes();
}

namespace {

/// The header of an Amber trajectory, whose variables lie one behind the other in each record.
class AmberHeader {
 public:
  explicit AmberHeader(const AmberSample& sample) : sample_(sample), file_(kBig) {}

  std::string run() {
    const std::string empty = write(0);
    file_ = ByteWriter(kBig);
    return write(empty.size());
  }

 private:
  void put_count(std::uint64_t number) {
    sample_.version == 5 ? file_.put(number) : file_.put(static_cast<std::uint32_t>(number));
  }

  void put_name(const std::string& name) {
    put_count(name.size());
    file_.put_text(name).put_text(std::string((4 - name.size() % 4) % 4, '\0'));
  }

  void put_variable(const std::string& name, const std::vector<std::uint32_t>& dimensions, std::uint64_t bytes,
                    std::uint64_t begin) {
    put_name(name);
    put_count(dimensions.size());
    for (const std::uint32_t dimension : dimensions) put_count(dimension);
    file_.put(std::uint32_t{0});
    put_count(0);
    file_.put(std::uint32_t{5});
    put_count(bytes);
    sample_.version == 1 ? file_.put(static_cast<std::uint32_t>(begin)) : file_.put(begin);
  }

  std::string write(std::uint64_t data) {
    file_.put_text("CDF").put(sample_.version);
    put_count(sample_.frames);
    file_.put(std::uint32_t{10});
    put_count(3);
    const std::pair<const char*, std::uint32_t> dimensions[] = {{"frame", 0}, {"atom", sample_.atoms}, {"spatial", 3}};
    for (const auto& [name, length] : dimensions) {
      put_name(name);
      put_count(length);
    }
    file_.put(std::uint32_t{12});
    put_count(1);
    put_name("Conventions");
    file_.put(std::uint32_t{2});
    put_name("AMBER");
    file_.put(std::uint32_t{11});
    put_count(4);
    put_variable("time", {0}, 4, data);
    put_variable("coordinates", {0, 1, 2}, 12 * sample_.atoms, data + 4);
    put_variable("cell_lengths", {0, 2}, 12, data + 4 + 12 * sample_.atoms);
    put_variable("cell_angles", {0, 2}, 12, data + 16 + 12 * sample_.atoms);
    return file_.bytes();
  }

  const AmberSample& sample_;
  ByteWriter file_;
};

}  // namespace

std::string amber_netcdf(const AmberSample& sample) {
  ByteWriter records(kBig);
  for (std::uint32_t frame = 0; frame < sample.frames; ++frame) {
    records.put(0.5F + static_cast<float>(frame));
    for (std::uint32_t n = 0; n < 3 * sample.atoms; ++n) records.put(coordinate(frame, n / 3, static_cast<int>(n % 3)));
    for (const float number : {10.0F, 20.0F, 30.0F, 90.0F, 90.0F, 90.0F}) records.put(number);
  }
  return AmberHeader(sample).run() + records.bytes();
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace meniscus::test
