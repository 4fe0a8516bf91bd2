// SPDX-License-Identifier: BSD-3-Clause
// The C interface from many threads at once, and in a child that fork() made.
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "core/surface/compute_surface.h"
#include "tests/c_api/c_objects.h"

namespace meniscus {
namespace {

using namespace test;

constexpr int kThreads = 8;

/// Runs the work on eight threads that begin together; returns how many of them were right.
template <typename Work>
int right_on_threads(const Work& work) {
  std::atomic<int> waiting{kThreads}, right{0};
  std::vector<std::thread> threads;
  for (int n = 0; n < kThreads; ++n)
    threads.emplace_back([&, n] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      if (work(n)) ++right;
    });
  for (std::thread& thread : threads) thread.join();
  return right;
}

TEST(CApiThreads, EightWithComputersOfTheirOwnAgree) {
  const testing::Balls balls = testing::ubiquitin();
  const double area = compute_surface_cpu(balls, 1.4).area;
  EXPECT_EQ(right_on_threads([&](int n) {
              meniscus_options options = default_options();
              options.threads = n % 3;  // all threads, one, two
              const Computer own = computer(options);
              bool right = true;
              for (int k = 0; k < 3; ++k) right = right && summary_of(computed(own.get(), balls)).area == area;
              return right;
            }),
            kThreads);
}

TEST(CApiThreads, EightShareOneComputerAndOneSurface) {
  const testing::Balls balls = testing::ubiquitin();
  const Surface direct = compute_surface_cpu(balls, 1.4);
  const Computer shared = computer();
  const SurfaceOf surface = computed(shared.get(), balls);
  EXPECT_EQ(right_on_threads([&](int n) {
              if (n % 2 == 0) return summary_of(computed(shared.get(), balls)).area == direct.area;
              const std::vector<double> areas = rows_of<double>(surface, MENISCUS_ATOM_AREAS);
              const double point[3] = {balls[0].center.x, balls[0].center.y, balls[0].center.z};
              double distance = 1.0;
              return areas.size() == balls.size() &&
                     meniscus_surface_distance(surface.get(), 1, point, &distance, nullptr) == MENISCUS_OK &&
                     distance < 0.0;
            }),
            kThreads);
}

TEST(CApiThreads, EachThreadHasItsOwnLastError) {
  EXPECT_EQ(right_on_threads([](int n) {
              double radius = 0.0;
              if (meniscus_element_radius(1000 + n, &radius, nullptr) != MENISCUS_INPUT) return false;
              return std::string(meniscus_last_error()).find(std::to_string(1000 + n)) != std::string::npos;
            }),
            kThreads);
}

TEST(CApiThreads, AChildOfForkGoesOnComputing) {
  const testing::Balls balls = testing::ubiquitin();
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  const double area = summary_of(surface).area;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::alarm(60);  // The alarm ends a child that waits for missing threads.
    const SurfaceOf again = computed(made.get(), balls);
    const bool right =
        again && summary_of(again).area == area && rows_of<double>(again, MENISCUS_ATOM_AREAS).size() == balls.size();
    ::_exit(right ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

}  // namespace
}  // namespace meniscus
