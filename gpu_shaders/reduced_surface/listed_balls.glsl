// SPDX-License-Identifier: BSD-3-Clause
// The balls whose neighbours are listed: every ball in order, or those that a view needs.

#ifdef LISTED
layout(binding = 2) uniform usamplerBuffer listed_balls;   // ascending
layout(binding = 3) uniform usamplerBuffer listed_before;  // per ball, and one more: how many listed ones come before it

// Entries, for so many balls.
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
