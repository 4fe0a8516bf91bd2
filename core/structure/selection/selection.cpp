// SPDX-License-Identifier: BSD-3-Clause
// Evaluates parsed selections step by step, each step for all atoms, with a stack of sets, and joins residues to
// places, one shell of neighbours after another.
#include "core/structure/selection/selection.h"

#include <algorithm>
#include <unordered_set>

#include <fmt/ranges.h>

#include "core/base/text.h"
#include "core/structure/element_tables.h"
#include "core/structure/selection/selection_steps.h"

namespace meniscus {
namespace {

std::string text_of(AtomField field, const Atom& atom) {
  switch (field) {
    case AtomField::chain:
      return atom.chain;
    case AtomField::residue_name:
      return atom.residue_name;
    case AtomField::altloc:
      return atom.altloc == ' ' ? std::string() : std::string(1, atom.altloc);
    default:
      return atom.name;
  }
}

double number_of(AtomField field, const Atom& atom) {
  switch (field) {
    case AtomField::element:
      return atom.element;
    case AtomField::residue_number:
      return atom.residue_number;
    case AtomField::index:
      return atom.index;
    case AtomField::serial:
      return atom.index + 1.0;
    case AtomField::model:
      return atom.model;
    case AtomField::b_factor:
      return atom.b_factor;
    case AtomField::occupancy:
      return atom.occupancy;
    case AtomField::charge:
      return atom.charge;
    case AtomField::radius:
      return atom.radius;
    case AtomField::hydrophobicity:
      return hydropathy(atom.residue_name);
    case AtomField::x:
      return atom.position.x;
    case AtomField::y:
      return atom.position.y;
    default:
      return atom.position.z;
  }
}

/// Rounds a value as atoms store it. Some values have single precision, so that 20.1 in the file must equal 20.1 in the
/// expression.
double as_kept(AtomField field, double value) {
  const bool single = field == AtomField::b_factor || field == AtomField::occupancy || field == AtomField::charge;
  return single ? static_cast<float>(value) : value;
}

bool meets(double left, Comparison comparison, double right) {
  switch (comparison) {
    case Comparison::less:
      return left < right;
    case Comparison::less_or_equal:
      return left <= right;
    case Comparison::greater:
      return left > right;
    case Comparison::greater_or_equal:
      return left >= right;
    case Comparison::equal:
      return left == right;
    case Comparison::not_equal:
      return left < right || left > right;  // false for a missing value
  }
  return false;
}

using Set = std::vector<bool>;

template <typename Predicate>
Set atoms_where(std::span<const Atom> atoms, Predicate&& predicate) {
  Set set(atoms.size());
  for (std::size_t n = 0; n < atoms.size(); ++n) set[n] = predicate(atoms[n]);
  return set;
}

bool has_copies(std::span<const Atom> atoms) {
  return std::ranges::any_of(atoms, [](const Atom& atom) { return atom.copy > 0; });
}

/// True if one of the values matches the atom. A chain of a copy has two names: the one in the file, and the one with
/// the number of the copy.
bool names(const TextTest& test, const Atom& atom, bool copied) {
  const auto is_one = [&](const std::string& text) {
    return std::ranges::any_of(test.values, [&](const TextPattern& pattern) { return matches(pattern, text); });
  };
  if (is_one(text_of(test.field, atom))) return true;
  if (!copied || test.field != AtomField::chain) return false;
  return is_one(atom.copy > 0 ? chain_of_file(atom) : atom.chain + "-1");
}

/// Evaluates one step after another. Each overload evaluates one kind of step.
class Evaluation {
 public:
  explicit Evaluation(std::span<const Atom> atoms) : atoms_(atoms), has_copies_(has_copies(atoms)) {}

  void operator()(const FlagTest& test) { stack_.push_back(atoms_with(test.flag, atoms_)); }

  void operator()(const TextTest& test) {
    stack_.push_back(atoms_where(atoms_, [&](const Atom& atom) { return names(test, atom, has_copies_); }));
  }

  void operator()(const NumberTest& test) {
    stack_.push_back(atoms_where(atoms_, [&](const Atom& atom) {
      const double value = number_of(test.field, atom);
      return std::any_of(test.ranges.begin(), test.ranges.end(), [&](const std::array<double, 2>& range) {
        return value >= as_kept(test.field, range[0]) && value <= as_kept(test.field, range[1]);
      });
    }));
  }

