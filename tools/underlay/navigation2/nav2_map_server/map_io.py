# SPDX-License-Identifier: Apache-2.0
"""Read and write maps: a YAML file with the metadata, and an image with the cells."""

from __future__ import annotations

from collections.abc import Mapping
import contextlib
from dataclasses import dataclass
import math
import os
from pathlib import Path
import tempfile
from typing import Any

import cv2
from nav2_map_server.occupancy_map import (
    MODES,
    occupancies_of,
    OccupancyMap,
    pixels_of,
    Thresholds,
)
from nav2_util.errors import NavigationError
from nav2_util.plugins import did_you_mean
import numpy as np
import yaml

__all__ = [
    'IMAGE_FORMATS',
    'MapDataError',
    'MapError',
    'MapMetadataError',
    'MissingMapError',
    'read_map',
    'write_map',
]

IMAGE_FORMATS = ('pgm', 'png', 'bmp')
_TRINARY = Thresholds(0.196, 0.65)
"""The thresholds written in mode 'trinary'; with others, unknown cells could be read as free."""
_KEYS = (
    'image',
    'resolution',
    'origin',
    'negate',
    'occupied_thresh',
    'free_thresh',
    'mode',
)


class MapError(NavigationError):
    """A map cannot be read or written; the text is a full sentence with the file."""


class MissingMapError(MapError):
    """The YAML file does not exist."""


class MapMetadataError(MapError):
    """The YAML file is not valid map metadata."""


class MapDataError(MapError):
    """The image is missing or invalid."""


@dataclass(frozen=True)
class _Metadata:
    """Metadata from the YAML file."""

    image: Path
    resolution_m: float
    origin: tuple[float, float, float]
    mode: str
    negate: bool
    thresholds: Thresholds


def read_map(path: str | os.PathLike[str]) -> OccupancyMap:
    """
    Read a map.

    Parameters
    ----------
    path
        The path of the YAML file.

    Raises
    ------
    MissingMapError, MapMetadataError, MapDataError
        Each is a MapError.

    """
    file = Path(os.path.expanduser(path))
    metadata = _read_metadata(file)
    pixels, opacity = _read_image(metadata.image, file)
    return OccupancyMap(
        occupancies_of(
            pixels, metadata.mode, metadata.thresholds, negate=metadata.negate, opacity=opacity
        ),
        metadata.resolution_m,
        metadata.origin,
    )


def write_map(
    found: OccupancyMap,
    stem: str | os.PathLike[str],
    *,
    image_format: str = '',
    mode: str = 'trinary',
    thresholds: Thresholds = Thresholds(),
) -> tuple[Path, Path]:
    """
    Write a map, or no file at all if that fails.

    Parameters
    ----------
    found
        The map.
    stem
        The path of the files without `.yaml` and so on.
    image_format
        'pgm', 'png' or 'bmp'; by default 'png' in mode 'scale', which needs it for unknown cells,
        and 'pgm' otherwise.
    mode
        'trinary', 'scale' or 'raw'.
    thresholds
        The thresholds of free and occupied cells. In mode 'trinary' they are applied when writing,
        and the file gets 0.196 and 0.65, which separate its three shades.

    Returns
    -------
    The paths of the YAML file and the image.

    Raises
    ------
    MapError
        It cannot be written with these arguments.

    """
    stem = Path(os.path.expanduser(stem))
    kind = image_format or ('png' if mode == 'scale' else 'pgm')
    _check_choice('image format', kind, IMAGE_FORMATS)
    _check_choice('mode', mode, MODES)
    if not found.occupancies.size:
        raise MapError('The map has no cells, and is not written.')
    if mode == 'scale' and kind != 'png' and (found.occupancies < 0).any():
        raise MapError(
            f"Images of format '{kind}' have no unknown cells in mode 'scale'. Use 'png'."
        )
    pixels, opacity = pixels_of(found.occupancies, mode, thresholds)
    if opacity is not None and kind == 'png':
        pixels = np.dstack([pixels, pixels, pixels, opacity])
    done, encoded = cv2.imencode(f'.{kind}', pixels)
    if not done:
        raise MapError(f"OpenCV cannot make an image of format '{kind}'.")
    # Not with_suffix: the name may contain dots.
    image, file = stem.parent / f'{stem.name}.{kind}', stem.parent / f'{stem.name}.yaml'
    x, y, yaw = found.origin
    if mode == 'trinary':
        thresholds = _TRINARY
    text = (
        f'image: {yaml.safe_dump(image.name).splitlines()[0]}\n'
        f'mode: {mode}\n'
        f'resolution: {found.resolution_m:.6g}\n'
        f'origin: [{x:.6g}, {y:.6g}, {yaw:.6g}]\n'
        f'negate: 0\n'
        f'occupied_thresh: {thresholds.occupied:g}\n'
        f'free_thresh: {thresholds.free:g}\n'
    )
    _replace({image: encoded.tobytes(), file: text.encode()})
    return file, image


