# SPDX-License-Identifier: Apache-2.0
"""Write the map of a scene: `ros2 run humanoid_simulation scene_map`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
import signal
import sys

from humanoid_common.errors import UserError
from humanoid_simulation.files import replace_file
from humanoid_simulation.scene.loading import load_scene
from humanoid_simulation.scene.occupancy import FREE, Layer, occupancy_of, OccupancyMap, OCCUPIED
import numpy as np

_GREY = {OCCUPIED: 0, FREE: 254}
_UNKNOWN_GREY = 205
"""Between the thresholds below, as written by map_saver."""


def main(argv: Sequence[str] | None = None) -> int:
    """
    Write the occupancy map of a scene, as the command `scene_map`.

    Parameters
    ----------
    argv
        Arguments of the command line, without the program; None uses those of the process.

    Returns
    -------
    int
        Exit code: 0, 1 if the map cannot be drawn or written, or 130 after Ctrl-C.

    """
    arguments = _parser().parse_args(argv)
    try:
        scene = load_scene(arguments.scene)
        layer = _layer(arguments)
        drawn = occupancy_of(
            scene, layer, arguments.resolution, tuple(arguments.start), arguments.margin
        )
        stem = arguments.output or Path(scene.name)
        picture, table = write_map(drawn, stem)
    except UserError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    rows, columns = drawn.cells.shape
    print(
        f'{table} and {picture}: {columns} x {rows} cells of {drawn.resolution_m:g} m, '
        f'{layer.low_m:g} to {layer.high_m:g} m above the ground'
    )
    return 0


def _parser() -> argparse.ArgumentParser:
    """Create the parser of the command line."""
    parser = argparse.ArgumentParser(
        prog='scene_map',
        description='Write the map that a perfect mapper would make of a scene, as .pgm and '
        '.yaml files for map_server and RViz.',
    )
    parser.add_argument(
        'scene',
        nargs='?',
        default='apartment',
        help='its name or YAML file (default: apartment)',
    )
    parser.add_argument(
        '--output',
        type=Path,
        help='the output files, without .yaml (default: the name of the scene)',
    )
    heights = parser.add_argument_group(
        'heights', 'Everything solid between two heights is drawn, so that obstacles above or '
        'below the scan plane of a laser scanner, such as table tops, are in the map as well.',
    )  # fmt: skip
    heights.add_argument(
        '--from-height',
        type=float,
        metavar='M',
        default=Layer.low_m,
        help=f'(default: {Layer.low_m:g})',
    )
    heights.add_argument(
        '--to-height',
        type=float,
        metavar='M',
        default=Layer.high_m,
        help=f'(default: {Layer.high_m:g})',
    )
    heights.add_argument(
        '--height',
        type=float,
        metavar='M',
        help='a single height instead: what a scanner there would see',
    )
    parser.add_argument(
        '--resolution',
        type=float,
        metavar='M',
        default=0.05,
        help='size of a cell (default: 0.05)',
    )
    parser.add_argument(
        '--start',
        type=float,
        nargs=2,
        metavar=('X', 'Y'),
        default=(0.0, 0.0),
        help='where the mapper starts (default: 0 0, as the robot does)',
    )
    parser.add_argument(
        '--margin',
        type=float,
        metavar='M',
        default=0.5,
        help='around the drawn area (default: 0.5)',
    )
    return parser


def _layer(arguments: argparse.Namespace) -> Layer:
    """Return the range of heights that the arguments give."""
    if arguments.height is not None:
        return Layer(arguments.height, arguments.height)
    return Layer(arguments.from_height, arguments.to_height)


def write_map(drawn: OccupancyMap, stem: Path) -> tuple[Path, Path]:
    """
    Write an occupancy map as .pgm and .yaml, the format of `map_server`.

    Each file is written atomically; the .yaml, which names the .pgm, comes last.

    Parameters
    ----------
    drawn
        The map.
    stem
        Path of both files without a suffix; a suffix .yaml or .pgm is dropped.

    Returns
    -------
    tuple[Path, Path]
        The paths of the .pgm and of the .yaml.

    Raises
    ------
    SimulationError
        A file cannot be written.

    """
    stem = stem.with_suffix('') if stem.suffix in ('.yaml', '.pgm') else stem
    picture, table = stem.with_name(f'{stem.name}.pgm'), stem.with_name(f'{stem.name}.yaml')
    rows, columns = drawn.cells.shape
    greys = np.full(drawn.cells.shape, _UNKNOWN_GREY, dtype=np.uint8)
    for value, grey in _GREY.items():
        greys[drawn.cells == value] = grey
    header = f'P5\n{columns} {rows}\n255\n'.encode()
    # The first row of an image is that of the largest y.
    replace_file(picture, header + greys[::-1].tobytes())
    x_m, y_m = drawn.origin_m
    text = (
        f'image: {picture.name}\n'
        'mode: trinary\n'
        f'resolution: {drawn.resolution_m:g}\n'
        f'origin: [{x_m:.6g}, {y_m:.6g}, 0]\n'
        'negate: 0\n'
        'occupied_thresh: 0.65\n'
        'free_thresh: 0.196\n'
    )
    replace_file(table, text.encode())
    return picture, table


if __name__ == '__main__':
    sys.exit(main())
