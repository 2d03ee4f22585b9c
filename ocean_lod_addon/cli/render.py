# SPDX-License-Identifier: GPL-3.0-or-later
"""`render`: a still or an animation of a preset's shot, or of an existing .blend file."""

import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from ..core import presets
from ..core.cost.quality import QUALITIES
from ..core.errors import OceanError
from ..core.sea import LARGEST_SEED
from ..core.shot_fit import first_fit, frame_needs
from .arguments import FrameRange, frame_range, real_number, resolution, whole_number

NAME = "render"
HELP = "Render a preset's shot, or an existing .blend file, to PNG, EXR or MP4."


@dataclass(frozen=True)
class _Format:
    """How Blender calls a kind of output."""

    file_format: str
    is_movie: bool = False


_FORMATS = {".png": _Format("PNG"), ".exr": _Format("OPEN_EXR"), ".mp4": _Format("FFMPEG", is_movie=True)}
_ENGINES = ("CYCLES", "EEVEE")


def add_arguments(parser) -> None:
    """Declare the command's arguments."""
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--preset", default="moderate", help="sea preset, or a preset .json file (%(default)s)")
    source.add_argument("--blend", metavar="FILE", help="render this .blend file instead of a preset's shot")
    parser.add_argument("--engine", choices=_ENGINES, help="render engine (CYCLES, or the file's)")
    parser.add_argument("--frames", type=frame_range, metavar="A:B[:STEP]", help="frames (1, or the file's)")
    parser.add_argument("--resolution", type=resolution, metavar="WxH", help="pixels (960x540, or the file's)")
    parser.add_argument(
        "--samples", type=whole_number(1, 1 << 20), metavar="N", help="samples per pixel (64, or the file's)"
    )
    parser.add_argument("--denoise", action="store_true", help="clean up the noise of Cycles")
    effort = parser.add_mutually_exclusive_group()
    effort.add_argument(
        "--quality", choices=tuple(QUALITIES), help="effort spent on mesh and ripples (standard, or the file's)"
    )
    effort.add_argument(
        "--budget-ms",
        type=real_number(0.01, 1e6),
        metavar="MS",
        help="the best quality whose frames take this long at most on this machine, before rendering",
    )
    parser.add_argument("--output", default="ocean.png", metavar="PATH", help=".png, .exr or .mp4 (%(default)s)")
    parser.add_argument(
        "--seed", type=whole_number(0, LARGEST_SEED), default=0, metavar="N", help="another sea of the same kind"
    )
    parser.add_argument("--save-blend", metavar="FILE", help="also save the scene that was rendered")


def run(options) -> None:
    """Render. Raises OceanError for what the artist can mend, before anything is written."""
    output = Path(options.output).absolute()
    output_format = _output_format(output)
    frames = options.frames
    _check_writable(output)
    if options.save_blend:
        _check_save_target(Path(options.save_blend))
    if options.blend:
        scene = open_blend(Path(options.blend))
        frames = frames or FrameRange(scene.frame_current, scene.frame_current)
        _set_overrides(scene, options)
    else:
        scene = _build(options)
        frames = frames or FrameRange(1, 1)
    _set_quality(scene, options)
    _set_output(scene, output, output_format, frames)
    if options.save_blend:
        _save(Path(options.save_blend))
    _render(scene, output, output_format, frames)


def _output_format(output):
    found = _FORMATS.get(output.suffix.lower())
    if found is None:
        raise OceanError(f"--output {output.name!r} ends in {output.suffix!r}, allowed is {', '.join(_FORMATS)}")
    return found


def _check_writable(output):
    folder = output.parent
    while not folder.exists():
        folder = folder.parent
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise OceanError(f"--output {output}: its folder can not be written to")
    if output.is_dir():
        raise OceanError(f"--output {output} is a folder, give a file name")


def _check_save_target(path):
    if path.suffix != ".blend":
        raise OceanError(f"--save-blend {path.name!r} ends in {path.suffix!r}, allowed is .blend")
    if path.is_dir():
        raise OceanError(f"--save-blend {path} is a folder, give a file name")
    _check_writable(path.absolute())


def open_blend(path: Path):
    """Open a .blend file; returns its scene, which has an ocean and a camera. Raises OceanError."""
    import bpy

    from ..scene import ocean_object

    if not path.is_file():
        raise OceanError(f"--blend {path}: there is no such file")
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path.absolute()), load_ui=False)
    except RuntimeError as error:
        raise OceanError(f"--blend {path}: {str(error).strip().splitlines()[-1]}") from None
    _ensure_registered()
    scene = bpy.context.scene
    if not any(ocean_object.is_ocean(ob) for ob in scene.objects):
        raise OceanError(f"--blend {path}: its scene {scene.name!r} has no ocean")
    if scene.camera is None:
        raise OceanError(f"--blend {path}: its scene {scene.name!r} has no camera")
    return scene


def _build(options):
    import bpy

    from ..scene import ocean_object, placing, shot_scene

    preset = presets.load(options.preset)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    _ensure_registered()
    scene = bpy.context.scene
    _set_default_quality(scene, options)
    _set_overrides(scene, options)
    shot_scene.build(scene, preset.shot)
    bpy.context.view_layer.update()
    needs = frame_needs(placing.view_of(scene.camera, scene), scene.render.resolution_x)
    sea = presets.with_seed(preset.sea, options.seed)
    grid, ripples, _ = first_fit(sea, needs)
    ocean = ocean_object.create(scene, sea, grid, preset.material, ripples=ripples, foam=preset.foam)
    scene.collection.objects.link(ocean)
    return scene


