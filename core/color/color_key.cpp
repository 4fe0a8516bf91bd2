// SPDX-License-Identifier: BSD-3-Clause
// Makes the key of what a picture shows from its schemes.
#include "core/color/color_key.h"

#include <cmath>
#include <set>

#include "core/base/system_file.h"
#include "core/color/coloring.h"
#include "core/color/lipophilicity.h"
#include "core/structure/element_tables.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;

std::string class_title(By by) {
  return by == By::element || by == By::element_cpk     ? "element"
         : by == By::chain || by == By::chain_okabe_ito ? "chain"
         : by == By::copy                               ? "copy"
         : by == By::model                              ? "model"
         : by == By::kind                               ? "kind of patch"
         : by == By::component                          ? "component"
                                                        : "residue type";
}

/// Returns "model 2", or its file if there are several.
std::string model_name(const Structure& structure, std::int32_t model) {
  const std::string* file = structure.added.empty() ? nullptr : &structure.file;
  for (const AddedFile& added : structure.added)
    if (added.model <= model) file = &added.file;
  return file ? text_of_path(path_of_text(*file).filename()) : fmt::format("model {}", model);
}

std::string class_name(const Structure& structure, const Atom& atom, By by) {
  switch (by) {
    case By::chain:
    case By::chain_okabe_ito:
      return chain_of_file(atom);
    case By::copy:
      return fmt::format("copy {}", atom.copy + 1);
    case By::model:
      return model_name(structure, atom.model);
    case By::residue:
      return std::string(residue_group(atom.residue_name).name);
    default:
      return atom.element == 0 ? "unknown" : element_symbol(atom.element);
  }
}

void add_class(ColorKey& key, const std::string& name, const glm::vec3& color) {
  if (std::ranges::find(key.classes, ColorClass{name, color}) == key.classes.end())
    key.classes.push_back({name, color});
}

bool any_of(const std::vector<bool>& atoms) { return std::ranges::find(atoms, true) != atoms.end(); }

/// Returns the atoms that each painter colours: first the scheme itself, then each rule. In a run, an atom may have
/// several painters.
std::vector<std::vector<bool>> painted_atoms(const Structure& structure, const std::vector<ColorRule>& rules,
                                             const DrawnAtoms& drawn) {
  std::vector<std::vector<bool>> painted(rules.size() + 1);
  std::vector<bool>& left = painted[0];
  left = drawn.atoms.empty() ? std::vector<bool>(structure.atoms.size(), true) : drawn.atoms;
  for (std::size_t rule = rules.size(); rule-- > 0;) {
    const Selection& atoms = rules[rule].atoms;
    const bool changes = drawn.in_a_run && atoms.uses_positions();
    std::vector<bool>& own = painted[rule + 1];
    own = changes ? atoms.possible(structure.atoms).selected : atoms.evaluate(structure);
    for (std::size_t a = 0; a < own.size(); ++a) {
      own[a] = own[a] && left[a];
      if (!changes) left[a] = left[a] && !own[a];
    }
  }
  return painted;
}

/// Removes the numbers of all other atoms.
void keep_numbers(ColorScale& scale, const std::vector<bool>& atoms) {
  std::vector<double> kept;
  for (std::size_t a = 0; a < scale.value.size(); ++a)
    if (atoms[a]) kept.push_back(scale.value[a]);
  scale.value = std::move(kept);
  scale.missing = static_cast<std::size_t>(std::ranges::count_if(scale.value, [](double v) { return std::isnan(v); }));
  std::erase_if(scale.classes, [&](double v) { return std::ranges::find(scale.value, v) == scale.value.end(); });
}

std::string missing_text(std::size_t atoms) { return fmt::format("none ({} atoms)", with_thousands(atoms)); }

ColorKey scale_key(const Structure& structure, const ColorScheme& scheme, const std::vector<bool>& atoms) {
  ColorKey key;
  ColorScale scale = color_scale(structure, scheme);
  if (!scheme.of_points()) {
    keep_numbers(scale, atoms);
  } else if (scheme.by == By::lipophilicity) {
    const std::vector<double> values = lipophilicities(structure);
    for (std::size_t a = 0; a < atoms.size(); ++a) scale.missing += atoms[a] && std::isnan(values[a]);
  }
  const bool has_numbers = scheme.of_points() || scale.missing < scale.value.size();
  key.scale = std::move(scale);
  if (has_numbers) return key;
  key.title = key.heading();
  key.classes = {{missing_text(key.scale->missing), key.scale->missing_color}};
  key.scale.reset();
  return key;
}

