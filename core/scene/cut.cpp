// SPDX-License-Identifier: BSD-3-Clause
// Parses cutting planes, and measures depths along the view and where atoms are.
#include "core/scene/cut.h"

#include <charconv>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/open_side.h"
#include "core/queries/copies.h"
#include "core/scene/representations.h"

namespace meniscus {
namespace {

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<glm::dvec3> parse_direction(std::string_view text) {
  if (text == "depth") return glm::dvec3(0.0);
  if (text == "x") return glm::dvec3(1.0, 0.0, 0.0);
  if (text == "y") return glm::dvec3(0.0, 1.0, 0.0);
  if (text == "z") return glm::dvec3(0.0, 0.0, 1.0);
  glm::dvec3 direction;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',');
    if ((axis < 2) != (comma != std::string_view::npos)) return {};
    const std::optional<double> value = parse_number(text.substr(0, comma));
    if (!value) return {};
    direction[axis] = *value;
    if (axis < 2) text.remove_prefix(comma + 1);
  }
  const double length = glm::length(direction);
  if (!(length > 1e-150) || !std::isfinite(length)) return {};
  return direction;
}

/// A word before an expression, and the place where it puts the plane.
struct PlaceWord {
  std::string_view word;
  Cut::Place place;
};
constexpr PlaceWord kPlaceWords[] = {{"through", Cut::Place::through}, {"before", Cut::Place::before}};

/// Returns nothing if the text does not begin with one of the words.
std::optional<Cut> parse_cut_by_atoms(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  for (const auto& [word, place] : kPlaceWords) {
    if (!text.starts_with(word)) continue;
    const std::string_view atoms = text.substr(word.size());
    if (!atoms.empty() && atoms.front() != ' ' && atoms.front() != '(') continue;
    if (atoms.find_first_not_of(' ') == std::string_view::npos)
      throw RequestError("{} is not a plane: name the atoms, such as {} ligand", in_quotes(text), word);
    Cut cut;
    cut.keeps_less = false;
    cut.place = place;
    cut.atoms = parse_selection(atoms.substr(atoms.find_first_not_of(' ')));
    return cut;
  }
  return {};
}

}  // namespace

Cut parse_cut(std::string_view text) {
  if (std::optional<Cut> cut = parse_cut_by_atoms(text)) return *std::move(cut);
  std::string tight(text);
  std::erase(tight, ' ');
  const std::size_t sign = tight.find_first_of("<>");
  const auto refuse = [&](const char* why) {
    return RequestError(fmt::format(
        "{} is not a plane: {}; write one such as x<20, 1,1,0>35, depth>0.5 or before ligand", in_quotes(text), why));
  };
  if (sign == std::string::npos) throw refuse("there is no < or >");
  const std::optional<glm::dvec3> direction = parse_direction(std::string_view(tight).substr(0, sign));
  if (!direction) throw refuse("expected x, y, z, depth or a direction of three numbers before < or >");
  const std::optional<double> bound = parse_number(std::string_view(tight).substr(sign + 1));
  if (!bound) throw refuse("expected one number after < or >");
  return {*direction, tight[sign] == '<', *bound, Cut::Place::bound, {}};
}

std::string cut_text(const Cut& cut) {
  for (const auto& [word, place] : kPlaceWords)
    if (cut.place == place) return fmt::format("{} {}", word, cut.atoms->text());
  const glm::dvec3& d = cut.direction;
  std::string axis = fmt::format("{},{},{}", d.x, d.y, d.z);
  if (d == glm::dvec3(0.0)) axis = "depth";
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 unit(0.0);
    unit[c] = 1.0;
    if (d == unit) axis = std::string(1, static_cast<char>('x' + c));
  }
  return fmt::format("{}{}{}", axis, cut.keeps_less ? '<' : '>', cut.bound);
}

ClipPlane clip_plane(const Cut& cut, const Camera& camera, std::span<const Ball> atoms) {
  glm::dvec3 normal = cut.direction;
  double offset = cut.bound;
  if (normal == glm::dvec3(0.0)) {
    normal = view_basis(camera).forward;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Ball& ball : atoms) {
      const double depth = glm::dot(ball.center, normal);
      low = std::min(low, depth - ball.radius);
      high = std::max(high, depth + ball.radius);
    }
    offset = low + cut.bound * (high - low);
  }
  const double length = glm::length(normal) * (cut.keeps_less ? 1.0 : -1.0);
  return {normal / length, offset / length};
}

