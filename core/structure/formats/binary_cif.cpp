// SPDX-License-Identifier: BSD-3-Clause
// Decodes the columns of BinaryCIF by its specification (github.com/molstar/BinaryCIF), for the reader of mmCIF.
#include "core/structure/formats/cif_document.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <variant>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

using nlohmann::json;

/// The categories that the reader of mmCIF needs.
constexpr std::string_view kCategories =
    " _atom_site _chem_comp_atom _chem_comp_bond _exptl _ma_qa_metric _ma_qa_metric_local _entity _entity_poly "
    "_struct_conf _struct_sheet_range _pdbx_struct_assembly _pdbx_struct_oper_list _pdbx_struct_assembly_gen ";

/// Limits of the unpacked size. Molecules have at most four values and forty letters per byte of their file.
constexpr std::size_t kMostValuesPerByte = 64, kMostLettersPerByte = 256;

/// Detects data that is nested too deep, because nlohmann's parser calls itself for each level.
class DepthGuard final : public nlohmann::json_sax<json> {
 public:
  bool too_deep = false;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(json::number_integer_t) override { return true; }
  bool number_unsigned(json::number_unsigned_t) override { return true; }
  bool number_float(json::number_float_t, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool key(std::string&) override { return true; }
  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  bool enter() { return !(too_deep = ++depth_ > kDeepestJson); }
  bool leave() { return --depth_ >= 0; }

  int depth_ = 0;
};

using Integers = std::vector<std::int64_t>;
using Numbers = std::variant<Integers, std::vector<float>, std::vector<double>>;
using Bytes = std::vector<std::uint8_t>;

/// An error in one column. The name of the file is put before it.
struct BadColumn {
  std::string what;
};

template <typename... Arguments>
[[noreturn]] void refuse(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
  throw BadColumn{fmt::format(words, std::forward<Arguments>(arguments)...)};
}

/// Returns the sum of two integers. It wraps, because sums in a hostile file may overflow.
std::int64_t sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

template <typename Stored, typename Value>
std::vector<Value> from_little_endian(const Bytes& bytes) {
  if (bytes.size() % sizeof(Stored) != 0) refuse("has {} bytes for numbers of {}", bytes.size(), sizeof(Stored));
  std::vector<Value> values;
  values.reserve(bytes.size() / sizeof(Stored));
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Stored)) {
    std::array<std::uint8_t, sizeof(Stored)> raw;
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), sizeof(Stored), raw.begin());
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    values.push_back(static_cast<Value>(std::bit_cast<Stored>(raw)));
  }
  return values;
}

Numbers numbers_of_bytes(const Bytes& bytes, int type) {
  switch (type) {
    case 1:
      return from_little_endian<std::int8_t, std::int64_t>(bytes);
    case 2:
      return from_little_endian<std::int16_t, std::int64_t>(bytes);
    case 3:
      return from_little_endian<std::int32_t, std::int64_t>(bytes);
    case 4:
      return from_little_endian<std::uint8_t, std::int64_t>(bytes);
    case 5:
      return from_little_endian<std::uint16_t, std::int64_t>(bytes);
    case 6:
      return from_little_endian<std::uint32_t, std::int64_t>(bytes);
    case 32:
      return from_little_endian<float, float>(bytes);
    case 33:
      return from_little_endian<double, double>(bytes);
    default:
      refuse("has numbers of type {}, which BinaryCIF does not know", type);
  }
}

Integers& integers_of(Numbers& numbers, std::string_view encoding) {
  if (Integers* integers = std::get_if<Integers>(&numbers)) return *integers;
  refuse("has {} of numbers that are not whole", encoding);
}

/// Decodes IntegerPacking. Values are sums that end with the first part that is not the limit of its bytes: 127, 127, 3
/// is 257.
Integers unpacked(const Integers& packed, const json& encoding) {
  const auto width = encoding.at("byteCount").get<int>();
  if (width != 1 && width != 2) refuse("is packed in {} bytes, not in 1 or 2", width);
  const bool is_unsigned = encoding.at("isUnsigned").get<bool>();
  const std::int64_t most = (std::int64_t{1} << (8 * width - (is_unsigned ? 0 : 1))) - 1,
                     least = is_unsigned ? std::numeric_limits<std::int64_t>::min() : -most - 1;
  Integers values;
  std::int64_t value = 0;
  for (const std::int64_t part : packed) {
    value = sum(value, part);
    if (part == most || part == least) continue;
    values.push_back(value);
    value = 0;
  }
  return values;
}

