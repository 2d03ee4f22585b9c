# SPDX-License-Identifier: GPL-3.0-or-later
"""The matrix products of a frame, by whichever way this machine's NumPy does them fastest.

NumPy with a BLAS multiplies matrices at the processor's full speed. Without one, as some builds of Blender
ship it, np.matmul is a plain loop; np.einsum is then many times faster, and because it releases the
interpreter lock, products spread over threads.
"""

import functools
import itertools
import os
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Product:
    """One matrix product, left @ right written into `out`; all float32, rows of `out` contiguous."""

    left: np.ndarray
    right: np.ndarray
    out: np.ndarray


def multiply_with_blas(products) -> None:
    """All products by np.matmul, which threads within a product itself."""
    for product in products:
        np.matmul(product.left, product.right, out=product.out)


def multiply_without_blas(products) -> None:
    """All products by np.einsum, in pieces spread over the processor's cores."""
    pieces = [piece for product in products for piece in _pieces(product)]
    for _ in _threads().map(_einsum, pieces):
        pass


_PIECE_ROWS, _PIECE_COLUMNS = 128, 384
"""A piece of a product for one thread, about; a millisecond of work. For each row of `left`, einsum runs through
all of `right`: so many columns of it stay in a core's own cache, and shorter runs would slow its inner loop."""


def _pieces(product):
    """A product cut up; every element is summed in the same order as in the whole."""
    rows, columns = product.out.shape
    for across in _even_slices(rows, _PIECE_ROWS):
        for along in _even_slices(columns, _PIECE_COLUMNS):
            yield Product(product.left[across], product.right[:, along], product.out[across, along])


def _even_slices(length, size):
    """Equal slices of range(length), about `size` long: no remainder is left that is too short to be fast."""
    count = max(1, round(length / size))
    cuts = [length * number // count for number in range(count + 1)]
    return [slice(start, stop) for start, stop in itertools.pairwise(cuts)]


def _einsum(product):
    np.einsum("ij,jk->ik", product.left, product.right, out=product.out)


@functools.lru_cache(maxsize=1)
def _threads():
    return ThreadPoolExecutor(max_workers=os.cpu_count(), thread_name_prefix="ocean_lod")


CONTRACTIONS = {"matmul": multiply_with_blas, "einsum": multiply_without_blas}
"""The ways there are; both give the same result up to float32 rounding."""


_FAST_LIBRARIES = ("openblas", "mkl", "accelerate", "blis", "armpl", "nvpl", "flexiblas")
"""Names, or parts of names, that NumPy's build gives to libraries of full speed."""

_CLEAR_WIN = 2.0
"""A measurement must be this clear to choose einsum, so that a busy machine does not tip the choice."""


def blas_library() -> str:
    """Name of the BLAS that NumPy was built with, in lower case, or an empty text if it has none."""
    library = np.show_config(mode="dicts")["Build Dependencies"].get("blas", {})
    name = library.get("name", "none").lower()
    return name if library.get("found", False) and name != "none" else ""


@functools.lru_cache(maxsize=1)
def fastest_contraction() -> str:
    """Which of CONTRACTIONS is faster with this NumPy.

    What NumPy was built with decides, so that every process and every machine of a farm with the same NumPy
    chooses alike: the two differ in the last bits. Only a library of unknown speed is measured, once.
    """
    name = blas_library()
    if not name:
        return "einsum"
    if any(known in name for known in _FAST_LIBRARIES):
        return "matmul"
    return _faster_as_measured()


def _faster_as_measured():
    """Some milliseconds on tiles of the usual shape."""
    generator = np.random.Generator(np.random.PCG64(0))
    left = generator.random((64, 258), np.float32)
    right = generator.random((258, 192), np.float32)
    count = 2 * (os.cpu_count() or 1)
    products = [Product(left, right, np.empty((64, 192), np.float32)) for _ in range(count)]
    with_blas, without = (_best_time(CONTRACTIONS[name], products) for name in ("matmul", "einsum"))
    return "einsum" if _CLEAR_WIN * without < with_blas else "matmul"


def _best_time(multiply, products, repeats=5):
    durations = []
    for _ in range(repeats):
        start = time.perf_counter()
        multiply(products)
        durations.append(time.perf_counter() - start)
    return min(durations)
