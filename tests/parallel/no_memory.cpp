// To be preloaded: makes one allocation of one rank fail, as when memory is used up.
//   NO_MEMORY_RANK   on this rank of Open MPI's
//   NO_MEMORY_AT     the n-th allocation of some size, from 1
//   NO_MEMORY_COUNT  a file to which the number of such allocations is written at the end

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

constexpr std::size_t some_size = 512;  // bytes: smaller ones are too many

std::atomic<long> n_allocations{0};

bool is_meant() {
  const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
  const char* meant = std::getenv("NO_MEMORY_RANK");
  return rank != nullptr && meant != nullptr && std::strcmp(rank, meant) == 0;
}

long failing_allocation() {
  const char* at = std::getenv("NO_MEMORY_AT");
  return is_meant() && at != nullptr ? std::atol(at) : 0;
}

struct Report {
  ~Report() {
    const char* file = std::getenv("NO_MEMORY_COUNT");
    if (file == nullptr || !is_meant()) return;
    if (std::FILE* stream = std::fopen(file, "w")) {
      std::fprintf(stream, "%ld\n", n_allocations.load());
      std::fclose(stream);
    }
  }
} report;

}  // namespace

void* operator new(std::size_t size) {
  static const long failing = failing_allocation();
  if (size >= some_size && ++n_allocations == failing) throw std::bad_alloc();
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
