# SPDX-License-Identifier: GPL-3.0-or-later
"""Every two effects, on and off together in all four ways: an ocean has what its plan names, no more and no fewer.

Ten effects that are on or off take six combinations for that, where all of them would be 1024. Each combination
is followed from the one before, in one file, and compared: attributes of the mesh, columns that the kernel writes,
images, nodes and node groups. Then one frame of 16 x 9 pixels with one sample is rendered in Cycles and one in
EEVEE, after which the comparison is made again: what a render calls for is what its own plan names.
"""

import itertools
import math

import bpy
import numpy as np
import pytest

import ocean_lod_addon
from ocean_lod_addon.core.effects import OFF, ON, Effects
from ocean_lod_addon.core.kernel import FrameKernel
from ocean_lod_addon.core.parameters import parameters_of
from ocean_lod_addon.nodes.groups import GROUP_KEY
from ocean_lod_addon.nodes.ripple_parts import PIXEL_PROPERTY
from ocean_lod_addon.scene import ocean_object, properties
from ocean_lod_addon.scene.ripple_images import IMAGE_KEY
from tests.fresh_ocean import fresh_ocean
from tests.render.exr import read_pixels

EFFECTS = tuple(parameters_of(Effects))


def covering_rows(factors):
    """Rows of booleans, one for each of so many factors, in which every two factors take all four pairs of values.

    Of rows 0 to n - 1 factor j is true in a subset of the last n - 1, ceil(n / 2) of them and another for each
    factor. Row 0 has (off, off); two subsets of more than half meet: (on, on); and as they differ, each has a row
    that the other has not: (on, off) and (off, on). Kleitman and Spencer (1973): there is no shorter way.
    """
    count = next(n for n in itertools.count(4) if math.comb(n - 1, (n + 1) // 2) >= factors)
    subsets = itertools.islice(itertools.combinations(range(1, count), (count + 1) // 2), factors)
    return np.array([[row in subset for row in range(count)] for subset in subsets]).T


ROWS = covering_rows(len(EFFECTS))


def test_rows_hold_every_pair_of_choices():
    assert len(ROWS) == 6
    for first, second in itertools.combinations(ROWS.T, 2):
        assert len(set(zip(first.tolist(), second.tolist(), strict=True))) == 4


@pytest.fixture(scope="module")
def shot(tmp_path_factory):
    """An ocean where every effect can be on, and what an ocean without effects consists of."""
    ocean, scene = fresh_ocean(cells=32, levels=2, cell_size=0.5)
    ocean.ocean_lod.material.sun_model = "formula"  # where Cycles shows skewed slopes
    ripples = ocean.ocean_lod.ripples
    ripples.resolution, ripples.longest_wavelength, ripples.shortest_wavelength = "256", 4.0, 1.0
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.rotation_euler, camera.location = (math.radians(60.0), 0.0, 0.0), (0.0, 0.0, 5.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("Sky")
    render = scene.render
    render.resolution_x, render.resolution_y = 16, 9
    render.image_settings.file_format = "OPEN_EXR"
    render.filepath = str(tmp_path_factory.mktemp("effects") / "frame.exr")
    scene.cycles.samples = scene.eevee.taa_render_samples = 1
    scene.cycles.use_denoising = False
    choose(ocean, scene, [False] * len(EFFECTS))
    yield ocean, scene, {attribute.name for attribute in ocean.data.attributes}
    ocean_lod_addon.unregister()


def choose(ocean, scene, row):
    """Set every effect to On or Off, as an artist who changes one after the other."""
    with properties.many_changes():
        for name, on in zip(EFFECTS, row[:-1], strict=False):
            setattr(ocean.ocean_lod.effects, name, ON if on else OFF)
    setattr(ocean.ocean_lod.effects, EFFECTS[-1], ON if row[-1] else OFF)


def groups_of(tree):
    """A node tree's groups, and those inside them."""
    inner = {node.node_tree for node in tree.nodes if node.type == "GROUP"}
    return inner.union(*(groups_of(group) for group in inner))


def check(ocean, scene, row, basis, columns):
    """Compare an ocean with its plan."""
    plan = ocean_object.plan(ocean, scene)
    on = {decision.effect: decision.on for decision in plan.decisions}
    assert on == dict(zip(EFFECTS, row.tolist(), strict=True))
    assert {attribute.name for attribute in ocean.data.attributes} == basis | set(plan.attributes)
    assert not basis & set(plan.attributes)
    assert columns == {plan.columns}
    assert sum(IMAGE_KEY in image for image in bpy.data.images) == plan.images
    assert (PIXEL_PROPERTY in ocean) == (on["foam"] or on["ripples"])
    tree = ocean.data.materials[0].node_tree
    assert sorted(node.name for node in tree.nodes if node.type == "GROUP") == sorted(plan.nodes)
    ours = {group for group in bpy.data.node_groups if GROUP_KEY in group and group.type == "SHADER"}
    assert ours == groups_of(tree)
    water = tree.nodes["Ocean LOD Water"]
    assert ("Wind Speed" in water.inputs) == on["skewed_slopes"]
    assert ("Volume" in water.outputs) == on["see_through"]


def engines():
    offered = [item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items]
    return "CYCLES", next(name for name in offered if name.startswith("BLENDER_EEVEE"))


@pytest.mark.render
@pytest.mark.parametrize("number", range(len(ROWS)))
def test_an_ocean_has_what_its_plan_names(shot, number, monkeypatch):
    ocean, scene, basis = shot
    row, columns = ROWS[number], set()
    whole = FrameKernel.evaluate

    def counted(self, time, anchors, out, visible=None, wave_limit=None, more=None):
        columns.add(out.array.shape[1] + sum(block.columns for block in more))
        whole(self, time, anchors, out, visible, wave_limit, more)

    monkeypatch.setattr(FrameKernel, "evaluate", counted)
    ocean.ocean_lod.ripples.kind = ("spectral", "random")[number % 2]
    columns.clear()
    choose(ocean, scene, row)
    check(ocean, scene, row, basis, columns)
    for engine in engines():
        scene.render.engine = engine
        columns.clear()
        bpy.ops.render.render(write_still=True)
        check(ocean, scene, row, basis, columns)
        picture = read_pixels(scene.render.filepath)
        assert picture.shape == (9, 16, 4)
        assert np.isfinite(picture).all()
        assert (picture[:5, :, :3].max(axis=(0, 1)) > 0.0).all(), "the water is lit"
