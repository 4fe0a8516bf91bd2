// SPDX-License-Identifier: BSD-3-Clause
// The C interface gets calls in any order, with arguments from a list that has bad ones in it. Each byte picks a call
// or an argument.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <meniscus/meniscus.h>

#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMostCalls = 40, kRows = 12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Makes choices from bytes; without bytes, the first of each list.
class Choices {
 public:
  explicit Choices(std::string_view bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  std::size_t below(std::size_t count) {
    if (rest_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte % count;
  }
  template <typename Value, std::size_t Count>
  Value of(const Value (&list)[Count]) {
    return list[below(Count)];
  }
  std::int32_t word(std::int32_t most) {
    return static_cast<std::int32_t>(below(static_cast<std::size_t>(most) + 3)) - 1;
  }
  bool yes() { return below(2) == 1; }

 private:
  std::string_view rest_;
};

/// The caller's references to objects of one kind, which are released at the end.
template <typename Object, void (*Release)(Object*), Object* (*Retain)(Object*)>
class Held {
 public:
  Held() = default;
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    for (Object* object : held_) Release(object);
  }
  /// Returns one of the objects or NULL.
  Object*& any(Choices& choices) { return held_[choices.below(held_.size())]; }
  void put(Choices& choices, Object* object) {
    Object*& place = any(choices);
    Release(place);
    place = object;
  }
  void share(Choices& choices) { put(choices, Retain(any(choices))); }

 private:
  std::array<Object*, 3> held_{};
};

class Caller {
 public:
  explicit Caller(std::string_view bytes) : choices_(bytes) {
    for (std::size_t n = 0; n < memory_.size(); ++n)
      memory_[n] = 0.37 * static_cast<double>(n % 7) + 0.9 * (n % 4 == 3);
  }

  void run() {
    for (std::size_t call = 0; call < kMostCalls && !choices_.empty(); ++call) (this->*choices_.of(kCalls))();
  }

 private:
  using Call = void (Caller::*)();
  static const Call kCalls[20];

  /// Checks that a status is known, has a sentence unless all went well, and is no fault of the library.
  bool done(meniscus_status status) {
    require(status >= MENISCUS_OK && status <= MENISCUS_NOT_CLOSED, "a status is one of the header");
    require(status != MENISCUS_INTERNAL, "no call finds a fault of the library");
    if (status != MENISCUS_OK) require_clear(std::runtime_error(meniscus_last_error()));
    return status == MENISCUS_OK;
  }

  template <typename Struct>
  const Struct* optional(Struct& options, meniscus_status (*defaults)(Struct*)) {
    options.size = sizeof options;
    done(defaults(&options));
    options.size = choices_.of({sizeof options, sizeof options, std::size_t{0}, kMost});
    return choices_.yes() ? nullptr : &options;
  }

  void make_computer() {
    meniscus_options options{};
    const meniscus_options* const wanted = optional(options, meniscus_default_options);
    options.probe_radius = choices_.of({1.4, 0.0, 0.5, 5.0, -1.0, 1e300, kNoNumber});
    options.kind = meniscus_kind{choices_.word(2)};
    options.device = meniscus_device{choices_.of({0, 0, 0, -1, 7})};
    options.threads = choices_.of({0, 1, 2, -1, 1 << 20});
    meniscus_computer* made = nullptr;
    keep(computers_, meniscus_computer_new(wanted, rarely_null(&made)), made);
  }

  template <typename Object>
  Object* rarely_null(Object* object) {
    return choices_.below(9) == 8 ? nullptr : object;
  }
  template <typename Held, typename Object>
  void keep(Held& held, meniscus_status status, Object* const& made) {
    if (done(status))
      held.put(choices_, made);
    else
      require(made == nullptr, "what fails makes nothing");
  }

  std::size_t stride() {
    return choices_.of({0ul, 32ul, 24ul, 8ul, 16ul, 12ul, 4ul, 7ul, kMost, kMost - 7, kMost / 2 + 1, kMost / 3});
  }
  std::size_t count() { return choices_.of({2ul, kRows, 1ul, 0ul, 5ul, kMost, kMost / 8, kMost / 24 + 1}); }
  double* place() {
    double* const aligned = memory_.data() + choices_.of({0, 3, 8});
    switch (choices_.below(8)) {
      case 6:
        return nullptr;
      case 7:
        return reinterpret_cast<double*>(reinterpret_cast<unsigned char*>(aligned) + 1);
      default:
        return aligned;
    }
  }

