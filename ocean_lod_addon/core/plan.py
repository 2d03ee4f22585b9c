# SPDX-License-Identifier: GPL-3.0-or-later
"""What a scene calls for: which effects are computed, and why. One pure function, `decide`.

An effect that changes no pixel by more than one of 255 steps, or moves nothing by more than VISIBLE_PIXELS, is not
computed; the sentence that goes with each decision says by which number. Thresholds are that low so that a frame
can decide for itself: where an effect comes or goes within a shot, the picture does not jump.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from .column_blocks import POSITION, TANGENTS, VELOCITY, ColumnBlock
from .effects import OFF, ON, Effects
from .foam.whitecap_law import EFFECTIVE_SHARE
from .foam.whitecaps import sea_breaker_wavenumber, sea_coverage, sea_wind
from .foam_settings import Foam
from .framing import Framing
from .lod import Grid
from .material_settings import MaterialSettings
from .optics.cox_munk import skewness_c03
from .parameters import parameters_of
from .readback_text import plain_number
from .ripple_settings import Ripples
from .ripples.bump import BumpLayout, bump_layout
from .roughness import roughening_system
from .sea import Sea
from .shot_fit import ShotNeeds, curvature_pixels
from .waves import WaveSet
from .wind import COX_MUNK_HEIGHT, wind_at_height

VISIBLE_PIXELS = 0.1
"""A surface displaced by less than this share of a pixel gives the same picture."""

BRIGHTNESS_STEPS = 255.0
"""A picture tells apart brightnesses of 1/255 of white."""

_NYQUIST_PIXELS = 2.0
"""Waves shorter than this many pixels are roughness."""

VELOCITY_ATTRIBUTE = "velocity"
"""Point attribute, FLOAT_VECTOR, m/s, that Cycles, Alembic and USD know."""

NORMAL_ATTRIBUTE = "custom_normal"
"""Point attribute, FLOAT_VECTOR, that Blender shades with in place of its own normals."""

FOAM_ATTRIBUTE = "ocean_foam"
"""Point attribute, FLOAT, 0 to 1: share of the area around a vertex that is white."""

WHITECAPS_ATTRIBUTE = "ocean_foam_whitecaps"
"""Point attribute, FLOAT, 0 to 1: how much of the foam is whitecaps; far away it is a uniform share of the sea."""

REST_POSITION_ATTRIBUTE = "ocean_rest_position"
"""Point attribute, FLOAT2, m: undisturbed x, y, where ripples and foam are looked up."""

RIPPLE_AMPLITUDE_ATTRIBUTE = "ocean_ripple_amplitude_"
"""Point attributes, FLOAT_COLOR, numbered from 0: what the mesh leaves of each band to the ripples, by fours."""


def ripple_attributes(bands: int) -> tuple[str, ...]:
    """Names of the attributes for ripples of which the mesh shows this many bands in part."""
    return tuple(f"{RIPPLE_AMPLITUDE_ATTRIBUTE}{number}" for number in range(-(-bands // 4)))


GUST_ATTRIBUTE = "ocean_gust"
"""Point attribute, FLOAT: what gusts multiply the slopes of ripples by."""

WATER_NODE, RIPPLES_NODE, FOAM_NODE = "Ocean LOD Water", "Ocean LOD Ripples", "Ocean LOD Foam"
"""Names of the group nodes in an ocean's material."""

EFFECT_ATTRIBUTES = {
    NORMAL_ATTRIBUTE: "FLOAT_VECTOR",
    VELOCITY_ATTRIBUTE: "FLOAT_VECTOR",
    FOAM_ATTRIBUTE: "FLOAT",
    WHITECAPS_ATTRIBUTE: "FLOAT",
}
"""The attributes that come and go with the plan's columns, and their types."""