def _check_choice(what: str, given: str, choices: tuple[str, ...]) -> None:
    if given not in choices:
        raise MapError(
            f"There is no {what} '{given}'.{did_you_mean(given, dict.fromkeys(choices))} "
            f'There are {", ".join(choices)}.'
        )


def _replace(contents: Mapping[Path, bytes]) -> None:
    """Replace all files, or restore all if that fails."""
    written: dict[Path, str] = {}
    try:
        for path, content in contents.items():
            handle, written[path] = tempfile.mkstemp(dir=path.parent, prefix=f'.{path.name}.')
            with os.fdopen(handle, 'wb') as file:
                file.write(content)
            os.chmod(written[path], 0o666 & ~_umask())
        for path, temporary in written.items():
            os.replace(temporary, path)
    except OSError as error:
        raise MapError(
            f"The map cannot be written to '{next(iter(contents)).parent}': {error.strerror}."
        ) from error
    finally:
        for temporary in written.values():
            with contextlib.suppress(OSError):
                os.unlink(temporary)


def _umask() -> int:
    mask = os.umask(0o022)
    os.umask(mask)
    return mask


def _read_metadata(file: Path) -> _Metadata:
    try:
        content = yaml.safe_load(file.read_text())
    except FileNotFoundError:
        raise MissingMapError(f"There is no map '{file}'.") from None
    except (OSError, UnicodeDecodeError) as error:
        raise MissingMapError(f"The map '{file}' cannot be read: {error}.") from error
    except yaml.YAMLError as error:
        raise MapMetadataError(f"The map '{file}' is not valid YAML: {error}.") from error
    if not isinstance(content, dict):
        raise MapMetadataError(f"The map '{file}' has no keys, such as 'image: map.pgm'.")
    reader = _Reader(file, content)
    try:
        thresholds = Thresholds(reader.number('free_thresh'), reader.number('occupied_thresh'))
    except ValueError as error:
        raise MapMetadataError(f"The map '{file}' has invalid thresholds: {error}.") from error
    resolution = reader.number('resolution')
    if resolution <= 0.0:
        reader.fail('resolution', 'a number above 0, in m')
    mode = content.get('mode', 'trinary')
    if mode not in MODES:
        reader.fail('mode', f'one of {", ".join(MODES)}')
    image = reader.value('image')
    if not isinstance(image, str) or not image:
        reader.fail('image', 'the path of an image')
    negate = content.get('negate', 0)
    if negate not in (0, 1):
        reader.fail('negate', '0 or 1')
    return _Metadata(
        file.parent / os.path.expanduser(image),
        resolution,
        reader.origin(),
        mode,
        bool(negate),
        thresholds,
    )


class _Reader:
    """Validating reader of the values of a YAML file."""

    def __init__(self, file: Path, content: dict[Any, Any]) -> None:
        self._file, self._content = file, content

    def value(self, key: str) -> Any:
        if key in self._content:
            return self._content[key]
        unknown = {str(each): None for each in self._content if each not in _KEYS}
        advice = did_you_mean(key, unknown).replace('Did you mean', 'Is it meant by')
        raise MapMetadataError(f"The map '{self._file}' has no key '{key}'.{advice}")

    def number(self, key: str) -> float:
        value = self.value(key)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            self.fail(key, 'a number')
        if not math.isfinite(value):
            self.fail(key, 'a finite number')
        return float(value)

    def origin(self) -> tuple[float, float, float]:
        value = self.value('origin')
        if isinstance(value, list) and len(value) == 3:
            with contextlib.suppress(TypeError, ValueError):
                x, y, yaw = map(float, value)
                return x, y, yaw
        self.fail('origin', 'a list of x, y in m and yaw in rad')
        raise AssertionError

    def fail(self, key: str, wanted: str) -> None:
        raise MapMetadataError(
            f"The key '{key}' of the map '{self._file}' must be {wanted}, but is "
            f'{self._content.get(key)!r}.'
        )


def _read_image(image: Path, file: Path) -> tuple[Any, Any]:
    """Read the brightness of pixels, and their opacity if there is an alpha channel."""
    try:
        content = image.read_bytes()
    except OSError as error:
        raise MapDataError(
            f"The image '{image}' of the map '{file}' cannot be read: {error.strerror}. "
            "The key 'image' is relative to the folder of the map."
        ) from error
    try:
        pixels = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        pixels = None
    if pixels is None:
        raise MapDataError(
            f"'{image}', of the map '{file}', is not an image that OpenCV can read."
        )
    if pixels.dtype == np.uint16:
        pixels = (pixels // 257).astype(np.uint8)
    if pixels.ndim == 2:
        return pixels, None
    colours = pixels[..., : 3 if pixels.shape[2] > 2 else 1]
    brightness = colours.mean(axis=2).astype(np.uint8)
    return brightness, pixels[..., -1] if pixels.shape[2] in (2, 4) else None
