#include "parallel.h"

#include "cancellation.h"

#include <memory>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <utility>

namespace lamella {

namespace {

// Threading Building Blocks and not OpenMP: a loop must not wait for a thread that has nothing left
// to do but has not been scheduled yet. With one of two cores busy an OpenMP team was several times
// slower than one thread (see docs/numerics.md).
std::unique_ptr<tbb::task_arena> arena = std::make_unique<tbb::task_arena>();
std::unique_ptr<tbb::global_control>
    more_than_cores; // TBB starts no more threads than there are cores unless told

thread_local const std::function<bool()>* cancellation = nullptr;

} // namespace

void set_thread_count(int threads) {
  if (threads > tbb::info::default_concurrency())
    more_than_cores = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, threads);
  arena =
      std::make_unique<tbb::task_arena>(threads > 0 ? threads : int(tbb::task_arena::automatic));
}

int thread_count() { return arena->max_concurrency(); }

Cancellation::Cancellation(std::function<bool()> wanted)
    : wanted_(std::move(wanted)), before_(std::exchange(cancellation, &wanted_)) {}

Cancellation::~Cancellation() { cancellation = before_; }

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& f) {
  const std::size_t chunks = (n + grain - 1) / grain;
  auto run = [&, wanted = cancellation](std::size_t chunk) {
    if (wanted && (*wanted)()) throw Cancelled();
    f(chunk * grain, std::min(n, (chunk + 1) * grain));
  };
  if (chunks <= 1 || thread_count() == 1) {
    for (std::size_t chunk = 0; chunk < chunks; chunk++) run(chunk);
    return;
  }
  arena->execute([&] { tbb::parallel_for(std::size_t(0), chunks, run); });
}

} // namespace lamella
