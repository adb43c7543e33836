// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_slow_approach_h
#define strait_driver_slow_approach_h

#include <functional>
#include <optional>

namespace strait
{
  /** Two values of a load or pressure between which a seal opens or closes. */
  struct Passage
  {
    double before; // where the state is that the path comes from
    double beyond; // where it is lost
  };

  /**
   * Where a state is lost on a path of small steps.
   *
   * A seal that can be open and closed at one load tells which by where it comes from,
   * and a large step may leave a state that small ones keep. Hence the end @c beyond of
   * what is known is asked for again once the other is near. If the state is kept there,
   * the path goes on from it, in steps that begin with @p tolerance (relative) and
   * double, until the state is lost at a step of that size. Nothing is returned if it is
   * kept to a millionth of where the path began, or to a million times that.
   *
   * @p is_lost gets a load or pressure, is to start from the last one at which the state
   * was kept, and says whether it is lost. Collective if that is.
   */
  std::optional<Passage> approach_slowly(Passage                            known,
                                         double                             tolerance,
                                         const std::function<bool(double)> &is_lost);
} // namespace strait

#endif
