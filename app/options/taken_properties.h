// SPDX-License-Identifier: BSD-3-Clause
// The properties of a scene that a command takes, and what some of them need to have an effect.
#pragma once

#include <initializer_list>
#include <set>
#include <string_view>
#include <vector>

#include "core/properties/properties.h"
#include "core/scene/idle_values.h"

namespace meniscus {

/// The scene's properties for which a command has options. Each command declares its own: those of a common set below,
/// and more or fewer. Options that no scene has are added by the command itself.
class TakenProperties {
 public:
  /// names: headings of the help, such as "Colour", and keys, such as "molecule.quiet"; one that begins with a minus is
  /// left out. The last one that names a property decides. Throws std::logic_error for a name that is neither.
  TakenProperties(std::initializer_list<std::string_view> names) { name(names); }

  /// Returns a copy with more and fewer properties.
  TakenProperties with(std::initializer_list<std::string_view> names) const;
  /// Returns a copy with conditions that this command adds to those of all scenes.
  TakenProperties needing(std::initializer_list<Need> needs) const;

  bool has(const Property& property) const { return taken_.contains(&property); }
  bool has(std::string_view key) const { return has(property_of(key)); }
  const std::vector<Need>& needs() const { return needs_; }

 private:
  void name(std::initializer_list<std::string_view> names);

  std::set<const Property*> taken_;
  std::vector<Need> needs_;
};

/// Returns what every command takes that computes surfaces of a molecule or of a run of frames.
const TakenProperties& run_properties();
/// Returns what every export of a figure takes.
const TakenProperties& figure_properties();
/// Returns what `meniscus render` takes.
const TakenProperties& render_properties();

/// Returns the condition of options for films: the output is one.
Need film_need();
/// Returns the condition of options that turn and move frames. is_met: a table of places or directions is written.
Need superposition_need(bool (*is_met)(const GivenScene& given));

}  // namespace meniscus
