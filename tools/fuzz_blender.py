# SPDX-License-Identifier: GPL-3.0-or-later
"""Random but valid steps in Blender, as an impatient artist takes them, with a check of everything after each.

The steps: change any setting of the panel, key it, add, remove or load wave systems and presets, run the ocean's
own operators, move, cut and turn the camera, move the ocean, change engine, frame rate and motion blur, change the
frame, render a tiny picture, undo, redo, duplicate, delete, save and load. The same seed takes the same steps.
Exits with 1 and the last steps at the first thing wrong.
"""

import argparse
import collections
import math
import os
import random
import resource
import sys
import tempfile
import traceback
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
_FOLDER = tempfile.TemporaryDirectory(prefix="ocean_lod_fuzz_")
os.environ["BLENDER_USER_RESOURCES"] = _FOLDER.name

import bpy  # noqa: E402
import numpy as np  # noqa: E402

import ocean_lod_addon  # noqa: E402
from ocean_lod_addon import ui  # noqa: E402
from ocean_lod_addon.core import presets  # noqa: E402
from ocean_lod_addon.core.errors import OceanError  # noqa: E402
from ocean_lod_addon.scene import ocean_object, planning, properties  # noqa: E402
from ocean_lod_addon.scene.mesh import read_positions  # noqa: E402
from ocean_lod_addon.ui import preset_library  # noqa: E402

MOST_OCEANS = 3
MOST_WAVES = 256
"""More are not tried: they are slow, and no different."""

class WrongError(Exception):
    """An invariant that does not hold."""


class Watched:
    """A stream that counts the tracebacks in it: Blender prints those of callbacks, and goes on."""

    def __init__(self, stream):
        self.stream, self.tracebacks = stream, 0

    def write(self, text):
        """Pass the text on."""
        self.tracebacks += "Traceback" in text
        return self.stream.write(text)

    def __getattr__(self, name):
        return getattr(self.stream, name)


def oceans():
    """All ocean objects, by name."""
    return sorted((ob for ob in bpy.context.scene.objects if ocean_object.is_ocean(ob)), key=lambda ob: ob.name)


def pick_ocean(choose):
    """One of the oceans, made the active object; a new one if there is none."""
    if not oceans():
        add(choose)
    ob = choose.choice(oceans())
    for other in bpy.context.selected_objects:
        other.select_set(False)
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob
    return ob


def add(choose):
    """Add an ocean, in an empty scene with a camera."""
    if bpy.context.scene.camera is None:
        cut(choose)
    if len(oceans()) < MOST_OCEANS:
        cells, levels = choose.choice([8, 16, 32]), choose.randint(1, 5)
        size = choose.choice([0.01, 0.25, 2.0])
        preset = choose.choice(presets.names())
        bpy.ops.mesh.ocean_lod_add(preset=preset, cells=cells, levels=levels, cell_size=size)


def value_of(setting, choose):
    """A random allowed value of a Blender property: often an end, else evenly or by magnitude; None for a text."""
    match setting.type:
        case "FLOAT":
            low, high, soft = setting.hard_min, setting.hard_max, setting.soft_max
            magnitude = low + (soft - low) * 10.0 ** choose.uniform(-6.0, 0.0)
            return choose.choice([low, high, setting.default, choose.uniform(low, high), magnitude, magnitude])
        case "INT":
            return choose.choice([setting.hard_min, choose.randint(setting.hard_min, setting.hard_max)])
        case "ENUM":
            return choose.choice(setting.enum_items).identifier
        case "BOOLEAN":
            return choose.random() < 0.5
    return None


CAN_BE_PICKED = ("FLOAT", "INT", "ENUM", "BOOLEAN")

PICKED_ELSEWHERE = {"grid", "systems"}
"""Groups of settings with steps of their own."""


def pick_setting(choose):
    """A group of settings of the active ocean, and one that the panel changes."""
    settings = pick_ocean(choose).ocean_lod
    groups = [
        getattr(settings, name)
        for name, setting in settings.bl_rna.properties.items()
        if setting.type == "POINTER" and name not in {*PICKED_ELSEWHERE, "rna_type"}
    ]
    group = choose.choice([*groups, *settings.sea.systems])
    settings = [
        setting
        for name, setting in group.bl_rna.properties.items()
        if setting.type in CAN_BE_PICKED and not setting.is_readonly and name != "active_system"
    ]
    return group, choose.choice(settings)


