// SPDX-License-Identifier: BSD-3-Clause
// Sides, turns, axes of assemblies, cameras of other programs, and balls that a camera certainly does not see.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/camera/camera_json.h"
#include "core/camera/view_request.h"
#include "core/math/ball.h"
#include "core/math/rigid_motion.h"

namespace meniscus {
namespace {

// The balls are longest along x + y, then z, and shortest along x - y.
const std::vector<Ball> kLong{{{-8, -8, 0}, 1}, {{8, 8, 0}, 1},  {{0, 0, 4}, 1}, {{0, 0, -4}, 1},
                              {{1, -1, 0}, 1},  {{-1, 1, 0}, 1}, {{3, 3, 1}, 1}};

glm::dmat3 rotation(const glm::dvec3& axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  const glm::dvec3 a = glm::normalize(axis);
  const glm::dmat3 cross({0, a.z, -a.y}, {-a.z, 0, a.x}, {a.y, -a.x, 0});
  return c * glm::dmat3(1.0) + s * cross + (1.0 - c) * glm::outerProduct(a, a);
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

ViewBasis side(const char* name, const std::optional<glm::dvec3>& symmetry = {}) {
  return view_basis(parse_view_direction(name).value(), {kLong, kLong, symmetry});
}

TEST(ViewDirection, FacesWhatItNames) {
  for (const std::string& word : view_direction_words()) {
    if (word.ends_with("channel")) continue;  // These have no channel.
    const ViewBasis basis = side(word.c_str(), glm::dvec3(0.6, 0.0, 0.8));
    expect_near(glm::cross(basis.right, basis.up), -basis.forward);
    EXPECT_NEAR(glm::length(basis.up), 1.0, 1e-12) << word;
    EXPECT_NEAR(glm::dot(basis.up, basis.forward), 0.0, 1e-12) << word;
  }
  expect_near(side("z").forward, {0, 0, -1});
  expect_near(side("z").right, {1, 0, 0});
  expect_near(side("-z").forward, {0, 0, 1});
  expect_near(side("-z").up, {0, 1, 0});
  expect_near(side("x").forward, {-1, 0, 0});
  expect_near(side("x").up, {0, 1, 0});
  expect_near(side("y").forward, {0, -1, 0});
  expect_near(side("y").right, {1, 0, 0});
  const glm::dvec3 long_axis = glm::normalize(glm::dvec3(1, 1, 0));
  EXPECT_NEAR(std::abs(glm::dot(side("1").forward, long_axis)), 1.0, 1e-3);
  EXPECT_NEAR(std::abs(glm::dot(side("2").right, long_axis)), 1.0, 1e-3);
  EXPECT_NEAR(std::abs(glm::dot(side("3").right, long_axis)), 1.0, 1e-3);
  const ViewBasis usual = broad_side(kLong);
  for (const auto& [word, other] :
       {std::pair{"front", "3"}, {"back", "-3"}, {"top", "2"}, {"bottom", "-2"}, {"right", "1"}, {"left", "-1"}})
    expect_near(side(word).forward, side(other).forward);
  expect_near(side("front").forward, usual.forward);
  expect_near(side("front").up, usual.up);
  expect_near(side("back").forward, -usual.forward);
  // What was up, right and below faces the viewer.
  expect_near(side("top").forward, -usual.up);
  expect_near(side("right").forward, -usual.right);
  expect_near(side("bottom").forward, usual.up);
  expect_near(side("symmetry", glm::dvec3(0, 0, 1)).forward, {0, 0, -1});
  expect_near(side("symmetry-side", glm::dvec3(0, 0.6, 0.8)).up, {0, 0.6, 0.8});
}

// Balls lie on a sphere of radius 9 about one in the middle, but for a hole.
TEST(ViewDirection, OpenLooksThroughTheHole) {
  const std::vector<Ball> seen{{{0.5, 0, 0}, 1.7}, {{-0.5, 0, 0}, 1.7}};
  for (const glm::dvec3& hole : {glm::dvec3(0.6, 0.0, 0.8), glm::dvec3(0, -1, 0), glm::dvec3(-0.48, 0.6, -0.64)}) {
    std::vector<Ball> all = seen;
    for (std::size_t n = 0; n < 400; ++n) {
      const glm::dvec3 at = spiral_direction(n, 400);
      if (glm::dot(at, hole) < 0.85) all.push_back({9.0 * at, 1.7});
    }
    const ViewBasis basis = view_basis(parse_view_direction("open").value(), {all, seen, {}});
    EXPECT_GT(glm::dot(-basis.forward, hole), 0.95);
    EXPECT_GT(glm::dot(view_basis(parse_view_direction("-open").value(), {all, seen, {}}).forward, hole), 0.95);
  }
}

TEST(ViewDirection, OpenLooksThroughTheThinnestWall) {
  const std::vector<Ball> seen{{{0, 0, 0}, 1.7}};
  std::vector<Ball> all = seen;
  const glm::dvec3 thin = spiral_direction(123, 300);
  for (std::size_t n = 0; n < 300; ++n) {
    const glm::dvec3 at = spiral_direction(n, 300);
    for (const double radius : {6.0, 9.0, 12.0})
      if (radius == 6.0 || glm::dot(at, thin) < 0.8) all.push_back({radius * at, 1.9});
  }
  EXPECT_GT(glm::dot(-view_basis(parse_view_direction("open").value(), {all, seen, {}}).forward, thin), 0.9);
}

/// Returns a tube of rings of balls along the axis, through the middle; its inside is `width` wide.
std::vector<Ball> tube(const glm::dvec3& axis, double length, double width) {
  const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0.3, -0.2, 0.9))), v = glm::cross(axis, u);
  const double radius = 0.5 * width + 2.0;
  const int around = static_cast<int>(std::ceil(2.0 * std::numbers::pi * radius / 2.0));
  std::vector<Ball> balls;
  for (double along = -0.5 * length; along <= 0.5 * length; along += 2.0) {
    for (int n = 0; n < around; ++n) {
      const double angle = 2.0 * std::numbers::pi * n / around;
      balls.push_back({along * axis + radius * (std::cos(angle) * u + std::sin(angle) * v), 2.0});
    }
  }
  return balls;
}

