# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene calls for: its facts read from Blender, the plan made from them, and the settings that follow."""

import functools

from ..core.camera_view import CameraView, looks_down
from ..core.carried import highest_wave
from ..core.discretise import discretise
from ..core.ocean import Ocean
from ..core.plan import Facts, Plan, Settings, decide, effective
from ..core.shot_fit import frame_needs
from ..nodes.material import shows_water
from . import clock, placing, properties

_EEVEE = "BLENDER_EEVEE"
"""What Blender's names of EEVEE begin with."""

_waves = functools.lru_cache(maxsize=8)(discretise)


class PlannedOcean:
    """A plan, and what an ocean is made from by it. Raises OceanError where settings do not go together."""

    def __init__(self, ob, scene, depsgraph=None, final: bool = True, plan: Plan | None = None):
        """For an (evaluated) object at the scene's current frame, for a `final` picture or the viewport.

        A `plan` made before is followed instead of a new one.
        """
        settings = read_settings(ob, scene)
        self.view = placing.camera_view(ob, scene, depsgraph)
        if plan is None:
            facts = scene_facts(ob, scene, settings, self.view, final)
            plan = decide(facts, settings, _waves(settings.sea, settings.grid.shortest_wavelength))
        used = effective(settings, plan)
        self.plan: Plan = plan
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


def scene_facts(ob, scene, settings: Settings, view: CameraView | None, final: bool = True) -> Facts:
    """The facts around an (evaluated) ocean at the scene's current frame, seen by a camera."""
    render = scene.render
    waves = _waves(settings.sea, settings.grid.shortest_wavelength)
    width = max(1, render.resolution_x * render.resolution_percentage // 100)
    blur = render.motion_blur_shutter / clock.frames_per_second(scene) if render.use_motion_blur else 0.0
    engine = "EEVEE" if render.engine.startswith(_EEVEE) else render.engine
    return Facts(
        engine=engine,
        final=final,
        shutter=blur,
        samples=scene.cycles.samples if engine == "CYCLES" else scene.eevee.taa_render_samples,
        camera=None if view is None else frame_needs(view, width),
        sees_water=view is None or looks_down(view, settings.framing.view_margin, highest_wave(waves)),
        visible_to_camera=ob.visible_camera,
        visible_to_light=any(
            (ob.visible_diffuse, ob.visible_glossy, ob.visible_transmission, ob.visible_volume_scatter)
        ),
        casts_shadows=ob.visible_shadow,
        shows_water=_shows_water(ob, engine),
    )


def _shows_water(ob, engine):
    """An ocean without a material is about to get its own."""
    materials = [material for material in ob.data.materials if material is not None]
    target = "EEVEE" if engine == "EEVEE" else "CYCLES"
    return not materials or any(shows_water(material, target) for material in materials)
