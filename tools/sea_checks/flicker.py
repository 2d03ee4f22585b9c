# SPDX-License-Identifier: GPL-3.0-or-later
"""A slow dolly towards the horizon, in a moving sea: by how much pixels just below the horizon change from frame
to frame, over the same in frames of 8 x 8 as many pixels, scaled down.

Those show the waves that a pixel of the frame can not tell apart one by one, as a lens would; what the frame
changes beyond them is aliasing. The noise of a path tracer changes pixels as well, but the less the more samples
there are, and it is no aliasing: every frame of Cycles is rendered twice with other noise, and the mean product of
both changes, to which noise adds nothing, is the mean square of the water's own. EEVEE has the same noise in every
picture, which can not be told apart: it counts.
"""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ocean_lod_addon.cli.render import set_samples
from ocean_lod_addon.core import presets
from ocean_lod_addon.core.shot import Shot

from .scenes import add_ocean, luminance, new_scene, save_gray, stretched

LIMIT = 1.5
SUPERSAMPLING = 8
_BELOW_HORIZON = 2  # pixels
_DOLLY = 0.05  # m in a frame
_EXPOSURE = -3.0  # stops: for the glitter, which would be white all over and hide what changes


@dataclass(frozen=True)
class Band:
    """What is looked at: of frames `width` pixels wide, rows below the horizon and columns in the middle; and how
    many frames."""

    width: int
    rows: int
    columns: int
    frames: int


@dataclass(frozen=True)
class Change:
    """Mean brightness over white, and the root mean square of what pixels change by: of the water's own making,
    and with the picture's noise."""

    mean: float
    water: float
    with_noise: float


def dolly(engine: str, band: Band):
    """The scene: an ocean fitted to a camera whose frames are `band.width` pixels wide."""
    preset = presets.load("moderate")
    shot = Shot(camera_height=3.0, camera_pitch=0.0, exposure=_EXPOSURE)
    scene = new_scene(shot, engine, band.width, band.width * 9 // 16, samples=1)
    add_ocean(scene, preset.sea, band.width, preset.material)
    return scene


def change(scene, band: Band, samples: int, factor: int, save: Path | None = None) -> Change:
    """The changes in frames of `factor` x `factor` as many pixels, scaled down."""
    set_samples(scene, samples)
    render = scene.render
    height = band.width * 9 // 16
    render.resolution_x, render.resolution_y = band.width * factor, height * factor
    render.use_border = render.use_crop_to_border = True
    half = 0.5 * band.columns / band.width
    render.border_min_x, render.border_max_x = 0.5 - half, 0.5 + half
    top = 0.5 - _BELOW_HORIZON / height
    render.border_min_y, render.border_max_y = top - band.rows / height, top
    seeds = (1, 2) if render.engine == "CYCLES" else (1,)
    films = []
    for seed in seeds:
        frames = []
        for number in range(band.frames):
            scene.cycles.seed = seed + len(seeds) * number
            scene.frame_set(1 + number)
            scene.camera.location.x = _DOLLY * number
            picture = luminance(scene)
            rows, columns = (side // factor for side in picture.shape)
            squares = picture[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor)
            frames.append(np.minimum(squares.mean(axis=(1, 3)), 1.0))  # as they are seen: glitter is white
        films.append(frames)
    if save is not None:
        save_gray(save, stretched(films[0][0]))
    changes = np.diff(films, axis=1)
    water = max(float(np.mean(changes[0] * changes[-1])), 0.0)
    return Change(float(np.mean(films)), float(np.sqrt(water)), float(np.sqrt(np.mean(changes**2))))


def run(options) -> None:
    """Print the change of the frames, of the reference, and their ratio, and save pictures and numbers."""
    band = Band(options.width, options.rows, options.columns, options.frames)
    folder = Path(options.save) if options.save else None
    found, scene = {}, dolly(options.engine, band)
    for name, factor in (("frames", 1), ("reference", SUPERSAMPLING)):
        samples = options.samples if factor == 1 else max(1, options.samples * 4 // factor**2)
        picture = folder / f"flicker_{options.engine}_{name}.png" if folder else None
        each = found[name] = change(scene, band, samples, factor, picture)
        print(
            f"{name:<10} mean {each.mean:.4f}, rms change from frame to frame {each.water:.5f},"
            f" with noise {each.with_noise:.5f}",
            flush=True,
        )
    ratio = found["frames"].water / found["reference"].water
    passed = ratio <= LIMIT
    word = "PASS" if passed else "MISS"
    print(f"{word}: {options.engine} flickers {ratio:.2f} times as much as the reference, allowed is {LIMIT:g}")
    if folder:
        report = {name: asdict(each) for name, each in found.items()} | {"ratio": ratio, "limit": LIMIT}
        (folder / f"flicker_{options.engine}.json").write_text(json.dumps(report, indent=2) + "\n")
