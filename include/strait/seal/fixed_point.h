// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace strait
{
  /**
   * Proposes the next iterate on the way to a fixed point x = F(x) of a map that is
   * costly and known only through its values.
   *
   * Anderson acceleration (J. ACM 12, 1965; type II of Fang and Saad 2009): of all
   * combinations of the last rounds, with weights that add up to one, the one whose
   * residual F(x) − x would be smallest if F were affine. Without history it is plain
   * relaxation. Knows no physics.
   *
   * A combination that leads against the residual is not taken, but relaxation: it is on
   * the way to a fixed point, or to where there has just been one, from which relaxation
   * leads away. Where relaxation comes near a fixed point both lead the same way.
   */
  class FixedPoint
  {
  public:
    /** The scalar product of the values of all ranks that is a residual's measure. */
    using Product =
      std::function<double(const std::vector<float> &, const std::vector<float> &)>;

    /**
     * @p history: how many earlier rounds are combined, 0 or more, at 8 B a value each;
     * @p relaxation: the largest fraction of the residual that is taken, in (0, 1].
     */
    FixedPoint(Product product, int history, double relaxation);

    /**
     * The next iterate, in place of @p x, after F(@p x) = @p image was found. Both have
     * @p n values on this rank. Unless it @p combines the rounds before it is plain
     * relaxation, with half the fraction each time that the residual turns round. Else
     * the fraction grows again; what this round says is remembered in either case.
     * Collective.
     */
    void advance(double *x, const double *image, std::size_t n, bool combines = true);

    /** Forget the rounds before and halve the fraction, because the map has jumped. */
    void jump();

    /** Forget the rounds before, because the map is another one, and take all of the
     *  fraction. */
    void restart();

    /** Begin at another point or with a map that has changed a little, with all of the
     *  fraction: what the rounds before say about directions still holds. */
    void move_on();

  private:
    // Differences between one round and the next. Single precision is enough to
    // find a direction: the residual that they are fitted to is exact.
    struct Difference
    {
      std::vector<float> x;
      std::vector<float> residual;
    };

    void remember(const double *x, const double *image, std::size_t n);

    /** Of the differences; none if the step to that combination leads against the
     *  residual. */
    std::vector<double> best_weights() const;

    /** Whether the residual leads back to where it was the round before. */
    bool turns_round() const;

    Product                 product;
    int                     history;
    double                  relaxation;  // the largest fraction
    double                  fraction;    // of the residual, now
    std::vector<Difference> differences; // the latest last
    std::vector<float>      last_residual;
    std::vector<double>     last_x;
    bool                    has_last = false; // on a rank without values as well
  };
} // namespace strait
