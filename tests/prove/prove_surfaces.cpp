// SPDX-License-Identifier: BSD-3-Clause
// prove_surfaces COUNT [FAMILY...] [--first N] [--effort N] [--write FOLDER]: the families of balls made to tie, each
// surface checked; prints a line for each family and the sum, writes what failed as files.
// prove_surfaces --minimize FILE: leaves out balls while the surface still fails, or still needs to be helped over
// ties, and prints what is left: an entry for tests/corpus.
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <string>
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

// What is worth keeping of an input: it fails, or its radii have to grow (core/surface/tie_ladder.h).
std::string trouble_of(const CorpusCase& entry) {
  const SurfaceVerdict verdict = check_surface(entry.balls, entry.probe_radius, 1);
  if (verdict.refused) return "refused";
  if (!verdict.complaint.empty()) return "wrong";
  return verdict.surface->certificate.grown_by > 0 ? "ties" : "";
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

int run(const Options& options) {
  std::size_t cases = 0, wrong = 0, refused = 0;
  std::mutex lock;
  for (const std::string& family : options.families) {
    std::atomic<std::size_t> grown = 0;
    std::size_t family_wrong = 0, family_refused = 0, exact_refused = 0;
    tbb::parallel_for(options.first, options.first + options.count, [&](std::uint32_t n) {
      const FamilyCase made = family_case(family, n);
      SurfaceVerdict verdict;
      try {
        const bool quick = n % 8 != 0 && options.effort == 1;
        verdict = check_surface(made.balls, made.probe_radius, n + 1, quick ? 0 : options.effort);
      } catch (const std::exception& error) {
        verdict.complaint = error.what();
      }
      if (verdict.surface && verdict.surface->certificate.grown_by > 0) ++grown;
      if (!verdict.refused && verdict.complaint.empty()) return;
      const std::lock_guard guard(lock);
      (verdict.refused ? family_refused : family_wrong)++;
      exact_refused += verdict.refused && made.jitter == 0;
      const std::string why = verdict.refused ? "refused" : verdict.complaint;
      fmt::print("  {} {} (probe {}, {} balls, jitter {:.1e}): {}\n", family, n, made.probe_radius, made.balls.size(),
                 made.jitter, why);
      if (!options.folder.empty()) write_case(fmt::format("{}/{}-{}.xyzr", options.folder, family, n), made, why);
    });
    fmt::print("{:12} cases {:7} wrong {:4} refused {:4} (exact {}) grown {}\n", family, options.count, family_wrong,
               family_refused, exact_refused, grown.load());
    std::fflush(stdout);
    cases += options.count;
    wrong += family_wrong;
    refused += family_refused;
  }
  const bool good = wrong == 0 && refused * 10000 <= cases;
  fmt::print("refused {} of {}\ncases {} failures {}\n", refused, cases, cases, good ? 0 : wrong + refused);
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