ColorKey ordered_key(const Structure& structure, const ColorScheme& scheme, const std::vector<bool>& atoms) {
  ColorKey key;
  key.title = scheme.by == By::secondary ? "secondary structure"
              : scheme.by == By::plddt   ? "confidence (pLDDT)"
              : scheme.by == By::snfg    ? "sugar"
                                         : "bead";
  const ClassedAtoms classed = ordered_classes(structure, scheme.by);
  std::vector<std::size_t> counts(classed.classes.size(), 0);
  for (std::size_t a = 0; a < atoms.size(); ++a)
    if (atoms[a]) ++counts[classed.of_atom[a]];
  for (std::size_t n = 0; n < counts.size(); ++n) {
    if (counts[n] == 0) continue;
    const ColorClass& entry = classed.classes[n];
    key.classes.push_back({entry.name == kWithoutConfidence ? missing_text(counts[n]) : entry.name, entry.color});
  }
  return key;
}

ColorKey key_of_scheme(const Structure& structure, const ColorScheme& scheme, const std::vector<bool>& atoms,
                       std::span<const AtomGroup> objects);

/// Returns the key of By::chain_element: the chains of some atoms and the elements of the others.
ColorKey chain_element_key(const Structure& structure, std::vector<bool> atoms) {
  std::vector<bool> of_chains(atoms.size());
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    of_chains[a] = atoms[a] && has_chain_color(structure.atoms[a]);
    atoms[a] = atoms[a] && !of_chains[a];
  }
  ColorScheme scheme;
  scheme.by = By::chain;
  ColorKey key;
  if (any_of(of_chains)) key = key_of_scheme(structure, scheme, of_chains, {});
  scheme.by = By::element_cpk;
  if (any_of(atoms)) add_key(key, key_of_scheme(structure, scheme, atoms, {}), "chain-element");
  return key;
}

/// Returns the key of a scheme without its rules, for these atoms.
ColorKey key_of_scheme(const Structure& structure, const ColorScheme& scheme, const std::vector<bool>& atoms,
                       std::span<const AtomGroup> objects) {
  if (scheme.by == By::automatic) return key_of_scheme(structure, resolved_scheme(structure, scheme), atoms, objects);
  if (scheme.has_scale()) return scale_key(structure, scheme, atoms);
  if (scheme.by == By::chain_element) return chain_element_key(structure, atoms);
  if (has_ordered_classes(scheme.by)) return ordered_key(structure, scheme, atoms);
  ColorKey key;
  if (scheme.by == By::fixed) return key;
  const By by = scheme.by;
  key.title = class_title(by);
  if (scheme.by == By::kind) {
    constexpr std::array<const char*, 3> kNames{"convex", "toroidal", "concave"};
    for (std::size_t n = 0; n < kNames.size(); ++n) add_class(key, kNames[n], kPatchKindColors[n]);
  }
  for (std::size_t n = 0; scheme.by == By::component && n < objects.size(); ++n)
    if (std::ranges::any_of(objects[n].atoms, [&](std::uint32_t a) { return atoms[a]; }))
      add_class(key, objects[n].name, categorical_color(n));
  if (scheme.by == By::kind || scheme.by == By::component) return key;
  ColorScheme bare;
  bare.by = by;
  const std::vector<glm::vec3> colors = color_atoms(structure, bare).atom;
  std::set<std::pair<std::string, std::size_t>> seen;
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    if (!atoms[a]) continue;
    const Atom& atom = structure.atoms[a];
    const std::string name = class_name(structure, atom, by);
    const auto file =
        static_cast<std::size_t>(scheme.by == By::model ? atom.model : 0);  // several files may have one name
    if (seen.emplace(name, file).second) add_class(key, name, colors[a]);
  }
  return key;
}

/// True if one key can explain both: no name has two colours, and no numbers two scales.
bool agree(const ColorKey& one, const ColorKey& more) {
  if (one.scale || more.scale) return one.scale && is_same_scale(one.scale, more.scale);
  return std::ranges::none_of(more.classes, [&](const ColorClass& added) {
    const auto known = std::ranges::find(one.classes, added.name, &ColorClass::name);
    return known != one.classes.end() && known->color != added.color;
  });
}

/// True if the entry names a thing: the remainder is not one.
bool is_a_thing(const ColorClass& entry) { return entry.name != "other" && !entry.name.starts_with("none ("); }