@dataclass(frozen=True)
class Facts:
    """The scene around an ocean, as far as it decides what to compute.

    engine              "CYCLES", "EEVEE" or another that shades without materials
    final               a picture is rendered, not the viewport
    shutter             s that the shutter is open, or 0 without motion blur
    samples             of each pixel
    camera              the camera's needs in this frame, or None without a camera
    sees_water          whether any of the sea is in the camera's frame
    visible_to_camera   whether camera rays see the ocean
    visible_to_light    whether reflected, refracted or scattered rays see it; a renderer of shadows only does not
    casts_shadows       whether it shades other objects
    shows_water         whether the material's output for this engine is linked to the ocean's own node
    """

    engine: str = "CYCLES"
    final: bool = True
    shutter: float = 0.0
    samples: int = 64
    camera: ShotNeeds | None = None
    sees_water: bool = True
    visible_to_camera: bool = True
    visible_to_light: bool = True
    casts_shadows: bool = True
    shows_water: bool = True


@dataclass(frozen=True)
class Settings:
    """What the artist set, as far as effects depend on it."""

    sea: Sea
    grid: Grid
    framing: Framing
    material: MaterialSettings
    ripples: Ripples
    foam: Foam
    effects: Effects


@dataclass(frozen=True)
class Decision:
    """Whether an effect is on, and the reason in one sentence."""

    effect: str
    label: str
    on: bool
    why: str


@dataclass(frozen=True)
class Plan:
    """What is computed: `decisions` by effect, and what follows from them."""

    decisions: tuple[Decision, ...]
    tiles: str
    """"none", "in view" or "all"."""
    why_tiles: str
    """The reason, in one sentence."""
    waves: int
    """Number of waves that are geometry."""
    foam_instants: int
    """How many instants foam is looked for at, where it is on."""
    ripple_layout: BumpLayout | None
    """The images and bands of the ripples, where they are on."""

    def on(self, effect: str) -> bool:
        """Whether an effect, called as in core.effects, is on."""
        return next(decision.on for decision in self.decisions if decision.effect == effect)

    @property
    def blocks(self) -> tuple[ColumnBlock, ...]:
        """Columns of the kernel but for those of foam, none for a frame without water."""
        if self.tiles == "none":
            return ()
        return (
            POSITION,
            *((TANGENTS,) if self.on("analytic_normals") else ()),
            *((VELOCITY,) if self.on("velocity") else ()),
        )

    @property
    def columns(self) -> int:
        """Numbers that the kernel works out for each vertex."""
        foam = self.foam_instants if self.blocks and self.on("foam") else 0
        return sum(block.columns for block in self.blocks) + foam

    @property
    def attributes(self) -> tuple[str, ...]:
        """Attributes of the mesh that come and go with effects."""
        return (
            *((NORMAL_ATTRIBUTE,) if self.on("analytic_normals") else ()),
            *((VELOCITY_ATTRIBUTE,) if self.on("velocity") else ()),
            *((FOAM_ATTRIBUTE, WHITECAPS_ATTRIBUTE) if self.on("foam") else ()),
            *((REST_POSITION_ATTRIBUTE,) if self.on("foam") or self.on("ripples") else ()),
            *((GUST_ATTRIBUTE,) if self.on("gusts") else ()),
            *(ripple_attributes(self.ripple_layout.handed_over) if self.ripple_layout else ()),
        )

    @property
    def images(self) -> int:
        """Number of images that are written for each frame."""
        return len(self.ripple_layout.tiles) if self.ripple_layout else 0

    @property
    def nodes(self) -> tuple[str, ...]:
        """Group nodes of the material."""
        return (
            WATER_NODE,
            *((RIPPLES_NODE,) if self.on("ripples") else ()),
            *((FOAM_NODE,) if self.on("foam") else ()),
        )

    def to_json(self) -> dict:
        """The plan as JSON."""
        return {
            "effects": {
                decision.effect: {"on": decision.on, "why": decision.why} for decision in self.decisions
            },
            "tiles": self.tiles,
            "why_tiles": self.why_tiles,
            "waves": self.waves,
            "columns_per_vertex": self.columns,
            "attributes": list(self.attributes),
            "images": self.images,
            "nodes": list(self.nodes),
        }


