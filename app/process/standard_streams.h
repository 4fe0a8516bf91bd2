// SPDX-License-Identifier: BSD-3-Clause
// Standard input, output and error, which may be closed, full or broken.
#pragma once

namespace meniscus {

/// Call first. A standard stream that is closed gets a descriptor that nothing can be read from or written to, lest the
/// next file opened takes its number and messages are written into it.
void hold_standard_streams();

/// Throws OutputError unless all that was printed has been taken. (What is said on standard error is no result: if it
/// cannot be said, the program goes on.)
void finish_standard_output();

}  // namespace meniscus