  void operator()(const ResidueTest& test) {
    stack_.push_back(atoms_where(atoms_, [&](const Atom& atom) {
      const ResidueTest::Id id{atom.residue_number, atom.insertion_code};
      return std::any_of(test.ranges.begin(), test.ranges.end(),
                         [&](const std::array<ResidueTest::Id, 2>& range) { return range[0] <= id && id <= range[1]; });
    }));
  }

  void operator()(const CompareTest& test) {
    const double value = as_kept(test.field, test.value);
    stack_.push_back(atoms_where(
        atoms_, [&](const Atom& atom) { return meets(number_of(test.field, atom), test.comparison, value); }));
  }

  void operator()(NotStep) { top().flip(); }

  void operator()(AndStep) {
    const Set right = pop();
    for (std::size_t n = 0; n < right.size(); ++n) top()[n] = top()[n] && right[n];
  }

  void operator()(OrStep) {
    const Set right = pop();
    for (std::size_t n = 0; n < right.size(); ++n) top()[n] = top()[n] || right[n];
  }

  void operator()(const WithinStep& step) {
    Set& set = top();
    std::vector<glm::dvec3> points;
    for (std::size_t n = 0; n < atoms_.size(); ++n) {
      if (set[n]) points.push_back(atoms_[n].position);
    }
    const PointTree tree(std::move(points));
    for (std::size_t n = 0; n < atoms_.size(); ++n) {
      set[n] = set[n] ? step.includes_set : tree.any_within(atoms_[n].position, step.distance);
    }
  }

  void operator()(const WholeStep& step) {
    Set& set = top();
    if (step.whole_chains) {
      std::set<std::pair<std::int32_t, std::string>> chains;
      for (std::size_t n = 0; n < atoms_.size(); ++n) {
        if (set[n]) chains.emplace(atoms_[n].model, atoms_[n].chain);
      }
      set = atoms_where(atoms_, [&](const Atom& atom) { return chains.contains({atom.model, atom.chain}); });
    } else {
      std::unordered_set<std::uint32_t> residues;
      for (std::size_t n = 0; n < atoms_.size(); ++n) {
        if (set[n]) residues.insert(atoms_[n].residue);
      }
      set = atoms_where(atoms_, [&](const Atom& atom) { return residues.contains(atom.residue); });
    }
  }

  void operator()(FirstStep) { top() = first_place(atoms_, top()); }

  void operator()(const FixedTest& test) {
    stack_.push_back(atoms_where(atoms_, [&](const Atom& atom) {
      return test.atoms->contains({test.compares_copies ? atom.copy : 0, atom.index});
    }));
  }

  void push(Set set) { stack_.push_back(std::move(set)); }
  Set pop() {
    Set set = std::move(stack_.back());
    stack_.pop_back();
    return set;
  }

  Set& top() { return stack_.back(); }