def change_setting(choose):
    """Set one property of the panel."""
    group, setting = pick_setting(choose)
    value = value_of(setting, choose)
    setattr(group, setting.identifier, min(value, MOST_WAVES) if setting.identifier == "wave_count" else value)


def key_setting(choose):
    """Key one property of the panel, at this frame and at another value a little later."""
    group, setting = pick_setting(choose)
    if setting.is_animatable and setting.type != "ENUM" and setting.identifier != "wave_count":
        scene = bpy.context.scene
        group.keyframe_insert(setting.identifier, frame=scene.frame_current)
        setattr(group, setting.identifier, value_of(setting, choose))
        group.keyframe_insert(setting.identifier, frame=scene.frame_current + choose.randint(1, 20))


def change_plane(choose):
    """Set the shape of the plane, valid and small."""
    grid = pick_ocean(choose).ocean_lod.grid
    name, values = choose.choice(
        [("cells", [8, 16, 32, 64]), ("levels", [1, 2, 4, 6]), ("cell_size", [0.003, 0.1, 1.0, 50.0])]
    )
    setattr(grid, name, choose.choice(values))


def change_frame(choose):
    """Go to another frame or sub-frame, away from it and back: the surface must be the same, bit for bit."""
    scene = bpy.context.scene
    frame = choose.choice([1, 0, -500, 1_000_000, choose.randint(-1000, 1000)])
    subframe = choose.choice([0.0, 0.25, 0.9])
    scene.frame_set(frame, subframe=subframe)
    first = {ob.name: read_positions(ob.data).tobytes() for ob in movable_oceans()}
    scene.frame_set(frame + choose.randint(1, 9))
    scene.frame_set(frame, subframe=subframe)
    for ob in movable_oceans():
        if read_positions(ob.data).tobytes() != first[ob.name]:
            raise WrongError(f"{ob.name}: frame {frame + subframe} is another surface when it is set again")


def movable_oceans():
    """Oceans with a mesh of their own and nothing to complain about."""
    return [ob for ob in oceans() if ob.data.users == 1 and not ocean_object.problem(ob)]


CAMERA_HEIGHTS = [-3.0, 0.0, 1e-6, 0.3, 1.8, 25.0, 900.0, 3e4]


def cut(choose):
    """Show the scene through another, new camera."""
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    move_camera(choose)


def move_camera(choose):
    """Put the camera anywhere, looking anywhere, through any lens; at times keyed."""
    scene = bpy.context.scene
    camera = scene.camera
    if camera is None:
        return
    x, y = (choose.choice([0.0, choose.uniform(-50, 50), choose.uniform(-1e6, 1e6)]) for _ in range(2))
    camera.location = x, y, choose.choice(CAMERA_HEIGHTS)
    pitch = choose.choice([0.0, math.pi / 2, math.pi, choose.uniform(0.0, math.pi)])
    camera.rotation_euler = pitch, choose.choice([0.0, choose.uniform(-3.0, 3.0)]), choose.uniform(-3.2, 3.2)
    camera.data.type = choose.choice(["PERSP", "PERSP", "ORTHO", "PANO"])
    camera.data.lens = choose.choice([2.0, 24.0, 50.0, 800.0])
    camera.data.clip_end = choose.choice([100.0, 1e5])
    if choose.random() < 0.3:
        camera.keyframe_insert("location", frame=scene.frame_current)
    bpy.context.view_layer.update()


def remove_camera(_choose):
    """Look through no camera."""
    bpy.context.scene.camera = None


def move_ocean(choose):
    """Move an ocean and turn it about z; at times tilt or scale it, which the panel refuses."""
    ob = pick_ocean(choose)
    ob.location = [choose.choice([0.0, choose.uniform(-1e4, 1e4)]) for _ in range(3)]
    tilt = choose.choice([0.0, 0.0, 0.0, 0.3])
    ob.rotation_euler = tilt, 0.0, choose.uniform(-3.2, 3.2)
    ob.scale = (ocean_object.metres_to_units(bpy.context.scene) * choose.choice([1.0, 1.0, 1.0, 2.0]),) * 3
    bpy.context.scene.frame_set(bpy.context.scene.frame_current)


def show(choose):
    """Hide an ocean from pictures, or from camera rays, or show it again."""
    ob = pick_ocean(choose)
    ob.hide_render, ob.visible_camera = choose.random() < 0.3, choose.random() < 0.7


