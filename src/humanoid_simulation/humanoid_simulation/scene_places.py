# SPDX-License-Identifier: Apache-2.0
"""Write the named places of a scene: `ros2 run humanoid_simulation scene_places`."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from pathlib import Path
import signal
import sys

from humanoid_common.errors import UserError
from humanoid_simulation.files import replace_file
from humanoid_simulation.scene.loading import load_scene
from humanoid_simulation.scene.outlines import rectangle
from humanoid_simulation.scene.scene import COMPOSED, Scene, Surface

_OPEN_BELOW, _CONTAINERS = ('table',), ('bin',)
_BOARD_M, _STANDS_M = 0.04, 0.01
_HEAD = """\
# SPDX-License-Identifier: Apache-2.0
# Named places of a home, in the frame of its map: what a user measured there.
#   surfaces: outline [[x, y], ...] and height in m; tolerance: how exact these are, in m;
#             depth: how thick the top is, in m; without it, it is solid down to the floor
#             container: true for the opening of a bin, into which things fall
#             fixtures: outline and height of what stands on it for good, in m
#   rooms:    outline [[x, y], ...]
"""


def main(argv: Sequence[str] | None = None) -> int:
    """
    Write the named places of a scene, as the command `scene_places`.

    Parameters
    ----------
    argv
        Arguments of the command line, without the program; None uses those of the process.

    Returns
    -------
    int
        Exit code: 0, 1 if the scene cannot be read or the file not written, or 130 after Ctrl-C.

    """
    parser = argparse.ArgumentParser(
        prog='scene_places',
        description='Write the surfaces and rooms of a scene as a file of named places, as if '
        'they had been measured in its map, whose origin is that of the scene.',
    )
    parser.add_argument(
        'scene', nargs='?', default='apartment', help='its name or YAML file (default: apartment)'
    )
    parser.add_argument(
        '--output', type=Path, help='the output file (default: places_ and the name of the scene)'
    )
    arguments = parser.parse_args(argv)
    try:
        scene = load_scene(arguments.scene)
        path = arguments.output or Path(f'places_{scene.name}.yaml')
        replace_file(path, places_text(scene).encode())
    except UserError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    print(f'{path}: {len(scene.surfaces)} surfaces and {len(scene.rooms)} rooms')
    return 0


def places_text(scene: Scene) -> str:
    """
    Format the surfaces and rooms of a scene as a YAML file of named places.

    Lengths are rounded to 1 cm, as a tape measure gives them.

    Parameters
    ----------
    scene
        The scene, whose origin is that of the frame `map`.

    Returns
    -------
    str
        Content of the file.

    """
    surfaces = [
        f'  - {{name: {surface.name}, height: {surface.height_m:.2f}, '
        f'outline: {_corners(surface.outline_m)}{_depth(scene, surface)}'
        f'{_container(scene, surface)}{_fixtures(scene, surface)}}}'
        for surface in scene.surfaces
    ]
    rooms = [
        f'  - {{name: {room.name}, outline: {_corners(room.outline_m)}}}' for room in scene.rooms
    ]
    lines = ['frame: map', 'surfaces:', *surfaces, 'rooms:', *rooms]
    return _HEAD + '\n'.join(lines) + '\n'


def _depth(scene: Scene, surface: Surface) -> str:
    """Format the thickness of a surface, if it is a board with free space below."""
    base = surface.name.partition('/')[0]
    boards = sum(each.name.partition('/')[0] == base for each in scene.surfaces)
    is_board = boards > 1 or scene.thing(base).kind in _OPEN_BELOW
    return f', depth: {_BOARD_M:.2f}' if is_board else ''


def _container(scene: Scene, surface: Surface) -> str:
    """Format the flag of a container, if the surface is the opening of one."""
    is_one = scene.thing(surface.name.partition('/')[0]).kind in _CONTAINERS
    return ', container: true' if is_one else ''


def _fixtures(scene: Scene, surface: Surface) -> str:
    """Format the outlines and heights of the fixtures on a surface, if there are any."""
    found = []
    for thing in scene.things:
        x_m, y_m, foot_m = thing.position_m
        is_piece = thing.is_fixed and thing.shape == COMPOSED
        is_there = surface.contains(x_m, y_m) and abs(foot_m - surface.height_m) < _STANDS_M
        if is_piece and is_there:
            length_m, width_m, height_m = thing.size_m
            around = rectangle((x_m, y_m), length_m, width_m, thing.orientation_rpy_rad[2])
            found.append(f'{{outline: {_corners(around)}, height: {height_m:.2f}}}')
    return f', fixtures: [{", ".join(found)}]' if found else ''


def _corners(outline_m: Iterable[tuple[float, float]]) -> str:
    return '[' + ', '.join(f'[{x_m:.2f}, {y_m:.2f}]' for x_m, y_m in outline_m) + ']'


if __name__ == '__main__':
    sys.exit(main())