 private:
  std::span<const Atom> atoms_;
  bool has_copies_;
  std::vector<Set> stack_;
};

bool is_of_backbone(const SelectionStep& step) {
  const auto* test = std::get_if<FlagTest>(&step);
  return test && (test->flag == AtomFlag::helix || test->flag == AtomFlag::strand || test->flag == AtomFlag::coil);
}

bool is_of_coordinates(const SelectionStep& step) {
  const auto is_one = [](AtomField field) {
    return field == AtomField::x || field == AtomField::y || field == AtomField::z;
  };
  const auto* numbers = std::get_if<NumberTest>(&step);
  const auto* comparison = std::get_if<CompareTest>(&step);
  return (numbers && is_one(numbers->field)) || (comparison && is_one(comparison->field));
}

/// True if the values of a step, other than wildcards, name this water or ion.
bool names_by(const SelectionStep& step, const Atom& atom, const std::set<std::string>& names_of_others) {
  if (const auto* test = std::get_if<FlagTest>(&step)) {
    return (test->flag == AtomFlag::water && atom.kind == AtomClass::water) ||
           ((test->flag == AtomFlag::ion || test->flag == AtomFlag::inorganic) && atom.kind == AtomClass::ion);
  }
  const bool ion = atom.kind == AtomClass::ion;
  if (const auto* test = std::get_if<NumberTest>(&step)) {
    return ion && test->field == AtomField::element &&
           std::any_of(test->ranges.begin(), test->ranges.end(),
                       [&](const std::array<double, 2>& range) { return range[0] == atom.element; });
  }
  if (const auto* test = std::get_if<FixedTest>(&step)) {
    return std::ranges::any_of(test->expression->steps,
                               [&](const SelectionStep& each) { return names_by(each, atom, names_of_others); });
  }
  const auto* test = std::get_if<TextTest>(&step);
  if (!test) return false;
  const bool by_atom_name = test->field == AtomField::name && ion && !names_of_others.contains(atom.name);
  if (test->field != AtomField::residue_name && !by_atom_name) return false;
  return std::any_of(test->values.begin(), test->values.end(), [&](const TextPattern& pattern) {
    return !pattern.has_wildcards && pattern.text == text_of(test->field, atom);
  });
}

}  // namespace

bool matches(const TextPattern& pattern, const std::string& text) {
  if (!pattern.has_wildcards) return pattern.text == text;
  std::size_t p = 0, t = 0, star = std::string::npos, retry = 0;
  while (t < text.size()) {
    if (p < pattern.text.size() && pattern.text[p] == '*') {
      star = p++;
      retry = t;
    } else if (p < pattern.text.size() && (pattern.text[p] == '?' || pattern.text[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++retry;
    } else {
      return false;
    }
  }
  return pattern.text.find_first_not_of('*', p) == std::string::npos;
}

std::vector<bool> Selection::evaluate(std::span<const Atom> atoms) const {
  Evaluation evaluation(atoms);
  for (const SelectionStep& step : steps_->steps) std::visit(evaluation, step);
  return evaluation.pop();
}

std::vector<bool> Selection::evaluate(const Structure& structure) const {
  if (structure.extra_atoms.empty()) return evaluate(structure.atoms);
  std::vector<Atom> atoms = structure.atoms;
  atoms.insert(atoms.end(), structure.extra_atoms.begin(), structure.extra_atoms.end());
  std::vector<bool> selected = evaluate(atoms);
  selected.resize(structure.atoms.size());
  return selected;
}

std::vector<bool> Selection::names(std::span<const Atom> atoms) const {
  std::set<std::string> names_of_others;
  for (const Atom& atom : atoms) {
    if (atom.kind != AtomClass::ion) names_of_others.insert(atom.name);
  }
  return atoms_where(atoms, [&](const Atom& atom) {
    return (atom.kind == AtomClass::water || atom.kind == AtomClass::ion) &&
           std::any_of(steps_->steps.begin(), steps_->steps.end(),
                       [&](const SelectionStep& step) { return names_by(step, atom, names_of_others); });
  });
}

std::string Selection::why_none(std::span<const Atom> atoms) const {
  std::vector<std::string> chains = chains_of(atoms);
  for (std::string& chain : chains) chain = chain.empty() ? "''" : escaped(chain);
  const std::size_t count = chains.size();
  const bool copied = has_copies(atoms);
  for (const SelectionStep& step : steps_->steps) {
    const auto* test = std::get_if<TextTest>(&step);
    if (!test || test->field != AtomField::chain) continue;
    for (const TextPattern& wanted : test->values) {
      const TextTest one{AtomField::chain, {wanted}};
      if (std::ranges::any_of(atoms, [&](const Atom& atom) { return meniscus::names(one, atom, copied); })) continue;
      constexpr std::size_t kNamed = 30;
      const bool more = chains.size() > kNamed;
      if (more) chains.resize(kNamed);
      return fmt::format("there is no chain {}, only {}{}{}", in_quotes(wanted.text), fmt::join(chains, ", "),
                         more ? fmt::format(" and {} more", count - kNamed) : "",
                         names_copies() && !copied ? "; copies that share one surface have no names" : "");
    }
  }
  return "chains and names are case-sensitive";
}

bool Selection::names_copies() const {
  return std::ranges::any_of(steps_->steps, [](const SelectionStep& step) {
    const auto* test = std::get_if<TextTest>(&step);
    return test && test->field == AtomField::chain && std::ranges::any_of(test->values, [](const TextPattern& value) {
             return value.text.find('-', 1) != std::string::npos;
           });
  });
}

bool Selection::uses_radius() const { return steps_->compare({AtomField::radius}); }

bool Selection::uses_positions() const {
  return std::ranges::any_of(steps_->steps, [](const SelectionStep& step) {
    return is_of_coordinates(step) || is_of_backbone(step) || std::holds_alternative<WithinStep>(step) ||
           std::holds_alternative<FirstStep>(step);
  });
}

// Two evaluations run in parallel: one of the atoms that are always selected, one of those that may be.
Selection::PossibleAtoms Selection::possible(std::span<const Atom> atoms) const {
  Evaluation certain(atoms), perhaps(atoms);
  PossibleAtoms possible{{}, Set(atoms.size(), false)};
  for (const SelectionStep& step : steps_->steps) {
    if (is_of_coordinates(step) || is_of_backbone(step)) {
      certain.push(Set(atoms.size(), false));
      perhaps.push(is_of_coordinates(step) ? Set(atoms.size(), true) : atoms_with(AtomFlag::protein, atoms));
    } else if (const auto* within = std::get_if<WithinStep>(&step)) {
      for (std::size_t n = 0; n < atoms.size(); ++n) {
        possible.measured[n] = possible.measured[n] || perhaps.top()[n];
        perhaps.top()[n] = within->includes_set || !certain.top()[n];
        certain.top()[n] = within->includes_set && certain.top()[n];
      }
    } else if (std::holds_alternative<FirstStep>(step)) {
      for (std::size_t n = 0; n < atoms.size(); ++n) possible.measured[n] = possible.measured[n] || perhaps.top()[n];
      certain.top().assign(atoms.size(), false);
    } else {
      std::visit(certain, step);
      std::visit(perhaps, step);
      if (std::holds_alternative<NotStep>(step)) std::swap(certain.top(), perhaps.top());
    }
  }
  possible.selected = perhaps.pop();
  return possible;
}

Selection Selection::fixed(std::span<const Atom> atoms, const std::vector<bool>& selected) const {
  auto chosen = std::make_shared<std::set<std::pair<std::uint32_t, std::uint32_t>>>();
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (selected[n]) chosen->emplace(atoms[n].copy, atoms[n].index);
  Selection fixed = *this;
  fixed.steps_ =
      std::make_shared<const SelectionSteps>(SelectionSteps{{FixedTest{steps_, std::move(chosen), has_copies(atoms)}}});
  return fixed;
}

Selection either(const Selection& a, const Selection& b) {
  SelectionSteps both = *a.steps_;
  both.steps.insert(both.steps.end(), b.steps_->steps.begin(), b.steps_->steps.end());
  both.steps.emplace_back(OrStep{});
  Selection either = a;
  either.text_ = fmt::format("({}) or ({})", a.text_, b.text_);
  either.steps_ = std::make_shared<const SelectionSteps>(std::move(both));
  return either;
}

bool SelectionSteps::compare(std::initializer_list<AtomField> fields) const {
  return std::ranges::any_of(steps, [&](const SelectionStep& step) {
    const auto* numbers = std::get_if<NumberTest>(&step);
    const auto* comparison = std::get_if<CompareTest>(&step);
    return (numbers && std::ranges::find(fields, numbers->field) != fields.end()) ||
           (comparison && std::ranges::find(fields, comparison->field) != fields.end());
  });
}

std::string advice_on_count(std::span<const Atom> atoms, std::size_t frame_atoms) {
  struct Part {
    const char *words, *selection;
  };
  constexpr Part kParts[] = {{"without water", "not water"},
                             {"without water and ions", "not (water or ion)"},
                             {"in polymers", "polymer"},
                             {"in proteins", "protein"},
                             {"without hydrogens", "not hydrogen"},
                             {"in polymers without hydrogens", "polymer and not hydrogen"},
                             {"named CA", "name CA"}};
  for (const Part& part : kParts) {
    const std::vector<bool> selected = parse_selection(part.selection).evaluate(atoms);
    if (static_cast<std::size_t>(std::ranges::count(selected, true)) == frame_atoms)
      return message("as many as it has {}: choose @trajectory-atoms '{}'@", part.words, part.selection);
  }
  return message(
      "they do not belong together; if the trajectory has only some of these atoms, select them by @trajectory-atoms@");
}

std::vector<bool> first_place(std::span<const Atom> atoms, const std::vector<bool>& selected) {
  using Residue = std::pair<std::uint32_t, std::uint32_t>;
  const auto residue_of = [&](std::size_t n) { return Residue{atoms[n].copy, atoms[n].residue}; };
  const auto in_file = [&](std::size_t n) { return std::pair(atoms[n].copy, atoms[n].index); };
  std::optional<std::size_t> first;
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (selected[n] && (!first || in_file(n) < in_file(*first))) first = n;
  std::vector<bool> place(atoms.size());
  std::set<Residue> reached;
  if (first) reached.insert(residue_of(*first));
  while (!reached.empty()) {
    std::vector<glm::dvec3> points;
    for (std::size_t n = 0; n < atoms.size(); ++n) {
      if (!selected[n] || place[n] || !reached.contains(residue_of(n))) continue;
      place[n] = true;
      points.push_back(atoms[n].position);
    }
    const PointTree tree(std::move(points));
    reached.clear();
    for (std::size_t n = 0; n < atoms.size(); ++n)
      if (selected[n] && !place[n] && tree.any_within(atoms[n].position, kWidestGap)) reached.insert(residue_of(n));
  }
  return place;
}

}  // namespace meniscus