TEST(ViewDirection, ChannelLooksAlongIt) {
  for (const glm::dvec3& axis : {glm::dvec3(0.6, 0.0, 0.8), glm::dvec3(0, -1, 0), glm::dvec3(-0.48, 0.6, 0.64)}) {
    const std::vector<Ball> balls = tube(axis, 40.0, 6.0);
    const glm::dvec3 end = -view_basis(parse_view_direction("channel").value(), {balls, balls, {}}).forward;
    EXPECT_GT(std::abs(glm::dot(end, axis)), std::cos(0.03));
    EXPECT_GE(end.z, -0.03);
    expect_near(view_basis(parse_view_direction("-channel").value(), {balls, balls, {}}).forward, end);
  }
}

TEST(ViewDirection, ChannelIsTheWidestOrThatOfTheAtomsNamed) {
  const std::vector<Ball> wide = tube({1, 0, 0}, 30.0, 8.0);
  std::vector<Ball> narrow = tube({0, 0, 1}, 30.0, 5.0);
  for (Ball& ball : narrow) ball.center.y += 40.0;
  std::vector<Ball> all = wide;
  all.insert(all.end(), narrow.begin(), narrow.end());
  const ViewDirection channel = parse_view_direction("channel").value();
  EXPECT_GT(std::abs(view_basis(channel, {all, all, {}}).forward.x), std::cos(0.03));
  EXPECT_GT(std::abs(view_basis(channel, {all, narrow, {}}).forward.z), std::cos(0.03));
  // Balls in the way count, too, at any distance.
  all.push_back({{0, 40, 60}, 10.0});
  EXPECT_THROW(view_basis(channel, {all, narrow, {}}), RequestError);
  const std::vector<Ball> one{{{0, 0, 0}, 5.0}};
  EXPECT_THROW(view_basis(channel, {one, one, {}}), RequestError);
}

