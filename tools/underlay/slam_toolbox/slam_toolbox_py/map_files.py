# SPDX-License-Identifier: Apache-2.0
"""Write a map as an image and its description, which `nav2_map_server` reads."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from slam_toolbox_py.occupancy import FREE, Grid, OCCUPIED

__all__ = ['full_path', 'save_map', 'write_atomically']

_BLACK, _WHITE, _GREY = 0, 254, 205


def full_path(name: str, *extensions: str) -> Path:
    """
    Make an absolute path from the name of a file, without its extension.

    Parameters
    ----------
    name
        The name, which may start with `~`.
    *extensions
        The extensions to remove, with their dots; others are kept as part of the name.

    """
    path = Path(os.path.abspath(os.path.expanduser(name)))
    return path.with_suffix('') if path.suffix in extensions else path


def write_atomically(path: Path, content: bytes) -> None:
    """
    Write a file atomically, so that no reader sees a partial file.

    Parameters
    ----------
    path
        The file, which is replaced if it exists.
    content
        Its content.

    Raises
    ------
    OSError
        It cannot be written.

    """
    draft = path.with_name(f'.{path.name}.{os.getpid()}')
    try:
        draft.write_bytes(content)
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)


def save_map(grid: Grid, name: str) -> Path:
    """
    Write a map as `name.pgm` and `name.yaml`.

    Parameters
    ----------
    grid
        The map.
    name
        The path without extension; `map` if it is empty.

    Returns
    -------
    The absolute path of the description.

    Raises
    ------
    OSError
        It cannot be written.

    """
    path = full_path(name or 'map', '.pgm', '.yaml')
    image = np.full(grid.cells.shape, _GREY, dtype=np.uint8)
    image[grid.cells == FREE] = _WHITE
    image[grid.cells == OCCUPIED] = _BLACK
    rows, columns = len(image), len(image[0])
    header = f'P5\n{columns} {rows}\n255\n'.encode()
    picture = path.with_name(f'{path.name}.pgm')
    write_atomically(picture, header + image[::-1].tobytes())
    description = path.with_name(f'{path.name}.yaml')
    x, y = (round(float(each), 6) for each in grid.origin)
    write_atomically(
        description,
        (
            f'image: {picture.name}\nmode: trinary\nresolution: {grid.resolution_m:g}\n'
            f'origin: [{x:g}, {y:g}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n'
        ).encode(),
    )
    return description