def _set_quality(scene, options):
    """Choose a quality, once: another machine that is to render the same is given it by name."""
    from ..scene import costing, ocean_object

    oceans = [ob for ob in scene.objects if ocean_object.is_ocean(ob)]
    for ob in oceans:
        if options.quality:
            costing.set_quality(ob, scene, options.quality)
        elif options.budget_ms is not None:
            choice = costing.meet_budget(ob, scene, 1e-3 * options.budget_ms / len(oceans))
            print(choice.explain(), file=sys.stdout if choice.fits else sys.stderr, flush=True)


def _ensure_registered():
    """Loading the factory settings switches off extensions, us among them."""
    import bpy

    if not hasattr(bpy.types.Object, "ocean_lod"):
        from .. import register

        register()


def _set_default_quality(scene, options):
    import bpy

    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.render.resolution_percentage = 100
    set_engine(scene, options.engine or "CYCLES")
    scene.cycles.use_denoising = False
    # What does not move is not built anew for each frame. Cycles in 4.5 would show the first frame's ripples.
    scene.render.use_persistent_data = bpy.app.version >= (5, 2, 0)
    scene.cycles.sample_clamp_indirect = 0.0
    scene.cycles.sample_clamp_direct = 0.0
    set_samples(scene, 64)


def _set_overrides(scene, options):
    if options.engine:
        set_engine(scene, options.engine)
    if options.resolution:
        scene.render.resolution_x, scene.render.resolution_y = options.resolution
        scene.render.resolution_percentage = 100
    if options.samples:
        set_samples(scene, options.samples)
    if options.denoise:
        _denoise(scene.cycles)


def set_engine(scene, engine: str) -> None:
    """Choose a render engine, CYCLES or EEVEE (which Blender 4.5 calls otherwise)."""
    import bpy

    if engine == "EEVEE":
        offered = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
        engine = next(name for name in offered if name.startswith("BLENDER_EEVEE"))
    scene.render.engine = engine


def set_samples(scene, samples: int) -> None:
    """Samples per pixel, of whichever engine renders."""
    scene.cycles.samples = samples
    scene.eevee.taa_render_samples = samples


def _denoise(cycles):
    """Open Image Denoise at its quickest, which costs less than a sample; at its best it costs seconds."""
    try:
        cycles.denoiser = "OPENIMAGEDENOISE"
    except TypeError:
        raise OceanError("--denoise: this Blender was built without Open Image Denoise") from None
    cycles.use_denoising = True
    cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
    cycles.denoising_quality = "FAST"
    cycles.denoising_prefilter = "NONE"


def _set_output(scene, output, output_format, frames):
    image = scene.render.image_settings
    if hasattr(image, "media_type"):  # Blender 5
        image.media_type = "VIDEO" if output_format.is_movie else "IMAGE"
    image.file_format = output_format.file_format
    if output_format.is_movie:
        ffmpeg = scene.render.ffmpeg
        ffmpeg.format, ffmpeg.codec = "MPEG4", "H264"
        ffmpeg.constant_rate_factor, ffmpeg.gopsize = "HIGH", 12
    elif output_format.file_format == "OPEN_EXR":
        image.color_depth = "32"
    scene.frame_start, scene.frame_end, scene.frame_step = frames.first, frames.last, frames.step
    scene.frame_set(frames.first)
    numbered = not output_format.is_movie and len(frames) > 1
    scene.render.filepath = str(output.with_suffix("")) + "_####" if numbered else str(output)
    scene.render.use_file_extension = numbered


def _save(path):
    import bpy

    bpy.ops.wm.save_as_mainfile(filepath=str(path.absolute()), copy=True)
    print(f"saved {path}", flush=True)


class _Progress:
    """A line per frame: which, how long it took, how long is left."""

    def __init__(self, scene, frames):
        self._scene, self._frames = scene, frames
        self._start = self._frame_start = time.perf_counter()
        self._done = 0

    def frame_begins(self, *_):
        self._frame_start = time.perf_counter()

    def frame_done(self, *_):
        now = time.perf_counter()
        self._done += 1
        left = (now - self._start) / self._done * (len(self._frames) - self._done)
        print(
            f"frame {self._scene.frame_current} ({self._done} of {len(self._frames)})"
            f"  {now - self._frame_start:.1f} s  {left:.0f} s left",
            flush=True,
        )


def _render(scene, output, output_format, frames):
    import bpy

    try:
        output.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OceanError(f"--output {output}: its folder can not be written to: {error.strerror}") from None
    progress = _Progress(scene, frames)
    handlers = bpy.app.handlers
    handlers.render_pre.append(progress.frame_begins)
    handlers.render_post.append(progress.frame_done)
    try:
        if output_format.is_movie or len(frames) > 1:
            bpy.ops.render.render(animation=True, scene=scene.name)
        else:
            bpy.ops.render.render(write_still=True, scene=scene.name)
    finally:
        handlers.render_post.remove(progress.frame_done)
        handlers.render_pre.remove(progress.frame_begins)
    if len(frames) == 1 and not output.is_file():
        raise OceanError(f"Blender could not write {output}")
    print(f"rendered {scene.render.filepath}", flush=True)