  void compute() {
    meniscus_atoms atoms{};
    atoms.size = choices_.of({sizeof atoms, sizeof atoms, sizeof atoms, sizeof(std::size_t) + 1, kMost});
    atoms.count = count();
    atoms.positions = place();
    atoms.radii = place();
    atoms.positions_stride = stride();
    atoms.radii_stride = stride();
    atoms.positions_type = meniscus_number_type{choices_.of({0, 0, 1, 2})};
    atoms.radii_type = meniscus_number_type{choices_.of({0, 0, 1, -1})};
    atoms.equal_radii = choices_.yes();
    atoms.reserved = choices_.of({0, 0, 0, 1});
    meniscus_computer* const computer = computers_.any(choices_);
    meniscus_surface*& surface = surfaces_.any(choices_);
    meniscus_surface* const before = surface;
    const auto call = surface ? meniscus_recompute : meniscus_compute;
    if (!done(call(computer, rarely_null(&atoms), &surface))) {
      require(surface == before, "what fails leaves the surface as it was");
      return;
    }
    meniscus_summary summary{};
    summary.size = sizeof summary;
    require(done(meniscus_surface_summary(surface, &summary)), "a surface has a summary");
    require(std::isfinite(summary.area) && summary.area > 0.0 && std::isfinite(summary.volume), "measures are numbers");
    require(summary.atoms == atoms.count, "all atoms are there");
  }

  void summarize() {
    meniscus_summary summary{};
    summary.size = choices_.of({sizeof summary, std::size_t{0}, std::size_t{24}, std::size_t{5000}});
    meniscus_surface* const surface = surfaces_.any(choices_);
    done(meniscus_surface_summary(surface, rarely_null(&summary)));
  }

  /// Reads every byte of the array.
  void read(const meniscus_array& array) {
    require(array.count == 0 || array.data, "rows stand somewhere");
    const auto* const bytes = static_cast<const unsigned char*>(array.data);
    for (std::size_t n = 0; n < array.count * array.stride; ++n) sum_ += bytes[n];
  }
  template <typename Held, typename Function, typename Table>
  void look(Held& held, Function function, Table last) {
    meniscus_array array{};
    auto* const object = held.any(choices_);
    const Table table{choices_.word(last)};
    if (done(function(object, table, rarely_null(&array)))) read(array);
  }
  void look_at_surface() { look(surfaces_, meniscus_surface_table, MENISCUS_FACES); }
  void look_at_mesh() { look(meshes_, meniscus_mesh_table, MENISCUS_MESH_VERTEX_ATOMS); }
  void look_at_pockets() { look(pockets_, meniscus_pockets_table, MENISCUS_POCKET_PROBES); }

  void measure_distances() {
    std::vector<double> results(4 * kRows);
    double* const distances = choices_.of({results.data(), results.data(), results.data() + 3 * kRows - 1,
                                           memory_.data(), static_cast<double*>(nullptr)});
    double* const nearest =
        choices_.of({static_cast<double*>(nullptr), results.data() + kRows, results.data(), memory_.data()});
    const std::size_t asked = count();
    double* const points = place();
    const std::vector<double> before = memory_;
    if (done(meniscus_surface_distance(surfaces_.any(choices_), asked, points, distances, nearest)) && asked > 0)
      require(std::isfinite(distances[0]), "distances are numbers");
    memory_ = before;
  }

  void derive() {
    meniscus_surface* const surface = surfaces_.any(choices_);
    std::vector<double> gradient(3 * kRows);
    double* const weights = choices_.yes() ? place() : nullptr;
    const meniscus_quantity quantity{choices_.word(3)};
    done(meniscus_surface_gradient(surface, quantity, weights, rarely_null(gradient.data())));
  }

