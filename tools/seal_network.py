# SPDX-License-Identifier: GPL-2.0-or-later
"""A whole seal as a random network of patches: its conductance, and how it scatters.

Conductances are those of a square (volume per time under the pressure drop of the seal). A patch is
a bond, because a network of bonds is unbiased: an infinite isotropic one whose ln K is symmetric
about µ conducts exp(µ) exactly (Dykhne 1970). Patches that are joined at their edges in series
would conduct less.
"""
import numpy as np
from scipy.linalg import solveh_banded
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.special import ndtri, stdtrit

from run_folder import at_load

# Networks for one band. They give its quantiles of 5 and 95 % to 9 % of the scatter, half as many
# to 13 %, and twice as many to 6 % in twice the time.
N_NETWORKS = 400
# A ring of more patches is cut to this number. Seals of that size scatter by 1.4 % of the scatter
# of the patches in ln K; 2 % at half of it, and 1 % at double, where a network takes 10 ms, not 5.
MOST_PATCHES = 5000


def _most_around(n_along, n_around):
    """The number of patches around to which a ring is cut."""
    return min(n_around, max(MOST_PATCHES // n_along, 2 * n_along))


def matrix_bytes(n_along, n_around):
    """Bytes of the band matrix of network_conductance() for a ring of sample_seals()."""
    rows = n_along - 1
    return 8 * (2 * rows + 1) * rows * _most_around(n_along, n_around)


def _positions(n):
    """Places in a row of the n points of a ring, folded: neighbours are at most two apart."""
    first = np.arange(n)
    return np.where(first < (n + 1) // 2, 2 * first, 2 * (n - 1 - first) + 1)


def _floating(nodes, along, across):
    """Which of the (m, N2) nodes open bonds connect neither with inlet nor with outlet; and whether
    inlet and outlet are connected with each other."""
    m, n = nodes.shape
    inlet, outlet = np.full((1, n), m * n), np.full((1, n), m * n + 1)
    chain = np.concatenate([inlet, nodes, outlet])
    begin = np.concatenate([chain[:-1][along > 0], nodes[across > 0]])
    end = np.concatenate([chain[1:][along > 0], np.roll(nodes, -1, axis=1)[across > 0]])
    _, label = connected_components(
        coo_matrix((np.ones(begin.size), (begin, end)), shape=(m * n + 2,) * 2), directed=False)
    labels = label[nodes]
    return (labels != label[-2]) & (labels != label[-1]), label[-2] == label[-1]


def network_conductance(along, across):
    """The conductance of a ring of bonds between inlet and outlet.

    along (N1, N2): N1 bonds one after the other in the direction of the flow, N2 around.
    across (N1 - 1, N2): from the node behind along[i, j] to that behind along[i, j + 1].
    """
    along, across = np.asarray(along, float), np.asarray(across, float)
    m, n = along.shape[0] - 1, along.shape[1]
    scale = along.max(initial=0.)
    if m == 0 or scale == 0:
        return along[0].sum() if m == 0 else 0.
    along = along / scale
    across = across / scale if n > 1 else np.zeros((m, 1))  # a single one is its own neighbour
    nodes = _positions(n) * m + np.arange(m)[:, None]
    diagonal = along[:-1] + along[1:] + across + np.roll(across, 1, axis=1)
    if along.min() == 0 or across.min(initial=1) == 0:
        floating, connected = _floating(nodes, along, across)
        if not connected:
            return 0.
        diagonal[floating] += 1  # no current reaches them: any potential will do

    matrix = np.zeros((2 * m + 1, m * n))  # lower half of a symmetric band
    matrix[0, nodes] = diagonal
    for begin, end, bonds in ((nodes[:-1], nodes[1:], along[1:-1]),
                              (nodes, np.roll(nodes, -1, axis=1), across)):
        np.subtract.at(matrix, (abs(end - begin), np.minimum(begin, end)), bonds)
    right = np.zeros(m * n)
    right[nodes[0]] = along[0]
    matrix = matrix[:m * n]  # a small matrix has fewer diagonals
    potential = solveh_banded(matrix, right, lower=True, check_finite=False)[nodes]
    # The dissipated power: its error is of second order in that of the potential.
    chain = np.concatenate([np.ones((1, n)), potential, np.zeros((1, n))])
    return scale * ((along * np.diff(chain, axis=0)**2).sum() +
                    (across * (np.roll(potential, -1, axis=1) - potential)**2).sum())


def at_loads(loads, conductances, wanted):
    """Interpolate the conductances (patches, loads) to the wanted loads: (patches, wanted).

    ln K is linear in the load. Between a load where a patch leaks and one where it is sealed, K is
    linear, which is an upper estimate, as K vanishes faster.
    """
    # Rounding must neither lead beyond the last load nor open a patch that is sealed at a load.
    nearest = loads[np.abs(np.subtract.outer(wanted, loads)).argmin(axis=-1)]
    wanted = np.where(at_load(wanted, nearest), nearest, wanted)
    right = np.clip(np.searchsorted(loads, wanted), 1, len(loads) - 1)
    weight = (wanted - loads[right - 1]) / (loads[right] - loads[right - 1])
    a, b = conductances[:, right - 1], conductances[:, right]
    open_ = (a > 0) & (b > 0)
    logs = [np.log(np.where(open_, k, 1)) for k in (a, b)]
    return np.where(open_, np.exp((1 - weight) * logs[0] + weight * logs[1]),
                    (1 - weight) * a + weight * b)


def sample_seals(along, across, n_around, aspect, resampled, rng):
    """Conductances of N_NETWORKS random seals, per square.

    along (n, N1), across (n, N1 - 1): conductances of the n patches at the pressures of their
    places over the width; aspect: width of a patch around the ring over its length along the flow.
    If resampled, each seal is made of n - 1 patches drawn from the n with repetition, which scatter
    about their mean as the n do about the true one; of two patches two are drawn, which scatter
    less.
    """
    n_along = along.shape[1]
    n_around = _most_around(n_along, n_around)
    seals = []
    for _ in range(N_NETWORKS):
        pools = [pool[rng.integers(len(pool), size=max(len(pool) - 1, 2))] if resampled else pool
                 for pool in (along, across)]
        bonds = [pool[rng.integers(len(pool), size=(n_around, pool.shape[1])),
                      np.arange(pool.shape[1])].T for pool in pools]
        seals.append(network_conductance(bonds[0] * aspect, bonds[1] / aspect) *
                     n_along / (n_around * aspect))
    return np.array(seals)


def _scatter(samples):
    """Standard deviation of the logarithm of those that leak."""
    leaking = samples[samples > 0]
    return np.log(leaking).std() if leaking.size > 1 else 0.


class Band:
    """Median, 5 and 95 % quantiles of the conductance of a seal, and the sources of its scatter."""

    def __init__(self, along, across, n_around, aspect, solution_error, rng):
        both = sample_seals(along, across, n_around, aspect, True, rng)
        alone = sample_seals(along, across, n_around, aspect, False, rng)
        self.arrangement = _scatter(alone)
        self.patches = np.sqrt(max(_scatter(both)**2 - self.arrangement**2, 0.))
        self.solution = solution_error
        # The scatter of patches is known only from the n of them: Student's t.
        free = max(len(along) - 1, 1)
        self.student = stdtrit(free, 0.95) / ndtri(0.95)
        self.student *= np.sqrt(max(free, 2) / free)  # two drawn of two scatter too little
        self.sealed = np.mean(both == 0)
        # The error of the solutions is known, however few patches there are.
        seals = self._widened(both) * np.exp(solution_error * rng.uniform(-1, 1, both.size))
        self.median, self.lower, self.upper = np.quantile(seals, (0.5, 0.05, 0.95))

    def _widened(self, samples):
        """Samples whose logarithms are moved away from their median, as Student's t requires."""
        median, total = np.median(samples), np.hypot(self.patches, self.arrangement)
        if median == 0 or total == 0:
            return samples
        by = np.hypot(self.student * self.patches, self.arrangement) / total
        return median * (samples / median)**by
