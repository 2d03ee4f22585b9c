# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene calls for: its facts read from Blender, the plan made from them, and the settings that follow."""

import functools

from ..core.discretise import discretise
from ..core.ocean import Ocean
from ..core.plan import Facts, Plan, Settings, decide, effective
from ..core.shot_fit import frame_needs
from . import clock, placing, properties

_EEVEE = "BLENDER_EEVEE"
"""What Blender's names of EEVEE begin with."""

_waves = functools.lru_cache(maxsize=8)(discretise)


class PlannedOcean:
    """A plan, and what an ocean is made from by it. Raises OceanError where settings do not go together."""

    def __init__(self, ob, scene, depsgraph=None, final: bool = True):
        """For an (evaluated) object at the scene's current frame, for a `final` picture or the viewport."""
        settings = read_settings(ob, scene)
        waves = _waves(settings.sea, settings.grid.shortest_wavelength)
        self.plan: Plan = decide(scene_facts(ob, scene, depsgraph, final), settings, waves)
        used = effective(settings, self.plan)
        self.ocean = Ocean(used.sea, used.grid, used.framing, used.ripples, used.foam)
        self.material = used.material


def read_settings(ob, scene) -> Settings:
    """What the artist has set on an (evaluated) object, in a scene of this frame rate. Raises OceanError."""
    asked = properties.read_ocean(ob.ocean_lod, clock.frames_per_second(scene))
    return Settings(
        asked.sea,
        asked.grid,
        asked.framing,
        properties.read_material(ob.ocean_lod),
        asked.ripples,
        asked.foam,
        properties.read_effects(ob.ocean_lod),
    )


def scene_facts(ob, scene, depsgraph=None, final: bool = True) -> Facts:
    """The facts around an (evaluated) ocean at the scene's current frame."""
    render = scene.render
    view = placing.camera_view(ob, scene, depsgraph)
    width = max(1, render.resolution_x * render.resolution_percentage // 100)
    blur = render.motion_blur_shutter / clock.frames_per_second(scene) if render.use_motion_blur else 0.0
    return Facts(
        engine="EEVEE" if render.engine.startswith(_EEVEE) else render.engine,
        final=final,
        shutter=blur,
        camera=None if view is None else frame_needs(view, width),
        visible_to_camera=ob.visible_camera,
    )
