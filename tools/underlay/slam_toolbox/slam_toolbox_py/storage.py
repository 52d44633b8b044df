# SPDX-License-Identifier: Apache-2.0
"""
How maps are written to files, and read again.

A map is saved for `nav2_map_server` as an image with its description. A mapper is serialized, to
continue mapping or to localize with it later: `NAME.posegraph` is a ZIP archive of NumPy arrays
(`numpy.load` reads it), all lengths in m and angles in rad, little-endian:

- `version` (1), `poses` (N, 3), `odometry` (N, 3), `stamps` (N,), `travelled` (N,)
- `point_counts` (N,), `points` and `normals` (sum of the counts, 2), in the base of each keyframe
- `outline_counts` (N,), `outlines` (sum of the counts, 2), `origins` (N, 2)
- `edge_nodes` (E, 2), `edge_poses` (E, 3), `edge_information` (E, 3, 3), `edge_is_loop` (E,)

`NAME.data` only refers to it, for programs that check for that file.
"""

from __future__ import annotations

import io
import os
from pathlib import Path
import zipfile

import numpy as np
import numpy.typing as npt
from slam_toolbox_py.mapper import Keyframe, Mapper
from slam_toolbox_py.occupancy import FREE, Grid, OCCUPIED
from slam_toolbox_py.pose_graph import Edge
from slam_toolbox_py.poses import FloatArray
from slam_toolbox_py.scans import Scan
from slam_toolbox_py.settings import MapperSettings

__all__ = ['PoseGraphFileError', 'load_pose_graph', 'save_map', 'save_pose_graph']

_BLACK, _WHITE, _GREY = 0, 254, 205

_VERSION = 1
_EXTENSIONS = ('.posegraph', '.data')
_SHAPES = {
    'poses': (3,),
    'odometry': (3,),
    'points': (2,),
    'normals': (2,),
    'outlines': (2,),
    'origins': (2,),
    'stamps': (),
    'travelled': (),
    'point_counts': (),
    'outline_counts': (),
    'edge_nodes': (2,),
    'edge_poses': (3,),
    'edge_information': (3, 3),
    'edge_is_loop': (),
}


def _full_path(name: str, *extensions: str) -> Path:
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


def _write_atomically(path: Path, content: bytes) -> None:
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
    path = _full_path(name or 'map', '.pgm', '.yaml')
    image = np.full(grid.cells.shape, _GREY, dtype=np.uint8)
    image[grid.cells == FREE] = _WHITE
    image[grid.cells == OCCUPIED] = _BLACK
    rows, columns = len(image), len(image[0])
    header = f'P5\n{columns} {rows}\n255\n'.encode()
    picture = path.with_name(f'{path.name}.pgm')
    _write_atomically(picture, header + image[::-1].tobytes())
    description = path.with_name(f'{path.name}.yaml')
    x, y = (round(float(each), 6) for each in grid.origin)
    _write_atomically(
        description,
        (
            f'image: {picture.name}\nmode: trinary\nresolution: {grid.resolution_m:g}\n'
            f'origin: [{x:g}, {y:g}, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n'
        ).encode(),
    )
    return description


class PoseGraphFileError(Exception):
    """A serialized pose graph cannot be read; the message states the reason."""


def save_pose_graph(mapper: Mapper, name: str) -> Path:
    """
    Write a mapper to a file.

    Parameters
    ----------
    mapper
        The mapper.
    name
        The path without extension; `map` if it is empty.

    Returns
    -------
    The absolute path of the file.

    Raises
    ------
    OSError
        It cannot be written.

    """
    scans, edges = [each.scan for each in mapper.keyframes], mapper.graph.edges
    arrays: dict[str, npt.NDArray[np.generic]] = {
        'version': np.array(_VERSION),
        'poses': mapper.graph.poses,
        'odometry': _stack([each.odometry for each in mapper.keyframes], 3),
        'stamps': np.array([each.stamp_s for each in mapper.keyframes], dtype=float),
        'travelled': np.array(mapper.travelled_m, dtype=float),
        'point_counts': np.array([len(each.points) for each in scans], dtype=np.int32),
        'points': _join([each.points for each in scans]),
        'normals': _join([each.normals for each in scans]),
        'outline_counts': np.array([len(each.outline) for each in scans], dtype=np.int32),
        'outlines': _join([each.outline for each in scans]),
        'origins': _stack([each.origin for each in scans], 2),
        'edge_nodes': np.array([(e.first, e.second) for e in edges], dtype=np.int32).reshape(
            -1, 2
        ),
        'edge_poses': _stack([each.measured for each in edges], 3),
        'edge_information': np.array([e.information for e in edges]).reshape(-1, 3, 3),
        'edge_is_loop': np.array([each.is_loop for each in edges], dtype=bool),
    }
    content = io.BytesIO()
    np.savez(content, allow_pickle=False, **arrays)
    path = _full_path(name or 'map', *_EXTENSIONS)
    file = path.with_name(f'{path.name}.posegraph')
    _write_atomically(file, content.getvalue())
    _write_atomically(
        path.with_name(f'{path.name}.data'), f'All of this map is in {file.name}.\n'.encode()
    )
    return file