TEST(ViewDirection, KnowsNoOtherWords) {
  for (const char* word : {"", "-", "w", "--x", "-front", "4", "X", "xy", "top ", "+z"})
    EXPECT_FALSE(parse_view_direction(word)) << word;
}

TEST(Turns, AreRightHandedAboutThePicturesAxes) {
  const ViewBasis usual{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  const auto after = [&](std::vector<Turn> turns) { return turned(usual, turns); };
  // y90 brings the front, z, to the right.
  expect_near(after({{1, 90.0}}).right, {0, 0, 1});
  // x90 brings the upper side, y, to the front.
  expect_near(after({{0, 90.0}}).forward, {0, -1, 0});
  // z90 brings the right side, x, upwards.
  expect_near(after({{2, 90.0}}).up, {1, 0, 0});
  // One turn follows another: Rx(-30) Ry(90), whose transpose has the axes of the picture as columns.
  const glm::dmat3 both = glm::transpose(rotation({1, 0, 0}, -30.0) * rotation({0, 1, 0}, 90.0));
  const ViewBasis turns = after({{1, 90.0}, {0, -30.0}});
  expect_near(turns.right, both[0]);
  expect_near(turns.up, both[1]);
  expect_near(-turns.forward, both[2]);
  EXPECT_EQ(parse_turn("x-30.5")->degrees, -30.5);
  EXPECT_EQ(parse_turn("z45")->axis, 2);
  for (const char* text : {"", "y", "90", "w90", "y 90", "y90x", "ynan", "y1e9", "90y"}) EXPECT_FALSE(parse_turn(text));
}

std::vector<RigidMotion> motions(std::vector<glm::dmat3> rotations) {
  std::vector<RigidMotion> result;
  for (const glm::dmat3& r : rotations) result.push_back({r, r * glm::dvec3(10, 2, 3)});
  return result;
}

TEST(SymmetryAxis, IsWhatMostCopiesTurnAbout) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -2)), two = glm::normalize(glm::dvec3(2, -1, 0));
  std::vector<glm::dmat3> ring, dihedral;
  for (int n = 0; n < 7; ++n) ring.push_back(rotation(axis, n * 360.0 / 7.0));
  for (const glm::dmat3& r : ring) dihedral.push_back(r);
  for (const glm::dmat3& r : ring) dihedral.push_back(r * rotation(two, 180.0));
  expect_near(symmetry_axis(motions(ring)).value(), -axis, 1e-9);
  expect_near(symmetry_axis(motions(dihedral)).value(), -axis, 1e-9);
  // A deposited frame that is turned itself changes nothing.
  for (glm::dmat3& r : ring) r = r * rotation({3, 1, 1}, 40.0);
  expect_near(symmetry_axis(motions(ring)).value(), -axis, 1e-9);
  EXPECT_FALSE(symmetry_axis({}));
  EXPECT_FALSE(symmetry_axis(motions({glm::dmat3(1.0), glm::dmat3(1.0)})));
  expect_near(symmetry_axis(motions({glm::dmat3(1.0), rotation({0, 0, 1}, 180.0)})).value(), {0, 0, 1}, 1e-9);
}

