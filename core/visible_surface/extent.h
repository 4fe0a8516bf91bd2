// SPDX-License-Identifier: BSD-3-Clause
// How much of the surface a picture is made of.
#pragma once

namespace meniscus {

enum class Extent {
  complete,  ///< all of it
  visible,   ///< what can matter for a pixel (theorem 2): the same picture
  paper      ///< what Krone, Dachsbacher & Ertl 2010 select: faces in deep clefts may be missing
};

}  // namespace meniscus
