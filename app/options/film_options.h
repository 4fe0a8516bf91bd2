// SPDX-License-Identifier: BSD-3-Clause
// The options that say how a film is encoded.
#pragma once

#include <CLI/CLI.hpp>

#include "app/film/film_format.h"

namespace meniscus {

/// --codec, --crf, --bits, --chroma. The format must live as long as the command.
void add_film_options(CLI::App& command, FilmFormat& format);

}  // namespace meniscus
