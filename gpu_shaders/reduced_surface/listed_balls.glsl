// SPDX-License-Identifier: BSD-3-Clause
// The balls whose neighbours are listed: all balls in order, or those that a view needs.

#ifdef LISTED
layout(binding = 2) uniform usamplerBuffer listed_balls;   // ascending
layout(binding = 3) uniform usamplerBuffer listed_before;  // number of listed balls before each ball and before the end

// Returns the number of entries for the first `ball_count` balls.
uint entries_of(uint ball_count) { return texelFetch(listed_before, int(ball_count)).x; }

uint ball_of(uint entry) { return texelFetch(listed_balls, int(entry)).x; }

bool is_listed(uint ball) {
  return texelFetch(listed_before, int(ball) + 1).x != texelFetch(listed_before, int(ball)).x;
}
#else
uint entries_of(uint ball_count) { return ball_count; }

uint ball_of(uint entry) { return entry; }

bool is_listed(uint ball) { return true; }
#endif
