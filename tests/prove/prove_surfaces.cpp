// SPDX-License-Identifier: BSD-3-Clause
// prove_surfaces COUNT [FAMILY...] [--first N] [--effort N] [--write FOLDER]: cases N to N + COUNT - 1 of the families
// of balls made to tie, each surface checked; prints a line for each family and the sum, writes what failed as files.
// lost: something is missing; wrong: anything else that fails; refused: no surface, as given or turned; grown: radii
// grew to tell ties apart; tied: turned another surface, within the bounds of growth (turning.h). prove_surfaces
// --check FILE...: a line for each file of balls (tests/corpus). prove_surfaces --minimize FILE: leaves out balls while
// the surface still fails, or still needs to be helped over ties, and prints what is left: an entry for tests/corpus.
#include <tbb/parallel_for.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/prove/families.h"
#include "tests/prove/surface_check.h"

namespace meniscus::testing {
namespace {

struct Options {
  std::uint32_t count = 0, first = 0;
  int effort = 1;
  std::string folder;
  std::vector<std::string> families;
};

void write_case(const std::string& path, const FamilyCase& made, const std::string& why) {
  std::ofstream file(path);
  file << fmt::format("# probe {}: {}\n", made.probe_radius, why);
  for (const Ball& b : made.balls)
    file << fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", b.center.x, b.center.y, b.center.z, b.radius);
}

// Returns why an input is worth keeping: it fails, or its radii have to grow (core/surface/compute_surface.h).
std::string trouble_of(const CorpusCase& entry) {
  const SurfaceVerdict verdict = check_surface(entry.balls, entry.probe_radius, 1);
  if (verdict.refused) return "refused";
  if (!verdict.complaint.empty()) return "wrong";
  return verdict.surface->certificate.grown_by > 0 ? "ties" : "";
}

int check_file(const std::string& path) {
  const CorpusCase entry = read_corpus(path);
  const SurfaceVerdict verdict = check_surface(entry.balls, entry.probe_radius, 1, 2, Turned::too);
  const std::string words = verdict.refused ? "refused" : verdict.complaint.empty() ? "right" : verdict.complaint;
  fmt::print("{}: {} balls, probe {}: {}{}", path, entry.balls.size(), entry.probe_radius, words,
             verdict.tied ? ", tied" : "");
  if (verdict.surface)
    fmt::print("; area {}, volume {}, grown by {}", verdict.surface->area, verdict.surface->volume,
               verdict.surface->certificate.grown_by);
  fmt::print("\n");
  return verdict.complaint.empty() && !verdict.refused ? 0 : 1;
}

int minimize(const std::string& path) {
  CorpusCase entry = read_corpus(path);
  const std::string trouble = trouble_of(entry);
  for (bool again = !trouble.empty(); again;) {
    again = false;
    for (std::size_t n = 0; n < entry.balls.size(); ++n) {
      CorpusCase less = entry;
      less.balls.erase(less.balls.begin() + static_cast<std::ptrdiff_t>(n));
      if (less.balls.empty() || trouble_of(less) != trouble) continue;
      entry = std::move(less);
      again = true;
      --n;
    }
  }
  fmt::print("# probe {}: {}\n", entry.probe_radius, trouble.empty() ? "no trouble" : trouble);
  for (const Ball& b : entry.balls)
    fmt::print("{:.17g} {:.17g} {:.17g} {:.17g}\n", b.center.x, b.center.y, b.center.z, b.radius);
  return 0;
}

struct Tally {
  std::size_t cases = 0, lost = 0, wrong = 0, refused = 0, exact = 0, grown = 0, tied = 0;

  void add(const SurfaceVerdict& verdict, double jitter) {
    ++cases;
    grown += verdict.surface && verdict.surface->certificate.grown_by > 0;
    tied += verdict.tied;
    refused += verdict.refused;
    exact += verdict.refused && jitter == 0;
    lost += verdict.lost;
    wrong += !verdict.lost && !verdict.complaint.empty();
  }
  void add(const Tally& t) {
    cases += t.cases, lost += t.lost, wrong += t.wrong, refused += t.refused, exact += t.exact, grown += t.grown;
    tied += t.tied;
  }
  void print(const std::string& name) const {
    fmt::print("{:13} cases {:7} lost {:4} wrong {:4} refused {:4} (exact {}) grown {} tied {}\n", name, cases, lost,
               wrong, refused, exact, grown, tied);
    std::fflush(stdout);
  }
};

SurfaceVerdict verdict_of(const FamilyCase& made, std::uint32_t n, int effort) {
  try {
    const bool quick = n % 8 != 0 && effort == 1;
    return check_surface(made.balls, made.probe_radius, n + 1, quick ? 0 : effort, Turned::too);
  } catch (const std::exception& error) {
    SurfaceVerdict verdict;
    verdict.complaint = error.what();
    return verdict;
  }
}

int run(const Options& options) {
  Tally all;
  std::mutex lock;
  for (const std::string& family : options.families) {
    Tally tally;
    tbb::parallel_for(options.first, options.first + options.count, [&](std::uint32_t n) {
      const FamilyCase made = family_case(family, n);
      const SurfaceVerdict verdict = verdict_of(made, n, options.effort);
      const std::lock_guard guard(lock);
      tally.add(verdict, made.jitter);
      if (!verdict.refused && verdict.complaint.empty()) return;
      const std::string why = verdict.refused ? "refused" : (verdict.lost ? "lost: " : "") + verdict.complaint;
      fmt::print("  {} {} (probe {}, {} balls, jitter {:.1e}): {}\n", family, n, made.probe_radius, made.balls.size(),
                 made.jitter, why);
      if (!options.folder.empty()) write_case(fmt::format("{}/{}-{}.xyzr", options.folder, family, n), made, why);
    });
    tally.print(family);
    all.add(tally);
  }
  all.print("all");
  const bool good = all.lost + all.wrong == 0 && all.refused * 10000 <= all.cases;
  fmt::print("cases {} failures {}\n", all.cases, good ? 0 : all.lost + all.wrong + all.refused);
  return good ? 0 : 1;
}

}  // namespace
}  // namespace meniscus::testing

int main(int argc, char** argv) {
  meniscus::testing::Options options;
  for (int n = 1; n < argc; ++n) {
    const std::string word = argv[n];
    const auto value = [&] { return n + 1 < argc ? argv[++n] : ""; };
    if (word == "--minimize") return meniscus::testing::minimize(value());
    if (word == "--check") {
      int bad = 0;
      while (n + 1 < argc) bad |= meniscus::testing::check_file(value());
      return bad;
    }
    if (word == "--first")
      options.first = static_cast<std::uint32_t>(std::atoi(value()));
    else if (word == "--effort")
      options.effort = std::atoi(value());
    else if (word == "--write")
      options.folder = value();
    else if (n == 1)
      options.count = static_cast<std::uint32_t>(std::atoi(word.c_str()));
    else
      options.families.push_back(word);
  }
  if (options.families.empty()) options.families = meniscus::testing::family_names();
  return meniscus::testing::run(options);
}
