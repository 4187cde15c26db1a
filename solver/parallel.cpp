#include "parallel.h"

#include <omp.h>

namespace lamella {

namespace {
int requested = 0;
}

void set_thread_count(int threads) { requested = threads; }

int thread_count() { return requested > 0 ? requested : omp_get_max_threads(); }

} // namespace lamella
