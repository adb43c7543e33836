// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_contact_zoom_in_h
#define strait_contact_zoom_in_h

#include <strait/spectral/slab_field.h>

#include <vector>

namespace strait
{
  /**
   * The @p pressure of a contact with the windows @p windows in place of its own, as a
   * start for the solution with them: what is known in a window is kept, the rest is
   * interpolated from the window's parent. Collective.
   */
  SlabField zoom_in(const SlabField &pressure, std::vector<ZoomWindow> windows);
} // namespace strait

#endif
