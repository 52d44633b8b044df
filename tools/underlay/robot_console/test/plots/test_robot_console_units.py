# SPDX-License-Identifier: Apache-2.0
"""In which units the numbers of messages are, and where a plot shows that."""

from __future__ import annotations

import pytest
from robot_console.plots.field_reader import FieldReader
from robot_console.plots.fields import element_type, is_message, is_number
from robot_console.plots.plot_board import PlotBoard
from robot_console.plots.plot_chart import legend_html
from robot_console.plots.series import parse_path, parse_series
from robot_console.plots.topic_listener import fields_of
from robot_console.plots.units import FIELDS, shared_unit, unit_of, VECTOR
from sensor_msgs.msg import Imu, JointState


@pytest.mark.parametrize(
    ('kind', 'path', 'unit'),
    [
        ('sensor_msgs/msg/Imu', 'angular_velocity.z', 'rad/s'),
        ('sensor_msgs/msg/Imu', 'linear_acceleration.x', 'm/s²'),
        ('sensor_msgs/msg/Imu', 'orientation.w', ''),
        ('sensor_msgs/msg/Imu', 'linear_acceleration_covariance[0]', ''),
        ('sensor_msgs/msg/Imu', 'header.stamp.sec', 's'),
        ('sensor_msgs/msg/Imu', 'header.stamp.nanosec', 'ns'),
        ('sensor_msgs/msg/JointState', 'position[left_knee]', 'rad or m'),
        ('sensor_msgs/msg/JointState', 'velocity[0]', 'rad/s or m/s'),
        ('sensor_msgs/msg/JointState', 'effort[0]', 'N m or N'),
        ('sensor_msgs/msg/Temperature', 'temperature', '°C'),
        ('sensor_msgs/msg/Temperature', 'variance', ''),
        ('sensor_msgs/msg/LaserScan', 'ranges[3]', 'm'),
        ('sensor_msgs/msg/LaserScan', 'intensities[3]', ''),
        ('nav_msgs/msg/Odometry', 'pose.pose.position.x', 'm'),
        ('nav_msgs/msg/Odometry', 'pose.covariance[0]', ''),
        ('nav_msgs/msg/Odometry', 'twist.twist.linear.x', 'm/s'),
        ('nav_msgs/msg/Odometry', 'twist.twist.angular.z', 'rad/s'),
        ('geometry_msgs/msg/TransformStamped', 'transform.translation.z', 'm'),
        ('geometry_msgs/msg/TransformStamped', 'transform.rotation.z', ''),
        ('geometry_msgs/msg/WrenchStamped', 'wrench.force.z', 'N'),
        ('geometry_msgs/msg/WrenchStamped', 'wrench.torque.z', 'N m'),
        ('geometry_msgs/msg/Vector3Stamped', 'vector.x', ''),
        ('geometry_msgs/msg/PolygonStamped', 'polygon.points[0].x', 'm'),
        ('trajectory_msgs/msg/JointTrajectory', 'points[0].positions[0]', 'rad or m'),
        ('std_msgs/msg/Float64', 'data', ''),
    ],
)
def test_units_of_messages(kind: str, path: str, unit: str) -> None:
    """Numbers have the unit of their field, or of the field whose vector they are in."""
    assert FieldReader(parse_path(f'topic.{path}'), kind, fields_of).unit == unit


def test_units_by_name() -> None:
    """Of types that nobody knows, only names count that leave no choice."""
    assert unit_of([('a/msg/Motor', 'temperature')]) == '°C'
    assert unit_of([('a/msg/Motor', 'angular_velocity'), (VECTOR, 'x')]) == 'rad/s'
    assert unit_of([('a/msg/Motor', 'temperature'), ('b/msg/Estimate', 'variance')]) == ''
    assert unit_of([('a/msg/Motor', 'position')]) == ''
    assert unit_of([]) == ''


@pytest.mark.parametrize('kind', FIELDS)
def test_fields_of_the_table_exist(kind: str) -> None:
    """Each field in the table is a field of the type that holds numbers, or a vector."""
    package, name = kind.split('/')
    fields = fields_of(f'{package}/msg/{name}')
    for field in FIELDS[kind]:
        each = element_type(fields[field]) or fields[field]
        assert is_number(each) or (is_message(each) and each == VECTOR), (kind, field)


def test_shared_unit() -> None:
    """Only what all have is shared."""
    assert shared_unit(['m', 'm']) == 'm'
    assert shared_unit(['m', 'rad']) == shared_unit(['m', '']) == shared_unit([]) == ''


def board(*series: str) -> PlotBoard:
    """Return a board with a value of each series."""
    board = PlotBoard(10.0)
    board.replace(map(parse_series, series))
    states = JointState(name=['knee'], position=[0.5], velocity=[0.25])
    for topic, message in (('imu', Imu()), ('js', states), ('jc', states)):
        board.find_type(topic, f'sensor_msgs/msg/{type(message).__name__}', fields_of)
        board.take(topic, message, 1.0)
    return board


def test_legend_shows_units_that_the_axis_cannot() -> None:
    """If all series have the same unit, it is at the axis; else in the legend."""
    same = board('js.position[knee]', 'jc.position[knee] - js.position[knee]')
    assert [each.unit for each in same.plotted] == ['rad or m'] * 2
    assert '<i>0.5</i>' in legend_html(same.plotted)
    other = board('js.position[knee]', 'imu.angular_velocity.z', 'imu.orientation.w')
    html = legend_html(other.plotted)
    assert '<i>0.5 rad or m</i>' in html and '<i>0 rad/s</i>' in html and '<i>1</i>' in html
    mixed = board('js.position[knee] - js.velocity[knee]', 'new.speed')
    assert [each.unit for each in mixed.plotted] == ['', '']
