# SPDX-License-Identifier: Apache-2.0
"""What the launch argument `scene` may be."""

from __future__ import annotations

from pathlib import Path

from humanoid_simulation.files import installed_scenes, SCENE_SUFFIXES


class SceneChoices(list[str]):
    """
    The names of the installed scenes, which completion offers, and every file that is one.

    It is a list, as `DeclareLaunchArgument` wants its choices: a wrong name ends the launch when
    the argument is declared, before any process has started.
    """

    def __init__(self) -> None:
        """Look for the scenes."""
        super().__init__(installed_scenes())

    def __contains__(self, value: object) -> bool:
        """Whether a text is the name of a scene, or the path of a file that can be one."""
        is_path = isinstance(value, str) and value.endswith(SCENE_SUFFIXES)
        return super().__contains__(value) or (is_path and Path(str(value)).is_file())

    def __str__(self) -> str:
        """Return what one reads in a description and in an error."""
        return ', '.join(f"'{name}'" for name in self) + ', or the path of a file (.yaml)'
