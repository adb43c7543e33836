// SPDX-License-Identifier: GPL-2.0-or-later
// A fuzzer for compilers without libFuzzer: it damages the files of a corpus, the
// same way in every run.
//
//     fuzz_readers CORPUS RUNS
//
// CORPUS is a folder; the environment variable STRAIT_FUZZ_READER names the reader.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace
{
  std::vector<std::string>
  read_corpus(const std::string &folder)
  {
    std::vector<std::filesystem::path> paths;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> corpus;
    for (const auto &path : paths)
      {
        std::ifstream stream(path, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(stream),
                            std::istreambuf_iterator<char>());
      }
    return corpus;
  }

  /** Damages texts. Runs repeat, as the standard fixes the numbers of std::mt19937. */
  class Mutator
  {
  public:
    Mutator(const std::vector<std::string> &corpus_, const std::uint32_t seed)
      : corpus(corpus_)
      , random(seed)
    {
    }

    std::string
    next()
    {
      std::string text = corpus[below(corpus.size())];
      for (std::size_t n = 1 + below(6); n > 0; --n)
        damage(text);
      return text;
    }

  private:
    std::size_t
    below(const std::size_t n)
    {
      return n == 0 ? 0 : random() % n;
    }

    /** A random place in @p text, more often near its start, where headers are. */
    std::size_t
    place(const std::string &text)
    {
      return below(1 + below(1 + text.size()));
    }

    void
    damage(std::string &text)
    {
      static const std::vector<std::string> words = {
        "nan",   "inf", "-1",  "0",    "1e308",  "-1e308", "1e-320", "99999999999",
        "65535", "=",   "set", "end",  "\n",     ";",      ",",      "*",
        "BAD",   "\\",  "\"",  "true", "-0x1p9", "<a>",    "</a>",   "%s"};
      const std::size_t at    = place(text);
      const std::size_t some  = std::min(text.size() - at, 1 + below(16));
      const std::string piece = text.substr(at, some);
      switch (below(8))
        {
          case 0:
            if (at < text.size())
              text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            break;
          case 1:
            set_number(text, at);
            break;
          case 2:
            text.erase(at, some);
            break;
          case 3:
            text.insert(place(text), piece);
            break;
          case 4:
            text.insert(at, words[below(words.size())]);
            break;
          case 5:
            replace_number(text, at, words[below(words.size())]);
            break;
          case 6:
            {
              const std::string &other = corpus[below(corpus.size())];
              text = text.substr(0, at) + other.substr(std::min(at, other.size()));
              break;
            }
          default:
            if (below(8) == 0)
              text.resize(at);
            else if (at < text.size())
              text[at] = static_cast<char>(random());
        }
    }

    /** Write a number as binary files store sizes: small, large, or too large. */
    void
    set_number(std::string &text, const std::size_t at)
    {
      static const std::vector<std::uint64_t> numbers    = {0,
                                                            1,
                                                            2,
                                                            127,
                                                            128,
                                                            255,
                                                            256,
                                                            32767,
                                                            65535,
                                                            65536,
                                                            0x7fffffff,
                                                            0x80000000,
                                                            0xffffffff,
                                                            1000000000000,
                                                            0x7fffffffffffffff,
                                                            0xffffffffffffffff};
      const std::uint64_t                     number     = numbers[below(numbers.size())];
      const std::size_t                       width      = std::size_t(1) << below(4);
      const bool                              big_endian = below(2) == 0;
      for (std::size_t i = 0; i < width && at + i < text.size(); ++i)
        text[at + i] =
          static_cast<char>(number >> 8 * (big_endian ? width - 1 - i : i) & 255);
    }

    /** Replace the next number in @p text, from @p at on, by @p word. */
    void
    replace_number(std::string &text, const std::size_t at, const std::string &word)
    {
      const std::string digits = "0123456789.+-e";
      const std::size_t begin  = text.find_first_of("0123456789", at);
      if (begin == std::string::npos)
        return;
      const std::size_t end =
        std::min(text.find_first_not_of(digits, begin), text.size());
      text.replace(begin, end - begin, word);
    }

    const std::vector<std::string> &corpus;
    std::mt19937                    random;
  };

  void
  try_input(const std::string &text)
  {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(text.data()),
                           text.size());
  }
} // namespace

int
main(int argc, char **argv)
{
  if (argc != 3)
    {
      std::cerr << "usage: fuzz_readers CORPUS RUNS\n";
      return 2;
    }
  const std::vector<std::string> corpus = read_corpus(argv[1]);
  if (corpus.empty())
    {
      std::cerr << argv[1] << " holds no file\n";
      return 2;
    }
  for (const std::string &text : corpus)
    try_input(text);
  constexpr std::uint32_t seed = 1;
  Mutator                 mutator(corpus, seed);
  for (long run = std::stol(argv[2]); run > 0; --run)
    try_input(mutator.next());
  std::cout << corpus.size() << " files and " << argv[2] << " damaged ones were read\n";
  return 0;
}
