#pragma once

namespace onestroke::test {

/// Calls of operator new since the program began, by the calling thread or by all threads. A program that links this
/// counts them.
long allocations_of_this_thread();
long allocations_of_all_threads();

}  // namespace onestroke::test
