# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid see: a detector of objects, a memory of them, and a head that looks."""

from __future__ import annotations

from humanoid_perception.places_choice import places_choice
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = (
    ('detector_backend', 'onnx', 'The detector: a YOLO network (onnx), or colours (colour).'),
    ('model_path', '', 'The ONNX file of a YOLO network; empty for the one in this package.'),
    ('labels_file', '', 'Names of its classes; empty for the names in the model.'),
    (
        'places_file',
        '',
        'Named places: a file, or the name of one in this package; by default, that of the scene.',
    ),
    (
        'perception_params_file',
        PathJoinSubstitution(
            [FindPackageShare('humanoid_perception'), 'config', 'perception.yaml']
        ),
        'Parameter file of the nodes.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
)


def generate_launch_description() -> LaunchDescription:
    """Start the three nodes."""
    detector = {
        'backend': LaunchConfiguration('detector_backend'),
        'model_path': LaunchConfiguration('model_path'),
        'labels_file': LaunchConfiguration('labels_file'),
    }
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            _node('object_detector', detector),
            _node('object_memory', {'places_file': places_choice()}),
            _node('gaze', {}),
        ]
    )


def _node(name: str, parameters: dict[str, object]) -> Node:
    """Describe a node of this package, which is started anew if it ends."""
    return Node(
        package='humanoid_perception',
        executable=name,
        namespace=LaunchConfiguration('namespace'),
        output='screen',
        respawn=True,
        respawn_delay=2.0,
        parameters=[
            LaunchConfiguration('perception_params_file'),
            {'use_sim_time': LaunchConfiguration('use_sim_time'), **parameters},
        ],
    )
