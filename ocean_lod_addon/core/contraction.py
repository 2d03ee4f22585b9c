# SPDX-License-Identifier: GPL-3.0-or-later
"""The matrix products of a frame, by whichever way this machine's NumPy does them fastest.

NumPy with a BLAS multiplies matrices at the processor's full speed. Without one, as some builds of Blender
ship it, np.matmul is a plain loop; np.einsum is then many times faster, and because it releases the
interpreter lock, products spread over threads. Multiplications are dear there, so that it pays to halve them
by the plane's symmetry (MirroredProduct).
"""

import contextlib
import functools
import itertools
import os
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


@dataclass(frozen=True, eq=False)
class Product:
    """One matrix product, left @ right written into `out`; all float32, rows of `out` contiguous."""

    left: np.ndarray
    right: np.ndarray
    out: np.ndarray

    @functools.cached_property
    def operations(self) -> float:
        """Additions and multiplications."""
        return 2.0 * self.left.shape[0] * self.left.shape[1] * self.right.shape[1]

    @functools.cached_property
    def pieces(self) -> tuple["Product", ...]:
        """It cut up for threads without BLAS; every element is summed in the same order as in the whole."""
        rows, columns = self.out.shape
        return tuple(
            Product(self.left[across], self.right[:, along], self.out[across, along])
            for across in even_slices(rows, PIECE_ROWS)
            for along in even_slices(columns, PIECE_COLUMNS)
        )


