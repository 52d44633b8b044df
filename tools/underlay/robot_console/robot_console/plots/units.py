# SPDX-License-Identifier: Apache-2.0
"""
In which units the numbers of messages are, by REP-103 and the definitions of the messages.

Units are SI units and those derived from them, as REP-103 demands: angles are in rad, and
temperatures in °C. Unknown fields and numbers without a unit, such as those of quaternions, have
none.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

__all__ = ['FIELDS', 'NAMES', 'shared_unit', 'unit_of']

JOINT_POSITION, JOINT_VELOCITY, JOINT_EFFORT = 'rad or m', 'rad/s or m/s', 'N m or N'
"""Of revolute or prismatic joints: messages do not say which."""
JOINT_ACCELERATION = 'rad/s² or m/s²'
TIME = {'sec': 's', 'nanosec': 'ns'}
POINT = dict.fromkeys('xyz', 'm')
INERTIA = ('ixx', 'ixy', 'ixz', 'iyy', 'iyz', 'izz')

VECTOR = 'geometry_msgs/Vector3'
"""Its numbers have the unit of the field that the vector is in."""

FIELDS: Mapping[str, Mapping[str, str]] = {
    'builtin_interfaces/Duration': TIME,
    'builtin_interfaces/Time': TIME,
    'geometry_msgs/Accel': {'linear': 'm/s²', 'angular': 'rad/s²'},
    'geometry_msgs/Inertia': {'m': 'kg', 'com': 'm', **dict.fromkeys(INERTIA, 'kg m²')},
    'geometry_msgs/Point': POINT,
    'geometry_msgs/Point32': POINT,
    'geometry_msgs/Pose2D': {'x': 'm', 'y': 'm', 'theta': 'rad'},
    'geometry_msgs/Transform': {'translation': 'm'},
    'geometry_msgs/Twist': {'linear': 'm/s', 'angular': 'rad/s'},
    'geometry_msgs/Wrench': {'force': 'N', 'torque': 'N m'},
    'nav_msgs/MapMetaData': {'resolution': 'm'},
    'sensor_msgs/BatteryState': {
        'voltage': 'V',
        'temperature': '°C',
        'current': 'A',
        'charge': 'A h',
        'capacity': 'A h',
        'design_capacity': 'A h',
        'cell_voltage': 'V',
        'cell_temperature': '°C',
    },
    'sensor_msgs/FluidPressure': {'fluid_pressure': 'Pa'},
    'sensor_msgs/Illuminance': {'illuminance': 'lx'},
    'sensor_msgs/Imu': {'angular_velocity': 'rad/s', 'linear_acceleration': 'm/s²'},
    'sensor_msgs/JointState': {
        'position': JOINT_POSITION,
        'velocity': JOINT_VELOCITY,
        'effort': JOINT_EFFORT,
    },
    'sensor_msgs/LaserScan': {
        **dict.fromkeys(('angle_min', 'angle_max', 'angle_increment'), 'rad'),
        **dict.fromkeys(('time_increment', 'scan_time'), 's'),
        **dict.fromkeys(('range_min', 'range_max', 'ranges'), 'm'),
    },
    'sensor_msgs/MagneticField': {'magnetic_field': 'T'},
    'sensor_msgs/NavSatFix': {'latitude': '°', 'longitude': '°', 'altitude': 'm'},
    'sensor_msgs/Range': {
        'field_of_view': 'rad',
        **dict.fromkeys(('min_range', 'max_range', 'range'), 'm'),
    },
    'sensor_msgs/Temperature': {'temperature': '°C'},
    'trajectory_msgs/JointTrajectoryPoint': {
        'positions': JOINT_POSITION,
        'velocities': JOINT_VELOCITY,
        'accelerations': JOINT_ACCELERATION,
        'effort': JOINT_EFFORT,
    },
    'visualization_msgs/Marker': {'scale': 'm'},
}
"""The units of the fields of message types, of numbers and of what holds numbers."""

NAMES: Mapping[str, str] = {
    'angular_acceleration': 'rad/s²',
    'angular_velocity': 'rad/s',
    'linear_acceleration': 'm/s²',
    'linear_velocity': 'm/s',
    'temperature': '°C',
    'voltage': 'V',
}
"""The units of fields of other types, by names that REP-103 leaves no choice for."""


def unit_of(fields: Sequence[tuple[str, str]]) -> str:
    """
    Return the unit of a number in a message.

    Parameters
    ----------
    fields
        The fields on the way to the number, from the outermost on: the type of the message that
        has the field, such as `sensor_msgs/msg/Imu` or `sensor_msgs/Imu`, and its name.

    Returns
    -------
    str
        For example `rad/s`; '' if it is unknown, or if there is none.

    """
    for kind, name in reversed(fields):
        message = kind.replace('/msg/', '/')
        if message != VECTOR:
            return FIELDS.get(message, NAMES).get(name, '')
    return ''


def shared_unit(units: Iterable[str]) -> str:
    """
    Return the unit that all of several numbers have; '' if they differ, or if there is none.

    Parameters
    ----------
    units
        Their units, as returned by `unit_of`.

    """
    found = set(units)
    return found.pop() if len(found) == 1 else ''
