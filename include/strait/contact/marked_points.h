// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_marked_points_h
#define strait_contact_marked_points_h

#include <strait/contact/contact_problem.h>

#include <cstdint>
#include <cstring>

namespace strait
{
  /** unmarked(begin, end) or some(begin, end) for eight points of a range at a time. As
   *  contact lies in patches, most of these are marked alike. */
  template <class Unmarked, class Some>
  void
  by_eights(const std::uint8_t          *marks,
            const ContactProblem::Block &range,
            const Unmarked              &unmarked,
            const Some                  &some)
  {
    std::size_t i = range.begin;
    for (; i + 8 <= range.end; i += 8)
      {
        std::uint64_t eight;
        std::memcpy(&eight, marks + i, 8);
        if (eight == 0)
          unmarked(i, i + 8);
        else
          some(i, i + 8);
      }
    some(i, range.end);
  }

  /** visit(i) for the marked points of a range. */
  template <class Visit>
  void
  for_each_marked(const std::uint8_t          *marks,
                  const ContactProblem::Block &range,
                  const Visit                 &visit)
  {
    by_eights(
      marks,
      range,
      [](std::size_t, std::size_t) {},
      [=, &visit](const std::size_t begin, const std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (marks[i])
            visit(i);
      });
  }
} // namespace strait

#endif