TEST(SymmetryAxis, OfAxesThatAreAlikeIsTheSameWhateverLastDigitsSay) {
  // The rotations of an icosahedron: six axes of five are alike, two of which are as near to z as each other.
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  const std::vector<glm::dmat3> generators{rotation(glm::normalize(glm::dvec3(1, 0, golden)), 72.0),
                                           rotation(glm::normalize(glm::dvec3(1, 1, 1)), 120.0)};
  std::vector<glm::dmat3> group{glm::dmat3(1.0)};
  const auto is_known = [&](const glm::dmat3& r) {
    return std::ranges::any_of(group, [&](const glm::dmat3& known) {
      return glm::length(known[0] - r[0]) + glm::length(known[1] - r[1]) < 1e-6;
    });
  };
  for (std::size_t n = 0; n < group.size(); ++n)
    for (const glm::dmat3& generator : generators)
      if (const glm::dmat3 made = generator * group[n]; !is_known(made)) group.push_back(made);
  ASSERT_EQ(group.size(), 60u);
  const glm::dvec3 expected = symmetry_axis(motions(group)).value();
  EXPECT_NEAR(expected.z, golden / std::sqrt(1.0 + golden * golden), 1e-9);
  for (int n = 0; n < 40; ++n) {
    std::vector<glm::dmat3> noisy = group;
    for (std::size_t r = 0; r < noisy.size(); ++r)
      noisy[r] = noisy[r] * rotation({0, 1, 0}, 1e-7 * std::sin(static_cast<double>(7 * r) + n));
    expect_near(symmetry_axis(motions(noisy)).value(), expected, 1e-6);
  }
}

