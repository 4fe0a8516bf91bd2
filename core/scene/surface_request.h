// SPDX-License-Identifier: BSD-3-Clause
// A request for a surface: its kind, its probe, and the device that computes it.
#pragma once

#include <functional>
#include <string>

#include "core/base/stage_clock.h"
#include "core/base/usual_probe.h"
#include "core/gpu/device_choice.h"

namespace meniscus {

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

}  // namespace meniscus
