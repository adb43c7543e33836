// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace strait
{
  /**
   * Proposes the next iterate towards a fixed point x = F(x) of a map that is costly and
   * known only through its values.
   *
   * Anderson acceleration (J. ACM 12, 1965; type II of Fang and Saad 2009) takes, of all
   * combinations of the last iterates with weights that add up to one, the one whose
   * residual F(x) − x would be smallest if F were affine. Without history it reduces to
   * plain relaxation. The class knows no physics.
   *
   * A combination whose step points against the residual is rejected in favour of
   * relaxation: it heads for a fixed point that relaxation moves away from, or for a
   * place where one has just vanished. Near a fixed point that relaxation approaches,
   * both steps point the same way.
   */
  class FixedPoint
  {
  public:
    /** Scalar product over the values of all ranks, which measures residuals. */
    using Product =
      std::function<double(const std::vector<float> &, const std::vector<float> &)>;

    /**
     * @p history: how many earlier rounds are combined, 0 or more, at 8 B per value each;
     * @p relaxation: the largest fraction of the residual that is taken, in (0, 1].
     */
    FixedPoint(Product product, int history, double relaxation);

    /**
     * Replace @p x by the next iterate, given the image F(@p x) = @p image. Both have
     * @p n values on this rank. Unless it @p combines the earlier rounds, the step is
     * plain relaxation, and the fraction is halved whenever the residual turns round
     * (which takes a history). In all other cases the fraction grows again. This round is
     * remembered either way. Collective.
     */
    void advance(double *x, const double *image, std::size_t n, bool combines = true);

    /** Forget the earlier rounds and halve the fraction, because the map has jumped. */
    void jump();

    /** Forget the earlier rounds, as the map is another one; restore the full
     *  fraction. */
    void restart();

    /** Begin at another point, or with a map that has changed a little, with the full
     *  fraction. The directions of the earlier rounds are kept, as they still hold. */
    void move_on();

  private:
    // Differences between one round and the next. Single precision is enough to find a
    // direction: the step itself takes the residual in double precision.
    struct Difference
    {
      std::vector<float> x;
      std::vector<float> residual;
    };

    void remember(const double *x, const double *image, std::size_t n);

    /** Weights of the differences in the best combination; empty if there are none or if
     *  the step points against the residual. */
    std::vector<double> best_weights() const;

    /** Whether the residual points against that of the round before. */
    bool turns_round() const;

    Product                 product;
    int                     history;
    double                  relaxation;  // largest fraction
    double                  fraction;    // of the residual that is taken now
    std::vector<Difference> differences; // latest last
    std::vector<float>      last_residual;
    std::vector<double>     last_x;
    bool                    has_last = false; // true on a rank without values as well
  };
} // namespace strait
