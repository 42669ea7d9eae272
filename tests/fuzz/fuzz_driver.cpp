// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target without libFuzzer: every file of the corpus as it is, then a fixed number of
// mutations of them. No clock and a fixed seed: the same inputs every time.
//
// usage: fuzz_X MUTATIONS FOLDER...   or   fuzz_X FILE   (to look at one input)
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz_target.h"

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxInput = 70000;
constexpr const char* kLastInput = "fuzz_last_input";

std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> read_corpus(int count, char** folders) {
    std::vector<fs::path> files;
    for (int i = 0; i < count; ++i) {
        if (!fs::is_directory(folders[i])) {
            continue;  // shared test data need not be there
        }
        for (const auto& entry : fs::recursive_directory_iterator(folders[i])) {
            if (entry.is_regular_file() && entry.file_size() <= kMaxInput) {
                files.push_back(entry.path());
            }
        }
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> inputs;
    inputs.reserve(files.size());
    for (const fs::path& file : files) {
        inputs.push_back(read_file(file));
    }
    return inputs;
}

class Mutator {
  public:
    explicit Mutator(const std::vector<std::string>& corpus) : corpus_(corpus) {}

    std::string next() {
        std::string input = pick();
        for (std::size_t changes = 1 + below(6); changes > 0; --changes) {
            change(input);
        }
        input.resize(std::min(input.size(), kMaxInput));
        return input;
    }

  private:
    /// Uniform enough below n; the same on every machine, unlike the standard's distributions.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
    const std::string& pick() { return corpus_[below(corpus_.size())]; }

    void change(std::string& input) {
        static constexpr const char* kWords[] = {
            "null", "1e999", "-1e-999",  "{", "[", "\"", "\\u0000", "\\ud800", "4294967296",
            "-0",   "\xff",  "\xc3\x28", "}", "]", ":",  ",",       "true",    "\n"};
        const std::size_t at = below(input.size() + 1);
        switch (below(7)) {
            case 0:
                if (at < input.size()) {
                    input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
                }
                break;
            case 1:
                input.insert(at, 1, static_cast<char>(below(256)));
                break;
            case 2:
                input.erase(at, 1 + below(8));
                break;
            case 3:
                input.insert(at, kWords[below(std::size(kWords))]);
                break;
            case 4:
                input.insert(at, input.substr(below(input.size() + 1), below(64)));
                break;
            case 5:
                input.resize(at);
                break;
            default: {
                const std::string& other = pick();
                input = input.substr(0, at) + other.substr(below(other.size() + 1));
            }
        }
    }

    const std::vector<std::string>& corpus_;
    std::mt19937_64 random_{20031205};
};

/// The input is written before it is tried, so that one that ends the process can be found.
void try_input(const std::string& input) {
    std::ofstream(kLastInput, std::ios::binary) << input;
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2) {
        const std::string input = read_file(argv[1]);
        return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()),
                                      input.size());
    }
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s MUTATIONS FOLDER... | FILE\n", argv[0]);
        return 2;
    }
    const std::vector<std::string> corpus = read_corpus(argc - 2, argv + 2);
    if (corpus.empty()) {
        std::fprintf(stderr, "the corpus is empty\n");
        return 1;
    }
    for (const std::string& input : corpus) {
        try_input(input);
    }
    Mutator mutator(corpus);
    const int mutations = std::atoi(argv[1]);
    for (int i = 0; i < mutations; ++i) {
        try_input(mutator.next());
    }
    std::printf("%zu files and %d mutations of them\n", corpus.size(), mutations);
    return 0;
}