  void find_pockets() {
    meniscus_pocket_options options{};
    const meniscus_pocket_options* const wanted = optional(options, meniscus_default_pocket_options);
    options.large_probe_radius = choices_.of({4.0, 2.0, 0.1, 1e9, kNoNumber});
    options.mouth_tolerance = choices_.of({0.5, 1.0, 0.0, -kInfinity});
    meniscus_pockets* found = nullptr;
    keep(pockets_, meniscus_surface_pockets(surfaces_.any(choices_), wanted, &found), found);
  }

  void make_mesh() {
    meniscus_mesh_options options{};
    const meniscus_mesh_options* wanted = optional(options, meniscus_default_mesh_options);
    if (!wanted) wanted = &options;  // The default is fine, and slow.
    options.tolerance = choices_.of({0.3, 1.0, 0.0, kNoNumber});
    options.density = choices_.of({0.0, 0.5, -1.0, kInfinity});
    const bool even = choices_.yes();
    options.method = options.density != 0.0 ? MENISCUS_MESH_BY_DENSITY
                     : even                 ? MENISCUS_MESH_EVEN
                                            : MENISCUS_MESH_BY_PATCH;
    if (options.density != 0.0) options.tolerance = 0.01;
    options.split_colors = choices_.yes();
    meniscus_mesh* made = nullptr;
    keep(meshes_, meniscus_surface_mesh(surfaces_.any(choices_), wanted, &made), made);
  }

  void save_mesh() {
    static const ScratchFile scratch("mesh");
    meniscus_mesh_file file{};
    const meniscus_mesh_file* const wanted = optional(file, meniscus_default_mesh_file);
    file.format = choices_.of({"ply", "stl", "glb", "3mf", "vtp", "smesh", "step", ""});
    file.attributes = choices_.of({"usual", "all", "none", "charge", ",", "\xff"});
    file.atom_colors = choices_.yes() ? reinterpret_cast<const float*>(place()) : nullptr;
    file.scale = choices_.of({1.0, 1e-3, 0.0, kNoNumber});
    file.replace = 1;
    meniscus_mesh* const mesh = meshes_.any(choices_);
    done(meniscus_mesh_save(mesh, rarely_null(scratch.write("").c_str()), wanted));
  }

  void paint() {
    meniscus_camera camera{};
    camera.size = sizeof camera;
    meniscus_surface* const surface = surfaces_.any(choices_);
    const double aspect = choices_.of({1.0, 0.0, kNoNumber});
    const meniscus_projection projection{choices_.word(1)};
    const bool framed = done(meniscus_surface_camera(surface, aspect, projection, &camera));
    const meniscus_camera* const seen_by = framed || choices_.yes() ? &camera : nullptr;
    const float* const colors = choices_.yes() ? reinterpret_cast<const float*>(place()) : nullptr;
    std::vector<std::uint8_t> rgba(80);
    const std::size_t room = choices_.of({std::size_t{80}, std::size_t{3}, kMost});
    meniscus_renderer* const renderer = renderers_.any(choices_);
    meniscus_scene* const scene = scenes_.any(choices_);
    if (scene) set(scene, "size", choices_.of({"5x4", "1x1", "4x5"}));  // Larger pictures take long.
    done(choices_.yes() ? meniscus_render_scene(renderer, scene, rgba.data(), room)
                        : meniscus_render(renderer, surface, scene, seen_by, colors, rgba.data(), room));
  }

  void make_scene() {
    meniscus_scene* made = nullptr;
    if (choices_.yes()) return keep(scenes_, meniscus_scene_new(rarely_null(&made)), made);
    const char* const json =
        choices_.of({R"({"meniscus_scene": 1, "look": {"depth_cue": 0.5}})", R"({"meniscus_scene": 2})", "{", "",
                     R"({"meniscus_scene": 1, "objects": [{"clip": "z<0"}]})", static_cast<const char*>(nullptr)});
    keep(scenes_, meniscus_scene_parse(json, rarely_null(&made)), made);
  }

