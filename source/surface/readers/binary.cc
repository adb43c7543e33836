// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/binary.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace strait
{
  namespace
  {
    template <class Number>
    double
    decode_as(const char *bytes)
    {
      using Word = std::conditional_t<
        sizeof(Number) == 1,
        std::uint8_t,
        std::conditional_t<
          sizeof(Number) == 2,
          std::uint16_t,
          std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>>;
      std::uint64_t bits = 0;
      for (std::size_t i = sizeof(Number); i-- > 0;)
        bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
      const Word word = static_cast<Word>(bits);
      Number     value;
      std::memcpy(&value, &word, sizeof(value));
      return static_cast<double>(value);
    }
  } // namespace

  std::size_t
  bytes_of(const NumberType type)
  {
    switch (type)
      {
        case NumberType::uint8:
        case NumberType::int8:
          return 1;
        case NumberType::uint16:
        case NumberType::int16:
          return 2;
        case NumberType::uint32:
        case NumberType::int32:
        case NumberType::float32:
          return 4;
        default:
          return 8;
      }
  }

  double
  decode(const NumberType type, const char *bytes)
  {
    switch (type)
      {
        case NumberType::uint8:
          return decode_as<std::uint8_t>(bytes);
        case NumberType::uint16:
          return decode_as<std::uint16_t>(bytes);
        case NumberType::uint32:
          return decode_as<std::uint32_t>(bytes);
        case NumberType::int8:
          return decode_as<std::int8_t>(bytes);
        case NumberType::int16:
          return decode_as<std::int16_t>(bytes);
        case NumberType::int32:
          return decode_as<std::int32_t>(bytes);
        case NumberType::int64:
          return decode_as<std::int64_t>(bytes);
        case NumberType::float32:
          return decode_as<float>(bytes);
        default:
          return decode_as<double>(bytes);
      }
  }

  std::vector<double>
  read_numbers(std::istream &stream, const NumberType type, const std::size_t n)
  {
    constexpr std::size_t at_once = 65536;
    const std::size_t     size    = bytes_of(type);
    std::vector<char>     bytes(size * at_once);
    std::vector<double>   values(n);
    for (std::size_t first = 0; first < n && stream; first += at_once)
      {
        const std::size_t count = std::min(at_once, n - first);
        stream.read(bytes.data(), static_cast<std::streamsize>(count * size));
        for (std::size_t i = 0; i < count; ++i)
          values[first + i] = decode(type, bytes.data() + i * size);
      }
    return values;
  }
} // namespace strait