CutAtoms cut_atoms(std::span<const Cut> cuts, const Structure& structure) {
  if (!uses_atoms(cuts)) return {};
  CutAtoms chosen(cuts.size());
  const std::vector<Atom> atoms = shown_atoms(structure);
  for (std::size_t n = 0; n < cuts.size(); ++n) {
    if (!cuts[n].atoms) continue;
    std::vector<bool> picked = cuts[n].atoms->evaluate(atoms);
    if (std::ranges::find(picked, true) == picked.end())
      throw RequestError(message("@clip {}@: selects none of the {} atoms that are shown; {}",
                                 in_quotes(cut_text(cuts[n])), with_thousands(atoms.size()),
                                 cuts[n].atoms->why_none(atoms)));
    for (std::size_t a = structure.atoms.size(); a < atoms.size(); ++a)
      if (picked[a]) chosen[n].push_back({atoms[a].position, atoms[a].radius});
    picked.resize(structure.atoms.size());
    const std::vector<Ball> own = standing_balls(structure, picked);
    chosen[n].insert(chosen[n].end(), own.begin(), own.end());
  }
  return chosen;
}

bool uses_atoms(std::span<const Cut> cuts) {
  return std::ranges::any_of(cuts, [](const Cut& cut) { return cut.atoms.has_value(); });
}

namespace {

/// Returns a plane that faces the viewer. All that is nearer to the viewer is cut away.
ClipPlane facing_plane(const Camera& camera, double depth) { return {-view_basis(camera).forward, -depth}; }

double middle_depth(std::span<const Ball> balls, const Camera& camera) {
  glm::dvec3 middle(0.0);
  for (const Ball& ball : balls) middle += ball.center / static_cast<double>(balls.size());
  return glm::dot(middle, view_basis(camera).forward);
}

}  // namespace

std::vector<ClipPlane> clip_planes(std::span<const Cut> cuts, const CutAtoms& cut_atoms, const CutView& view) {
  const Camera& camera = view.camera;
  std::vector<ClipPlane> planes;
  for (std::size_t n = 0; n < cuts.size(); ++n) {
    if (cuts[n].place == Cut::Place::through)
      planes.push_back(facing_plane(camera, middle_depth(cut_atoms.at(n), camera)));
    else if (cuts[n].place == Cut::Place::before)
      planes.push_back(facing_plane(camera, open_depth(cut_atoms.at(n), view.shown, camera).depth));
    else
      planes.push_back(clip_plane(cuts[n], camera, view.atoms));
  }
  return planes;
}

std::vector<Ball> shown_balls(std::span<const Ball> atoms, const Coloring& coloring) {
  std::vector<Ball> shown;
  for (std::uint32_t a = 0; a < atoms.size(); ++a)
    if (coloring.shows(a)) shown.push_back(atoms[a]);
  return shown;
}

std::vector<Ball> shown_balls(std::span<const SurfaceObject> objects) {
  std::vector<Ball> shown;
  for (const SurfaceObject& object : objects) {
    const std::vector<Ball> own = shown_balls(object.surface.atoms, object.coloring);
    for (const RigidMotion& motion : object.copies)
      for (const Ball& ball : own) shown.push_back(moved(ball, motion));
  }
  return shown;
}

std::vector<std::string> ineffective_cuts(std::span<const Cut> cuts, const CutAtoms& cut_atoms, const CutView& view,
                                          std::span<const Ball> balls) {
  std::vector<std::string> sentences;
  const std::vector<ClipPlane> planes = clip_planes(cuts, cut_atoms, view);
  for (std::size_t n = 0; n < cuts.size(); ++n) {
    const Cut& cut = cuts[n];
    const ClipPlane& plane = planes[n];
    if (cut.place == Cut::Place::before) {
      const OpenDepth open = open_depth(cut_atoms.at(n), view.shown, view.camera);
      if (open.is_limited)
        sentences.push_back(
            message("{} leaves them {:.0f} % hidden: they are part of the surface, so the plane is before all of them; "
                    "with @select@ without them, and @sticks@, it goes deeper",
                    cut_text(cut), 100.0 * (1.0 - open.seen)));
      continue;
    }
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Ball& ball : balls) {
      const double along = glm::dot(plane.normal, ball.center);
      least = std::min(least, along - ball.radius);
      most = std::max(most, along + ball.radius);
    }
    const bool keeps_all = most <= plane.offset;
    if (!keeps_all && least < plane.offset) continue;
    std::string where = "0 is its nearest point, 1 its farthest";
    if (cut.place == Cut::Place::through) where = "the atoms are beyond it";
    if (cut.direction != glm::dvec3(0.0)) {
      // The plane's normal has the length 1, and points to the side that is cut away.
      const double scale = glm::length(cut.direction) * (cut.keeps_less ? 1.0 : -1.0);
      const std::string axis = cut_text(cut);
      where = fmt::format("its {} is {:.1f} to {:.1f}", axis.substr(0, axis.find_first_of("<>")),
                          std::min(scale * least, scale * most), std::max(scale * least, scale * most));
    }
    sentences.push_back(
        fmt::format("{} {} of the surface: {}", cut_text(cut), keeps_all ? "cuts nothing" : "leaves nothing", where));
  }
  return sentences;
}

}  // namespace meniscus
