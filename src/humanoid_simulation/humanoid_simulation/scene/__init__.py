# SPDX-License-Identifier: Apache-2.0
"""Scenes: the floor, objects, rooms and places of a simulated world."""

from humanoid_simulation.scene.loading import load_scene, scene_of
from humanoid_simulation.scene.scene import Floor, Scene, Thing

__all__ = ['Floor', 'Scene', 'Thing', 'load_scene', 'scene_of']
