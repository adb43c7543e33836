// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/surface/readers/map_message.h>

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <limits>

namespace strait
{
  namespace
  {
    constexpr std::uint64_t longest_text = 1U << 20;
    constexpr std::int64_t  largest_side = 65535; // see check_claim()

    /** What goes ahead of texts and heights. Numbers of one width leave no holes. */
    struct Head
    {
      std::int64_t          kind        = 0;
      std::int64_t          nx          = 0;
      std::int64_t          ny          = 0;
      std::int64_t          n_values    = 0;
      std::int64_t          is_periodic = 0;
      std::int64_t          has_size    = 0;
      std::array<double, 2> size{};
    };

    /** Call @p pass(done, left), which is read() or write(), until all is through. */
    template <typename Pass>
    bool
    pass_all(const std::size_t size, const Pass &pass)
    {
      std::size_t done = 0;
      while (done < size)
        {
          const ssize_t n = pass(done, size - done);
          if (n == 0 || (n < 0 && errno != EINTR))
            return false;
          if (n > 0)
            done += static_cast<std::size_t>(n);
        }
      return true;
    }

    bool
    write_all(const int file, const void *data, const std::size_t size)
    {
      const char *bytes = static_cast<const char *>(data);
      return pass_all(size, [&](const std::size_t done, const std::size_t left) {
        return write(file, bytes + done, left);
      });
    }

    bool
    read_all(const int file, void *data, const std::size_t size)
    {
      char *bytes = static_cast<char *>(data);
      return pass_all(size, [&](const std::size_t done, const std::size_t left) {
        return read(file, bytes + done, left);
      });
    }

    bool
    send_text(const int file, const std::string &text)
    {
      const std::uint64_t length = text.size();
      return write_all(file, &length, sizeof length) &&
             write_all(file, text.data(), text.size());
    }

    bool
    receive_text(const int file, std::string &text)
    {
      std::uint64_t length = 0;
      if (!read_all(file, &length, sizeof length) || length > longest_text)
        return false;
      text.resize(length);
      return read_all(file, text.data(), text.size());
    }

    bool
    send_unit(const int file, const LengthUnit &unit)
    {
      // No length is NaN.
      const double metres =
        unit.metres.value_or(std::numeric_limits<double>::quiet_NaN());
      return send_text(file, unit.name) && write_all(file, &metres, sizeof metres);
    }

    bool
    receive_unit(const int file, LengthUnit &unit)
    {
      double metres = 0.;
      if (!receive_text(file, unit.name) || !read_all(file, &metres, sizeof metres))
        return false;
      if (!std::isnan(metres))
        unit.metres = metres;
      return true;
    }

    bool
    makes_sense(const Head &head)
    {
      using Kind = MapMessage::Kind;
      if (head.kind != static_cast<int>(Kind::map))
        return head.kind > 0 && head.kind <= static_cast<int>(Kind::other_error) &&
               head.n_values == 0;
      return head.nx > 0 && head.nx <= largest_side && head.ny > 0 &&
             head.ny <= largest_side && head.n_values == head.nx * head.ny;
    }
  } // namespace

  bool
  send(const int file, const MapMessage &message)
  {
    const HeightMap &map = message.map;
    Head             head;
    head.kind        = static_cast<int>(message.kind);
    head.nx          = map.nx;
    head.ny          = map.ny;
    head.n_values    = static_cast<std::int64_t>(map.values.size());
    head.is_periodic = map.is_periodic ? 1 : 0;
    head.has_size    = map.size.has_value() ? 1 : 0;
    head.size        = map.size.value_or(std::array<double, 2>{});
    return write_all(file, &head, sizeof head) &&
           send_text(file, message.text.substr(0, longest_text)) &&
           send_unit(file, map.lateral_unit) && send_unit(file, map.height_unit) &&
           send_text(file, map.format) &&
           write_all(file, map.values.data(), map.values.size() * sizeof(double));
  }

  std::optional<MapMessage>
  receive(const int file)
  {
    Head       head;
    MapMessage message;
    HeightMap &map = message.map;
    if (!read_all(file, &head, sizeof head) || !makes_sense(head) ||
        !receive_text(file, message.text) || !receive_unit(file, map.lateral_unit) ||
        !receive_unit(file, map.height_unit) || !receive_text(file, map.format))
      return {};
    message.kind = static_cast<MapMessage::Kind>(head.kind);
    map.nx       = static_cast<int>(head.nx);
    map.ny       = static_cast<int>(head.ny);
    if (head.has_size != 0)
      map.size = head.size;
    map.is_periodic = head.is_periodic != 0;
    map.values.resize(head.n_values);
    if (!read_all(file, map.values.data(), map.values.size() * sizeof(double)))
      return {};
    return message;
  }
} // namespace strait
