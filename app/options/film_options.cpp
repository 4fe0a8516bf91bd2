// SPDX-License-Identifier: BSD-3-Clause
#include "app/options/film_options.h"

namespace meniscus {

void add_film_options(CLI::App& command, FilmFormat& format) {
  command
      .add_option("--codec", format.codec,
                  "Of a film: h264 (.mp4, .mov, .mkv), h265, vp9 (.webm), prores, prores4444 (.mov; it keeps what is "
                  "transparent), dnxhr, gif [by the ending]")
      ->check(CLI::IsMember(film_codec_names()).description(""))
      ->type_name("WORD");
  command.add_option("--crf", format.rate_factor, "Rate factor: less is better and larger [h264 18, h265 20, vp9 24]")
      ->type_name("N");
  command.add_option("--bits", format.bits, "Of a channel of a film, 8 or 10 [8; of prores 10]")
      ->check(CLI::IsMember({8, 10}).description(""))
      ->type_name("N");
  command.add_option("--chroma", format.chroma, "Colour in 420, 422 or 444 of its pixels [420; of prores, dnxhr 422]")
      ->check(CLI::IsMember({420, 422, 444}).description(""))
      ->type_name("N");
}

}  // namespace meniscus
