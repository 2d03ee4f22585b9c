# SPDX-License-Identifier: GPL-3.0-or-later
"""How the products of a frame are shared out to threads where there is no BLAS."""

import os

import numpy as np
import pytest

from ocean_lod_addon.core import contraction
from ocean_lod_addon.core.contraction import MirroredProduct, Product


def product(rows, inner, columns):
    left, right = np.ones((rows, inner), np.float32), np.ones((inner, columns), np.float32)
    return Product(left, right, np.empty((rows, columns), np.float32))


@pytest.mark.parametrize("count", [1, 7, 40])
def test_every_piece_is_in_one_batch_in_its_turn(count):
    products = [product(100 + 10 * number, 80, 1500) for number in range(count)]
    pieces = [piece for each in products for piece in each.pieces]
    shared_out = [piece for batch in contraction._batches(products) for piece in batch]
    assert [id(piece) for piece in shared_out] == [id(piece) for piece in pieces]


def test_little_work_stays_in_one_batch_and_much_is_shared_evenly():
    assert len(contraction._batches([product(10, 10, 10)] * 50)) == 1
    much = contraction._batches([product(128, 100, 1000)] * 60)
    operations = [sum(piece.operations for piece in batch) for batch in much]
    assert len(much) % os.cpu_count() == 0
    assert sum(operations) / len(much) <= 1.5 * contraction.WORTH_A_THREAD
    largest_piece = max(piece.operations for batch in much for piece in batch)
    assert max(operations) - min(operations) <= 2.0 * largest_piece


@pytest.mark.parametrize("vertices", [0, 1, 1000, 1 << 17, (1 << 17) + 1, 1_000_003])
def test_shares_are_all_vertices_once_and_as_many_for_each_core(vertices):
    shares = contraction.shares(vertices)
    covered = np.concatenate([np.arange(vertices)[share] for share in shares])
    assert (covered == np.arange(vertices)).all()
    lengths = [share.stop - share.start for share in shares]
    assert max(lengths) - min(lengths) <= 1
    assert max(lengths) <= 1 << 17
    assert len(shares) == 1 if vertices <= 1 << 17 else len(shares) % os.cpu_count() == 0


def test_shares_of_many_columns_stay_in_the_cache():
    assert len(contraction.shares(1 << 17, 16)) == 1
    shares = contraction.shares(1 << 17, 64)
    assert len(shares) % os.cpu_count() == 0
    assert all((share.stop - share.start) * 64 <= 1 << 21 for share in shares)


def test_no_product_is_no_work():
    contraction.multiply_without_blas([])


@pytest.mark.parametrize("own", [True, False])
@pytest.mark.parametrize("first_line_has_no_image", [True, False])
def test_pieces_of_a_mirrored_product_make_the_whole(own, first_line_has_no_image):
    """U + V, and s (U - V) of each line that has an image; the sum is not cut, so the bits are equal."""
    random = np.random.default_rng(2)
    rows, lines, signs = 300, 1700, (1, -1, 1)
    left = tuple(random.random((rows, 20), np.float32) for _ in range(2))
    right = tuple(random.random((20, lines * len(signs)), np.float32) for _ in range(2))
    out = np.full((rows, lines * len(signs)), np.nan, np.float32) if own else None
    image = np.full((rows, lines - first_line_has_no_image, len(signs)), np.nan, np.float32)
    whole = MirroredProduct(left, right, signs, out, image)
    assert len(whole.pieces) > 2
    assert all(len(p.left[0]) < rows and p.right[0].shape[1] < 3 * lines for p in whole.pieces)
    contraction.multiply_without_blas([whole])
    U, V = (np.einsum("ij,jk->ik", a, b) for a, b in zip(left, right, strict=True))
    if own:
        np.testing.assert_array_equal(out, U + V)
    expected = (U - V).reshape(rows, lines, len(signs)) * np.array(signs, np.float32)
    np.testing.assert_array_equal(image, expected[:, first_line_has_no_image:])