/// Decodes RunLength: pairs of a value and the number of its repetitions. most: greatest number of values.
Integers repeated(const Integers& pairs, std::size_t most) {
  Integers values;
  for (std::size_t n = 0; n + 1 < pairs.size(); n += 2) {
    const std::int64_t count = pairs[n + 1];
    if (count < 0 || static_cast<std::uint64_t>(count) > most - values.size())
      refuse("repeats a value {} times, more than the bytes of the file", count);
    values.insert(values.end(), static_cast<std::size_t>(count), pairs[n]);
  }
  return values;
}

template <typename Function>
std::vector<double> doubles_of(const Integers& integers, Function&& value_of) {
  std::vector<double> values;
  values.reserve(integers.size());
  for (const std::int64_t n : integers) values.push_back(value_of(static_cast<double>(n)));
  return values;
}

/// Decodes the bytes of a column. most: greatest number of values after any step.
Numbers decoded(const Bytes& bytes, const json& encodings, std::size_t most) {
  Numbers numbers;
  bool begun = false;
  for (auto encoding = encodings.rbegin(); encoding != encodings.rend(); ++encoding) {
    const auto& kind = encoding->at("kind").get_ref<const std::string&>();
    if ((kind == "ByteArray") == begun) refuse("has its encodings in an order that is not possible");
    if (!begun) {
      numbers = numbers_of_bytes(bytes, encoding->at("type").get<int>());
      begun = true;
      continue;
    }
    Integers& integers = integers_of(numbers, kind);
    if (kind == "IntegerPacking") {
      numbers = unpacked(integers, *encoding);
    } else if (kind == "RunLength") {
      numbers = repeated(integers, most);
    } else if (kind == "Delta") {
      std::int64_t value = encoding->at("origin").get<std::int64_t>();
      for (std::int64_t& n : integers) n = value = sum(value, n);
    } else if (kind == "FixedPoint") {
      const double factor = encoding->at("factor").get<double>();
      numbers = doubles_of(integers, [=](double n) { return n / factor; });
    } else if (kind == "IntervalQuantization") {
      const double least = encoding->at("min").get<double>(), largest = encoding->at("max").get<double>(),
                   steps = encoding->at("numSteps").get<double>();
      numbers = doubles_of(integers, [=](double n) { return least + n * (largest - least) / (steps - 1.0); });
    } else {
      refuse("is encoded by {}, which this version does not read", in_quotes(kind));
    }
  }
  return numbers;
}

const Bytes& bytes_of(const json& value) { return value.get_binary(); }

class Decoder {
 public:
  explicit Decoder(const TextFile& file) : file_(file) {}

  gemmi::cif::Document run() {
    gemmi::cif::Document document;
    const json tree = parse();
    for (const json& block : tree.at("dataBlocks")) {
      document.blocks.emplace_back(block.value("header", std::string()));
      std::set<std::string> seen;
      for (const json& category : block.at("categories")) {
        const auto& name = category.at("name").get_ref<const std::string&>();
        if (kCategories.find(' ' + name + ' ') == std::string_view::npos || !seen.insert(name).second) continue;
        read_category(category, name, document.blocks.back());
      }
    }
    return document;
  }

 private:
  json parse() const {
    DepthGuard guard;
    json::sax_parse(file_.text, &guard, json::input_format_t::msgpack);
    if (guard.too_deep) throw InputError(file_.path, 0, "is not a readable BinaryCIF file: it is nested too deep");
    return json::from_msgpack(file_.text);
  }

  void read_category(const json& category, const std::string& name, gemmi::cif::Block& block) {
    const auto rows = category.at("rowCount").get<std::size_t>();
    const json& columns = category.at("columns");
    if (rows == 0 || columns.empty()) return;
    values_ += rows < file_.text.size() ? rows * columns.size() : file_.text.size() * kMostValuesPerByte;
    if (rows > file_.text.size() || values_ > kMostValuesPerByte * file_.text.size())
      throw InputError(file_.path, 0, "{} has {} rows, more than its {} bytes hold of a molecule; is it damaged?", name,
                       with_thousands(rows), with_thousands(file_.text.size()));
    std::vector<std::string> tags;
    std::vector<std::vector<std::string>> texts;
    for (const json& column : columns) {
      std::string tag = column.at("name").get<std::string>();
      try {
        texts.push_back(read_column(column, rows));
      } catch (const BadColumn& bad) {
        throw InputError(file_.path, 0, "column {} {}; write the file again", escaped(name + '.' + tag), bad.what);
      }
      tags.push_back(std::move(tag));
    }
    std::vector<std::string>& values = block.init_loop(name + '.', std::move(tags)).values;
    values.reserve(rows * texts.size());
    for (std::size_t row = 0; row < rows; ++row)
      for (std::vector<std::string>& text : texts) values.push_back(std::move(text[row]));
  }

