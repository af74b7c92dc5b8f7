// SPDX-License-Identifier: MIT
// A small stand-in for libFuzzer where the compiler has none: runs every file of the corpus, then mutations of them, the
// same ones for the same seed. No coverage is measured. Takes libFuzzer's options: -runs=N -seed=N -max_len=N FOLDER...
// The input of a run that crashes or hangs is left in crash-<seed>-<run> in the working folder.
#include "tests/fuzz/fuzz.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
/// A reader that believes what a file announces is stopped here.
extern "C" char const* __asan_default_options() { return "max_allocation_size_mb=1024:allocator_may_return_null=0"; }
#endif

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr unsigned seconds_for_a_run = 10;

struct Options {
    long long runs = 10000;
    unsigned long long seed = 1;
    std::size_t max_len = 1 << 16;
    std::vector<std::string> folders;
};

// For the handlers, which may call next to nothing.
Bytes const* current = nullptr;
char crash_file[64];

void leave_input()
{
    if (!current) return;
    int const file = ::open(crash_file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0) return;
    [[maybe_unused]] ssize_t const written = ::write(file, current->data(), current->size());
    ::close(file);
    static char const text[] = "the input is in ";
    [[maybe_unused]] ssize_t said = ::write(2, text, sizeof text - 1);
    said = ::write(2, crash_file, std::strlen(crash_file));
    said = ::write(2, "\n", 1);
}

extern "C" void on_signal(int signal)
{
    leave_input();
    if (signal == SIGALRM) {
        static char const text[] = "a run took too long\n";
        [[maybe_unused]] ssize_t const said = ::write(2, text, sizeof text - 1);
        ::_exit(70);
    }
    std::signal(signal, SIG_DFL);
    ::raise(signal);
}

void watch_for_crashes()
{
    std::signal(SIGALRM, on_signal);
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_set_death_callback(leave_input);
    std::signal(SIGABRT, on_signal);
#else
    for (int const signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, on_signal);
    rlimit const memory{std::size_t(4) << 30, std::size_t(4) << 30};
    ::setrlimit(RLIMIT_AS, &memory);
#endif
}

std::vector<Bytes> read_corpus(std::vector<std::string> const& folders)
{
    std::vector<std::filesystem::path> paths;
    for (std::string const& folder : folders)
        for (auto const& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end()); // the same order everywhere
    std::vector<Bytes> corpus;
    for (auto const& path : paths) {
        std::ifstream file(path, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return corpus;
}

class Mutator {
public:
    Mutator(std::vector<Bytes> const& corpus, Options const& options)
        : corpus_(corpus), options_(options), random_(options.seed)
    {
    }

    Bytes next()
    {
        Bytes bytes = corpus_[below(corpus_.size())];
        for (std::size_t n = 1 + below(6); n > 0; --n) mutate(bytes);
        if (bytes.size() > options_.max_len) bytes.resize(options_.max_len);
        return bytes;
    }

private:
    std::size_t below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }

    void mutate(Bytes& bytes)
    {
        std::size_t const at = below(bytes.size() + 1), most = bytes.size() - at;
        auto const begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        auto const some = [&](std::size_t limit) { return static_cast<std::ptrdiff_t>(std::min(most, 1 + below(limit))); };
        switch (below(9)) {
        case 0: // a bit
            if (most) *begin ^= static_cast<std::uint8_t>(1u << below(8));
            return;
        case 1: // a byte
            if (most) *begin = static_cast<std::uint8_t>(random_());
            return;
        case 2: // a large or odd number of 1 to 8 bytes
            for (std::ptrdiff_t n = some(8), value = static_cast<std::ptrdiff_t>(below(3)); n > 0; --n)
                begin[n - 1] = value == 0 ? 0xff : value == 1 ? 0 : 0x80;
            return;
        case 3:
            bytes.erase(begin, begin + some(64));
            return;
        case 4:
            bytes.resize(at);
            return;
        case 5: { // a piece again
            Bytes const piece(begin, begin + some(64));
            bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() + 1)), piece.begin(), piece.end());
            return;
        }
        case 6: { // a piece of another file
            Bytes const& other = corpus_[below(corpus_.size())];
            std::size_t const from = below(other.size() + 1), length = std::min(other.size() - from, 1 + below(256));
            bytes.insert(begin, other.begin() + static_cast<std::ptrdiff_t>(from),
                         other.begin() + static_cast<std::ptrdiff_t>(from + length));
            return;
        }
        case 7: { // a word that means something to some reader
            static char const* const words[] = {"nan", "inf",  "-1",    "1e308",  "1e999",      "9223372036854775807",
                                                "-0",  "\"",   "[[",    "]]",     "{",          "}",
                                                "\n",  ",",    "solid", "facet",  "#set ",      "=",
                                                ".",   "\r\n", "true",  "\"\"\"", "2147483648", "0"};
            char const* const word = words[below(std::size(words))];
            bytes.insert(begin, word, word + std::strlen(word));
            return;
        }
        default: // the same byte many times
            bytes.insert(begin, 1 + below(512), most ? *begin : std::uint8_t('['));
        }
    }

    std::vector<Bytes> const& corpus_;
    Options const& options_;
    std::mt19937_64 random_;
};

void run(Bytes const& bytes, unsigned long long seed, long long n)
{
    current = &bytes;
    std::snprintf(crash_file, sizeof crash_file, "crash-%llu-%lld", seed, n);
    ::alarm(seconds_for_a_run);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    ::alarm(0);
    current = nullptr;
}

Options parse(int argc, char** argv)
{
    Options options;
    for (int n = 1; n < argc; ++n) {
        std::string const text = argv[n];
        auto const number = [&] { return std::stoull(text.substr(text.find('=') + 1)); };
        if (text.starts_with("-runs=")) options.runs = static_cast<long long>(number());
        else if (text.starts_with("-seed=")) options.seed = number();
        else if (text.starts_with("-max_len=")) options.max_len = number();
        else if (!text.starts_with("-")) options.folders.push_back(text);
    }
    return options;
}

} // namespace

int main(int argc, char** argv)
{
    Options const options = parse(argc, argv);
    std::vector<Bytes> const corpus = read_corpus(options.folders);
    if (corpus.empty()) {
        std::fprintf(stderr, "no corpus: name a folder\n");
        return 2;
    }
    watch_for_crashes();
    for (std::size_t n = 0; n < corpus.size(); ++n) run(corpus[n], 0, static_cast<long long>(n));
    Mutator mutator(corpus, options);
    for (long long n = 0; n < options.runs; ++n) run(mutator.next(), options.seed, n);
    std::printf("%zu files and %lld mutations of them: no crash, no hang\n", corpus.size(), options.runs);
    return 0;
}
