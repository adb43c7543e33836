// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef strait_driver_threshold_search_h
#define strait_driver_threshold_search_h

#include <strait/percolation/bottleneck.h>
#include <strait/spectral/state_archive.h>

#include <functional>
#include <map>
#include <vector>

namespace strait
{
  /** What one contact solve tells about percolation. */
  struct ThresholdProbe
  {
    Bottleneck bottleneck; // value > 0: the gap there; < 0: how firmly it is closed
    double     contact_area = 0.;
    long       fft_pairs    = 0;
  };

  /** In either direction. Collective. */
  void transfer_probe(StateArchive &archive, ThresholdProbe &probe);

  /** The critical load, enclosed. */
  struct Threshold
  {
    double slip_length = 0.;
    // The largest load known with a percolating channel, and the smallest without; with
    // hysteresis those on the path that the search follows.
    double    lower        = 0.;
    double    upper        = 0.;
    double    contact_area = 0.; // at lower
    GridPoint last_constriction; // at lower
    int       n_solves  = 0;     // contact solves made for this threshold
    long      fft_pairs = 0;     // of those

    double
    critical_load() const
    {
      return .5 * (lower + upper);
    }

    double
    relative_width() const
    {
      return (upper - lower) / upper;
    }
  };

  /** All of them, in either direction. Collective. */
  void transfer_thresholds(StateArchive &archive, std::vector<Threshold> &thresholds);

  /**
   * Encloses the largest load at which a channel percolates.
   *
   * The value v(L) of the bottleneck falls with the load L and changes its sign at
   * the critical load. On the open side it is the gap of a constriction, which
   * vanishes as (1 − L/L_c)^(6/5), on the sealed side a contact pressure, which was
   * found to grow as (L/L_c − 1)^0.63: raised to the reciprocal powers both are
   * close to linear, and a line through two loads of one side foretells the
   * threshold. Within a grid spacing of closing, v itself is linear through zero, and
   * the line through one load of each side does. The next load lies a little beyond, so
   * that it closes in from the other side. Every load that was probed serves all later
   * searches, so a second slip length costs little.
   */
  class ThresholdSearch
  {
  public:
    using Probe = std::function<ThresholdProbe(double load)>;

    /**
     * @p first_load: where to begin; @p tolerance: relative width of the bracket to
     * reach.
     */
    ThresholdSearch(Probe probe, double first_load, double tolerance);

    /**
     * The threshold for channels of a gap above @p level = 2|d0|. Collective if the
     * probe is. Throws ComputationError if no load within a factor of 10⁶ of the
     * first brackets it.
     */
    Threshold find(double slip_length);

    /**
     * The same where the verdict depends on where the load comes from: with @p from_open
     * from open states, to larger loads, else from sealed ones to smaller loads, in small
     * steps in the end (see approach_slowly()). Collective and throws likewise.
     */
    Threshold find_slowly(double slip_length, bool from_open);

  private:
    /** A load, the openness there, and the same straightened. */
    struct Point
    {
      double load;
      double openness;
      double value;
    };

    /** What is known at one level, by load. */
    struct Known
    {
      std::vector<Point> open;   // ascending: the last is nearest to the threshold
      std::vector<Point> sealed; // descending, likewise

      double
      width() const
      {
        return sealed.back().load - open.back().load;
      }
    };

    double      ask(double load, double level);
    Known       enclose(double level);
    Threshold   between(double slip_length, double lower, double upper);
    Known       known_at(double level) const;
    double      load_outside(const Known &known) const;
    double      load_between(const Known &known, bool bisect) const;
    static bool is_linear(const Known &known);

    Probe                            probe;
    double                           first_load;
    double                           tolerance;
    std::map<double, ThresholdProbe> probed;        // by load
    int                              n_solves  = 0; // since the last threshold was found
    long                             fft_pairs = 0; // likewise
  };
} // namespace strait

#endif