  std::vector<std::string> read_column(const json& column, std::size_t rows) {
    const json& data = column.at("data");
    const json& encodings = data.at("encoding");
    const Bytes& bytes = bytes_of(data.at("data"));
    if (encodings.empty()) refuse("has no encoding");
    std::vector<std::string> texts = encodings.front().at("kind") == "StringArray"
                                         ? read_strings(bytes, encodings.front(), rows)
                                         : texts_of(decoded(bytes, encodings, rows));
    if (texts.size() != rows) refuse("has {} values in {} rows", with_thousands(texts.size()), with_thousands(rows));
    const auto mask = column.find("mask");
    if (mask == column.end() || mask->is_null()) return texts;
    Numbers decoded_mask = decoded(bytes_of(mask->at("data")), mask->at("encoding"), rows);
    const Integers& masked = integers_of(decoded_mask, "a mask");
    if (masked.size() != rows)
      refuse("has a mask for {} of {} rows", with_thousands(masked.size()), with_thousands(rows));
    for (std::size_t row = 0; row < rows; ++row)
      if (masked[row] != 0) texts[row] = masked[row] == 1 ? "." : "?";
    return texts;
  }

  static std::vector<std::string> texts_of(const Numbers& numbers) {
    std::vector<std::string> texts;
    std::visit(
        [&](const auto& values) {
          texts.reserve(values.size());
          for (const auto value : values) texts.push_back(fmt::format("{}", value));
        },
        numbers);
    return texts;
  }

  /// Decodes a column of texts. It consists of places in a list of distinct texts, which are joined into one text. A
  /// place below 0 means that there is no text.
  std::vector<std::string> read_strings(const Bytes& bytes, const json& encoding, std::size_t rows) {
    Numbers decoded_places = decoded(bytes, encoding.at("dataEncoding"), rows);
    const Integers& places = integers_of(decoded_places, "places");
    const auto& all = encoding.at("stringData").get_ref<const std::string&>();
    Numbers decoded_offsets =
        decoded(bytes_of(encoding.at("offsets")), encoding.at("offsetEncoding"), file_.text.size());
    const Integers& offsets = integers_of(decoded_offsets, "offsets");
    std::vector<std::string> distinct;
    for (std::size_t n = 0; n + 1 < offsets.size(); ++n) {
      const std::int64_t begin = offsets[n], end = offsets[n + 1];
      if (begin < 0 || end < begin || static_cast<std::uint64_t>(end) > all.size())
        refuse("has a text from letter {} to {} of {}", begin, end, all.size());
      distinct.push_back(
          gemmi::cif::quote(all.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin))));
    }
    std::vector<std::string> texts;
    texts.reserve(places.size());
    for (const std::int64_t place : places) {
      if (place >= static_cast<std::int64_t>(distinct.size())) refuse("names text {} of {}", place, distinct.size());
      texts.push_back(place < 0 ? std::string("?") : distinct[static_cast<std::size_t>(place)]);
      letters_ += texts.back().size();
      if (letters_ > kMostLettersPerByte * file_.text.size()) refuse("unpacks to far more letters than a molecule has");
    }
    return texts;
  }

  const TextFile& file_;
  std::size_t values_ = 0, letters_ = 0;  ///< totals of all tables
};

}  // namespace

gemmi::cif::Document read_binary_cif(const TextFile& file) {
  try {
    return Decoder(file).run();
  } catch (const json::exception& error) {
    // The text of the exception is "[json.exception.parse_error.110] parse error at byte 7: ...".
    std::string what = error.what();
    what.erase(0, what.starts_with('[') ? std::min(what.size(), what.find("] ") + 2) : 0);
    throw InputError(file.path, 0, "is not a readable BinaryCIF file: {}; is it cut short?", escaped(what));
  }
}

}  // namespace meniscus
