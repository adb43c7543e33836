// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_zoom_in_h
#define strait_contact_zoom_in_h

#include <strait/contact/contact_state.h>

#include <vector>

namespace strait
{
  /**
   * @p state with the windows @p windows in place of its own, as a start for the solution
   * with them: what the state knows of a window is kept, the rest is interpolated from
   * the window's parent. Collective.
   */
  ContactState zoom_in(ContactState state, std::vector<ZoomWindow> windows);
} // namespace strait

#endif