  bool set(meniscus_scene* scene, const char* name, const char* value) {
    return done(meniscus_scene_set(scene, name, value));
  }
  /// Sets any property to a text that may be one of its values, or one of another property's.
  void set_value() {
    meniscus_array table{};
    require(done(meniscus_scene_properties(&table)), "there is a table of properties");
    const auto* const rows = static_cast<const meniscus_property*>(table.data);
    const meniscus_property& property = rows[choices_.below(table.count)];
    const char* const value = choices_.of({"1", "true", "0.5pt", "all", "white", "", "-1e300", "\xff", "chain A=red",
                                           "1x1", "z<0", property.initial, static_cast<const char*>(nullptr), "false"});
    meniscus_scene* const scene = scenes_.any(choices_);
    set(scene, choices_.of({property.name, property.key, "", "\xc3"}), value);
  }
  void look_at_scene() {
    meniscus_scene* const scene = scenes_.any(choices_);
    const char* text = nullptr;
    if (done(meniscus_scene_json(scene, choices_.of({static_cast<const char*>(nullptr), "", "/", "\xff"}),
                                 rarely_null(&text)))) {
      meniscus_scene* again = nullptr;
      keep(scenes_, meniscus_scene_parse(text, &again), again);
    }
    meniscus_scene* const asked = scenes_.any(choices_);  // The earlier scene may be gone.
    if (done(meniscus_scene_get(asked, choices_.of({"label", "look.preset", "none"}), choices_.below(3),
                                rarely_null(&text))) &&
        text)
      sum_ += static_cast<unsigned>(std::strlen(text));
  }

  void make_renderer() {
    meniscus_renderer* made = nullptr;
    keep(renderers_, meniscus_renderer_new(meniscus_device{choices_.of({0, 0, -1, 9})}, &made), made);
  }

  void name_element() {
    std::int32_t element = 0;
    double radius = 0.0;
    const char* source = nullptr;
    done(meniscus_element_of_symbol(choices_.of({"C", "zn", "", "\xc3", "Xx", static_cast<const char*>(nullptr)}),
                                    &element));
    if (done(meniscus_element_radius(choices_.yes() ? element : choices_.of({118, 119, -1, 0}), &radius, &source)))
      require(radius > 0.0 && source && *source, "elements have a radius, and it has a source");
  }

  void share() {
    switch (choices_.below(6)) {
      case 0:
        return computers_.share(choices_);
      case 1:
        return surfaces_.share(choices_);
      case 2:
        return meshes_.share(choices_);
      case 3:
        return pockets_.share(choices_);
      case 4:
        return scenes_.share(choices_);
      default:
        return renderers_.share(choices_);
    }
  }
  void let_go() {
    computers_.put(choices_, nullptr);
    surfaces_.put(choices_, nullptr);
    meshes_.put(choices_, nullptr);
    scenes_.put(choices_, nullptr);
  }

  Choices choices_;
  /// Rows of x, y, z, radius as far as any stride of the list reaches.
  std::vector<double> memory_ = std::vector<double>(4 * kRows + 16);
  Held<meniscus_computer, meniscus_computer_release, meniscus_computer_retain> computers_;
  Held<meniscus_surface, meniscus_surface_release, meniscus_surface_retain> surfaces_;
  Held<meniscus_mesh, meniscus_mesh_release, meniscus_mesh_retain> meshes_;
  Held<meniscus_pockets, meniscus_pockets_release, meniscus_pockets_retain> pockets_;
  Held<meniscus_renderer, meniscus_renderer_release, meniscus_renderer_retain> renderers_;
  Held<meniscus_scene, meniscus_scene_release, meniscus_scene_retain> scenes_;
  unsigned sum_ = 0;
};

const Caller::Call Caller::kCalls[20] = {&Caller::make_computer,   &Caller::compute,
                                         &Caller::compute,         &Caller::summarize,
                                         &Caller::look_at_surface, &Caller::look_at_mesh,
                                         &Caller::make_mesh,       &Caller::look_at_pockets,
                                         &Caller::find_pockets,    &Caller::measure_distances,
                                         &Caller::derive,          &Caller::save_mesh,
                                         &Caller::make_renderer,   &Caller::paint,
                                         &Caller::name_element,    &Caller::share,
                                         &Caller::let_go,          &Caller::make_scene,
                                         &Caller::set_value,       &Caller::look_at_scene};

void run_c_api(std::string_view bytes) { Caller(bytes).run(); }

const Registration registered_c_api{"c_api", run_c_api};

}  // namespace
}  // namespace meniscus::fuzz