@dataclass(frozen=True)
class Auto:
    """What Auto would do, and why; not `possible` where there is nothing that could be turned on."""

    on: bool
    why: str
    possible: bool = True


def decide(facts: Facts, settings: Settings, waves: WaveSet) -> Plan:
    """The plan for a scene; a function of its arguments alone."""
    auto = {
        "horizontal_displacement": lambda: _horizontal_displacement(facts, settings, waves),
        "analytic_normals": lambda: _analytic_normals(facts, settings, waves),
        "velocity": lambda: _velocity(facts, waves),
        "foam": lambda: _foam(facts, settings),
        "ripples": lambda: _ripples(facts, settings),
        "gusts": lambda: _gusts(facts, settings),
        "skewed_slopes": lambda: _skewed_slopes(facts, settings),
        "curved_earth": lambda: _curved_earth(facts, settings),
        "see_through": lambda: _see_through(facts, settings),
        "finite_depth": lambda: _finite_depth(settings, waves),
    }
    decisions = []
    for name, parameter in parameters_of(Effects).items():
        answer = _answer(getattr(settings.effects, name), auto[name])
        decisions.append(Decision(name, parameter.label, bool(answer.on), answer.why))
    tiles, why_tiles = _tiles(facts, settings)
    ripples = next(decision.on for decision in decisions if decision.effect == "ripples")
    layout = bump_layout(settings.ripples, settings.grid.shortest_wavelength) if ripples else None
    return Plan(tuple(decisions), tiles, why_tiles, len(waves), settings.foam.memory_steps, layout)


def effective(settings: Settings, plan: Plan) -> Settings:
    """The settings as the plan wants them: what it leaves out is off in them (foam: None), what it adds, on."""
    choppy = plan.on("horizontal_displacement")
    return replace(
        settings,
        sea=replace(
            settings.sea,
            choppiness=settings.sea.choppiness if choppy else 0.0,
            finite_depth=plan.on("finite_depth"),
        ),
        framing=replace(
            settings.framing,
            curved_earth=plan.on("curved_earth"),
            only_in_view=settings.framing.only_in_view and plan.tiles != "all",
        ),
        material=replace(
            settings.material, skewed_slopes=plan.on("skewed_slopes"), see_through=plan.on("see_through")
        ),
        ripples=replace(
            settings.ripples,
            kind=settings.ripples.kind if plan.on("ripples") else "off",
            gusts=plan.on("gusts"),
        ),
        foam=settings.foam if plan.on("foam") else None,
    )


def _answer(word, auto):
    """The artist's word over what Auto would do, which is asked only where it matters."""
    if word == OFF:
        return Auto(False, "Set to Off")
    answer = auto()
    if word == ON and not answer.on and answer.possible:
        return Auto(True, f"Set to On; Auto would not: {answer.why}")
    return answer


def _tiles(facts, settings):
    """Which tiles move, and why."""
    if not (facts.visible_to_camera or facts.visible_to_light or facts.casts_shadows):
        return "none", "No ray sees the ocean"
    if not facts.final:
        return "all", "The viewport shows the whole plane"
    if not settings.framing.only_in_view:
        return "all", "Asked for by the framing"
    if not facts.visible_to_camera:
        return "all", "What is seen in reflections or as shadows may lie outside the frame"
    if facts.sees_water:
        return "in view", "The others are outside the frame and its margin"
    return "none", "The sea is outside the frame and its margin"


def _pixels(facts, length):
    """How many pixels a length in m is on the nearest water in frame; None without a camera."""
    if facts.camera is None:
        return None
    return length / (facts.camera.nearest * facts.camera.pixel_angle)


def _in_pixels(pixels):
    return f"{plain_number(pixels)} pixel{'' if pixels == 1 else 's'}"


def _no_shading(facts):
    """Why there is nothing to shade, or an empty text."""
    if facts.engine not in ("CYCLES", "EEVEE"):
        return f"{facts.engine} shades without the ocean's material"
    if not facts.visible_to_camera:
        seen = "in reflections and shadows" if facts.visible_to_light else "as a shadow"
        return f"The ocean is seen {seen} only"
    return ""