std::string fault_of(const std::string& text) {
  try {
    parse_any_camera(text, "v", 1.5);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kChimeraX = "view matrix camera 0,0,1,40, 1,0,0,5, 0,1,0,6";

TEST(CameraFiles, AreToldApartByContent) {
  const Camera own = parse_any_camera(
      R"( {"position":[1,2,30],"target":[1,2,3],"up":[0,1,0],"projection":"orthographic","height":40})", "v", 1.5);
  EXPECT_EQ(own.height, 40.0);
  const Camera pymol = parse_any_camera("1 0 0 0 1 0 0 0 1  1 2 -50  3 4 5  10 90 0", "v", 1.5);
  EXPECT_EQ(pymol.position, glm::dvec3(2, 2, 55));
  EXPECT_EQ(pymol.target, glm::dvec3(2, 2, 5));
  EXPECT_EQ(pymol.vertical_fov, 20.0);
  EXPECT_EQ(parse_any_camera("1 0 0 0 1 0 0 0 1  0 0 -50  0 0 0  10 90 1", "v", 1.5).projection,
            Projection::orthographic);
  const Camera chimerax = parse_any_camera(kChimeraX, "v", 1.5);
  EXPECT_EQ(chimerax.position, glm::dvec3(40, 5, 6));
  expect_near(view_basis(chimerax).right, {0, 1, 0});
  expect_near(view_basis(chimerax).up, {0, 0, 1});
  expect_near(view_basis(chimerax).forward, {-1, 0, 0});
  // 30 degrees across.
  EXPECT_NEAR(half_extent(chimerax, 1.5).x, std::tan(std::numbers::pi / 12.0), 1e-12);
  // Models that were all carried along: the camera belongs to where their files have them.
  const Camera carried =
      parse_any_camera(kChimeraX + " models #1,1,0,0,7,0,1,0,0,0,0,1,0,#2,1,0,0,7,0,1,0,0,0,0,1,0", "v", 1.5);
  EXPECT_EQ(carried.position, glm::dvec3(33, 5, 6));
}

TEST(CameraFiles, SayWhatIsWrong) {
  EXPECT_EQ(fault_of("1 2 3"),
            "v: camera: this is not a camera: expected JSON, the 18 numbers of PyMOL's get_view (here are 3 words), or "
            "ChimeraX's `view matrix`");
  EXPECT_EQ(fault_of("1 0 0 0 1 0 0 0 x  1 2 -50  3 4 5  10 90 0"),
            "v: camera: 'x' is not a finite number of PyMOL's get_view");
  EXPECT_EQ(fault_of("2 0 0 0 1 0 0 0 1  1 2 -50  3 4 5  10 90 0"),
            "v: camera: the matrix of PyMOL's get_view is not a rotation");
  EXPECT_EQ(fault_of("1 0 0 0 1 0 0 0 1  1 2 50  3 4 5  10 90 0"),
            "v: camera: PyMOL's get_view has the molecule behind the camera");
  EXPECT_EQ(fault_of("view matrix camera 1,0,0"), "v: camera: ChimeraX's camera has fewer than 12 numbers");
  EXPECT_EQ(fault_of("view matrix camera 1,0,0,0,1,0,0,0,1,2,3,4"),
            "v: camera: the matrix of ChimeraX's camera is not a rotation");
  EXPECT_EQ(fault_of(kChimeraX + " shapes"), "v: camera: 'shapes' is not part of ChimeraX's `view matrix`");
  EXPECT_EQ(fault_of(kChimeraX + " models #1,1,0,0,7,0,1,0,0,0,0,1,0,#2,1,0,0,8,0,1,0,0,0,0,1,0"),
            "v: camera: ChimeraX has moved its models relative to each other, which one camera cannot show; reset "
            "their positions first");
  EXPECT_EQ(fault_of("{"), "v:1: camera: this is not JSON");
}

TEST(ViewRequests, FrameWhatIsAskedFor) {
  const std::vector<Ball> pocket{{{3, 3, 1}, 1}};
  ViewRequest request;
  const Camera all = view_camera(request, {}, {kLong, kLong, {}});
  expect_near(all.position, frame_camera(kLong, request.aspect()).position, 1e-15);
  request.turns = {{1, 40.0}};
  const Camera turned_camera = view_camera(request, {}, {kLong, kLong, {}});
  EXPECT_FALSE(sees_nothing(turned_camera, request.aspect(), kLong, 0.0));
  EXPECT_GT(glm::length(view_basis(turned_camera).forward - view_basis(all).forward), 0.5);
  // The camera is near the pocket, on the given side.
  Camera given;
  given.position = {0, 0, 100};
  request.turns.clear();
  EXPECT_EQ(view_camera(request, given, {kLong, kLong, {}}).position, given.position);
  request.zoom_to = parse_selection("all");
  const Camera near = view_camera(request, given, {kLong, pocket, {}});
  expect_near(view_basis(near).forward, {0, 0, -1});
  EXPECT_NEAR(near.position.x, 3.0, 1e-9);
  EXPECT_LT(near.position.z, 10.0);
  EXPECT_FALSE(sees_nothing(near, request.aspect(), pocket, 0.0));
  // Turned by hand: about the middle of what is shown, which stays where it was in the picture.
  request.zoom_to.reset();
  request.turns = {{0, 180.0}};
  const std::vector<Ball> pair{{{-1, 0, 5}, 1}, {{1, 0, 5}, 1}};
  expect_near(view_camera(request, given, {pair, pair, {}}).position, {0, 0, -90}, 1e-9);
}

TEST(SeesNothing, OnlyWhereThatIsCertain) {
  Camera camera;
  camera.position = {0, 0, 10};
  camera.vertical_fov = 90.0;
  const auto blind = [&](const glm::dvec3& center, double radius, double reach = 0.0) {
    const std::vector<Ball> balls{{center, radius}};
    return sees_nothing(camera, 2.0, balls, reach);
  };
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    camera.projection = projection;
    camera.height = 20.0;
    EXPECT_FALSE(blind({0, 0, 0}, 1));
    EXPECT_TRUE(blind({0, 0, 20}, 1));
    EXPECT_FALSE(blind({0, 0, 20}, 11));
    EXPECT_TRUE(blind({0, 12, 0}, 1));
    EXPECT_FALSE(blind({0, 12, 0}, 1, 1.5));
    EXPECT_FALSE(blind({12, 0, 0}, 1));  // The picture is wide.
    EXPECT_TRUE(blind({25, 0, 0}, 1));
    // The nearest of the four sides is met under an angle.
    EXPECT_EQ(blind({0, 11.2, 0}, 1), projection == Projection::orthographic);
  }
  const std::vector<Ball> one_of_two{{{0, 50, 0}, 1}, {{0, 0, 0}, 1}};
  EXPECT_FALSE(sees_nothing(camera, 2.0, one_of_two, 0.0));
}

}  // namespace
}  // namespace meniscus
