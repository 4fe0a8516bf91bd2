// SPDX-License-Identifier: BSD-3-Clause
// Test text with an error in its fourth line, to see where a compiler's log puts it.

float broken() { return undeclared_name; }