def _no_water(facts):
    """Why the ocean's own nodes shade nothing, or an empty text."""
    if not facts.shows_water:
        return f"The material's output for {facts.engine} is not linked to the ocean's node"
    return _no_shading(facts)


def _horizontal_displacement(facts, settings, waves):
    if settings.sea.choppiness == 0.0:
        return Auto(False, "Choppiness is 0", possible=False)
    displacement = math.sqrt(0.5 * float(np.sum((waves.orbit_ratio * waves.amplitude) ** 2)))
    pixels = _pixels(facts, displacement)
    if pixels is None:
        return Auto(True, f"Moves the water sideways by {displacement:.3g} m rms; there is no camera to judge by")
    return Auto(
        pixels >= VISIBLE_PIXELS,
        f"Moves the water sideways by {displacement:.3g} m rms, {_in_pixels(pixels)} on the nearest water",
    )


def lost_slope_variance(cell_size: float, waves: WaveSet) -> float:
    """Share of the waves' slope variance that normals made from the finest faces do not show.

    A vertex normal is the mean over the faces around it: of a wave it sees the central difference, sin(k h) /
    (k h) of the slope.
    """
    variance = 0.5 * (waves.wavenumber * waves.amplitude) ** 2
    total = float(np.sum(variance))
    seen = np.sinc(waves.wavenumber * cell_size / np.pi) ** 2
    return float(np.sum(variance * (1.0 - seen))) / total if total > 0.0 else 0.0


def _analytic_normals(facts, settings, waves):
    """The brightness of the glitter goes with one over the slope variance.

    Time does not decide: five more columns and their normals take less of it than Blender's own normals do, by
    41 ms instead of 155 for a frame of 362 k vertices in Blender 4.5 and 96 instead of 255 in 5.2.
    """
    nothing = _no_shading(facts)
    if nothing:
        return Auto(False, nothing)
    steps = BRIGHTNESS_STEPS * lost_slope_variance(settings.grid.cell_size, waves)
    return Auto(steps >= 1.0, f"Normals of the faces would be off by {steps:.0f} of 255 steps of the glitter")


def _velocity(facts, waves):
    if facts.shutter == 0.0:
        return Auto(False, "There is no motion blur")
    if facts.engine != "CYCLES":
        return Auto(False, f"{facts.engine} blurs from the instants of the shutter instead")
    if not facts.final:
        return Auto(False, "The viewport shows no motion blur")
    error = 0.5 * _rms_acceleration(waves) * (0.5 * facts.shutter) ** 2
    pixels = _pixels(facts, error)
    if pixels is None or not facts.visible_to_camera:
        return Auto(True, "Motion blur needs one evaluation of the sea instead of one for each instant")
    return Auto(
        pixels <= VISIBLE_PIXELS,
        f"A straight blur is off by {_in_pixels(pixels)} from the water's curved paths on the nearest water",
    )


def _rms_acceleration(waves):
    """omega^2 A sqrt((1 + C^2) / 2) of all waves together, m/s^2."""
    omega, A, C = waves.angular_frequency, waves.amplitude, waves.orbit_ratio
    return math.sqrt(0.5 * float(np.sum((omega**2 * A) ** 2 * (1.0 + C**2))))


def _foam(facts, settings):
    """A whitecap smaller than a pixel shows by its share of it, and all of them by their share of the sea.

    One that lies between the samples of a pixel is noise: it shows by the share of the sea only.
    """
    coverage = sea_coverage(settings.foam, settings.sea)
    if coverage == 0.0:
        wind = f"{sea_wind(settings.sea):g} m/s of wind"
        reason = "Foam's Coverage is 0" if settings.foam.coverage == 0.0 else f"No waves break in {wind}"
        return Auto(False, reason, possible=False)
    nothing = _no_shading(facts)  # with another material the attribute may be what the artist wants
    if nothing:
        return Auto(False, nothing)
    pixels = _pixels(facts, np.pi / sea_breaker_wavenumber(settings.sea))
    share = 1.0 if pixels is None else min(pixels, 1.0) ** 2
    share = share if share * facts.samples >= 1.0 else 0.0
    steps = BRIGHTNESS_STEPS * settings.foam.reflectance * max(share, EFFECTIVE_SHARE * coverage)
    return Auto(
        steps >= 1.0,
        f"Whitecaps cover {coverage:.2%} of the sea and change a pixel by up to {steps:.0f} of 255 steps",
    )


