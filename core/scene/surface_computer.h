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

/// Holds as long as it lives; 0: all threads.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0)
      limit_.reset(
          new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)));
  }

 private:
  /// Not when an exception passes: oneTBB that got no memory may hold a lock for ever, and would wait for it. The limit
  /// stays in force then, as all of a program have the same.
  struct End {
    void operator()(tbb::global_control* limit) const noexcept {
      if (std::uncaught_exceptions() == 0) delete limit;
    }
  };

  std::unique_ptr<tbb::global_control, End> limit_;
};

struct Surface;

/// Which surface of the atoms.
enum class SurfaceKind {
  ses,  ///< solvent-excluded: what the probe cannot reach
  sas,  ///< solvent-accessible: where the probe's centre can be; the boundary of the balls of radius r + probe radius
  vdw   ///< van der Waals: the boundary of the balls themselves; no probe
};

/// "ses", "sas" or "vdw".
const char* kind_word(SurfaceKind kind);

/// What is wrong with a probe radius (Å) and what would be right; empty if nothing is.
std::string probe_fault(double radius);

/// Which surface is computed, and where: on the CPU, or through GL.
struct SurfaceRequest {
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = kUsualProbe;  ///< Å
  bool probe_named = false;           ///< whether someone asked for it; a van der Waals surface has none
  bool cpu = false;                   ///< on the CPU; else on GL
  DeviceChoice gl;                    ///< automatic: a hardware GPU if there is one, else the CPU
  bool verify = false;                ///< compute on the other device too and compare
  /// With `verify`, a further look at each closed surface, such as by its mesh; throws OpenSurfaceError. May be empty.
  std::function<void(const Surface&)> check;
  bool drawn = true;     ///< false: for numbers only, see ClipPlanes::left_out
  bool bordered = true;  ///< false: nobody needs tables of vertices, borders and faces; large surfaces may lack them
  int threads = 0;       ///< CPU threads; 0: all
  StageTiming timing = StageTiming::rough;  ///< exact: someone looks at the times of stages
};

/// What the balls grow by (Å) before a probe rolls over them.
double growth_of(SurfaceKind kind, double probe_radius);
/// The radius (Å) of the probe that rolls over the grown balls; 0: the surface is theirs.
double rolling_probe(SurfaceKind kind, double probe_radius);

/// The balls with radii larger by `growth` (Å).
std::vector<Ball> grown(std::span<const Ball> balls, double growth);

/// Throws RequestError where a probe is named for a surface that has none.
void require_probe_of_kind(const SurfaceRequest& request);

class EglContext;
class ReducedSurfaceEngine;

/// A surface and how it came to be.
struct ComputedSurface {
  Surface surface;
  std::string device;  ///< "cpu (16 threads)", or GL renderer and version
  std::vector<StageTime> stages;
};

/// Computes any number of surfaces on the device that was asked for.
class SurfaceComputer {
 public:
  /// Automatic takes a hardware GPU if there is one, else the CPU, which is faster than software GL. What runs on GL
  /// runs in `context`, if there is one: it is current and lives longer; else in a context of its own. Throws
  /// RequestError for a van der Waals surface with a probe.
  explicit SurfaceComputer(const SurfaceRequest& request, const EglContext* context = nullptr);
  ~SurfaceComputer();

  /// balls: van der Waals. Sas and vdw surfaces are made of balls without a probe: of these grown, or of these.
  /// With `verify` the surface is computed on the other device as well (software GL if need be) and checked further,
  /// and every difference is an error. Look at its certificate. Throws OpenSurfaceError, CapacityError, GpuError.
  Surface compute(std::span<const Ball> balls);

  /// Whether surfaces are made on the CPU alone, so not verified by GL; then, and only then, on any thread.
  bool is_on_cpu() const { return on_cpu_ && !request_.verify; }
  const std::string& device() const { return device_; }  ///< "cpu (16 threads)", or GL renderer and version
  const std::vector<StageTime>& stages() const { return clock_.times(); }  ///< of all surfaces since the last restart
  void restart_clock() { clock_.restart(); }
  /// look: called before each stage; what it throws ends the computation.
  void before_stages(std::function<void()> look) { clock_.before_stages(std::move(look)); }

 private:
  bool find_hardware();
  std::unique_ptr<ReducedSurfaceEngine> make_engine(bool on_cpu, const DeviceChoice& gl) const;
  void verify(const Surface& surface, std::span<const Ball> balls, double probe_radius);

  SurfaceRequest request_;
  const EglContext* context_;
  ThreadLimit thread_limit_;
  bool on_cpu_;
  std::unique_ptr<ReducedSurfaceEngine> engine_, verifier_;  // verifier_: with --verify, on the other device
  std::string device_;
  StageClock clock_;
};

/// One closed surface. Throws what SurfaceComputer::compute throws, and OpenSurfaceError if it is not closed.
ComputedSurface compute_surface(std::span<const Ball> balls, const SurfaceRequest& request);

/// The sum of all stages.
double total_ms(const std::vector<StageTime>& stages);

}  // namespace meniscus
