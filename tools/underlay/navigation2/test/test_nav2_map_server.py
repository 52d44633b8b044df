# SPDX-License-Identifier: Apache-2.0
"""The servers of maps, in process, and the command that saves one."""

from __future__ import annotations

import os
import subprocess
import sys

from nav2_map_server import OccupancyMap, read_map, write_map
from nav2_map_server.costmap_filter_info_server import CostmapFilterInfoServer
from nav2_map_server.map_messages import make_grid
from nav2_map_server.map_saver import MapSaver
from nav2_map_server.map_server import MapServer
from nav2_msgs.msg import CostmapFilterInfo
from nav2_msgs.srv import LoadMap, SaveMap
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetMap
import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture
def room(tmp_path):
    cells = np.array([[0, 100, -1], [0, 0, 100]], np.int8)
    return write_map(OccupancyMap(cells, 0.05, (-1.0, 2.0, 0.0)), tmp_path / 'room')[0]


def start(node):
    assert node.trigger_configure().name == 'SUCCESS'
    assert node.trigger_activate().name == 'SUCCESS'
    return node


def listen(ros, kind, topic):
    heard = []
    ros.node('listener').create_subscription(kind, topic, heard.append, LATCHED)
    return heard


def test_map_server_publishes_and_answers(ros, room):
    """The map comes on the topic, also to who is late, and from the service."""
    start(ros.make(MapServer, {'yaml_filename': str(room)}))
    heard = listen(ros, OccupancyGrid, '/map')
    ros.wait_until(lambda: heard, what='the map')
    assert heard[0].header.frame_id == 'map'
    assert (heard[0].info.width, heard[0].info.height) == (3, 2)
    assert list(heard[0].data) == [0, 100, -1, 0, 0, 100]
    assert heard[0].info.origin.position.y == 2.0
    assert ros.call(GetMap, '/map_server/map').map.data == heard[0].data


def test_load_map_tells_what_is_wrong(ros, room, tmp_path):
    """Each kind of failure has its code; the map that was there stays."""
    start(ros.make(MapServer))
    heard = listen(ros, OccupancyGrid, '/map')

    def load(url):
        return ros.call(LoadMap, '/map_server/load_map', LoadMap.Request(map_url=url)).result

    assert load(str(room)) == LoadMap.Response.RESULT_SUCCESS
    assert load(f'file://{room}') == LoadMap.Response.RESULT_SUCCESS
    ros.wait_until(lambda: heard, what='the map')
    assert load(str(tmp_path / 'none.yaml')) == LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST
    assert load('') == LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST
    text = room.read_text()
    room.write_text(text.replace('resolution', 'resoluton'))
    assert load(str(room)) == LoadMap.Response.RESULT_INVALID_MAP_METADATA
    room.write_text(text)
    (tmp_path / 'room.pgm').write_text('nothing')
    assert load(str(room)) == LoadMap.Response.RESULT_INVALID_MAP_DATA


def test_inactive_map_server(ros, room):
    """Before it is active the server loads nothing, and after cleaning up it has no map."""
    server = ros.make(MapServer, {'yaml_filename': str(room), 'topic_name': 'floor'})
    assert server.trigger_configure().name == 'SUCCESS'
    request = LoadMap.Request(map_url=str(room))
    answer = ros.call(LoadMap, '/map_server/load_map', request)
    assert answer.result == LoadMap.Response.RESULT_UNDEFINED_FAILURE
    assert server.trigger_activate().name == 'SUCCESS'
    heard = listen(ros, OccupancyGrid, '/floor')
    ros.wait_until(lambda: heard, what='the map')
    assert server.trigger_deactivate().name == 'SUCCESS'
    assert server.trigger_cleanup().name == 'SUCCESS'


@pytest.mark.parametrize('path', ['/nowhere/room.yaml', '~no_one/room.yaml'])
def test_wrong_map_fails_to_configure(ros, capfd, path):
    """A map server with a missing map is not configured and says why."""
    server = ros.make(MapServer, {'yaml_filename': path})
    assert server.trigger_configure().name == 'FAILURE'
    assert f"There is no map '{path}'" in capfd.readouterr().err


def test_map_saver_saves(ros, tmp_path):
    """The service writes the map of a topic; without a map it says no."""
    saver = ros.make(MapSaver, {'save_map_timeout': 0.3})
    assert saver.trigger_configure().name == 'SUCCESS'
    url = str(tmp_path / 'saved')
    request = SaveMap.Request(map_topic='map', map_url=url)
    assert not ros.call(SaveMap, '/map_saver/save_map', request).result
    cells = np.array([[0, 100, -1], [0, 0, 100]], np.int8)
    made = OccupancyMap(cells, 0.05, (-1.0, 2.0, 0.0))
    node = ros.node('mapper')
    publisher = node.create_publisher(OccupancyGrid, '/map', LATCHED)
    publisher.publish(make_grid(made, 'map', node.get_clock().now().to_msg()))
    assert ros.call(SaveMap, '/map_saver/save_map', request).result
    np.testing.assert_array_equal(read_map(f'{url}.yaml').occupancies, cells)
    wrong = SaveMap.Request(map_topic='map', map_url=url, image_format='gif')
    assert not ros.call(SaveMap, '/map_saver/save_map', wrong).result


def test_filter_info(ros):
    """What a mask means is published, also to who is late."""
    parameters = {
        'filter_info_topic': '/info',
        'type': 1,
        'mask_topic': '/mask',
        'base': 100.0,
        'multiplier': -1.0,
    }
    start(ros.make(CostmapFilterInfoServer, parameters))
    heard = listen(ros, CostmapFilterInfo, '/info')
    ros.wait_until(lambda: heard, what='the information')
    assert (heard[0].type, heard[0].filter_mask_topic) == (1, '/mask')
    assert (heard[0].base, heard[0].multiplier) == (100.0, -1.0)


def run_cli(domain, folder, *words):
    return subprocess.Popen(
        [
            sys.executable,
            '-c',
            'from nav2_map_server.map_saver import main; exit(main())',
            *words,
        ],
        env={
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        },
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def test_command_saves(ros, domain, room, tmp_path):
    """map_saver_cli writes the map with its options, and ends."""
    start(ros.make(MapServer, {'yaml_filename': str(room)}))
    words = ['-t', '/map', '-f', 'copy', '--fmt', 'png', '--mode', 'scale', '--occ', '0.7']
    process = run_cli(domain, tmp_path, *words, '--ros-args', '-p', 'save_map_timeout:=20.0')
    ros.wait_until(lambda: process.poll() is not None, 40.0, 'the command')
    assert process.returncode == 0, process.stdout.read()
    copy = read_map(tmp_path / 'copy.yaml')
    np.testing.assert_array_equal(copy.occupancies, read_map(room).occupancies)
    assert 'occupied_thresh: 0.7' in (tmp_path / 'copy.yaml').read_text()


def test_command_without_a_map(domain, tmp_path):
    """Without a map the command fails with a sentence, and writes nothing."""
    words = ['-t', '/nobody', '--ros-args', '-p', 'save_map_timeout:=0.2']
    output, _ = (process := run_cli(domain, tmp_path, *words)).communicate(timeout=60)
    assert process.returncode == 1
    assert "No map was received on '/nobody' within 0.2 s" in output
    assert os.listdir(tmp_path) == []