@dataclass(frozen=True, eq=False)
class MirroredProduct:
    """Two products at the price of one, on rectangles of the plane that mirror each other about its middle line.

        U = left[0] @ right[0],   V = left[1] @ right[1]
        out = U + V               on the rectangle, (rows, lines x columns), or None if nobody sees it
        mirrored = s (U - V)      on its mirror image, (rows, lines, columns), in the order of the former, or None

    `signs` are the s of each column, 1 or -1. The rectangle may begin with the middle line, which has no image.
    """

    left: tuple[np.ndarray, np.ndarray]
    right: tuple[np.ndarray, np.ndarray]
    signs: tuple[int, ...]
    out: np.ndarray | None
    mirrored: np.ndarray | None

    @functools.cached_property
    def operations(self) -> float:
        """Additions and multiplications in U and V."""
        return sum(
            2.0 * left.shape[0] * left.shape[1] * right.shape[1]
            for left, right in zip(self.left, self.right, strict=True)
        )

    @functools.cached_property
    def pieces(self) -> tuple["MirroredProduct", ...]:
        """It cut up for threads, as a `Product` is."""
        return tuple(
            self._piece(across, along)
            for across in even_slices(len(self.left[0]), PIECE_ROWS)
            for along in even_slices(self._lines, PIECE_COLUMNS // len(self.signs))
        )

    @property
    def _lines(self):
        return self.right[0].shape[1] // len(self.signs)

    def _piece(self, rows, lines):
        width = len(self.signs)
        columns = slice(width * lines.start, width * lines.stop)
        mirrored = None
        if self.mirrored is not None:
            without_image = self._lines - self.mirrored.shape[1]
            image = slice(max(lines.start - without_image, 0), lines.stop - without_image)
            mirrored = self.mirrored[rows, image]
        return MirroredProduct(
            tuple(left[rows] for left in self.left),
            tuple(right[:, columns] for right in self.right),
            self.signs,
            None if self.out is None else self.out[rows, columns],
            mirrored,
        )


class CallCost(NamedTuple):
    """What a product takes besides its multiplications, as multiplications that take as long; found by trying.

    rows   so many more rows of the left factor: the right one is rearranged at each call
    terms  so many multiplications for each column of a block: all else of a call
    """

    rows: int
    terms: float


@dataclass(frozen=True, eq=False)
class Contraction:
    """A way to multiply: `multiply` a list of products, `mirrored` where it wants MirroredProducts."""

    multiply: Callable[[list], None]
    mirrored: bool
    call: CallCost


def multiply_with_blas(products) -> None:
    """All products by np.matmul, which threads within a product itself."""
    for product in products:
        np.matmul(product.left, product.right, out=product.out)


def multiply_without_blas(products) -> None:
    """All products by np.einsum, in pieces spread over the processor's cores."""
    in_threads(_multiply_batch, _batches(products))


def _batches(products):
    """The pieces of some products in lists of about equal work, as many for each core; or one, of little work."""
    pieces = [piece for product in products for piece in product.pieces]
    operations = sum(piece.operations for piece in pieces)
    count = _for_each_core(piece_count(operations, WORTH_A_THREAD))
    result, done = [[] for _ in range(count)], 0.0
    for piece in pieces:
        result[min(int(count * (done + 0.5 * piece.operations) / operations), count - 1)].append(piece)
        done += piece.operations
    return [batch for batch in result if batch]


WORTH_A_THREAD = 3e7
"""Additions and multiplications, two or three milliseconds. To hand work over and to pass the interpreter lock to
and fro costs more than half a millisecond."""

PIECE_ROWS, PIECE_COLUMNS = 64, 3072
"""A piece of a product for one thread, about. For each row of `left`, einsum runs through all of `right`: whole
rows of that follow each other in memory, parts of rows do not, which takes a fifth longer. Rows of more columns
push the row that they add to out of the cache."""


def even_slices(length: int, size: float) -> list[slice]:
    """Equal slices of range(length), about `size` long: no remainder is left that is too short to be fast."""
    return _slices(length, piece_count(length, size))


def _slices(length, count):
    cuts = [length * number // count for number in range(count + 1)]
    return [slice(start, stop) for start, stop in itertools.pairwise(cuts)]


def piece_count(length: float, size: float) -> int:
    """Into how many pieces of about `size` a length is cut."""
    return max(1, round(length / size))


def _multiply_batch(pieces):
    for piece in pieces:
        if isinstance(piece, MirroredProduct):
            _multiply_mirrored(piece)
        else:
            np.einsum("ij,jk->ik", piece.left, piece.right, out=piece.out)


def _multiply_mirrored(product):
    (rows, _), (_, width) = product.left[0].shape, product.right[0].shape
    U, V = _scratch.matrices(rows, width)
    for left, right, out in zip(product.left, product.right, (U, V), strict=True):
        np.einsum("ij,jk->ik", left, right, out=out)
    if product.out is not None:
        np.add(U, V, out=product.out)
    if product.mirrored is not None:
        _, lines, columns = product.mirrored.shape
        own = slice(width - lines * columns, None)  # without the middle line, which has no image
        for column, sign in enumerate(product.signs):
            less, more = (matrix[:, own][:, column::columns] for matrix in ((V, U) if sign > 0 else (U, V)))
            np.subtract(more, less, out=product.mirrored[:, :, column])


def aligned_matrix(rows: int, columns: int) -> np.ndarray:
    """An uninitialised float32 matrix whose rows all begin where the processor loads fastest."""
    width = -(-columns // _ALIGNMENT) * _ALIGNMENT
    memory = np.empty(rows * width + _ALIGNMENT, np.float32)
    start = -(memory.ctypes.data // memory.itemsize) % _ALIGNMENT
    return memory[start : start + rows * width].reshape(rows, width)[:, :columns]


_ALIGNMENT = 16
"""float32 in a cache line."""


class _Scratch(threading.local):
    """A thread's own U and V."""

    def __init__(self):
        self._kept = {}

    def matrices(self, rows, columns):
        """Two matrices of at least so many rows, cut to them."""
        kept = self._kept.get(columns)
        if kept is None or len(kept[0]) < rows:
            kept = self._kept[columns] = (aligned_matrix(rows, columns), aligned_matrix(rows, columns))
        return kept[0][:rows], kept[1][:rows]


_scratch = _Scratch()


def in_threads(work: Callable[[object], object], pieces) -> None:
    """Do `work` on all pieces, spread over the processor's cores, as far as NumPy frees the interpreter lock.

    To wake another thread takes some tenths of a millisecond: a single piece is not worth it.
    """
    pieces = list(pieces)
    if len(pieces) == 1:
        work(pieces[0])
        return
    for _ in _threads().map(work, pieces):
        pass


def shares(vertices: int, columns: int = 1) -> list[slice]:
    """Equal parts of so many vertices for `in_threads`, as many for each core; or all, if they are few.

    `columns` is how many numbers that lie side by side in memory each vertex has, of which one is taken at a time.
    """
    most = min(_MOST_VERTICES, _MOST_NUMBERS // columns)
    return _slices(vertices, _for_each_core(max(1, -(-vertices // most))))


_MOST_VERTICES = 1 << 17
"""In a thread's turn. Of less work, threads spend their time on waiting for the interpreter."""

_MOST_NUMBERS = 1 << 21
"""In a thread's turn: lines of more float32 have left the cache when the next number in them is wanted."""


def _for_each_core(count):
    """At least so many pieces, as many for each core; or 1, which needs no other."""
    return count if count <= 1 else count + -count % _core_count()


def _core_count():
    return os.cpu_count() or 1


@functools.lru_cache(maxsize=1)
def _threads():
    return ThreadPoolExecutor(_core_count(), "ocean_lod", np.setbufsize, (SMALL_BUFFER,))


SMALL_BUFFER = 256
"""Elements that NumPy copies at a time where it wants to. Its own choice, 8192 of each operand, would push out of
a core's cache what the frame needs next, and be most of what a frame allocates."""


@contextlib.contextmanager
def small_buffers():
    """Within this context NumPy copies few elements at a time."""
    before = np.setbufsize(SMALL_BUFFER)
    try:
        yield
    finally:
        np.setbufsize(before)


CONTRACTIONS = {
    "matmul": Contraction(multiply_with_blas, mirrored=False, call=CallCost(8, 2e5)),
    "einsum": Contraction(multiply_without_blas, mirrored=True, call=CallCost(0, 1e5)),
}
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
    count = 2 * _core_count()
    products = [Product(left, right, np.empty((64, 192), np.float32)) for _ in range(count)]
    with_blas, without = (_best_time(CONTRACTIONS[name], products) for name in ("matmul", "einsum"))
    return "einsum" if _CLEAR_WIN * without < with_blas else "matmul"


def _best_time(contraction, products, repeats=5):
    durations = []
    for _ in range(repeats):
        start = time.perf_counter()
        contraction.multiply(products)
        durations.append(time.perf_counter() - start)
    return min(durations)
