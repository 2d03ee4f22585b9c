# SPDX-License-Identifier: GPL-3.0-or-later
"""Counter-based random numbers: the n-th draw of a stream depends on its seed and n alone.

SplitMix64 (Steele, Lea and Flood 2014). Adding waves to a set never changes the draws of earlier ones, and
every platform and NumPy gives the same bits.
"""

import numpy as np

_GOLDEN_GAMMA = np.uint64(0x9E3779B97F4A7C15)
_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)


def splitmix64(seed: int, index) -> np.ndarray:
    """The 64-bit outputs number `index` (0, 1, ..., any shape) of the stream `seed`, as uint64."""
    counter = np.asarray(index, dtype=np.uint64) + np.uint64(1)
    with np.errstate(over="ignore"):  # arithmetic modulo 2^64 is the generator's definition
        z = np.uint64(seed % 2**64) + counter * _GOLDEN_GAMMA
        z = (z ^ (z >> np.uint64(30))) * _MIX_1
        z = (z ^ (z >> np.uint64(27))) * _MIX_2
    return z ^ (z >> np.uint64(31))


def uniform(seed: int, index) -> np.ndarray:
    """Draws number `index` of the stream `seed`, uniform on [0, 1), with 53 random bits, as float64."""
    return (splitmix64(seed, index) >> np.uint64(11)).astype(np.float64) * 2.0**-53


def stream_seed(seed: int, stream: int) -> int:
    """The seed of a sub-stream, so that different uses of one seed (phases, directions) are independent."""
    return int(splitmix64(seed, stream))
