# SPDX-License-Identifier: Apache-2.0
"""Maps in files: what is written is read again, and errors say where they are."""

from __future__ import annotations

import os

import cv2
from nav2_map_server import MapError, OccupancyMap, read_map, write_map
from nav2_map_server.map_io import MapDataError, MapMetadataError, MissingMapError
from nav2_map_server.occupancy_map import occupancies_of, Thresholds
import numpy as np
import pytest

YAML = (
    'image: room.pgm\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\nnegate: 0\n'
    'occupied_thresh: 0.65\nfree_thresh: 0.196\n'
)


def make_map(values=(0, 100, -1)):
    generator = np.random.default_rng(3)
    cells = generator.choice(np.array(values, np.int8), size=(30, 20))
    return OccupancyMap(cells, 0.05, (-1.5, 2.25, 0.5))


@pytest.fixture
def room(tmp_path):
    """Write a map of two rows: free and occupied on top, unknown and free below."""
    (tmp_path / 'room.yaml').write_text(YAML)
    pixels = np.array([[254, 0], [205, 255]], np.uint8)
    (tmp_path / 'room.pgm').write_bytes(b'P5\n# made by hand\n2 2\n255\n' + pixels.tobytes())
    return tmp_path / 'room.yaml'


@pytest.mark.parametrize('image_format', ['pgm', 'png', 'bmp'])
@pytest.mark.parametrize(
    ('mode', 'values'),
    [('trinary', (0, 100, -1)), ('scale', range(-1, 101)), ('raw', range(-1, 101))],
)
def test_round_trip(tmp_path, mode, values, image_format):
    """In each mode and format, a map is read as it was written."""
    if mode == 'scale' and image_format != 'png':
        values = range(101)
    made = make_map(values)
    file, image = write_map(made, tmp_path / 'my.map', image_format=image_format, mode=mode)
    assert (file.name, image.name) == ('my.map.yaml', f'my.map.{image_format}')
    found = read_map(file)
    np.testing.assert_array_equal(found.occupancies, made.occupancies)
    assert (found.resolution_m, found.origin) == (0.05, (-1.5, 2.25, 0.5))


def test_official_map_is_read(room):
    """The first row of an image is the last of the map; white is free, black occupied."""
    found = read_map(room)
    assert found.occupancies.tolist() == [[-1, 0], [0, 100]]
    assert found.resolution_m == 0.05
    assert found.origin == (-1.0, -2.0, 0.0)


def test_negated_map(room):
    """With negate, black is free."""
    room.write_text(YAML.replace('negate: 0', 'negate: 1'))
    assert read_map(room).occupancies.tolist() == [[100, 100], [100, 0]]


def test_scale_and_raw_values():
    """In mode scale pixels between the thresholds are percentages, in raw they are themselves."""
    pixels = np.array([[0, 255, 140, 60]], np.uint8)
    scaled = occupancies_of(pixels, 'scale', Thresholds(0.2, 0.7))
    assert scaled.tolist() == [[100, 0, 50, 100]]
    opacity = np.array([[255, 254, 0, 255]], np.uint8)
    scaled = occupancies_of(pixels, 'scale', Thresholds(0.2, 0.7), opacity=opacity)
    assert scaled.tolist() == [[100, -1, -1, 100]]
    raw = occupancies_of(pixels, 'raw', Thresholds())
    assert raw.tolist() == [[0, -1, -1, 60]]


def test_thresholds_of_writing(tmp_path):
    """What is between the thresholds is unknown in mode trinary."""
    made = OccupancyMap(np.array([[0, 25, 26, 64, 65, 100]], np.int8), 0.1, (0.0, 0.0, 0.0))
    file, image = write_map(made, tmp_path / 'map')
    assert cv2.imread(str(image), cv2.IMREAD_UNCHANGED).tolist() == [[254, 254, 205, 205, 0, 0]]
    assert 'free_thresh: 0.196' in file.read_text()


@pytest.mark.parametrize('shape', [(2, 2, 3), (2, 2, 4)])
def test_coloured_image(room, shape):
    """The mean of the colours counts."""
    pixels = np.zeros(shape, np.uint8)
    pixels[0, 0, :3] = (255, 255, 255)
    if shape[2] == 4:
        pixels[..., 3] = 255
    cv2.imwrite(str(room.with_suffix('.png')), pixels)
    room.write_text(YAML.replace('room.pgm', 'room.png'))
    assert read_map(room).occupancies.tolist() == [[100, 100], [0, 100]]


@pytest.mark.parametrize(
    ('old', 'new', 'kind', 'said'),
    [
        (
            'resolution',
            'resoluton',
            MapMetadataError,
            "no key 'resolution'. Is it meant by 'resoluton'?",
        ),
        ('resolution: 0.05', 'resolution: fine', MapMetadataError, "'resolution' of the map"),
        ('resolution: 0.05', 'resolution: 0', MapMetadataError, 'a number above 0'),
        ('[-1.0, -2.0, 0.0]', '[1, 2]', MapMetadataError, "'origin' of the map"),
        ('negate: 0', 'negate: 2', MapMetadataError, "'negate' of the map"),
        ('negate: 0', 'mode: tertiary', MapMetadataError, 'one of trinary, scale, raw'),
        ('0.196', '0.75', MapMetadataError, 'invalid thresholds'),
        (YAML, '- 1', MapMetadataError, 'has no keys'),
        (YAML, 'a: [', MapMetadataError, 'is not valid YAML'),
        ('room.pgm', 'hall.pgm', MapDataError, 'No such file or directory'),
        ('room.pgm', 'room.yaml', MapDataError, 'is not an image'),
    ],
)
def test_errors_are_sentences(room, old, new, kind, said):
    """Whatever is wrong in a map, the error names the file and the key."""
    room.write_text(YAML.replace(old, new))
    with pytest.raises(kind, match='room.yaml') as error:
        read_map(room)
    assert said in str(error.value)


def test_missing_map(tmp_path):
    """A map that is not there is named."""
    with pytest.raises(MissingMapError, match='none.yaml'):
        read_map(tmp_path / 'none.yaml')


@pytest.mark.parametrize(
    ('options', 'said'),
    [
        ({'image_format': 'pgmm'}, "Did you mean 'pgm'?"),
        ({'mode': 'raww'}, "Did you mean 'raw'?"),
        ({'mode': 'scale', 'image_format': 'pgm'}, "Use 'png'"),
    ],
)
def test_wrong_options_write_nothing(tmp_path, options, said):
    """A format or a mode that is not there is an error, and no file is left."""
    with pytest.raises(MapError) as error:
        write_map(make_map(), tmp_path / 'map', **options)
    assert said in str(error.value)
    assert os.listdir(tmp_path) == []


def test_failed_writing_leaves_no_half_map(tmp_path):
    """If a file cannot be written, there are neither new nor temporary ones."""
    with pytest.raises(MapError, match='nowhere'):
        write_map(make_map(), tmp_path / 'nowhere' / 'map')
    (tmp_path / 'map.yaml').mkdir()
    with pytest.raises(MapError, match='cannot be written'):
        write_map(make_map(), tmp_path / 'map')
    assert [name for name in os.listdir(tmp_path) if name.startswith('.')] == []
