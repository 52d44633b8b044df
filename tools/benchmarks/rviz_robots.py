# SPDX-License-Identifier: Apache-2.0
"""Robots for the measurement of `rviz2`: descriptions, and continuously changing transforms.

One process replaces the `robot_state_publisher` of each robot, since those would use the cores on
which `rviz2` is measured. `python3 rviz_robots.py COUNT RATE_HZ` runs until it is ended.
"""

from __future__ import annotations

from math import sin
import struct
import sys
import time
from typing import Any

from geometry_msgs.msg import TransformStamped
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from urdf import parse_urdf, RobotModel
from urdf.kinematics import joint_motion

JOINTS = 23
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PHASES = 50
STAMP = struct.pack('<iI', 0x12345678, 0x23456789)
BODY = '<visual><geometry><box size="0.1 0.1 0.2"/></geometry></visual>'


def main() -> None:
    """Publish until the process is ended."""
    count, rate_hz = int(sys.argv[1]), float(sys.argv[2])
    rclpy.init()
    node = rclpy.create_node('robots')
    stand = [describe(node, f'robot_{index}', index) for index in range(count)]
    static = node.create_publisher(TFMessage, '/tf_static', LATCHED)
    static.publish(TFMessage(transforms=stand))
    moving = node.create_publisher(TFMessage, '/tf', 100)
    robots = [phases(f'robot_{index}') for index in range(count)]
    begin_s, number = time.monotonic(), 0
    while True:
        for robot in robots:
            moving.publish(stamped(robot[number % PHASES]))
        number += 1
        time.sleep(max(0.0, begin_s + number / rate_hz - time.monotonic()))


def urdf() -> str:
    """Return the URDF of a robot with two arms and two legs, all of whose joints rotate."""
    links = ''.join(f'<link name="link_{index}">{BODY}</link>' for index in range(JOINTS + 1))
    joints = ''.join(
        f'<joint name="joint_{index}" type="continuous"><parent link="link_{above(index)}"/>'
        f'<child link="link_{index + 1}"/><origin xyz="{index % 4 / 20} 0 0.1"/>'
        f'<axis xyz="{("1 0 0", "0 1 0", "0 0 1")[index % 3]}"/></joint>'
        for index in range(JOINTS)
    )
    return f'<robot name="robot">{links}{joints}</robot>'


def above(index: int) -> int:
    """
    Return the index of the parent link of a joint: six joints in a row form a limb.

    Parameters
    ----------
    index
        The index of the joint, counted from 0.

    """
    return 0 if index % 6 == 0 else index


def describe(node: Any, name: str, index: int) -> TransformStamped:
    """
    Publish the description of a robot; return the transform from the map to its first link.

    Parameters
    ----------
    node
        The node of rclpy that publishes it.
    name
        The name of the robot, which is the prefix of its topic and frames.
    index
        Its index, which is its position along y in m.

    """
    publisher = node.create_publisher(String, f'/{name}/robot_description', LATCHED)
    publisher.publish(String(data=urdf()))
    transform = TransformStamped(child_frame_id=f'{name}/link_0')
    transform.header.frame_id = 'map'
    transform.transform.translation.y = float(index)
    return transform


def phases(name: str) -> list[bytes]:
    """
    Serialize the transforms of a robot over one period of its motion.

    Parameters
    ----------
    name
        The name of the robot, which is the prefix of its frames.

    Returns
    -------
    list of bytes
        `PHASES` messages for `/tf`, whose stamps `stamped` replaces.

    """
    model = parse_urdf(urdf())
    return [serialize_message(pose_of(model, name, number)) for number in range(PHASES)]


def pose_of(model: RobotModel, name: str, number: int) -> TFMessage:
    """
    Compute the transforms of all joints in one pose, with the stamp `STAMP`.

    Parameters
    ----------
    model
        The robot.
    name
        The prefix of its frames.
    number
        The phase of the motion, from 0 to below `PHASES`.

    """
    transforms = []
    for index, joint in enumerate(model.joints):
        transform = TransformStamped(child_frame_id=f'{name}/{joint.child}')
        transform.header.frame_id = f'{name}/{joint.parent}'
        stamp = transform.header.stamp
        stamp.sec, stamp.nanosec = struct.unpack('<iI', STAMP)
        pose = joint_motion(joint)(0.5 * sin(6.283 * number / PHASES + index))
        at, turn = transform.transform.translation, transform.transform.rotation
        at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = pose
        transforms.append(transform)
    return TFMessage(transforms=transforms)


def stamped(message: bytes) -> bytes:
    """
    Replace the stamps of a serialized message by the current time.

    Parameters
    ----------
    message
        One of `phases`.

    """
    now_ns = time.time_ns()
    return message.replace(STAMP, struct.pack('<iI', now_ns // 10**9, now_ns % 10**9))


if __name__ == '__main__':
    main()
