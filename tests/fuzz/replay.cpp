// A stand-in for libFuzzer's main program: every file of the corpus once, then changed ones for some seconds, always
// the same in the same order.
//
//     fuzz_msh SECONDS CORPUS

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

// The libraries below keep memory to the end; an allocation beyond 256 MB for inputs of some kilobytes is a finding.
// NOLINTNEXTLINE(readability-identifier-naming,bugprone-reserved-identifier): the sanitizer's name
extern "C" const char* __asan_default_options() { return "detect_leaks=0:max_allocation_size_mb=256"; }

namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> read_corpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<Bytes> corpus;
  for (const auto& name : names) {
    std::ifstream stream(name, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return corpus;
}

class Mutator {
 public:
  explicit Mutator(const std::vector<Bytes>& corpus) : corpus_(corpus) {}

  Bytes next() {
    Bytes bytes = any();
    for (std::size_t n = 1 + below(4); n > 0; --n) change(bytes);
    return bytes;
  }

 private:
  std::size_t below(std::size_t n) { return random_() % std::max<std::size_t>(n, 1); }
  const Bytes& any() { return corpus_[below(corpus_.size())]; }

  /// One change: a byte, a digit, a cut, a repetition, or a piece of another file.
  void change(Bytes& bytes) {
    if (bytes.empty()) bytes = any();
    const auto at = [&](std::size_t i) { return bytes.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t begin = below(bytes.size()), length = 1 + below(std::min<std::size_t>(64, bytes.size() - begin));
    switch (below(6)) {
      case 0:
        bytes[begin] = static_cast<std::uint8_t>(below(256));
        break;
      case 1:
        bytes.insert(at(begin), static_cast<std::uint8_t>('0' + below(10)));
        break;
      case 2:
        bytes.erase(at(begin), at(begin + length));
        break;
      case 3:
        bytes.resize(begin);
        break;
      case 4: {
        const Bytes piece(at(begin), at(begin + length));
        bytes.insert(at(below(bytes.size())), piece.begin(), piece.end());
        break;
      }
      default: {
        const Bytes& other = any();
        const std::size_t from = below(other.size()), n = std::min(length, other.size() - from);
        std::copy_n(other.begin() + static_cast<std::ptrdiff_t>(from), std::min(n, bytes.size() - begin), at(begin));
      }
    }
  }

  const std::vector<Bytes>& corpus_;
  std::mt19937 random_{1};
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s SECONDS CORPUS\n", argv[0]);
    return 2;
  }
  const std::vector<Bytes> corpus = read_corpus(argv[2]);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s holds no files\n", argv[2]);
    return 2;
  }
  for (const Bytes& bytes : corpus) LLVMFuzzerTestOneInput(bytes.data(), bytes.size());

  Mutator mutator(corpus);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[1]));
  long n = 0;
  for (; std::chrono::steady_clock::now() < end; ++n) {
    const Bytes bytes = mutator.next();
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%zu files and %ld changed ones\n", corpus.size(), n);
  return 0;
}
