# SPDX-License-Identifier: Apache-2.0
"""Choices of the launch argument `scene`."""

from __future__ import annotations

from pathlib import Path

from humanoid_simulation.files import installed_scenes, SCENE_SUFFIXES


class SceneChoices(list[str]):
    """
    The names of the installed scenes, for completion; paths of scene files are accepted as well.

    It is a list, as `DeclareLaunchArgument` requires of its choices: a wrong name ends the launch
    when the argument is declared, before any process has started.
    """

    def __init__(self) -> None:
        super().__init__(installed_scenes())

    def __contains__(self, value: object) -> bool:
        """Check whether a text is the name of a scene, or the path of a file that can be one."""
        is_path = isinstance(value, str) and value.endswith(SCENE_SUFFIXES)
        return super().__contains__(value) or (is_path and Path(str(value)).is_file())

    def __str__(self) -> str:
        """Format the choices for descriptions and error messages."""
        return ', '.join(f"'{name}'" for name in self) + ', or the path of a file (.yaml)'
