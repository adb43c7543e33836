// SPDX-License-Identifier: GPL-2.0-or-later
#include <strait/flow/pressure_estimate.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace strait
{
  namespace
  {
    /** Logarithm of a gap, 50 steps to the octave, counted such that the largest gap
     *  is at the last place. */
    class GapScale
    {
    public:
      static constexpr int n_places = 2048;

      explicit GapScale(const FlowLattice &gap)
      {
        for (std::size_t k = 0; k < gap.size(); ++k)
          largest = std::max(largest, gap[k]);
      }

      int
      place(const double g) const
      {
        return std::max(n_places - 1 + static_cast<int>(50. * std::log2(g / largest)), 0);
      }

    private:
      double largest = 0.;
    };
  } // namespace

  std::vector<float>
  estimate_pressure(const FlowLattice &gap, const FlowPath &path)
  {
    constexpr float                       unknown = -1.F;
    const GapScale                        scale(gap);
    std::vector<float>                    pressure(gap.size(), unknown);
    std::vector<std::vector<std::size_t>> waiting(GapScale::n_places);
    for (std::size_t p = 0; p < path.points.size(); ++p)
      {
        const std::size_t k = gap.index_of(path.points[p]);
        pressure[k] = static_cast<float>(1. - path.resistances[p] / path.resistance());
        waiting.back().push_back(k);
      }
    for (int place = GapScale::n_places - 1; place >= 0; --place)
      while (!waiting[place].empty())
        {
          const std::size_t k = waiting[place].back();
          waiting[place].pop_back();
          const int a = gap.along(k), b = gap.across_of(k);
          for (const auto &[da, db] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            {
              if (!gap.can_step(k, da, db))
                continue;
              const std::size_t to = gap.index(a + da, b + db);
              if (!(gap[to] > 0) || pressure[to] != unknown)
                continue;
              pressure[to] = pressure[k];
              waiting[std::min(place, scale.place(gap[to]))].push_back(to);
            }
        }
    return pressure;
  }
} // namespace strait
