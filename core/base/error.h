// SPDX-License-Identifier: BSD-3-Clause
// The errors that the library throws. The program turns each kind into one line and one exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace meniscus {

/// The base class of all errors that a user can meet. Bugs of Meniscus itself are found by asserts instead. Errors take
/// their text as it is, or format it by fmt::format() if values follow it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  template <typename First, typename... Values>
  Error(fmt::format_string<First, Values...> text, First&& first, Values&&... values)
      : std::runtime_error(fmt::format(text, std::forward<First>(first), std::forward<Values>(values)...)) {}
};

/// Input that cannot be read or is not valid. The text is "file:line: what is wrong, the value, what to do"; line 0
/// means the whole file.
class InputError : public Error {
 public:
  InputError(const std::string& file, std::size_t line, const std::string& what)
      : Error((line ? file + ':' + std::to_string(line) : file) + ": " + what) {}
  template <typename First, typename... Values>
  InputError(const std::string& file, std::size_t line, fmt::format_string<First, Values...> text, First&& first,
             Values&&... values)
      : InputError(file, line, fmt::format(text, std::forward<First>(first), std::forward<Values>(values)...)) {}
};

/// A selection that cannot be understood. what() is a sentence, a line with the expression and a line with a caret
/// under the place. It may be printed as it is.
class SelectionError : public Error {
 public:
  SelectionError(const std::string& sentence, const std::string& picture)
      : Error(sentence + '\n' + picture), sentence_(sentence), picture_(picture) {}
  const std::string& sentence() const { return sentence_; }
  const std::string& picture() const { return picture_; }  ///< the two lines after the sentence, joined by a line end

 private:
  std::string sentence_, picture_;
};

/// A request that cannot be fulfilled, such as options that exclude each other, or a picture too small for its legend.
class RequestError : public Error {
 public:
  using Error::Error;
};

/// No GPU or GL can be used, or the driver refused a call.
class GpuError : public Error {
 public:
  using Error::Error;
};

/// A limit of the machine or of a file format was reached.
class CapacityError : public Error {
 public:
  using Error::Error;
};

/// An output cannot be written, or it exists and must not be replaced.
class OutputError : public Error {
 public:
  OutputError(const std::string& path, const std::string& what) : Error(path + ": " + what) {}
  template <typename First, typename... Values>
  OutputError(const std::string& path, fmt::format_string<First, Values...> text, First&& first, Values&&... values)
      : OutputError(path, fmt::format(text, std::forward<First>(first), std::forward<Values>(values)...)) {}
};

/// The surface cannot be closed, so that there is no surface. The message names the atoms.
class OpenSurfaceError : public Error {
 public:
  using Error::Error;
};

}  // namespace meniscus
