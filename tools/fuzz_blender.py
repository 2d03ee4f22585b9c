# SPDX-License-Identifier: GPL-3.0-or-later
"""Random but valid steps in Blender, as an impatient artist takes them, with a check of everything after each.

The steps: change a setting, add, remove or load wave systems, change the frame, undo, redo, duplicate, delete,
save and load. The same seed takes the same steps. Exits with 1 and the last steps at the first thing wrong.
"""

import argparse
import collections
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
from ocean_lod_addon.core import presets  # noqa: E402
from ocean_lod_addon.core.errors import OceanError  # noqa: E402
from ocean_lod_addon.core.parameters import Choice, Integer, Number, Switch, parameters_of  # noqa: E402
from ocean_lod_addon.scene import ocean_object, properties  # noqa: E402
from ocean_lod_addon.scene.mesh import read_positions  # noqa: E402

MOST_OCEANS = 3
MOST_WAVES = 256
"""More are not tried: they are slow, and no different."""

WARM_UP = 0.25
"""Share of the steps after which memory must stay flat: caches and undo steps fill up before."""
LARGEST_GROWTH = 200.0
"""MiB of growth of the process's peak afterwards: a leak of one mesh a step would be thousands."""


class WrongError(Exception):
    """An invariant that does not hold."""


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
    """Add an ocean."""
    if len(oceans()) < MOST_OCEANS:
        cells, levels = choose.choice([8, 16, 32]), choose.randint(1, 5)
        size = choose.choice([0.01, 0.25, 2.0])
        preset = choose.choice(presets.names())
        bpy.ops.mesh.ocean_lod_add(preset=preset, cells=cells, levels=levels, cell_size=size)


def value_of(parameter, choose):
    """A random allowed value: often an end, else evenly or by magnitude."""
    match parameter:
        case Number():
            low, high = parameter.minimum, parameter.maximum
            soft = parameter.soft_maximum or high
            magnitude = low + (soft - low) * 10.0 ** choose.uniform(-6.0, 0.0)
            return choose.choice([low, high, parameter.default, choose.uniform(low, high), magnitude, magnitude])
        case Integer():
            return choose.choice([parameter.minimum, choose.randint(parameter.minimum, parameter.maximum)])
        case Choice():
            return choose.choice(parameter.options).key
        case Switch():
            return choose.random() < 0.5
    return None


def change_setting(choose):
    """Set one property of the panel."""
    settings = pick_ocean(choose).ocean_lod
    groups = [(properties.Sea, settings.sea), (properties.OceanTime, settings.time)]
    groups += [(properties.Framing, settings.framing), (properties.MaterialSettings, settings.material)]
    groups += [(properties.WaveSystem, system) for system in settings.sea.systems]
    kind, group = choose.choice(groups)
    name, parameter = choose.choice(list(parameters_of(kind).items()))
    value = value_of(parameter, choose)
    if value is None:
        return
    if name == "wave_count":
        value = min(value, MOST_WAVES)
    setattr(group, name, value)


def change_plane(choose):
    """Set the shape of the plane, valid and small."""
    grid = pick_ocean(choose).ocean_lod.grid
    name, values = choose.choice(
        [("cells", [8, 16, 32, 64]), ("levels", [1, 2, 4, 6]), ("cell_size", [0.003, 0.1, 1.0, 50.0])]
    )
    setattr(grid, name, choose.choice(values))


def change_frame(choose):
    """Go to another frame or sub-frame."""
    frame = choose.choice([1, 0, -500, 1_000_000, choose.randint(-1000, 1000)])
    bpy.context.scene.frame_set(frame, subframe=choose.choice([0.0, 0.25, 0.9]))


def load_preset(choose):
    """Load a sea."""
    pick_ocean(choose)
    bpy.ops.object.ocean_lod_load_preset(preset=choose.choice(presets.names()))


def add_system(choose):
    """Add a wave system."""
    if len(pick_ocean(choose).ocean_lod.sea.systems) < 4:
        bpy.ops.object.ocean_lod_add_system()


def remove_system(choose):
    """Remove a wave system."""
    pick_ocean(choose)
    if bpy.ops.object.ocean_lod_remove_system.poll():
        bpy.ops.object.ocean_lod_remove_system()


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
        bpy.ops.object.duplicate(linked=False)


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
    change_setting: 12,
    change_plane: 2,
    change_frame: 6,
    load_preset: 2,
    add_system: 1,
    remove_system: 1,
    undo: 3,
    redo: 2,
    duplicate: 1,
    delete: 1,
    add: 1,
    save_and_load: 1,
}
"""What to do, and how often."""

UNDONE_BY_ITSELF = (undo, redo, save_and_load)


def check():
    """Raise `WrongError` if anything is not as it must be."""
    handlers = [h for h in bpy.app.handlers.frame_change_post if "ocean_lod" in h.__module__]
    if len(handlers) != 1:
        raise WrongError(f"{len(handlers)} frame-change handlers")
    for ob in oceans():
        try:
            ocean = ocean_object.read_ocean(ob, bpy.context.scene)
            surface = ocean_object._surface(ocean)
        except OceanError as error:  # settings that do not go together; the panel says so
            allowed = str(error)
        else:
            allowed = ""
            found = len(ob.data.vertices)
            if found != surface.vertex_count:
                raise WrongError(f"{ob.name}: {found} vertices, settings make {surface.vertex_count}")
        if ocean_object.problem(ob) not in ("", allowed):
            raise WrongError(f"{ob.name}: {ocean_object.problem(ob)}")
        if not np.isfinite(read_positions(ob.data)).all():
            raise WrongError(f"{ob.name}: vertices are not finite")


def peak_memory() -> float:
    """The most memory that the process has used, MiB."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1024.0**2 if sys.platform == "darwin" else 1024.0)


def fuzz(steps: int, seed: int) -> None:
    """Take the steps. Raises whatever goes wrong, with the steps up to there printed."""
    choose = random.Random(seed)
    taken = collections.deque(maxlen=20)
    warm = None
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
        if number == int(WARM_UP * steps):
            warm = peak_memory()
    if warm is not None and peak_memory() - warm > LARGEST_GROWTH:
        raise WrongError(f"memory grew from {warm:.0f} to {peak_memory():.0f} MiB")
    print(f"{steps} steps with seed {seed}: nothing wrong, {peak_memory():.0f} MiB at most", flush=True)


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
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
