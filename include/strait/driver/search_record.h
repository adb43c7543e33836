// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_search_record_h
#define strait_driver_search_record_h

#include <strait/driver/blow_out.h>
#include <strait/driver/threshold_search.h>

#include <cstddef>
#include <vector>

namespace strait
{
  /**
   * The answers to all probes of a kind, in their order. A search that is resumed begins
   * anew and is given those that it had; as it asks the same again, it comes to where it
   * was at once.
   */
  template <typename Answer>
  class SearchRecord
  {
  public:
    /** Whether the next probe was made before. */
    bool
    is_known() const
    {
      return next < answers.size();
    }

    /** The answer to the next probe, which must be known. */
    Answer
    recall()
    {
      return answers[next++];
    }

    /** Add the answer to a new probe. */
    void
    note(const Answer &answer)
    {
      answers.push_back(answer);
      next = answers.size();
    }

    /** Begin anew when taken. Collective. */
    void
    transfer(StateArchive &archive)
    {
      auto n = static_cast<long>(answers.size());
      archive.value(n);
      answers.resize(n);
      for (Answer &answer : answers)
        transfer_probe(archive, answer);
      if (archive.is_reading())
        next = 0;
    }

    std::size_t
    size() const
    {
      return answers.size();
    }

  private:
    std::vector<Answer> answers;
    std::size_t         next = 0;
  };
} // namespace strait

#endif