def _ripples(facts, settings):
    ripples = settings.ripples
    if ripples.kind == "off":
        return Auto(False, "The ripples' kind is Off", possible=False)
    if _wind(settings.sea) == 0.0:
        return Auto(False, "There is no wind to raise ripples", possible=False)
    nothing = _no_water(facts)
    if nothing:
        return Auto(False, nothing)
    longest = ripples.longest_wavelength
    pixels = _pixels(facts, longest)
    if pixels is None:
        return Auto(True, "There is no camera to judge by")
    return Auto(
        pixels >= _NYQUIST_PIXELS,
        f"The longest ripple, {longest:g} m, is {_in_pixels(pixels)} long on the nearest water",
    )


def _gusts(facts, settings):
    if _wind(settings.sea) == 0.0:
        return Auto(False, "There is no wind to blow in gusts", possible=False)
    if not settings.ripples.gusts:
        return Auto(False, "The ripples' Gusts are not asked for")
    nothing = _no_shading(facts)
    if nothing:
        return Auto(False, nothing)
    strength = settings.ripples.gust_strength
    steps = BRIGHTNESS_STEPS * strength  # the glitter is as bright as one over the slope variance
    return Auto(steps >= 1.0, f"Changes the glitter by {steps:.0f} of 255 steps (rms)")


def _wind(sea):
    """The wind on the water, m/s at the height of Cox and Munk's formulas; 0 without any."""
    rough = roughening_system(sea)
    return 0.0 if rough is None else wind_at_height(sea.systems[rough].wind_speed, COX_MUNK_HEIGHT)


def _skewed_slopes(facts, settings):
    if facts.engine == "CYCLES" and settings.material.sun_model != "formula":
        return Auto(False, "Cycles' own closure reflects the sun, which knows no skew", possible=False)
    if not facts.shows_water:
        return Auto(False, _no_water(facts))
    wind = _wind(settings.sea)
    if wind == 0.0:
        return Auto(False, "There is no wind to skew the slopes", possible=False)
    if not settings.material.skewed_slopes:
        return Auto(False, "The water's skewed slopes are not asked for")
    steps = BRIGHTNESS_STEPS * abs(skewness_c03(wind)) / 3.0  # c03 He3(2) / 6 at two deviations, He3(2) = 2
    return Auto(steps >= 1.0, f"Changes the glitter by {steps:.0f} of 255 steps at twice the rms slope")


def _curved_earth(facts, settings):
    if settings.framing.curved_earth:
        return Auto(True, "Asked for by Curved Earth of the framing")
    if facts.camera is None:
        return Auto(False, "There is no camera whose horizon it would move")
    pixels = curvature_pixels(facts.camera, settings.grid.half_extent)
    return Auto(
        pixels >= VISIBLE_PIXELS,
        f"Moves the horizon by {_in_pixels(max(pixels, 0.0))} seen from {facts.camera.height:.3g} m",
    )


def _see_through(facts, settings):
    if not settings.material.see_through:
        return Auto(False, "The water's See Through is not asked for")
    nothing = _no_water(facts)
    if nothing:
        return Auto(False, nothing)
    return Auto(True, "Asked for by See Through of the water")


def _finite_depth(settings, waves):
    if not settings.sea.finite_depth:
        return Auto(False, "The sea's Finite Depth is not asked for")
    if not len(waves):
        return Auto(True, "Asked for by Finite Depth; there are no waves to feel it")
    slowing = 1.0 - math.tanh(float(waves.wavenumber.min()) * settings.sea.depth)
    return Auto(True, f"Asked for by Finite Depth; it costs nothing and slows the longest wave by {slowing:.2%}")
