// SPDX-License-Identifier: BSD-3-Clause
// The errors the library throws; the program turns each kind into one line and one exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace meniscus {

/// Base of every error a user can meet. Broken invariants of our own are asserts instead.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Input that cannot be read or is not valid: "file:line: what, value, what to do". Line 0: the file as a whole.
class InputError : public Error {
 public:
  InputError(const std::string& file, std::size_t line, const std::string& what)
      : Error((line ? file + ':' + std::to_string(line) : file) + ": " + what) {}
};

/// A selection that cannot be understood. what(): a sentence, a line with the expression, a line with a caret under the
/// place; it may be printed as it is.
class SelectionError : public Error {
 public:
  SelectionError(const std::string& sentence, const std::string& picture)
      : Error(sentence + '\n' + picture), sentence_(sentence), picture_(picture) {}
  const std::string& sentence() const { return sentence_; }
  const std::string& picture() const { return picture_; }  ///< both lines, with a line end between

 private:
  std::string sentence_, picture_;
};

/// A request that cannot be met: options that exclude each other, a picture too small for its legend.
class RequestError : public Error {
 public:
  using Error::Error;
};

/// No usable GPU or GL, or the driver refused something.
class GpuError : public Error {
 public:
  using Error::Error;
};

/// A limit of the machine or the format was reached.
class CapacityError : public Error {
 public:
  using Error::Error;
};

/// An output cannot be written, or exists and may not be replaced.
class OutputError : public Error {
 public:
  OutputError(const std::string& path, const std::string& what) : Error(path + ": " + what) {}
};

/// The surface is not closed, so there is no surface; the message names the atoms.
class OpenSurfaceError : public Error {
 public:
  using Error::Error;
};

}  // namespace meniscus