def load_pose_graph(name: str, settings: MapperSettings) -> Mapper:
    """
    Read a mapper from a file that `save_pose_graph` has written.

    Parameters
    ----------
    name
        The path without extension.
    settings
        The settings of the mapper.

    Raises
    ------
    PoseGraphFileError
        It cannot be read, or is not a pose graph.

    """
    path = _full_path(name, *_EXTENSIONS)
    path = path.with_name(f'{path.name}.posegraph')
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {key: file[key] for key in file.files}
    except FileNotFoundError:
        raise PoseGraphFileError(
            f"File '{path}' not found. Give the name without extension, with its folder."
        ) from None
    except OSError as error:
        raise PoseGraphFileError(f"'{path}' cannot be read: {error.strerror or error}.") from error
    except (ValueError, KeyError, EOFError, zipfile.BadZipFile, zipfile.LargeZipFile) as error:
        raise PoseGraphFileError(
            f"'{path}' is not a serialized map of this program, or is broken: {error}. Maps "
            'of genuine slam_toolbox cannot be read; build the map again and serialize it.'
        ) from error
    fault = _fault(arrays)
    if fault:
        raise PoseGraphFileError(f"'{path}' is broken: {fault}. Serialize the map again.")
    return _mapper_of(arrays, settings)


def _mapper_of(arrays: dict[str, npt.NDArray[np.generic]], settings: MapperSettings) -> Mapper:
    mapper = Mapper(settings)
    values = {key: np.asarray(each, dtype=float) for key, each in arrays.items()}
    ends = np.cumsum(arrays['point_counts'])[:-1]
    points, normals = np.split(values['points'], ends), np.split(values['normals'], ends)
    outlines = np.split(values['outlines'], np.cumsum(arrays['outline_counts'])[:-1])
    for i, pose in enumerate(values['poses']):
        scan = Scan(points[i], normals[i], outlines[i], values['origins'][i])
        mapper.add_known(
            Keyframe(scan, values['odometry'][i], float(values['stamps'][i])),
            pose,
            float(values['travelled'][i]),
        )
    for nodes, measured, information, is_loop in zip(
        arrays['edge_nodes'],
        values['edge_poses'],
        values['edge_information'],
        arrays['edge_is_loop'],
    ):
        first, second = int(nodes[0]), int(nodes[1])
        mapper.graph.add_edge(Edge(first, second, measured, information, bool(is_loop)))
    mapper.follow_graph()
    return mapper


def _fault(arrays: dict[str, npt.NDArray[np.generic]]) -> str | None:
    """Validate the arrays of a file; return the error, or None if they are valid."""
    if 'version' not in arrays or int(arrays['version'].sum()) != _VERSION:
        return f'its version is not {_VERSION}'
    for key, shape in _SHAPES.items():
        if key not in arrays or arrays[key].shape[1:] != shape or arrays[key].ndim < 1:
            return f"'{key}' is missing or has another shape"
        if not np.isfinite(np.asarray(arrays[key], dtype=float)).all():
            return f"'{key}' has values that are not numbers"
    nodes = len(arrays['poses'])
    if not nodes:
        return 'it has no keyframes'
    keys = ('odometry', 'stamps', 'travelled', 'origins', 'point_counts', 'outline_counts')
    if any(len(arrays[key]) != nodes for key in keys):
        return 'its keyframes are not complete'
    points, outlines = (int(arrays[f'{key}_counts'].sum()) for key in ('point', 'outline'))
    lengths = len(arrays['points']), len(arrays['normals']), len(arrays['outlines'])
    if lengths != (points, points, outlines):
        return 'its scans are not complete'
    ends = arrays['edge_nodes']
    if ends.size and not (0 <= int(ends.min()) and int(ends.max()) < nodes):
        return 'an edge leads to a keyframe that does not exist'
    return None


def _join(parts: list[FloatArray]) -> npt.NDArray[np.float32]:
    return np.concatenate([np.zeros((0, 2)), *parts]).astype(np.float32)


def _stack(rows: list[FloatArray], width: int) -> FloatArray:
    return np.array(rows, dtype=float).reshape(-1, width)