/// Adds a sentence for each difference in the entries that both show under one title, or under none.
void compare(const ColorKey& a, const ColorKey& b, const std::string& in_a, const std::string& in_b,
             std::vector<std::string>& found) {
  const auto has = [](const ColorKey& key, const ColorClass& entry) {
    return std::ranges::find(key.classes, entry) != key.classes.end();
  };
  const auto text = [](const ColorKey& key, const ColorClass& entry) {
    return key.title + (key.title.empty() ? "" : " ") + in_quotes(entry.name);
  };
  if (a.scale && b.scale && a.scale->title == b.scale->title && !is_same_scale(a.scale, b.scale))
    found.push_back(fmt::format("the colours of {} show {:g} to {:g} in {}, but {:g} to {:g} in {}", a.scale->title,
                                a.scale->range[0], a.scale->range[1], in_a, b.scale->range[0], b.scale->range[1],
                                in_b));
  if (a.title != b.title && !a.title.empty() && !b.title.empty()) return;
  for (const ColorClass& one : a.classes)
    for (const ColorClass& other : b.classes) {
      if (!is_a_thing(one) || !is_a_thing(other) || has(b, one) || has(a, other)) continue;
      if (one.name == other.name)
        found.push_back(fmt::format("{} is {} in {} and {} in {}", text(a, one), hex_color(one.color), in_a,
                                    hex_color(other.color), in_b));
      else if (one.color == other.color)
        found.push_back(
            fmt::format("{} is {} in {} and {} in {}", hex_color(one.color), text(a, one), in_a, text(b, other), in_b));
    }
}

}  // namespace

std::string ColorKey::heading() const {
  return scale ? scale->title + (scale->unit.empty() ? "" : " (" + scale->unit + ")") : title;
}

std::vector<const ColorKey*> ColorKey::parts() const {
  std::vector<const ColorKey*> parts{this};
  for (const ColorKey& other : others) parts.push_back(&other);
  return parts;
}

void add_key(ColorKey& key, ColorKey more, const std::string& whose) {
  for (ColorKey& other : std::exchange(more.others, {})) add_key(key, std::move(other), whose);
  if (more.empty()) return;
  const auto has_title = [&](const ColorKey& part) { return !part.empty() && part.heading() == more.heading(); };
  const auto other = std::ranges::find_if(key.others, has_title);
  ColorKey* const known = has_title(key) ? &key : other != key.others.end() ? &*other : nullptr;
  if (known && agree(*known, more)) {
    for (const ColorClass& added : more.classes) add_class(*known, added.name, added.color);
    return;
  }
  if (known) (more.scale ? more.scale->title : more.title) += ", " + whose;
  key.others.push_back(std::move(more));
}

bool is_same_scale(const std::optional<ColorScale>& one, const std::optional<ColorScale>& other) {
  if (!one || !other) return one.has_value() == other.has_value();
  return one->title == other->title && one->unit == other->unit && one->map == other->map &&
         one->own_map == other->own_map && one->range == other->range && one->missing_color == other->missing_color &&
         one->ends == other->ends && one->classes == other->classes;
}

std::string color_conflicts(std::span<const ColorKey> keys, std::string_view picture) {
  std::vector<std::string> found;
  for (std::size_t n = 0; n < keys.size(); ++n)
    for (std::size_t m = n + 1; m < keys.size(); ++m)
      for (const ColorKey* const a : keys[n].parts())
        for (const ColorKey* const b : keys[m].parts())
          compare(*a, *b, fmt::format("{} {}", picture, n + 1), fmt::format("{} {}", picture, m + 1), found);
  if (found.empty()) return {};
  return found.front() + (found.size() > 1 ? fmt::format("; {} more colours differ", found.size() - 1) : "");
}

void add_other(ColorKey& key, const std::string& name, const glm::vec3& color) {
  if (!key.empty()) add_class(key, name, color);
}

ColorKey color_key(const Structure& structure, const ColorScheme& scheme, const DrawnAtoms& drawn) {
  std::vector<std::vector<bool>> painted = painted_atoms(structure, scheme.rules, drawn);
  if (scheme.by == By::kind) return key_of_scheme(structure, scheme, painted[0], {});  // rules do not apply to patches
  // Rules that colour by the same thing as others are explained together with them.
  std::vector<const ColorScheme*> painters{&scheme};
  for (const ColorRule& rule : scheme.rules) painters.push_back(&rule.paint);
  for (std::size_t n = 0; n < painters.size(); ++n)
    for (std::size_t more = n + 1; more < painters.size(); ++more) {
      if (painters[n]->by == By::fixed || painters[more]->by != painters[n]->by) continue;
      for (std::size_t a = 0; a < painted[n].size(); ++a) painted[n][a] = painted[n][a] || painted[more][a];
      painted[more].clear();
    }
  ColorKey key;
  if (any_of(painted[0])) key = key_of_scheme(structure, scheme, painted[0], drawn.objects);
  for (std::size_t n = 0; n < scheme.rules.size(); ++n) {
    if (!any_of(painted[n + 1])) continue;
    const ColorRule& rule = scheme.rules[n];
    const std::string name = rule.name.empty() ? rule.atoms.text() : rule.name;
    if (rule.paint.by == By::fixed)
      add_class(key, name, rule.paint.fixed);
    else
      add_key(key, key_of_scheme(structure, rule.paint, painted[n + 1], {}), name);
  }
  if (scheme.by == By::fixed && any_of(painted[0])) add_other(key, "other", scheme.fixed);
  return key;
}

}  // namespace meniscus
