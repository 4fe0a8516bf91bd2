// SPDX-License-Identifier: BSD-3-Clause
// Computes the surface of balls on the device that a request chooses.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tbb/global_control.h>

#include "core/base/constants.h"
#include "core/base/progress.h"
#include "core/gpu/device_choice.h"
#include "core/math/ball.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Limits the number of threads while it exists; 0: all threads.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0)
      limit_.reset(
          new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)));
  }

 private:
  /// Keeps the limit if an exception passes: oneTBB that got no memory may hold a lock for ever, and ending the limit
  /// would wait for it. That is harmless because the whole program has one limit.
  struct End {
    void operator()(tbb::global_control* limit) const noexcept {
      if (std::uncaught_exceptions() == 0) delete limit;
    }
  };

  std::unique_ptr<tbb::global_control, End> limit_;
};

/// The kind of a surface of atoms.
enum class SurfaceKind {
  ses,  ///< solvent-excluded: the boundary of the volume that the probe cannot reach
  sas,  ///< solvent-accessible: the boundary of the balls of radius r + probe radius, where the probe's centre can be
  vdw   ///< van der Waals: the boundary of the balls themselves; no probe
};

/// Returns "ses", "sas" or "vdw".
const char* kind_word(SurfaceKind kind);

/// Returns what is wrong with a probe radius (Å) and what would be right; empty if it is valid.
std::string probe_fault(double radius);

/// The surface to be computed, and its device: the CPU, or a GPU through GL.
struct SurfaceRequest {
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = kUsualProbe;  ///< Å
  bool probe_named = false;           ///< true if the user set it; a van der Waals surface has none
  bool cpu = false;                   ///< true: on the CPU; false: on GL
  DeviceChoice gl;                    ///< automatic: a hardware GPU if there is one, else the CPU
  bool verify = false;                ///< true: compute on the other device too, and compare
  /// An additional check of each closed surface with `verify`, such as by its mesh; throws OpenSurfaceError. May be
  /// empty.
  std::function<void(const Surface&)> check;
  bool drawn = true;     ///< false: for numbers only, see ClipPlanes::left_out
  bool bordered = true;  ///< false: tables of vertices, borders and faces are not needed; large surfaces may lack them
  int threads = 0;       ///< CPU threads; 0: all
  StageTiming timing = StageTiming::rough;  ///< exact: times of stages are reported
};

/// Returns the growth of the balls (Å) before a probe rolls over them.
double growth_of(SurfaceKind kind, double probe_radius);
/// Returns the radius (Å) of the probe that rolls over the grown balls; 0: the surface is the balls' own.
double rolling_probe(SurfaceKind kind, double probe_radius);

/// Returns the balls with radii larger by `growth` (Å).
std::vector<Ball> grown(std::span<const Ball> balls, double growth);

/// Throws RequestError if the user set a probe for a surface that has none.
void require_probe_of_kind(const SurfaceRequest& request);

class EglContext;
class ReducedSurfaceEngine;

/// A surface, and the device and times of its computation.
struct ComputedSurface {
  Surface surface;
  std::string device;  ///< "cpu (16 threads)", or GL renderer and version
  std::vector<StageTime> stages;
};

/// Computes any number of surfaces on the requested device.
class SurfaceComputer {
 public:
  /// The automatic choice is a hardware GPU if there is one, else the CPU, which is faster than software GL. context: a
  /// current context, which must outlive this object; work on GL is done in it; nullptr: in a context of its own.
  /// Throws RequestError for a van der Waals surface with a probe.
  explicit SurfaceComputer(const SurfaceRequest& request, const EglContext* context = nullptr);
  ~SurfaceComputer();

  /// Returns the surface of van der Waals balls. Sas and vdw surfaces are made without a probe: of the grown balls, or
  /// of the balls themselves.
  /// With `verify` the surface is computed on the other device as well (software GL if necessary) and checked further,
  /// and every difference is an error. The caller must look at the surface's certificate. Throws OpenSurfaceError,
  /// CapacityError, GpuError.
  Surface compute(std::span<const Ball> balls);

  /// True if surfaces are computed on the CPU alone, so not verified by GL; then, and only then, compute() may run on
  /// any thread.
  bool is_on_cpu() const { return on_cpu_ && !request_.verify; }
  const std::string& device() const { return device_; }  ///< "cpu (16 threads)", or GL renderer and version
  /// Returns the times of all surfaces since the last restart.
  const std::vector<StageTime>& stages() const { return clock_.times(); }
  void restart_clock() { clock_.restart(); }
  /// look: called before each stage; an exception that it throws ends the computation.
  void before_stages(std::function<void()> look) { clock_.before_stages(std::move(look)); }

 private:
  bool find_hardware();
  std::unique_ptr<ReducedSurfaceEngine> make_engine(bool on_cpu, const DeviceChoice& gl) const;
  void verify(const Surface& surface, std::span<const Ball> balls, double probe_radius);

  SurfaceRequest request_;
  const EglContext* context_;
  ThreadLimit thread_limit_;
  bool on_cpu_;
  std::unique_ptr<ReducedSurfaceEngine> engine_, verifier_;  // verifier_: on the other device, with --verify only
  std::string device_;
  StageClock clock_;
};

/// Returns one closed surface. Throws like SurfaceComputer::compute, and OpenSurfaceError if the surface is not closed.
ComputedSurface compute_surface(std::span<const Ball> balls, const SurfaceRequest& request);

/// Returns the sum of the times of all stages, ms.
double total_ms(const std::vector<StageTime>& stages);

}  // namespace meniscus
