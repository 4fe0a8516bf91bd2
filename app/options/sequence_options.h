// SPDX-License-Identifier: BSD-3-Clause
// The options that make a run of frames out of a command for one molecule.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/reports/run_progress.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

/// Where the bonds come from along which molecules are made whole.
enum class WholeBy {
  nothing,  ///< molecules stay as they are
  bonds,    ///< those the file lists and those of standard residues
  guess     ///< those the file lists and all that distances suggest
};

/// What the sequence options say. Commands keep one of these alive as long as their CLI::App.
struct SequenceOptions {
  std::string trajectory;         ///< empty: the models of the molecule's file are the frames
  bool trust_atom_order = false;  ///< bonds of the first frame are not compared with those of the molecule's file
  std::uint64_t repeat = 1;       ///< each frame this often in a row
  std::string frames;             ///< as parse_frame_list reads it; empty: all
  std::uint64_t stride = 1;
  std::string begin, end;  ///< a frame ("100") or a time ("2.5ns", "300ps"); empty: no bound
  std::string only;        ///< the share of the run that is made; empty: all of it
  WholeBy whole = WholeBy::nothing;
  std::optional<Selection> superpose, center;
  std::uint64_t reference = 0;
  std::uint64_t smooth = 1;  ///< frames that a mean is taken over; odd
  ProgressStyle progress = ProgressStyle::automatic;

  /// Is a run asked for at all?
  bool asked() const;
};

/// --trajectory, --trust-atom-order, --repeat, --frames, --stride, --begin, --end, --only, --whole, --superpose,
/// --center, --reference,
/// --smooth,
/// --progress, under a heading of their own.
void add_sequence_options(CLI::App& command, SequenceOptions& options);

}  // namespace meniscus
