// SPDX-License-Identifier: BSD-3-Clause
// Computes the surface of balls on the device that a request chooses.
#pragma once

#include <exception>

#include <tbb/global_control.h>

#include "core/base/constants.h"
#include "core/base/progress.h"
#include "core/gpu/device_choice.h"
#include "core/math/ball.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Limits the number of threads of the whole program while it exists; 0: no limit. If there are several limits, the
/// smallest applies.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0)
      limit_.reset(
          new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)));
  }

 private:
  /// Leaves the limit in force if an exception is passing: when memory runs out, oneTBB may keep a lock for ever, and
  /// the end of the limit would wait for it. That is harmless because the whole program has one number of threads.
  struct End {
    void operator()(tbb::global_control* limit) const noexcept {
      if (std::uncaught_exceptions() == 0) delete limit;
    }
  };

  std::unique_ptr<tbb::global_control, End> limit_;
};

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
  /// The choice of GL device if `cpu` is false; automatic: a hardware GPU if there is one, else the CPU.
  DeviceChoice gl;
  bool verify = false;  ///< true: compute on the other device too, and compare
  /// With `verify` only: a further check of each closed surface, for example of its mesh. It throws OpenSurfaceError
  /// for a faulty surface. May be empty.
  std::function<void(const Surface&)> check;
  ClipPlanes planes = ClipPlanes::listed;  ///< left_out: for numbers only; with `verify` they are always listed
  /// False: a surface of very many atoms may come without its tables of vertices, borders and faces (Surface::sums),
  /// which saves memory on the CPU.
  bool bordered = true;
  int threads = 0;  ///< CPU threads; 0: all
  /// How exactly times are assigned to stages; exact times cost time on a GPU.
  StageTiming timing = StageTiming::rough;
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
  /// The automatic choice is a hardware GPU if there is one, else the CPU, which is faster than software GL. `context`
  /// is a current GL context that must outlive this object; GL work is done in it. If it is nullptr, this object makes
  /// its own. Throws RequestError for a van der Waals surface with a probe.
  explicit SurfaceComputer(const SurfaceRequest& request, const EglContext* context = nullptr);
  ~SurfaceComputer();

  /// Returns the surface of van der Waals balls, whose radii this function enlarges for an accessible surface. The
  /// surface may have open places: the caller must check Surface::certificate (certificate.closed is true for a closed
  /// surface). With `verify` the surface is also computed on the other device, by software GL if necessary. Throws
  /// OpenSurfaceError for any difference between the devices and for a fault that request.check finds, CapacityError if
  /// there is too much to compute, and GpuError if GL fails.
  Surface compute(std::span<const Ball> balls);

  /// True if surfaces are computed on the CPU alone, without a check by GL. Only then may compute() run on any thread.
  bool is_on_cpu() const { return on_cpu_ && !request_.verify; }
  const std::string& device() const { return device_; }  ///< "cpu (16 threads)", or GL renderer and version
  /// Returns the times of all surfaces since the last restart_clock().
  const std::vector<StageTime>& stages() const { return clock_.times(); }
  void restart_clock() { clock_.restart(); }
  /// Sets a function that is called before each stage. An exception that it throws ends the computation.
  void before_stages(std::function<void()> look) { clock_.before_stages(std::move(look)); }

 private:
  /// True if the automatic choice is a hardware GPU. If it has to make a context for that, it keeps the engine.
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

/// Returns one closed surface. Throws OpenSurfaceError if the surface is not closed, and what
/// SurfaceComputer::compute() throws.
ComputedSurface compute_surface(std::span<const Ball> balls, const SurfaceRequest& request);

double total_ms(const std::vector<StageTime>& stages);

}  // namespace meniscus