def change_scene(choose):
    """Change engine, frame rate, motion blur or picture size."""
    render = bpy.context.scene.render
    render.engine = choose.choice(ENGINES)
    render.fps, render.fps_base = choose.choice([(24, 1.0), (24, 1.001), (60, 1.0), (1, 1.0)])
    render.use_motion_blur, render.motion_blur_shutter = choose.random() < 0.4, choose.choice([0.01, 0.5, 2.0])
    render.resolution_x, render.resolution_y = choose.choice([(16, 9), (4, 16), (1920, 1080)])


ENGINES = ["CYCLES", "BLENDER_EEVEE_NEXT" if bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"]
"""The engines that the ocean has a material for."""

EEVEE_SHARE = 0.15
"""Of pictures: each compiles its shaders anew, which takes seconds."""


def render(choose):
    """Render a tiny picture in either engine: all of it must be numbers."""
    scene = bpy.context.scene
    if scene.camera is None:
        return
    settings, before = scene.render, (scene.render.engine, scene.render.resolution_x, scene.render.resolution_y)
    settings.engine = ENGINES[choose.random() < EEVEE_SHARE]
    settings.resolution_x, settings.resolution_y = 16, 12
    scene.cycles.samples = scene.eevee.taa_render_samples = 1
    settings.image_settings.file_format, settings.image_settings.color_depth = "OPEN_EXR", "32"
    settings.filepath = str(Path(_FOLDER.name) / "fuzz.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(settings.filepath)
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    engine, (settings.engine, settings.resolution_x, settings.resolution_y) = settings.engine, before
    if not np.isfinite(pixels).all():
        raise WrongError(f"{engine}: {np.count_nonzero(~np.isfinite(pixels))} values of a picture are no numbers")


def load_preset(choose):
    """Load a sea."""
    pick_ocean(choose)
    bpy.ops.object.ocean_lod_load_preset(preset=choose.choice(presets.names()))


def save_preset(choose):
    """Save a sea, load another one and the saved one again: it must be the same."""
    ob = pick_ocean(choose)
    before = properties.read_preset(ob.ocean_lod, "Fuzz", "")
    bpy.ops.object.ocean_lod_save_preset(name="Fuzz", overwrite=True)
    bpy.ops.object.ocean_lod_load_preset(preset=choose.choice(presets.names()))
    bpy.ops.object.ocean_lod_load_preset(preset="Fuzz")
    if properties.read_preset(ob.ocean_lod, "Fuzz", "") != before:
        raise WrongError(f"{ob.name}: a saved preset loads back as another sea")
    if choose.random() < 0.5:
        preset_library.remove("Fuzz")


FILE_OPERATORS = ("_preset",)
"""Endings of operators that read or write files, with steps of their own."""

OPERATORS = [
    cls.bl_idname.partition(".")[2]
    for cls in ui._CLASSES
    if issubclass(cls, bpy.types.Operator)
    and cls.bl_idname.startswith("object.")
    and not cls.bl_idname.endswith(FILE_OPERATORS)
]


def run_operator(choose):
    """Press one of the panel's buttons."""
    pick_ocean(choose)
    name = choose.choice(OPERATORS)
    operator = getattr(bpy.ops.object, name)
    too_many = name == "ocean_lod_add_system" and len(bpy.context.object.ocean_lod.sea.systems) > 3
    if operator.poll() and not too_many:
        try:
            operator("EXEC_DEFAULT")
        except RuntimeError as error:  # an operator reports what can be mended in this way
            if "Traceback" in str(error) or len(str(error).strip().splitlines()) != 1:
                raise
    grid = bpy.context.object.ocean_lod.grid
    grid.cells, grid.levels = min(grid.cells, 64), min(grid.levels, 6)  # a long lens asks for millions of vertices


def undo(_choose):
    """Undo."""
    if bpy.ops.ed.undo.poll():
        try:
            bpy.ops.ed.undo()
        except RuntimeError:  # nothing to undo
            return


def redo(_choose):
    """Redo."""
    if bpy.ops.ed.redo.poll():
        try:
            bpy.ops.ed.redo()
        except RuntimeError:  # nothing to redo
            return


def duplicate(choose):
    """Duplicate an ocean, with a mesh of its own or sharing one."""
    pick_ocean(choose)
    if len(oceans()) < MOST_OCEANS:
        bpy.ops.object.duplicate(linked=choose.random() < 0.3)


def delete(choose):
    """Delete an ocean."""
    pick_ocean(choose)
    bpy.ops.object.delete()


def save_and_load(_choose):
    """Save the file and open it again."""
    path = str(Path(_FOLDER.name) / "fuzz.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)


STEPS = {
    change_setting: 24,
    key_setting: 1,
    change_plane: 2,
    change_frame: 6,
    move_camera: 5,
    cut: 1,
    remove_camera: 0.3,
    move_ocean: 2,
    show: 1,
    change_scene: 2,
    render: 3,
    load_preset: 3,
    save_preset: 1,
    run_operator: 3,
    undo: 5,
    redo: 3,
    duplicate: 1,
    delete: 1,
    add: 1,
    save_and_load: 1,
}
"""What to do, and how often."""

UNDONE_BY_ITSELF = (undo, redo, save_and_load)


def check():
    """Raise `WrongError` if anything is not as it must be."""
    if sys.stderr.tracebacks:
        raise WrongError("a callback failed, as printed above")
    handlers = [h for h in bpy.app.handlers.frame_change_post if "ocean_lod" in h.__module__]
    if len(handlers) != 1:
        raise WrongError(f"{len(handlers)} frame-change handlers")
    for ob in oceans():
        problem, allowed = ocean_object.problem(ob), complaint(ob)
        if problem and not allowed and ob.data.users == 1:
            bpy.context.scene.frame_set(bpy.context.scene.frame_current)  # what was mended in between
            problem = ocean_object.problem(ob)
        if problem and not allowed and ob.data.users == 1:
            raise WrongError(f"{ob.name}: {problem}")
        for attribute in ob.data.attributes:
            if attribute.data_type in ("FLOAT", "FLOAT2", "FLOAT_VECTOR", "FLOAT_COLOR"):
                check_finite(ob, attribute)


def complaint(ob):
    """What the panel rightly says about settings that do not go together, or nothing."""
    scene = bpy.context.scene
    try:
        ocean_object._check_transform(ob, scene)
        surface = ocean_object._surface(planning.PlannedOcean(ob, scene, final=False).ocean)
    except OceanError as error:
        return str(error)
    found = len(ob.data.vertices)
    if found != surface.vertex_count and ob.data.users == 1:
        raise WrongError(f"{ob.name}: {found} vertices, settings make {surface.vertex_count}")
    return ""


def check_finite(ob, attribute):
    """Raise `WrongError` if an attribute of an ocean holds anything but numbers."""
    name = {"FLOAT": "value", "FLOAT_COLOR": "color"}.get(attribute.data_type, "vector")
    width = {"FLOAT": 1, "FLOAT2": 2, "FLOAT_VECTOR": 3, "FLOAT_COLOR": 4}[attribute.data_type]
    values = np.empty(width * len(attribute.data), np.float32)
    attribute.data.foreach_get(name, values)
    if not np.isfinite(values).all():
        raise WrongError(f"{ob.name}: {attribute.name} is not finite")


def peak_memory() -> float:
    """The most memory that the process has used, MiB."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024.0**2 if sys.platform == "darwin" else 1024.0)


def fuzz(steps: int, seed: int) -> None:
    """Take the steps. Raises whatever goes wrong, with the steps up to there printed."""
    choose = random.Random(seed)
    taken = collections.deque(maxlen=20)
    for number in range(steps):
        step = choose.choices(list(STEPS), STEPS.values())[0]
        taken.append(f"{number}: {step.__name__}")
        try:
            step(choose)
            if step not in UNDONE_BY_ITSELF:
                bpy.ops.ed.undo_push(message=step.__name__)
            check()
        except Exception:
            print("\n".join(taken), flush=True)
            raise
    print(f"{steps} steps with seed {seed}: nothing wrong, {peak_memory():.0f} MiB at most", flush=True)


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    sys.stderr = Watched(sys.stderr)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.context.preferences.edit.undo_steps = 8
    ocean_lod_addon.register()
    try:
        fuzz(options.steps, options.seed)
    except Exception:  # noqa: BLE001 - whatever it is, it is what was looked for
        traceback.print_exc()
        return 1
    return 0


if __name__ == "__main__":
    exit_code = main()
    _FOLDER.cleanup()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(exit_code)  # Blender 4.5 as a Python module can hang while the interpreter shuts down
