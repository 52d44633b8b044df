# SPDX-License-Identifier: Apache-2.0
"""The node of a costmap, in process."""

from __future__ import annotations

from array import array
import itertools
import math

from geometry_msgs.msg import Point32, Polygon, PolygonStamped, TransformStamped
from map_msgs.msg import OccupancyGridUpdate
from nav2_costmap_2d import Costmap2DROS, make_costmap
from nav2_costmap_2d.costs import (
    FREE_SPACE,
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_msgs.msg import Costmap, CostmapFilterInfo, SpeedLimit
from nav2_msgs.srv import (
    ClearCostmapAroundRobot,
    ClearCostmapExceptRegion,
    ClearEntireCostmap,
    GetCost,
    GetCostmap,
)
from nav2_util import LifecycleNode
from nav_msgs.msg import OccupancyGrid
import numpy as np
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan, PointCloud2, PointField, Range
from std_msgs.msg import Bool
from std_srvs.srv import SetBool
from tf2_ros import TransformBroadcaster

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SOURCE = {
    'obstacle_layer.observation_sources': 'scan',
    'obstacle_layer.scan.topic': '/scan',
    'obstacle_layer.scan.max_obstacle_height': 2.0,
    'obstacle_layer.scan.clearing': True,
}
LOCAL = {
    'global_frame': 'odom',
    'rolling_window': True,
    'width': 3,
    'height': 3,
    'resolution': 0.05,
    'update_frequency': 50.0,
    'publish_frequency': 50.0,
    'robot_radius': 0.2,
    'plugins': ['obstacle_layer', 'inflation_layer'],
    'inflation_layer.inflation_radius': 0.5,
    'inflation_layer.cost_scaling_factor': 3.0,
    **SOURCE,
}
GLOBAL = {
    'update_frequency': 50.0,
    'publish_frequency': 50.0,
    'robot_radius': 0.2,
    'track_unknown_space': True,
    'static_layer.map_topic': '/map',
    **SOURCE,
}


class World:
    """What a costmap hears: transforms, a map and a scanner."""

    def __init__(self, ros, **options):
        self.ros = ros
        self.node = ros.node(**options)
        self.broadcaster = TransformBroadcaster(self.node)
        self.scans = self.node.create_publisher(LaserScan, '/scan', qos_profile_sensor_data)
        self.maps = self.node.create_publisher(OccupancyGrid, '/map', LATCHED)
        self.places = {('map', 'odom'): (0.0, 0.0), ('odom', 'base_link'): (0.0, 0.0)}
        self.node.create_timer(0.02, self.send_transforms)

    def send_transforms(self):
        for (parent, child), (x, y) in self.places.items():
            moved = TransformStamped(child_frame_id=child)
            moved.header.frame_id = parent
            moved.header.stamp = self.node.get_clock().now().to_msg()
            moved.transform.translation.x, moved.transform.translation.y = x, y
            self.broadcaster.sendTransform(moved)

    def scan(self, ranges, **fields):
        count = len(ranges)
        scan = LaserScan(
            angle_min=0.01 - math.pi,
            angle_increment=2.0 * math.pi / count,
            range_min=0.05,
            range_max=10.0,
            ranges=[float(each) for each in ranges],
            **fields,
        )
        scan.header.frame_id = 'base_link'
        scan.header.stamp = self.node.get_clock().now().to_msg()
        self.scans.publish(scan)

    def grid(self, cells, frame='map', origin=(0.0, 0.0), resolution=0.1):
        return grid_message(cells, frame, origin, resolution)

    def start(self, costmap):
        assert costmap.trigger_configure().name == 'SUCCESS'
        assert costmap.trigger_activate().name == 'SUCCESS'


def grid_message(cells, frame='map', origin=(0.0, 0.0), resolution=0.1):
    cells = np.asarray(cells, np.int8)
    message = OccupancyGrid()
    message.header.frame_id = frame
    message.info.height, message.info.width = cells.shape
    message.info.resolution = resolution
    message.info.origin.position.x, message.info.origin.position.y = origin
    message.data = array('b', cells.tobytes())
    return message


@pytest.fixture
def world(ros):
    return World(ros)


def make(world, parameters, name='local_costmap'):
    return world.ros.make(Costmap2DROS, parameters, node_name=name, namespace=name)


def test_costmap_of_a_server_gets_its_parameters(ros, tmp_path):
    """A server's costmap reads its own section of the file, and overrides of the server."""
    file = tmp_path / 'nav2.yaml'
    file.write_text(
        'robot1:\n  global_costmap:\n    global_costmap:\n      ros__parameters:\n'
        '        plugins: [inflation_layer]\n'
        '        resolution: 0.05\n        width: 4\n        height: 3\n'
    )
    arguments = ['--ros-args', '--params-file', str(file), '-r', '__node:=renamed']
    owner = ros.make(
        LifecycleNode,
        {'global_costmap.global_costmap.height': 2},
        node_name='planner_server',
        namespace='robot1',
        cli_args=arguments,
    )
    costmap = make_costmap(owner, 'global_costmap')
    assert owner.get_fully_qualified_name() == '/robot1/renamed'
    assert costmap.get_fully_qualified_name() == '/robot1/global_costmap/global_costmap'
    assert costmap in owner.companions
    assert costmap.trigger_configure().name == 'SUCCESS'
    assert costmap.grid.cells.shape == (40, 80)
    assert costmap.resolve_beside('scan') == '/robot1/scan'
    assert costmap.resolve_beside('/scan') == '/scan'


def test_scan_marks_clears_and_inflates(world):
    """What a scanner sees is an obstacle with higher costs around, until it sees through."""
    costmap = make(world, LOCAL)
    world.start(costmap)
    ros = world.ros

    def sees(range_m):
        world.scan([range_m] * 90)
        ros.spin(0.02)
        return costmap.grid

    ros.wait_until(lambda: sees(1.02).cost_at(1.02, 0.01) == LETHAL_OBSTACLE, what='an obstacle')
    assert costmap.is_current
    assert costmap.grid.cells.shape == (60, 60)
    assert costmap.grid.cost_at(0.92, 0.01) == INSCRIBED_INFLATED_OBSTACLE
    assert 0 < costmap.grid.cost_at(0.6, 0.0) < INSCRIBED_INFLATED_OBSTACLE
    assert costmap.grid.cost_at(0.0, 0.0) == FREE_SPACE
    ros.wait_until(lambda: sees(1.42).cost_at(1.02, 0.01) != LETHAL_OBSTACLE, what='the way free')


def test_costmap_follows_the_robot(world):
    """A rolling costmap keeps what it saw at the same place when the robot moves."""
    costmap = make(world, LOCAL)
    world.start(costmap)
    ros = world.ros

    def sees_wall():
        world.scan([1.02 if abs(index - 45) < 3 else 5.0 for index in range(90)])
        ros.spin(0.02)
        return costmap.grid.cost_at(1.02, 0.01) == LETHAL_OBSTACLE

    ros.wait_until(sees_wall, what='an obstacle')
    world.places['odom', 'base_link'] = (0.5, 0.0)
    ros.wait_until(lambda: abs(costmap.grid.origin_x + 1.0) < 0.051, what='the costmap to move')
    assert costmap.grid.cost_at(1.02, 0.01) == LETHAL_OBSTACLE
    assert abs(costmap.robot_pose().x - 0.5) < 1e-6


def test_map_makes_the_size(world):
    """A map is taken with free, occupied and unknown cells, and its size is the costmap's."""
    cells = np.zeros((40, 60), int)
    cells[:, 30] = 100
    cells[:5, :5] = -1
    world.maps.publish(world.grid(cells, origin=(-1.0, -2.0)))
    costmap = make(world, GLOBAL, 'global_costmap')
    world.start(costmap)
    world.ros.wait_until(lambda: costmap.is_current, what='the map')
    assert costmap.grid.cells.shape == (40, 60)
    assert (costmap.grid.origin_x, costmap.grid.origin_y) == (-1.0, -2.0)
    assert costmap.grid.resolution == 0.1
    assert (costmap.grid.cells[10:, 30] == LETHAL_OBSTACLE).all()
    assert costmap.grid.cells[2, 2] == NO_INFORMATION
    assert costmap.grid.cells[20, 32] == INSCRIBED_INFLATED_OBSTACLE


def test_another_map_takes_the_place_of_the_first(world):
    """A costmap is never empty when a new map comes, however seldom it is updated."""
    walls = np.zeros((40, 60), int)
    walls[:, 30] = 100
    world.maps.publish(world.grid(walls))
    costmap = make(world, {**GLOBAL, 'update_frequency': 0.2}, 'global_costmap')
    world.start(costmap)
    world.ros.wait_until(lambda: costmap.grid.cells.any(), what='the map')
    world.ros.spin(0.1)
    larger = np.zeros((50, 70), int)
    larger[:, 30] = 100
    world.maps.publish(world.grid(larger))
    world.ros.wait_until(lambda: costmap.grid.cells.shape == (50, 70), what='the other map')
    assert (costmap.grid.cells[10:, 30] == LETHAL_OBSTACLE).all()


def test_map_in_another_frame_is_transformed(world):
    """A rolling costmap in odom takes the part of a map in map that is around the robot."""
    cells = np.zeros((60, 60), int)
    cells[:, 40] = 100
    world.places['map', 'odom'] = (2.0, 3.0)
    world.maps.publish(world.grid(cells))
    parameters = {**LOCAL, 'plugins': ['static_layer'], 'static_layer.map_topic': 'map'}
    costmap = make(world, parameters)
    world.start(costmap)
    world.ros.wait_until(
        lambda: (
            costmap.grid.cost_at(2.05 - 1.0, 0.0) == FREE_SPACE
            and costmap.grid.cost_at(2.05 - 0.95, 0.0) == FREE_SPACE
            and costmap.is_current
        ),
        what='the map',
    )
    # The wall is at x = 4.0 to 4.1 in map, which is 2.0 to 2.1 in odom: beyond the window.
    world.places['odom', 'base_link'] = (1.0, 0.0)
    world.ros.wait_until(
        lambda: costmap.grid.cost_at(2.05, 0.0) == LETHAL_OBSTACLE, what='the wall'
    )


def test_updates_of_the_map(world):
    """Parts of the map come from the topic of updates."""
    updates = world.node.create_publisher(OccupancyGridUpdate, '/map_updates', 10)
    world.maps.publish(world.grid(np.zeros((40, 40))))
    parameters = {**GLOBAL, 'static_layer.subscribe_to_updates': True}
    costmap = make(world, parameters, 'global_costmap')
    world.start(costmap)
    world.ros.wait_until(lambda: costmap.is_current, what='the map')
    message = OccupancyGridUpdate(x=10, y=20, width=2, height=1, data=[100, 100])

    def has_update():
        updates.publish(message)
        world.ros.spin(0.02)
        return costmap.grid.cells[20, 11] == LETHAL_OBSTACLE

    world.ros.wait_until(has_update, what='the update')
    assert costmap.grid.cells[20, 12] == INSCRIBED_INFLATED_OBSTACLE


def test_services_clear_and_tell_costs(world):
    """Obstacles are forgotten as services say, and costs are told."""
    costmap = make(world, LOCAL)
    world.start(costmap)
    ros = world.ros

    def sees_wall():
        world.scan([1.22] * 180)
        ros.spin(0.02)
        return costmap.grid.cost_at(1.22, 0.01) == LETHAL_OBSTACLE

    ros.wait_until(sees_wall, what='an obstacle')
    # The newest scan counts again after clearing; take it away.
    for source in next(iter(costmap.layers))._sources:
        source._kept.clear()
        source._waiting.clear()
    call, name = ros.call, '/local_costmap/{}_local_costmap'.format
    ask = GetCost.Request(x=1.22, y=0.01)
    assert call(GetCost, name('get_cost'), ask).cost == LETHAL_OBSTACLE
    assert call(GetCost, name('get_cost'), GetCost.Request(x=50.0)).cost == -1.0
    told = call(GetCostmap, '/local_costmap/get_costmap').map
    assert told.metadata.size_x == 60 and max(told.data) == LETHAL_OBSTACLE
    call(
        ClearCostmapAroundRobot,
        name('clear_around'),
        ClearCostmapAroundRobot.Request(reset_distance=1.0),
    )
    assert costmap.grid.cost_at(1.22, 0.01) == LETHAL_OBSTACLE
    call(
        ClearCostmapExceptRegion,
        name('clear_except'),
        ClearCostmapExceptRegion.Request(reset_distance=2.6),
    )
    assert costmap.grid.cost_at(1.22, 0.01) == LETHAL_OBSTACLE
    call(ClearEntireCostmap, name('clear_entirely'))
    assert costmap.grid.cells.max() == FREE_SPACE


def test_topics(world):
    """Who subscribes late gets the whole costmap, then what changes."""
    costmap = make(world, GLOBAL, 'global_costmap')
    world.start(costmap)
    world.maps.publish(world.grid(np.zeros((40, 60))))
    ros, heard = world.ros, {}
    ros.wait_until(lambda: costmap.is_current, what='the map')

    def listen(kind, topic):
        heard[topic] = []
        full = f'/global_costmap/{topic}'
        world.node.create_subscription(
            kind, full, heard[topic].append, 1 if 'footprint' in topic else LATCHED
        )

    listen(OccupancyGrid, 'costmap')
    listen(Costmap, 'costmap_raw')
    listen(PolygonStamped, 'published_footprint')
    listen(OccupancyGrid, 'static_layer')
    listen(Costmap, 'obstacle_layer_raw')
    ros.wait_until(lambda: all(heard.values()), what='all topics')
    listen(OccupancyGridUpdate, 'costmap_updates')

    ranges = itertools.cycle([1.55, 1.85])

    def is_updated():
        world.scan([next(ranges)] * 90)
        ros.spin(0.02)
        return heard['costmap_updates']

    ros.wait_until(is_updated, what='an update')
    assert heard['costmap'][0].info.width == heard['static_layer'][-1].info.width == 60
    assert heard['obstacle_layer_raw'][-1].metadata.layer == 'obstacle_layer'
    assert heard['costmap_raw'][0].metadata.resolution == pytest.approx(0.1)
    assert heard['published_footprint'][0].header.frame_id == 'map'
    update = heard['costmap_updates'][-1]
    assert len(update.data) == update.width * update.height
    assert any(max(each.data) == 100 for each in heard['costmap_updates'])


def test_who_comes_again_gets_what_is_new(world):
    """A subscriber that takes the place of another one gets the whole costmap as it is now."""
    costmap = make(world, {**LOCAL, 'publish_frequency': 10.0})
    world.start(costmap)
    ros, node, wholes = world.ros, world.node, []

    def listen():
        return node.create_subscription(
            OccupancyGrid, '/local_costmap/costmap', wholes.append, LATCHED
        )

    first = listen()
    ros.wait_until(lambda: wholes, what='the costmap')

    def sees_wall():
        world.scan([1.22] * 90)
        ros.spin(0.02)
        return costmap.grid.cost_at(1.22, 0.01) == LETHAL_OBSTACLE

    ros.wait_until(sees_wall, what='an obstacle')
    ros.spin(0.15)
    node.destroy_subscription(first)
    listen()
    ros.wait_until(lambda: max(wholes[-1].data) == 100, 5.0, 'the costmap with the obstacle')


def test_footprint_topic_changes_the_inflation(world):
    """A footprint from the topic takes the place of that of the parameters."""
    costmap = make(
        world, {**LOCAL, 'footprint': '[[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]]'}
    )
    world.start(costmap)
    assert not costmap.is_circular
    assert np.allclose(np.abs(costmap.footprint), [0.21, 0.11])
    publisher = world.node.create_publisher(Polygon, '/local_costmap/footprint', 10)
    corners = [(0.3, 0.3), (0.3, -0.3), (-0.3, -0.3), (-0.3, 0.3)]
    polygon = Polygon(points=[Point32(x=x, y=y) for x, y in corners])

    def is_taken():
        publisher.publish(polygon)
        world.ros.spin(0.02)
        return np.allclose(np.abs(costmap.footprint), 0.31)

    world.ros.wait_until(is_taken, what='the footprint')


def test_parameters_change(world):
    """The radius of inflation and the footprint change while the node runs."""
    costmap = make(world, LOCAL)
    world.start(costmap)

    def set_to(name, value):
        request = SetParameters.Request(
            parameters=[Parameter(name, value=value).to_parameter_msg()]
        )
        return world.ros.call(
            SetParameters, '/local_costmap/local_costmap/set_parameters', request
        ).results[0]

    assert set_to('robot_radius', 0.4).successful
    assert costmap.radius == pytest.approx(0.41, abs=0.01)
    assert set_to('inflation_layer.inflation_radius', 0.2).successful
    refused = set_to('footprint', '[[1, 2]')
    assert not refused.successful and 'list of corners' in refused.reason


def test_clouds_count_between_heights(world):
    """Points of a cloud mark between the lowest and the highest height."""
    parameters = {
        **LOCAL,
        'obstacle_layer.scan.data_type': 'PointCloud2',
        'obstacle_layer.scan.topic': '/points',
    }
    parameters['obstacle_layer.scan.min_obstacle_height'] = 0.1
    costmap = make(world, parameters)
    world.start(costmap)
    publisher = world.node.create_publisher(PointCloud2, '/points', qos_profile_sensor_data)
    points = np.array(
        [[1.02, 0.01, 0.5], [0.0, 1.0, 0.05], [-1.0, 0.0, 2.5], [np.nan] * 3], np.float32
    )
    cloud = PointCloud2(height=1, width=4, point_step=12, row_step=48, data=points.tobytes())
    cloud.fields = [
        PointField(name=axis, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, axis in enumerate('xyz')
    ]
    cloud.header.frame_id = 'base_link'

    def is_marked():
        cloud.header.stamp = world.node.get_clock().now().to_msg()
        publisher.publish(cloud)
        world.ros.spin(0.02)
        return costmap.grid.cost_at(1.02, 0.01) == LETHAL_OBSTACLE

    world.ros.wait_until(is_marked, what='a point')
    assert costmap.grid.cost_at(0.0, 1.0) == FREE_SPACE
    assert costmap.grid.cost_at(-1.0, 0.0) == FREE_SPACE


def test_range_sensors_mark(world):
    """A sonar that sees something marks the end of its cone."""
    parameters = {
        **LOCAL,
        'plugins': ['sonar'],
        'sonar.plugin': 'nav2_costmap_2d::RangeSensorLayer',
        'sonar.topics': ['/sonar'],
    }
    costmap = make(world, parameters)
    world.start(costmap)
    publisher = world.node.create_publisher(Range, '/sonar', qos_profile_sensor_data)
    message = Range(field_of_view=0.3, min_range=0.1, max_range=2.0, range=1.02)
    message.header.frame_id = 'base_link'

    def is_marked():
        message.header.stamp = world.node.get_clock().now().to_msg()
        publisher.publish(message)
        world.ros.spin(0.02)
        return costmap.grid.cost_at(1.02, 0.01) == LETHAL_OBSTACLE

    world.ros.wait_until(is_marked, what='an obstacle')
    assert costmap.grid.cost_at(0.5, 0.0) == FREE_SPACE


def test_filters(world):
    """Areas of masks are obstacles, and have speed limits, until a service says otherwise."""
    world.maps.publish(world.grid(np.zeros((60, 60)), origin=(-3.0, -3.0)))
    keepout = np.zeros((60, 60))
    keepout[:10] = 100
    node, publishers = world.node, []
    for name, kind, mask, base, factor in (
        ('keepout', 0, keepout, 0.0, 1.0),
        ('speed', 1, np.full((60, 60), 40), 100.0, -1.0),
    ):
        info = CostmapFilterInfo(
            type=kind, filter_mask_topic=f'/{name}_mask', base=base, multiplier=factor
        )
        for message, topic in (
            (info, f'/{name}_info'),
            (world.grid(mask, origin=(-3.0, -3.0)), f'/{name}_mask'),
        ):
            publishers.append(node.create_publisher(type(message), topic, LATCHED))
            publishers[-1].publish(message)
    limits = []
    node.create_subscription(SpeedLimit, '/speed_limit', limits.append, 10)
    parameters = {
        **GLOBAL,
        'filters': ['keepout_filter', 'speed_filter'],
        'keepout_filter.plugin': 'nav2_costmap_2d::KeepoutFilter',
        'keepout_filter.filter_info_topic': '/keepout_info',
        'speed_filter.plugin': 'nav2_costmap_2d::SpeedFilter',
        'speed_filter.filter_info_topic': 'speed_info',
        'speed_filter.speed_limit_topic': 'speed_limit',
    }
    costmap = make(world, parameters, 'global_costmap')
    world.ros.spin(0.3)
    world.start(costmap)
    world.ros.wait_until(
        lambda: costmap.grid.cost_at(0.0, -2.5) == LETHAL_OBSTACLE and costmap.is_current,
        what='the keepout area',
    )
    assert costmap.grid.cost_at(0.0, 0.0) == FREE_SPACE
    world.ros.wait_until(lambda: limits, what='a limit of speed')
    assert limits[0].percentage and limits[0].speed_limit == 60.0
    toggled = world.ros.call(
        SetBool, '/global_costmap/keepout_filter/toggle_filter', SetBool.Request(data=False)
    )
    assert toggled.success
    world.ros.wait_until(
        lambda: costmap.grid.cost_at(0.0, -2.5) == FREE_SPACE, what='the area to be free'
    )


@pytest.mark.parametrize(
    ('parameters', 'said'),
    [
        (
            {'static_layer.plugin': 'nav2_costmap_2d::StatikLayer'},
            "Did you mean 'nav2_costmap_2d::StaticLayer'",
        ),
        ({'plugins': ['extra']}, "The parameter 'extra.plugin' is not set"),
        ({'footprint': '[[1, 2]]'}, 'at least three corners'),
        (
            {'filters': ['keepout'], 'keepout.plugin': 'nav2_costmap_2d::KeepoutFilter'},
            "'keepout.filter_info_topic'",
        ),
    ],
)
def test_wrong_parameters_are_sentences(world, parameters, said, capfd):
    """A costmap that cannot be configured says why, and what to set."""
    costmap = make(world, parameters)
    assert costmap.trigger_configure().name == 'FAILURE'
    assert said in capfd.readouterr().err


def test_lifecycle_repeats(world):
    """A costmap is cleaned up and configured once more."""
    costmap = make(world, LOCAL)
    for _ in range(2):
        world.start(costmap)
        world.ros.wait_until(lambda: costmap.is_current, what='the costmap')
        assert costmap.trigger_deactivate().name == 'SUCCESS'
        assert costmap.trigger_cleanup().name == 'SUCCESS'
    assert not costmap.is_current


def test_binary_filter_and_what_has_no_limit(world):
    """A state flips in areas of a mask; where a mask of speeds is 0 there is no limit."""
    node, states, limits, publishers = world.node, [], [], []
    mask = np.zeros((60, 60))
    mask[:, 35:] = 80
    for name, kind, base, factor in (('binary', 3, 0.0, 1.0), ('speed', 2, 0.0, 0.01)):
        info = CostmapFilterInfo(
            type=kind, filter_mask_topic=f'{name}_mask', base=base, multiplier=factor
        )
        for message, topic in (
            (info, f'/{name}_info'),
            (world.grid(mask, 'odom', origin=(-3.0, -3.0)), f'/{name}_mask'),
        ):
            publishers.append(node.create_publisher(type(message), topic, LATCHED))
            publishers[-1].publish(message)
    node.create_subscription(Bool, '/binary_state', states.append, 10)
    node.create_subscription(SpeedLimit, '/speed_limit', limits.append, 10)
    parameters = {
        **LOCAL,
        'filters': ['binary', 'speed'],
        'binary.plugin': 'nav2_costmap_2d::BinaryFilter',
        'binary.filter_info_topic': 'binary_info',
        'speed.plugin': 'nav2_costmap_2d::SpeedFilter',
        'speed.filter_info_topic': 'speed_info',
    }
    costmap = make(world, parameters)
    world.ros.spin(0.3)
    world.start(costmap)
    world.ros.wait_until(lambda: states, what='the first state')
    assert not states[0].data
    world.places['odom', 'base_link'] = (1.0, 0.0)
    world.ros.wait_until(lambda: len(states) > 1 and limits, what='another state, and a limit')
    assert states[1].data
    assert not limits[0].percentage and limits[0].speed_limit == pytest.approx(0.8)
    world.places['odom', 'base_link'] = (0.0, 0.0)
    world.ros.wait_until(lambda: len(limits) > 1, what='no limit')
    assert limits[1].speed_limit == 0.0


def test_wrong_messages_do_not_stop_a_costmap(world, capfd):
    """Maps, clouds and footprints that are not as they say are not used, and named."""
    parameters = {
        **LOCAL,
        'plugins': ['static_layer', 'obstacle_layer'],
        'obstacle_layer.scan.data_type': 'PointCloud2',
        'obstacle_layer.scan.topic': '/points',
    }
    costmap = make(world, parameters)
    world.start(costmap)
    clouds = world.node.create_publisher(PointCloud2, '/points', qos_profile_sensor_data)
    cloud = PointCloud2(height=1, width=4, point_step=12, row_step=48, data=b'1234')
    cloud.fields = [
        PointField(name=axis, offset=4 * index, datatype=PointField.FLOAT32, count=1)
        for index, axis in enumerate('xyz')
    ]
    cloud.header.frame_id = 'base_link'
    shapes = world.node.create_publisher(Polygon, '/local_costmap/footprint', 10)
    broken = world.grid(np.zeros((3, 3)))
    broken.info.width = 7
    said = ''

    def all_named():
        nonlocal said
        cloud.header.stamp = world.node.get_clock().now().to_msg()
        clouds.publish(cloud)
        shapes.publish(Polygon())
        world.maps.publish(broken)
        world.ros.spin(0.05)
        said += capfd.readouterr().err
        return all(
            each in said for each in ('does not fit its description', '7 x 3', 'three corners')
        )

    world.ros.wait_until(all_named, what='three sentences')
    assert costmap.is_active


def test_parameters_of_layers_that_are_not_used(world, capfd):
    """A layer in a parameter file that is in no list is named, as is a voxel map."""
    parameters = {
        **LOCAL,
        'plugins': ['voxel_layer'],
        'voxel_layer.plugin': 'nav2_costmap_2d::VoxelLayer',
        'voxel_layer.publish_voxel_map': True,
        'static_layer.plugin': 'nav2_costmap_2d::StaticLayer',
    }
    costmap = make(world, parameters)
    assert costmap.trigger_configure().name == 'SUCCESS'
    said = capfd.readouterr().err
    assert "'static_layer' is in neither 'plugins' nor 'filters'" in said
    assert "'voxel_layer.publish_voxel_map' has no effect" in said


def test_simulated_time(ros):
    """With simulated time a costmap works as /clock goes on, also after a jump back."""
    clock = ros.node('simulator').create_publisher(Clock, '/clock', 1)
    world = World(ros, parameter_overrides=[Parameter('use_sim_time', value=True)])
    costmap = make(world, {**LOCAL, 'use_sim_time': True, 'update_frequency': 20.0})
    world.start(costmap)
    now_ns = 10**11

    def sees(range_m):
        nonlocal now_ns
        now_ns += 20_000_000
        clock.publish(Clock(clock=Time(nanoseconds=now_ns).to_msg()))
        ros.spin(0.01)
        world.scan([range_m] * 90)
        ros.spin(0.01)
        return costmap.grid.cost_at(range_m, 0.01) == LETHAL_OBSTACLE and costmap.is_current

    ros.wait_until(lambda: sees(1.02), what='an obstacle')
    now_ns = 10**9
    ros.wait_until(lambda: sees(1.22), what='an obstacle after the jump')
