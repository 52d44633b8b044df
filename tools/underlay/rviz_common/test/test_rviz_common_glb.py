# SPDX-License-Identifier: Apache-2.0
"""Triangles as a GLB file."""

import json

import numpy as np
import pytest
from rviz_common.glb import glb_of, surface_glb

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
WHITE = np.full((3, 4), 255, np.uint8)


def test_colours_of_triangles_are_those_of_other_markers():
    """A file has light, not values of a screen: half of the value is a fifth of the light."""
    glb = glb_of(CORNERS, np.array([[128, 255, 10, 128]] * 3, np.uint8))
    red, green, blue, alpha = np.frombuffer(glb[-8:], np.uint16) / 65535.0
    assert (red, green) == pytest.approx((0.2159, 1.0), abs=1e-4)
    assert (blue, alpha) == pytest.approx((10 / 255 / 12.92, 128 / 255), abs=1e-4)


@pytest.mark.parametrize(
    ('is_lit', 'extensions'), [(True, None), (False, {'KHR_materials_unlit': {}})]
)
def test_no_light_changes_triangles_that_are_not_lit(is_lit, extensions):
    """Their material says so, and that it takes an extension, which a reader must know."""
    glb = glb_of(CORNERS, np.full((3, 4), 255, np.uint8), is_lit)
    content = json.loads(glb[20 : 20 + int.from_bytes(glb[12:16], 'little')])
    (material,) = content['materials']
    assert material.get('extensions') == extensions
    assert content.get('extensionsUsed', []) == list(extensions or [])
    assert material['doubleSided'] is is_lit


def test_a_surface_of_nothing_has_valid_normals():
    """A triangle without an area has a normal of length 1, as the format demands."""
    glb = surface_glb(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]], np.uint32), WHITE)
    normals = np.frombuffer(glb[-36 - 24 - 12 : -24 - 12], np.float32).reshape(3, 3)
    assert normals.tolist() == [[0.0, 0.0, 1.0]] * 3
